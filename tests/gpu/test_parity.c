// The GPU follows the CPU reference: pass by pass from the same state, and over 100 steps.
//
// Tolerances, as shares of natural scales: density 2e-6 of the largest density, pressure the same times the
// gas constant, acceleration 1e-5 of the largest one. Measured on llvmpipe and on an H200: at most a seventh
// of that.
#include "adapter.h"
#include "core/sim.h"
#include "gpu/mueller.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static WeirGpu *gpu;

static const double density_tolerance = 2e-6;
static const double acceleration_tolerance = 1e-5;

static double largest(const float *values, size_t count)
{
    double most = 0;
    for (size_t n = 0; n < count; ++n) most = fmax(most, fabs((double)values[n]));
    return most;
}

static void check_array(const char *what, const float *actual, const float *expected, size_t count,
                        double tolerance)
{
    for (size_t n = 0; n < count; ++n) {
        double difference = fabs((double)actual[n] - expected[n]);
        if (!(difference <= tolerance)) // NaN fails
            fail_msg("%s[%zu] is %.9g on the GPU and %.9g on the CPU, tolerance %.3g", what, n,
                     (double)actual[n], (double)expected[n], tolerance);
    }
}

// All fields of two simulations in the same state.
static void check_passes(WeirSim *on_gpu, WeirSim *on_cpu)
{
    WeirState actual, expected;
    CHECK_SIM(on_gpu, weir_sim_state(on_gpu, &actual), WEIR_OK);
    CHECK_SIM(on_cpu, weir_sim_state(on_cpu, &expected), WEIR_OK);
    assert_int_equal(actual.count, expected.count);
    size_t count = actual.count;
    const WeirParameters *parameters = weir_sim_parameters(on_cpu);
    double density = density_tolerance * largest(expected.density, count);
    check_array("position", actual.position, expected.position, 2 * count, 0);
    check_array("velocity", actual.velocity, expected.velocity, 2 * count, 0);
    check_array("density", actual.density, expected.density, count, density);
    check_array("pressure", actual.pressure, expected.pressure, count, parameters->gas_constant * density);
    check_array("acceleration", actual.acceleration, expected.acceleration, 2 * count,
                acceleration_tolerance * largest(expected.acceleration, 2 * count));
}

typedef struct Case {
    const char *search, *kernels;
} Case;
static const Case cases[] = {
    {"grid", "consistent"}, {"grid", "tutorial"}, {"all_pairs", "consistent"}, {"all_pairs", "tutorial"}};
enum { CASES = sizeof cases / sizeof cases[0] };

// `count` particles at random places of a box, so that pressures are large, with random velocities.
static void check_random_state(const Case *chosen, uint32_t count, double low, double high, double negative)
{
    double scale = fmin(1.0, sqrt(1200.0 / count));
    WeirScene *scene = weir_test_count_scene(count, 1, 0.02 * scale, 0.07 * scale);
    weir_test_gravity(scene, 1.5, -9.81);
    weir_test_set(scene, "viscosity", 20);
    weir_test_set(scene, "negative_pressure", negative);
    weir_test_choose(scene, "search", chosen->search);
    weir_test_choose(scene, "kernels", chosen->kernels);
    WeirSim *on_gpu = weir_test_sim(scene, weir_gpu_backend(gpu), 0), *on_cpu = weir_test_sim(scene, NULL, 1);
    float *position = calloc(2 * count, sizeof *position), *velocity = calloc(2 * count, sizeof *velocity);
    WeirRandom random = {count + 1};
    for (uint32_t n = 0; n < 2 * count; ++n) {
        position[n] = (float)weir_random_range(&random, low, high);
        velocity[n] = (float)weir_random_range(&random, -3, 3);
    }
    weir_test_set_state(on_gpu, position, velocity);
    weir_test_set_state(on_cpu, position, velocity);
    check_passes(on_gpu, on_cpu);
    free(position);
    free(velocity);
    weir_sim_destroy(on_gpu);
    weir_sim_destroy(on_cpu);
    weir_scene_destroy(scene);
}

