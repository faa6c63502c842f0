// The estimate of the largest stable time step against measurement: below it a run holds, well above it the
// run blows up or gains energy.
#include <math.h>
#include <stdio.h>

#include "common/build.h"
#include "core/sim.h"
#include "core/smoothing.h"

typedef struct Configuration {
    const char *name;
    double spacing, support, gas_constant, viscosity;
    double breaks; // share of the estimate at which it must break: viscosity is judged on the safe side
} Configuration;

static const Configuration configurations[] = {
    {"article, 13 neighbours", 0.0225, 0.045, 2000, 0.1, 2.1},
    {"article, 20 neighbours", 0.018, 0.045, 2000, 0.1, 2.1},
    {"article, 50 neighbours", 0.01125, 0.045, 2000, 0.1, 2.1},
    {"soft", 0.02, 0.05, 200, 0.1, 2.1},
    {"stiff", 0.02, 0.05, 20000, 0.1, 2.1},
    {"small", 0.002, 0.005, 2000, 0.1, 2.1},
    {"viscous", 0.02, 0.05, 2000, 50, 2.9},
    {"honey", 0.02, 0.05, 2000, 400, 4.1},
};
enum { CONFIGURATIONS = sizeof configurations / sizeof configurations[0] };

// A dam break of 400 particles at `share` of the estimate. Returns the mechanical energy at the end as a
// share of the start's, or INFINITY after a blow-up.
static double run(const Configuration *configuration, double share, uint32_t steps)
{
    const double size = 40 * configuration->spacing;
    WeirScene *scene = weir_test_scene(configuration->spacing, configuration->support, 0, size);
    // The weight compresses the column by half a percent whatever its stiffness: without pressure nothing can
    // become unstable.
    weir_test_gravity(scene, 0, -0.005 * configuration->gas_constant / (0.5 * size));
    weir_test_set(scene, "gas_constant", configuration->gas_constant);
    weir_test_set(scene, "viscosity", configuration->viscosity);
    weir_test_box(scene, 0, 0, 0.5 * size, 0.5 * size);
    weir_test_set(scene, "time_step", share * weir_scene_stable_time_step(scene));
    WeirSim *sim = weir_test_sim(scene, NULL, 0);
    WeirDiagnostics start = weir_test_diagnose(sim, 0), end;
    WeirStatus status = weir_sim_step(sim, steps);
    CHECK_SIM(sim, weir_sim_diagnose(sim, 0, &end), WEIR_OK);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
    if (status == WEIR_ERROR_UNSTABLE) return INFINITY;
    assert_int_equal(status, WEIR_OK);
    return (end.kinetic_energy + end.potential_energy) / (start.kinetic_energy + start.potential_energy);
}

static void holds_below_the_estimate(void **state)
{
    (void)state;
    for (int n = 0; n < CONFIGURATIONS; ++n) {
        double energy = run(&configurations[n], 1.0, 600);
        if (!(energy <= 1.001)) fail_msg("%s: energy is %g of the start's", configurations[n].name, energy);
    }
}

static void breaks_well_above_the_estimate(void **state)
{
    (void)state;
    for (int n = 0; n < CONFIGURATIONS; ++n) {
        double energy = run(&configurations[n], configurations[n].breaks, 600);
        if (!(energy > 1.05)) fail_msg("%s: energy is %g of the start's", configurations[n].name, energy);
    }
}

// The article's own numbers and block of fluid. Measured: 0.0007 s holds at any viscosity, 0.0008 s only at
// the article's own, 0.0012 s never.
static void article_step_is_judged_rightly(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_scene(0.007, 0.045, -1, 1); // about 130 neighbours
    weir_test_set(scene, "viscosity", 0.1);
    weir_test_set(scene, "gas_constant", 2000);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_box(scene, -1, -1, -0.104, 0.792);
    double stable = weir_scene_stable_time_step(scene);
    assert_true(stable >= 0.0006);
    assert_true(stable <= 0.0007);
    weir_scene_destroy(scene);
}

// What the estimate must follow: c = sqrt(k) and length. It is rounded down to two digits, so by 10
// % at most.
static void estimate_scales_with_the_method(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_scene(0.02, 0.05, 0, 1);
    weir_test_set(scene, "viscosity", 0);
    weir_test_set(scene, "gas_constant", 1000);
    double base = weir_scene_stable_time_step(scene);
    weir_test_set(scene, "gas_constant", 4000);
    CHECK_NEAR(weir_scene_stable_time_step(scene), base / 2, 0.05 * base);
    weir_test_set(scene, "gas_constant", 1000);
    weir_test_set(scene, "particle_spacing", 0.002);
    weir_test_set(scene, "support_radius", 0.005);
    CHECK_NEAR(weir_scene_stable_time_step(scene), base / 10, 0.01 * base);
    weir_test_set(scene, "viscosity", 100);
    assert_true(weir_scene_stable_time_step(scene) < base / 10);
    // Without stiffness and viscosity nothing limits it but the parameter's own range.
    weir_test_set(scene, "viscosity", 0);
    weir_test_set(scene, "gas_constant", 0);
    assert_true(weir_scene_stable_time_step(scene) >= 0.1);
    weir_scene_destroy(scene);
}

// 1/s: how fast velocities along x that alternate from column to column of a lattice decay by wcsph's viscosity near surfaces,
// 2 (d + 2) nu sum_j V F (v_ij . x_ij) x_ij / r^2. An explicit step of 2 over it amplifies them.
static double decay_of_columns(const WeirParameters *parameters, uint32_t dimension)
{
    double spacing = parameters->particle_spacing, volume = pow(spacing, dimension), sum = 0;
    int reach = (int)(parameters->support_radius / spacing), deep = dimension == 3 ? reach : 0;
    for (int k = -deep; k <= deep; ++k) {
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
                double r2 = i * i + j * j + k * k;
                if (i % 2 == 0) continue; // moves as the one in the middle does
                double f = -weir_smoothing_gradient(parameters->kernel, dimension, sqrt(r2) * spacing,
                                                    parameters->support_radius);
                sum += 2 * volume * f * i * i / r2;
            }
        }
    }
    return 2 * (dimension + 2) * parameters->viscosity / parameters->rest_density * sum;
}

// Half of what a lattice stands is left to clumps.
static void viscous_step_is_stable(void **state)
{
    (void)state;
    const uint32_t every_kernel[] = {WEIR_KERNEL_WENDLAND, WEIR_KERNEL_CUBIC, WEIR_KERNEL_QUINTIC};
    const float ratios[] = {2.1f, 2.5f, 3, 4};
    WeirParameters parameters;
    weir_parameters_default(&parameters);
    parameters.viscosity = 20;
    for (int n = 0; n < 24; ++n) {
        uint32_t dimension = 2 + (uint32_t)n % 2;
        parameters.kernel = every_kernel[n / 2 % 3];
        parameters.support_radius = ratios[n / 6] * parameters.particle_spacing;
        double share = weir_viscous_step(&parameters) * decay_of_columns(&parameters, dimension);
        if (!(share > 0.3 && share < 1.2))
            fail_msg("%uD, kernel %u, support %g: %g", dimension, parameters.kernel, ratios[n / 6], share);
    }
    parameters.viscosity = 0;
    assert_true(weir_viscous_step(&parameters) > 1e30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(holds_below_the_estimate),       cmocka_unit_test(breaks_well_above_the_estimate),
        cmocka_unit_test(article_step_is_judged_rightly), cmocka_unit_test(estimate_scales_with_the_method),
        cmocka_unit_test(viscous_step_is_stable),
    };
    return cmocka_run_group_tests_name("stability", tests, NULL, NULL);
}
