#include "core/smoothing.h"

#include <float.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

static double positive_power(double x, int n)
{
    if (x <= 0.0) return 0.0;
    double result = 1.0;
    for (; n > 0; --n) result *= x;
    return result;
}

double weir_smoothing_shape(uint32_t kernel, double s)
{
    if (s >= 1.0) return 0.0;
    if (kernel == WEIR_KERNEL_CUBIC) {
        double q = 2.0 * s;
        return q < 1.0 ? 1.0 - 1.5 * q * q + 0.75 * q * q * q : 0.25 * positive_power(2.0 - q, 3);
    }
    if (kernel == WEIR_KERNEL_QUINTIC) {
        double q = 3.0 * s;
        return positive_power(3.0 - q, 5) - 6.0 * positive_power(2.0 - q, 5) +
               15.0 * positive_power(1.0 - q, 5);
    }
    return positive_power(1.0 - s, 4) * (4.0 * s + 1.0);
}

// -(dw/ds) / s over a constant that the gradient factor holds: 20 for wendland, 4 for cubic, 9 for quintic.
double weir_smoothing_slope(uint32_t kernel, double s)
{
    if (s >= 1.0) return 0.0;
    if (kernel == WEIR_KERNEL_CUBIC) {
        double q = 2.0 * s;
        return q < 1.0 ? 3.0 - 2.25 * q : 0.75 * (2.0 - q) * (2.0 - q) / q;
    }
    if (kernel == WEIR_KERNEL_QUINTIC) {
        double q = 3.0 * s;
        // Below q = 1 the sum of the three terms is divisible by q: 120 - 120 q^2 + 50 q^3.
        if (q < 1.0) return 120.0 - 120.0 * q * q + 50.0 * q * q * q;
        return 5.0 * (positive_power(3.0 - q, 4) - 6.0 * positive_power(2.0 - q, 4)) / q;
    }
    return positive_power(1.0 - s, 3);
}

double weir_smoothing_length(uint32_t kernel, double support_radius)
{
    return support_radius / (kernel == WEIR_KERNEL_QUINTIC ? 3.0 : 2.0);
}

double weir_viscous_step(const WeirParameters *parameters)
{
    double h = weir_smoothing_length(parameters->kernel, parameters->support_radius);
    if (!(parameters->viscosity > 0.0f)) return FLT_MAX;
    return fmin(h * h * parameters->rest_density / (16.0 * parameters->viscosity), FLT_MAX);
}

double weir_smoothing_factor(uint32_t kernel, uint32_t dimension, double support_radius)
{
    // By dimension, for h = 1 (cubic, quintic) and for R = 1 (wendland).
    const double factors[3][3] = {
        {3.0 / 2.0, 7.0 / pi, 21.0 / (2.0 * pi)},
        {2.0 / 3.0, 10.0 / (7.0 * pi), 1.0 / pi},
        {1.0 / 120.0, 7.0 / (478.0 * pi), 1.0 / (120.0 * pi)},
    };
    double length =
        kernel == WEIR_KERNEL_WENDLAND ? support_radius : weir_smoothing_length(kernel, support_radius);
    return factors[kernel][dimension - 1] / positive_power(length, (int)dimension);
}

double weir_smoothing_gradient_factor(uint32_t kernel, uint32_t dimension, double support_radius)
{
    double slope = kernel == WEIR_KERNEL_CUBIC ? 4.0 : kernel == WEIR_KERNEL_QUINTIC ? 9.0 : 20.0;
    return -slope * weir_smoothing_factor(kernel, dimension, support_radius) /
           (support_radius * support_radius);
}

double weir_smoothing_value(uint32_t kernel, uint32_t dimension, double r, double support_radius)
{
    return weir_smoothing_factor(kernel, dimension, support_radius) *
           weir_smoothing_shape(kernel, r / support_radius);
}

double weir_smoothing_gradient(uint32_t kernel, uint32_t dimension, double r, double support_radius)
{
    return weir_smoothing_gradient_factor(kernel, dimension, support_radius) *
           weir_smoothing_slope(kernel, r / support_radius);
}