static void passes_match_on_random_states(void **state)
{
    (void)state;
    for (int n = 0; n < CASES; ++n) {
        check_random_state(&cases[n], 1200, 0, 1, 0);
        check_random_state(&cases[n], 1200, 0, 1, 0.5);
    }
}

// Crowded into one cell, into a corner, and counts around the size of a workgroup.
static void passes_match_on_nasty_states(void **state)
{
    (void)state;
    static const uint32_t counts[] = {1, 2, 3, 127, 128, 129, 257};
    for (size_t n = 0; n < sizeof counts / sizeof counts[0]; ++n) {
        check_random_state(&cases[0], counts[n], 0, 1, 0);
        check_random_state(&cases[0], counts[n], 0.501, 0.509, 0);
        check_random_state(&cases[0], counts[n], 0.99, 1, 1);
    }
}

// One, four or eight threads share a particle's neighbours.
static void passes_match_with_any_number_of_lanes(void **state)
{
    (void)state;
    static const uint32_t counts[] = {1200, 9001, 66001}, lanes[] = {8, 4, 1};
    for (size_t n = 0; n < sizeof counts / sizeof counts[0]; ++n) {
        assert_int_equal(weir_mueller_lanes(gpu, counts[n]), lanes[n]);
        check_random_state(&cases[0], counts[n], 0, 1, 0.5);
    }
}

static void coinciding_particles_match(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_count_scene(4, 1, 0.02, 0.07);
    WeirSim *on_gpu = weir_test_sim(scene, weir_gpu_backend(gpu), 0), *on_cpu = weir_test_sim(scene, NULL, 1);
    static const float position[] = {0.5f, 0.5f, 0.5f, 0.5f, 0, 0, 1, 1},
                       velocity[] = {1, 0, -1, 0, 0, 0, 0, 0};
    weir_test_set_state(on_gpu, position, velocity);
    weir_test_set_state(on_cpu, position, velocity);
    check_passes(on_gpu, on_cpu);
    weir_sim_destroy(on_gpu);
    weir_sim_destroy(on_cpu);
    weir_scene_destroy(scene);
}

// Largest distances between two simulations that took the same steps.
static void check_paths(WeirSim *a, WeirSim *b)
{
    WeirState actual, expected;
    CHECK_SIM(a, weir_sim_state(a, &actual), WEIR_OK);
    CHECK_SIM(b, weir_sim_state(b, &expected), WEIR_OK);
    assert_int_equal(actual.step, expected.step);
    size_t count = actual.count;
    double spacing = weir_sim_parameters(b)->particle_spacing;
    // A hundredth of a spacing, a hundredth of the largest speed: rounding grows with every collision.
    check_array("position", actual.position, expected.position, 2 * count, 0.01 * spacing);
    check_array("velocity", actual.velocity, expected.velocity, 2 * count,
                0.01 * largest(expected.velocity, 2 * count));
    WeirDiagnostics first = weir_test_diagnose(a, 0), second = weir_test_diagnose(b, 0);
    CHECK_NEAR(first.kinetic_energy, second.kinetic_energy, 1e-4 * second.kinetic_energy);
    CHECK_NEAR(first.potential_energy, second.potential_energy, 1e-5 * second.potential_energy);
    CHECK_NEAR(first.density_error_mean, second.density_error_mean, 1e-4);
    assert_int_equal(first.lost_particles, 0);
}

static WeirSim *run_dam(const WeirBackend *backend, const Case *chosen, const WeirTool *tool, uint32_t steps)
{
    WeirScene *scene = weir_test_dam();
    weir_test_choose(scene, "search", chosen->search);
    weir_test_choose(scene, "kernels", chosen->kernels);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    if (tool) CHECK_SIM(sim, weir_sim_set_tool(sim, tool), WEIR_OK);
    weir_test_step(sim, steps);
    CHECK_SIM(sim, weir_sim_wait(sim), WEIR_OK);
    weir_scene_destroy(scene);
    return sim;
}

