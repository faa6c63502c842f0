// Exact and series solutions that cases are judged by. SI units, double precision.
#pragma once

#include <stdint.h>

extern const double weir_pi;

// Exponent b < 0 of the velocity e^{b t} of a Taylor-Green vortex of wavelength L in a fluid of kinematic viscosity nu:
// b = -8 pi^2 nu / L^2. The velocity at t = 0 for speed U is (-U cos kx sin ky, U sin kx cos ky), k = 2 pi / L.
double weir_taylor_green_exponent(double nu, double length);
void weir_taylor_green_velocity(double speed, double length, double decay, double x, double y,
                                double velocity[2]);

// Flow between plates y = 0 and y = L from rest: driven by an acceleration F (Poiseuille), or by the upper plate's speed
// V (Couette). Series of J. P. Morris, P. J. Fox, Y. Zhu, J. Comput. Phys. 136 (1997).
double weir_poiseuille_speed(double acceleration, double nu, double length, double y, double t);
double weir_couette_speed(double plate_speed, double nu, double length, double y, double t);

// Angular frequency of a small gravity wave: omega^2 = g k tanh(k H).
double weir_wave_frequency(double gravity, double wavenumber, double depth);

// Semi-axes at time t of a drop, a disc of `radius` at the start, in the strain flow (s x, -s y) and a central
// acceleration -Omega^2 x: s' = (s^2 + Omega^2)(b^2 - a^2)/(a^2 + b^2), a' = s a, b' = -s b.
// Omega = 0: J. J. Monaghan, J. Comput. Phys. 110 (1994).
void weir_drop_axes(double omega, double strain, double radius, double t, double axes[2]);
// Period of the oscillating drop: time from the start until a - b crosses zero upwards (strain > 0) again.
double weir_drop_period(double omega, double strain, double radius);
// Largest semi-axis of the oscillating drop.
double weir_drop_largest_axis(double omega, double strain, double radius);

// Pressure at the start in a square of side L that rotates like a rigid body, corner at the origin (A. Colagrossi,
// thesis, Rome 2005).
double weir_rotating_square_pressure(double rho, double omega, double length, double x, double y);

// Solitary wave of height a on still water of depth h (Rayleigh 1876): surface a sech^2(kappa (x - c t)), speed c = sqrt(g (h + a)),
// kappa = sqrt(3 a / (4 h^2 (h + a))).
double weir_solitary_speed(double gravity, double depth, double height);
double weir_solitary_surface(double depth, double height, double distance);
