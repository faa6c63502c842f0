#include "validation/analytic.h"

#include <math.h>

const double weir_pi = 3.14159265358979323846;

double weir_taylor_green_exponent(double nu, double length)
{
    return -8.0 * weir_pi * weir_pi * nu / (length * length);
}

void weir_taylor_green_velocity(double speed, double length, double decay, double x, double y,
                                double velocity[2])
{
    double k = 2.0 * weir_pi / length;
    velocity[0] = -speed * decay * cos(k * x) * sin(k * y);
    velocity[1] = speed * decay * sin(k * x) * cos(k * y);
}

double weir_poiseuille_speed(double acceleration, double nu, double length, double y, double t)
{
    double u = acceleration / (2.0 * nu) * y * (length - y);
    for (int n = 0; n < 100; ++n) {
        double m = 2.0 * n + 1.0, k = m * weir_pi / length;
        u -= 4.0 * acceleration * length * length / (nu * pow(weir_pi * m, 3.0)) * sin(k * y) *
             exp(-k * k * nu * t);
    }
    return u;
}

double weir_couette_speed(double plate_speed, double nu, double length, double y, double t)
{
    double u = plate_speed * y / length;
    for (int n = 1; n < 200; ++n) {
        double k = n * weir_pi / length;
        u += 2.0 * plate_speed / (n * weir_pi) * (n % 2 ? -1.0 : 1.0) * sin(k * y) * exp(-k * k * nu * t);
    }
    return u;
}

double weir_wave_frequency(double gravity, double wavenumber, double depth)
{
    return sqrt(gravity * wavenumber * tanh(wavenumber * depth));
}

// ---- Drops ----

// State a, b, s.
static void drop_rates(double omega, const double state[3], double rates[3])
{
    double a2 = state[0] * state[0], b2 = state[1] * state[1], s = state[2];
    rates[0] = s * state[0];
    rates[1] = -s * state[1];
    rates[2] = (s * s + omega * omega) * (b2 - a2) / (a2 + b2);
}

// Classical Runge-Kutta step of fourth order.
static void drop_step(double omega, double dt, double state[3])
{
    static const double share[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    double rates[3] = {0.0, 0.0, 0.0}, sum[3] = {0.0, 0.0, 0.0};
    for (int stage = 0; stage < 4; ++stage) {
        double at[3];
        for (int k = 0; k < 3; ++k) at[k] = state[k] + share[stage] * dt * rates[k];
        drop_rates(omega, at, rates);
        for (int k = 0; k < 3; ++k) sum[k] += weight[stage] * rates[k];
    }
    for (int k = 0; k < 3; ++k) state[k] += dt / 6.0 * sum[k];
}

void weir_drop_axes(double omega, double strain, double radius, double t, double axes[2])
{
    double state[3] = {radius, radius, strain}, scale = fmax(fabs(strain), omega);
    int steps = 1 + (int)ceil(400.0 * scale * t);
    for (int k = 0; k < steps; ++k) drop_step(omega, t / steps, state);
    axes[0] = state[0];
    axes[1] = state[1];
}

double weir_drop_period(double omega, double strain, double radius)
{
    double state[3] = {radius, radius, strain}, dt = 1e-3 / fmax(fabs(strain), omega), before = 0.0;
    for (int k = 1; k < 1000000; ++k) {
        drop_step(omega, dt, state);
        double now = state[0] - state[1];
        if (k > 1 && before < 0.0 && now >= 0.0) return dt * (k - now / (now - before));
        before = now;
    }
    return NAN;
}

double weir_drop_largest_axis(double omega, double strain, double radius)
{
    double state[3] = {radius, radius, strain}, dt = 1e-3 / fmax(fabs(strain), omega), largest = radius;
    for (int k = 0; k < 20000; ++k) {
        drop_step(omega, dt, state);
        largest = fmax(largest, fmax(state[0], state[1]));
    }
    return largest;
}

double weir_rotating_square_pressure(double rho, double omega, double length, double x, double y)
{
    double sum = 0.0;
    for (int m = 1; m < 200; m += 2) {
        for (int n = 1; n < 200; n += 2) {
            double kx = m * weir_pi / length, ky = n * weir_pi / length;
            sum += -32.0 * omega * omega * rho / (m * n * weir_pi * weir_pi * (kx * kx + ky * ky)) *
                   sin(kx * x) * sin(ky * y);
        }
    }
    return sum;
}

// ---- Solitary wave ----

double weir_solitary_speed(double gravity, double depth, double height)
{
    return sqrt(gravity * (depth + height));
}

static double solitary_kappa(double depth, double height)
{
    return sqrt(0.75 * height / (depth * depth * (depth + height)));
}

double weir_solitary_surface(double depth, double height, double distance)
{
    double s = 1.0 / cosh(solitary_kappa(depth, height) * distance);
    return height * s * s;
}
