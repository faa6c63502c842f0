#include "common/reference.h"

#include <math.h>
#include <stdlib.h>

#include "common/check.h"

static const double pi = 3.14159265358979323846;

double weir_reference_poly6(double r, double h)
{
    return r < h ? 4 / (pi * pow(h, 8)) * pow(h * h - r * r, 3) : 0;
}

double weir_reference_spiky(double r, double h)
{
    return r < h ? 10 / (pi * pow(h, 5)) * pow(h - r, 3) : 0;
}

double weir_reference_spiky_slope(double r, double h)
{
    return r < h ? -30 / (pi * pow(h, 5)) * pow(h - r, 2) : 0;
}

double weir_reference_laplacian(double r, double h)
{
    return r < h ? 40 / (pi * pow(h, 5)) * (h - r) : 0;
}

static double density_kernel(double r, const WeirParameters *parameters)
{
    return parameters->kernels == WEIR_KERNELS_TUTORIAL ? weir_reference_poly6(r, parameters->support_radius)
                                                        : weir_reference_spiky(r, parameters->support_radius);
}

double weir_reference_mass(const WeirParameters *parameters)
{
    double spacing = parameters->particle_spacing, sum = 0;
    int reach = (int)(parameters->support_radius / spacing) + 1;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j) sum += density_kernel(spacing * hypot(i, j), parameters);
    return parameters->rest_density / sum;
}

double weir_reference_internal_energy(double density, const WeirParameters *parameters)
{
    double ratio = density / parameters->rest_density;
    return ratio > 1 ? parameters->gas_constant * (log(ratio) + 1 / ratio - 1) : 0;
}

static void sum_density(WeirReference *reference, const WeirParameters *parameters, const float *position)
{
    double mass = weir_reference_mass(parameters), h = parameters->support_radius;
    for (uint32_t i = 0; i < reference->count; ++i) {
        for (uint32_t j = 0; j < reference->count; ++j) {
            double r = hypot((double)position[2 * i] - position[2 * j],
                             (double)position[2 * i + 1] - position[2 * j + 1]);
            reference->density[i] += mass * density_kernel(r, parameters);
            reference->neighbors[i] += i != j && r < h;
        }
        double pressure = parameters->gas_constant * (reference->density[i] - parameters->rest_density);
        reference->pressure[i] = pressure < 0 ? pressure * parameters->negative_pressure : pressure;
    }
}

// Adds what particle j does to particle i.
static void add_pair(WeirReference *reference, const WeirParameters *parameters, uint32_t i, uint32_t j,
                     const float *position, const float *velocity)
{
    double mass = weir_reference_mass(parameters), h = parameters->support_radius;
    double d[2], dv[2], r;
    for (int k = 0; k < 2; ++k) {
        d[k] = (double)position[2 * i + k] - position[2 * j + k];
        dv[k] = (double)velocity[2 * j + k] - velocity[2 * i + k];
    }
    r = hypot(d[0], d[1]);
    if (r >= h) return;
    double pi_ = reference->pressure[i], pj = reference->pressure[j];
    double rho_i = reference->density[i], rho_j = reference->density[j];
    double pressure = parameters->kernels == WEIR_KERNELS_TUTORIAL
                          ? (pi_ + pj) / (2 * rho_i * rho_j)
                          : pi_ / (rho_i * rho_i) + pj / (rho_j * rho_j);
    double slope = r > 0 ? weir_reference_spiky_slope(r, h) / r : 0;
    double drag = parameters->viscosity * mass / (rho_i * rho_j) * weir_reference_laplacian(r, h);
    for (int k = 0; k < 2; ++k)
        reference->acceleration[2 * i + k] += -mass * pressure * slope * d[k] + drag * dv[k];
    // p = k (rho - rho0) is a difference: its rounding error goes with k (rho + rho0).
    double rest = parameters->rest_density, stiffness = parameters->gas_constant;
    double carried = stiffness * ((rho_i + rest) / (rho_i * rho_i) + (rho_j + rest) / (rho_j * rho_j));
    reference->acceleration_scale[i] +=
        mass * carried * fabs(slope) * r + drag * (fabs(velocity[2 * i]) + fabs(velocity[2 * i + 1]) +
                                                   fabs(velocity[2 * j]) + fabs(velocity[2 * j + 1]));
}

void weir_reference_evaluate(WeirReference *reference, const WeirParameters *parameters, uint32_t count,
                             const float *position, const float *velocity)
{
    reference->count = count;
    reference->density = calloc(count, sizeof(double));
    reference->pressure = calloc(count, sizeof(double));
    reference->acceleration = calloc(2 * (size_t)count, sizeof(double));
    reference->acceleration_scale = calloc(count, sizeof(double));
    reference->neighbors = calloc(count, sizeof(uint32_t));
    assert_true(reference->density && reference->pressure && reference->acceleration &&
                reference->acceleration_scale && reference->neighbors);
    sum_density(reference, parameters, position);
    for (uint32_t i = 0; i < count; ++i) {
        for (int k = 0; k < 2; ++k) {
            reference->acceleration[2 * i + k] = parameters->gravity[k];
            reference->acceleration_scale[i] += fabs(parameters->gravity[k]);
        }
        for (uint32_t j = 0; j < count; ++j)
            if (j != i) add_pair(reference, parameters, i, j, position, velocity);
    }
}

void weir_reference_free(WeirReference *reference)
{
    free(reference->density);
    free(reference->pressure);
    free(reference->acceleration);
    free(reference->acceleration_scale);
    free(reference->neighbors);
}
