#include "core/kernel.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// x^n by multiplication: pow() differs in the last bit between C libraries, and the mass depends on it.
static double power(double x, int n)
{
    double result = 1.0;
    for (; n > 0; --n) result *= x;
    return result;
}

double weir_kernel_poly6(double r, double h)
{
    double q = h * h - r * r;
    return r < h ? 4.0 / (pi * power(h, 8)) * q * q * q : 0.0;
}

double weir_kernel_spiky(double r, double h)
{
    double q = h - r;
    return r < h ? 10.0 / (pi * power(h, 5)) * q * q * q : 0.0;
}

double weir_kernel_spiky_gradient(double r, double h)
{
    double q = h - r;
    return r < h ? -30.0 / (pi * power(h, 5)) * q * q : 0.0;
}

double weir_kernel_viscosity_laplacian(double r, double h)
{
    return r < h ? 40.0 / (pi * power(h, 5)) * (h - r) : 0.0;
}

double weir_kernel_density(double r, double h, uint32_t kernels)
{
    return kernels == WEIR_KERNELS_TUTORIAL ? weir_kernel_poly6(r, h) : weir_kernel_spiky(r, h);
}

// Lattice sites within the support radius, along one axis. Bounded: a scene may hold any ratio.
static int lattice_reach(const WeirParameters *parameters)
{
    return (int)fmin(ceil((double)parameters->support_radius / parameters->particle_spacing), 1000.0);
}

double weir_calibrated_mass(const WeirParameters *parameters)
{
    double spacing = parameters->particle_spacing, h = parameters->support_radius, sum = 0.0;
    int reach = lattice_reach(parameters);
    for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
            double r = spacing * sqrt((double)(row * row + column * column));
            sum += weir_kernel_density(r, h, parameters->kernels);
        }
    }
    return parameters->rest_density / sum;
}

// |S(k)| for k along an axis or the diagonal, S(k) = sum_j gradW(r_j) sin(k . r_j): how strongly a plane wave
// of displacements changes the density.
static double lattice_response(const WeirParameters *parameters, double kx, double ky)
{
    double spacing = parameters->particle_spacing, h = parameters->support_radius, sx = 0.0, sy = 0.0;
    int reach = lattice_reach(parameters);
    for (int row = -reach; row <= reach; ++row) {
        for (int column = -reach; column <= reach; ++column) {
            if (row == 0 && column == 0) continue;
            double x = column * spacing, y = row * spacing, r = sqrt(x * x + y * y);
            double weight = weir_kernel_spiky_gradient(r, h) / r * sin(kx * x + ky * y);
            sx += weight * x;
            sy += weight * y;
        }
    }
    return sqrt(sx * sx + sy * sy);
}

double weir_stable_time_step(const WeirParameters *parameters)
{
    enum { SAMPLES = 48 };
    double mass = weir_calibrated_mass(parameters), strongest = 0.0;
    for (int n = 1; n <= SAMPLES; ++n) {
        double k = pi / parameters->particle_spacing * n / SAMPLES;
        strongest = fmax(strongest, lattice_response(parameters, k, 0.0));
        strongest = fmax(strongest, lattice_response(parameters, k, k));
    }
    double sound_speed = sqrt(parameters->gas_constant);
    double omega = sound_speed * mass / parameters->rest_density * strongest;
    // Viscosity damps faster than omega resolves when its rate is the larger one.
    double kinematic = parameters->viscosity / parameters->rest_density;
    double h = parameters->support_radius, viscous = 0.0;
    if (kinematic > 0.0) viscous = kinematic * 40.0 / (h * h);
    double rate = 0.5 * omega + viscous;
    return rate > 0.0 ? 1.0 / rate : 0.1;
}
