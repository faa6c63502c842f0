// Smoothing kernels of `wcsph` in 1D, 2D and 3D, all with one support radius: what the passes evaluate in float,
// here in double, for constants, diagnostics and tests.
//
//   r in [0, R), s = r / R     W(r) = factor w(s)     (dW/dr) / r = gradient_factor g(s), never divided by r
//
// wendland  Wendland C2, R = 2h:       w = (1-s)^4 (4s+1)
// cubic     M4 spline, R = 2h, q = 2s: w = 1 - 3/2 q^2 + 3/4 q^3 (q < 1), (2-q)^3 / 4 (q < 2)
// quintic   M6 spline, R = 3h, q = 3s: w = (3-q)^5 - 6 (2-q)^5 + 15 (1-q)^5, each term only where positive
//
// Sources: H. Wendland, Adv. Comput. Math. 4 (1995); W. Dehnen, H. Aly, MNRAS 425 (2012); J. J. Monaghan,
// Rep. Prog. Phys. 68 (2005).
#pragma once

#include "core/parameters.h"

// W(r) in 1/m^dimension. `kernel`: WEIR_KERNEL_...; `support_radius` R in m.
double weir_smoothing_value(uint32_t kernel, uint32_t dimension, double r, double support_radius);
// (dW/dr) / r in 1/m^(dimension + 2): negative inside the support, finite at r = 0 for wendland and quintic (the
// cubic spline's too).
double weir_smoothing_gradient(uint32_t kernel, uint32_t dimension, double r, double support_radius);
// w(s) and g(s) alone; g is positive, so gradient_factor is negative.
double weir_smoothing_shape(uint32_t kernel, double s);
double weir_smoothing_slope(uint32_t kernel, double s);
// The two factors.
double weir_smoothing_factor(uint32_t kernel, uint32_t dimension, double support_radius);
double weir_smoothing_gradient_factor(uint32_t kernel, uint32_t dimension, double support_radius);
// Smoothing length h in m: R / 2, or R / 3 for the quintic spline.
double weir_smoothing_length(uint32_t kernel, double support_radius);

// Longest time step, s, with which laminar viscosity is stable: h^2 rho0 / (16 mu); FLT_MAX without viscosity. On a lattice, velocities that
// alternate along it decay at up to 18 mu / (rho0 h^2) by viscosity along the line between particles, and explicit steps
// amplify them from twice that time on; clumps are stiffer, so it is half of it. (h^2 rho0 / (8 mu), J. P. Morris et al., J. Comput. Phys.
// 136 (1997), is for viscosity that also acts across.)
double weir_viscous_step(const WeirParameters *parameters);
