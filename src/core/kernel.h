// Smoothing kernels of `mueller` in 2D and what follows from them: calibrated mass, pass constants,
// stable step.
//
// Sources: M. Mueller, D. Charypar, M. Gross, "Particle-based fluid simulation for interactive applications",
// SCA 2003. The paper's normalisations are for 3D; these are the same shapes normalised for the plane
// (docs/method.md). h is the support radius, r the distance, both in metres; every kernel is zero for r >= h.
#pragma once

#include "core/parameters.h"

// W(r) = 4 / (pi h^8) (h^2 - r^2)^3, in 1/m^2.
double weir_kernel_poly6(double r, double h);
// W(r) = 10 / (pi h^5) (h - r)^3, in 1/m^2.
double weir_kernel_spiky(double r, double h);
// dW/dr of the spiky kernel = -30 / (pi h^5) (h - r)^2, in 1/m^3.
double weir_kernel_spiky_gradient(double r, double h);
// Laplacian 40 / (pi h^5) (h - r), in 1/m^4: positive, so that viscosity only ever damps.
double weir_kernel_viscosity_laplacian(double r, double h);
// The kernel that sums density for a choice of `kernels`.
double weir_kernel_density(double r, double h, uint32_t kernels);

// Mass per particle that gives a resting square lattice of `particle_spacing` the rest density: rho0 / sum W.
double weir_calibrated_mass(const WeirParameters *parameters);
// Estimate of the largest stable time step in seconds: C h / (c + 3 v) with a Courant number C that falls
// with the ratio of support radius to spacing, fitted to measured limits (docs/method.md, "Time step");
// rounded down to two digits. `speed` v is the largest that the fluid can reach, m/s.
double weir_stable_time_step(const WeirParameters *parameters, double speed);
