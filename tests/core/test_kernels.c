// Kernels of the plane: normalisation, support, sign, and that each derivative is the derivative.
#include <math.h>
#include <stdio.h>

#include "common/build.h"
#include "common/reference.h"
#include "core/kernel.h"

static const double pi = 3.14159265358979323846;
static const double supports[] = {1e-3, 0.025, 0.045, 1, 30};
enum { SUPPORTS = sizeof supports / sizeof supports[0] };

typedef double Kernel(double r, double h);
static Kernel *const kernels[] = {weir_kernel_poly6, weir_kernel_spiky};

// Integral of f(r) 2 pi r dr from 0 to h, Simpson.
static double integral_over_plane(Kernel *f, double h)
{
    enum { INTERVALS = 2000 };
    double sum = 0;
    for (int n = 0; n <= INTERVALS; ++n) {
        double r = h * n / INTERVALS, weight = n == 0 || n == INTERVALS ? 1 : n % 2 ? 4 : 2;
        sum += weight * f(r, h) * 2 * pi * r;
    }
    return sum * h / INTERVALS / 3;
}

static void integral_is_one(void **state)
{
    (void)state;
    for (int s = 0; s < SUPPORTS; ++s) {
        CHECK_NEAR(integral_over_plane(weir_kernel_poly6, supports[s]), 1, 1e-10);
        CHECK_NEAR(integral_over_plane(weir_kernel_spiky, supports[s]), 1, 1e-10);
    }
}

static void support_is_compact_and_nothing_negative(void **state)
{
    (void)state;
    for (int s = 0; s < SUPPORTS; ++s) {
        double h = supports[s];
        for (int k = 0; k < 2; ++k) {
            for (int n = 0; n < 1000; ++n) {
                assert_true(kernels[k](h * n / 1000, h) > 0);
                assert_true(kernels[k](h * n / 1000, h) > kernels[k](h * (n + 1) / 1000, h));
            }
            CHECK_NEAR(kernels[k](h, h), 0, 0);
            CHECK_NEAR(kernels[k](1.001 * h, h), 0, 0);
            CHECK_NEAR(kernels[k](1e9 * h, h), 0, 0);
        }
        for (int n = 0; n < 1000; ++n) {
            assert_true(weir_kernel_spiky_gradient(h * n / 1000, h) < 0);
            assert_true(weir_kernel_viscosity_laplacian(h * n / 1000, h) > 0);
        }
        CHECK_NEAR(weir_kernel_spiky_gradient(1.001 * h, h), 0, 0);
        CHECK_NEAR(weir_kernel_viscosity_laplacian(1.001 * h, h), 0, 0);
    }
}

static void gradient_is_the_slope(void **state)
{
    (void)state;
    for (int s = 0; s < SUPPORTS; ++s) {
        double h = supports[s], step = 1e-5 * h, scale = fabs(weir_kernel_spiky_gradient(0, h));
        for (int n = 1; n < 100; ++n) {
            double r = h * n / 100;
            double numeric = (weir_kernel_spiky(r + step, h) - weir_kernel_spiky(r - step, h)) / (2 * step);
            CHECK_NEAR(weir_kernel_spiky_gradient(r, h), numeric, 1e-7 * scale);
        }
    }
}

// The viscosity kernel is W with laplacian W = A (h - r), W(h) = W'(h) = 0. Its normalisation fixes A: with
// r W' = integral of A (h - r) r dr from h, the integral of W over the plane is -pi times that of r^2 W'.
static void laplacian_belongs_to_a_normalised_kernel(void **state)
{
    (void)state;
    enum { INTERVALS = 4000 };
    for (int s = 0; s < SUPPORTS; ++s) {
        double h = supports[s], dr = h / INTERVALS, r_slope = 0, integral = 0;
        for (int n = INTERVALS; n > 0; --n) { // midpoint rule inwards from W'(h) = 0
            double r = (n - 0.5) * dr;
            double half = 0.5 * weir_kernel_viscosity_laplacian(r, h) * r * dr;
            r_slope -= half;
            integral -= pi * r * r_slope * dr;
            r_slope -= half;
        }
        CHECK_NEAR(integral, 1, 1e-5);
    }
}

static void kernels_equal_the_reference(void **state)
{
    (void)state;
    for (int s = 0; s < SUPPORTS; ++s) {
        double h = supports[s];
        for (int n = 0; n <= 110; ++n) {
            double r = h * n / 100;
            CHECK_NEAR(weir_kernel_poly6(r, h), weir_reference_poly6(r, h), 1e-12 / (h * h));
            CHECK_NEAR(weir_kernel_spiky(r, h), weir_reference_spiky(r, h), 1e-12 / (h * h));
            CHECK_NEAR(weir_kernel_spiky_gradient(r, h), weir_reference_spiky_slope(r, h),
                       1e-11 / (h * h * h));
            CHECK_NEAR(weir_kernel_viscosity_laplacian(r, h), weir_reference_laplacian(r, h),
                       1e-11 / (h * h * h * h));
            CHECK_NEAR(weir_kernel_density(r, h, WEIR_KERNELS_CONSISTENT), weir_kernel_spiky(r, h), 0);
            CHECK_NEAR(weir_kernel_density(r, h, WEIR_KERNELS_TUTORIAL), weir_kernel_poly6(r, h), 0);
        }
    }
}

// For a fine lattice the calibrated mass is rho0 * spacing^2; for any it is the reference's.
static void mass_is_calibrated(void **state)
{
    (void)state;
    WeirParameters parameters;
    weir_parameters_default(&parameters);
    for (double ratio = 1.2; ratio < 20; ratio *= 1.4) {
        parameters.support_radius = (float)(ratio * parameters.particle_spacing);
        for (uint32_t choice = 0; choice < 2; ++choice) {
            parameters.kernels = choice;
            double mass = weir_calibrated_mass(&parameters);
            CHECK_NEAR(mass, weir_reference_mass(&parameters), 1e-12 * mass);
            double area = (double)parameters.particle_spacing * parameters.particle_spacing;
            if (ratio > 8) CHECK_NEAR(mass, parameters.rest_density * area, 5e-3 * mass);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integral_is_one),
        cmocka_unit_test(support_is_compact_and_nothing_negative),
        cmocka_unit_test(gradient_is_the_slope),
        cmocka_unit_test(laplacian_belongs_to_a_normalised_kernel),
        cmocka_unit_test(kernels_equal_the_reference),
        cmocka_unit_test(mass_is_calibrated),
    };
    return cmocka_run_group_tests_name("kernels", tests, NULL, NULL);
}