// After some ninety steps a particle meets the floor a step earlier or later, by rounding.
static void eighty_steps_match(void **state)
{
    (void)state;
    for (int n = 0; n < CASES; ++n) {
        WeirSim *on_gpu = run_dam(weir_gpu_backend(gpu), &cases[n], NULL, 80);
        WeirSim *on_cpu = run_dam(NULL, &cases[n], NULL, 80);
        check_paths(on_gpu, on_cpu);
        weir_sim_destroy(on_gpu);
        weir_sim_destroy(on_cpu);
    }
}

static void all_pairs_matches_the_grid(void **state)
{
    (void)state;
    for (int n = 0; n < 2; ++n) {
        WeirSim *grid = run_dam(weir_gpu_backend(gpu), &cases[n], NULL, 80);
        WeirSim *all_pairs = run_dam(weir_gpu_backend(gpu), &cases[n + 2], NULL, 80);
        check_paths(all_pairs, grid);
        weir_sim_destroy(grid);
        weir_sim_destroy(all_pairs);
    }
}

static void tools_match(void **state)
{
    (void)state;
    for (int kind = WEIR_TOOL_PUSH; kind <= WEIR_TOOL_STIR; ++kind) {
        WeirTool tool = {
            .kind = kind, .position = {0.2f, 0.2f}, .velocity = {1, -2}, .radius = 0.15f, .strength = 50};
        WeirSim *on_gpu = run_dam(weir_gpu_backend(gpu), &cases[0], &tool, 30);
        WeirSim *on_cpu = run_dam(NULL, &cases[0], &tool, 30);
        WeirSim *without = run_dam(NULL, &cases[0], NULL, 30);
        check_paths(on_gpu, on_cpu);
        assert_true(weir_test_hash(on_cpu) != weir_test_hash(without)); // it did act
        weir_sim_destroy(on_gpu);
        weir_sim_destroy(on_cpu);
        weir_sim_destroy(without);
    }
}

static void equal_runs_give_equal_bits(void **state)
{
    (void)state;
    for (int n = 0; n < CASES; ++n) {
        WeirSim *first = run_dam(weir_gpu_backend(gpu), &cases[n], NULL, 60);
        WeirSim *second = run_dam(weir_gpu_backend(gpu), &cases[n], NULL, 60);
        assert_true(weir_test_hash(first) == weir_test_hash(second));
        weir_sim_destroy(first);
        weir_sim_destroy(second);
    }
}

// Two different scenes at the same time, against each one alone.
static void simulations_run_side_by_side(void **state)
{
    (void)state;
    WeirScene *scenes[2] = {weir_test_dam(), weir_test_drops()};
    WeirSim *sims[2], *alone;
    for (int n = 0; n < 2; ++n) sims[n] = weir_test_sim(scenes[n], weir_gpu_backend(gpu), 0);
    for (int step = 0; step < 12; ++step)
        for (int n = 0; n < 2; ++n) weir_test_step(sims[n], 3);
    for (int n = 0; n < 2; ++n) {
        alone = weir_test_sim(scenes[n], weir_gpu_backend(gpu), 0);
        weir_test_step(alone, 36);
        assert_true(weir_test_hash(alone) == weir_test_hash(sims[n]));
        weir_sim_destroy(alone);
    }
    for (int n = 0; n < 2; ++n) {
        weir_sim_destroy(sims[n]);
        weir_scene_destroy(scenes[n]);
    }
}

int main(void)
{
    gpu = weir_test_gpu(NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_match_on_random_states),
        cmocka_unit_test(passes_match_on_nasty_states),
        cmocka_unit_test(passes_match_with_any_number_of_lanes),
        cmocka_unit_test(coinciding_particles_match),
        cmocka_unit_test(eighty_steps_match),
        cmocka_unit_test(all_pairs_matches_the_grid),
        cmocka_unit_test(tools_match),
        cmocka_unit_test(equal_runs_give_equal_bits),
        cmocka_unit_test(simulations_run_side_by_side),
    };
    int failed = cmocka_run_group_tests_name("parity", tests, NULL, NULL);
    weir_gpu_destroy(gpu);
    return failed;
}
