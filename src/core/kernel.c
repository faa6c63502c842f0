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

double weir_stable_time_step(const WeirParameters *parameters, double speed)
{
    double h = parameters->support_radius, spacing = parameters->particle_spacing;
    // Fewer neighbours, more disorder, smaller steps. Both numbers fitted to measured limits: docs/method.md.
    double courant = 1.12 * fmax(1.0 - 0.95 * spacing / h, 0.1);
    double sound_speed = sqrt(parameters->gas_constant);
    double kinematic_viscosity = parameters->viscosity / parameters->rest_density;
    // Rates add: sound and flow cross the support, viscosity relaxes the velocity inside it.
    double rate = (sound_speed + 3.0 * speed) / (courant * h) + 8.0 * kinematic_viscosity / (h * h);
    const WeirParameterInfo *info = weir_parameter_info((uint32_t)weir_parameter_find("time_step"));
    double step = rate > 0.0 ? 1.0 / rate : info->maximum;
    // Two digits, rounded down: a number to read and to type.
    double digit = pow(10.0, floor(log10(step)) - 1.0);
    return fmax(info->minimum, fmin(floor(step / digit) * digit, info->maximum));
}
