// Momentum, energy and symmetry: what the equations conserve, the solver must.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/reference.h"
#include "common/shared.h"
#include "core/sim.h"

// Sum of m |v| and of m |a| dt over all particles: the sizes that rounding of one step is a share of.
static double momentum_scale(WeirSim *sim)
{
    const WeirParameters *parameters = weir_sim_parameters(sim);
    uint32_t count = weir_sim_particle_count(sim);
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    float *acceleration = weir_test_read(sim, WEIR_FIELD_ACCELERATION);
    double sum = 0;
    for (uint32_t k = 0; k < 2 * count; ++k)
        sum += fabs(velocity[k]) + fabs(acceleration[k]) * parameters->time_step;
    free(velocity);
    free(acceleration);
    return sum * weir_sim_constants(sim)->particle_mass;
}

static void momentum_of_kernels(const WeirBackend *backend, const char *kernels)
{
    WeirScene *scene = weir_test_drops();
    weir_test_choose(scene, "kernels", kernels);
    weir_test_set(scene, "viscosity", 2);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    // With the hash: all sums in double, on every backend.
    WeirDiagnostics before = weir_test_diagnose(sim, WEIR_DIAGNOSE_HASH), after;
    for (int step = 0; step < 150; ++step, before = after) {
        double scale = momentum_scale(sim);
        weir_test_step(sim, 1);
        after = weir_test_diagnose(sim, WEIR_DIAGNOSE_HASH);
        // A unit in the last place is 1.2e-7; over hundreds of particles roundings cancel (measured: 3e-9).
        for (int axis = 0; axis < 2; ++axis)
            CHECK_NEAR(after.momentum[axis], before.momentum[axis], 2e-8 * scale);
    }
    // They did collide: the left drop, the first half of the particles, came in with 1 m/s.
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    uint32_t half = weir_sim_particle_count(sim) / 2;
    double left = 0;
    for (uint32_t i = 0; i < half; ++i) left += velocity[2 * i] / half;
    free(velocity);
    CHECK_AT_MOST(left, 0.8);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void momentum_of_colliding_drops(const WeirBackend *backend)
{
    momentum_of_kernels(backend, "consistent");
    momentum_of_kernels(backend, "tutorial");
}

// Kinetic, potential and internal energy; the last from the density, by the equation of state's own integral.
static double total_energy(WeirSim *sim)
{
    WeirDiagnostics diagnostics = weir_test_diagnose(sim, 0);
    const WeirParameters *parameters = weir_sim_parameters(sim);
    float *density = weir_test_read(sim, WEIR_FIELD_DENSITY);
    double internal = 0;
    for (uint32_t i = 0; i < weir_sim_particle_count(sim); ++i)
        internal += weir_reference_internal_energy(density[i], parameters);
    free(density);
    return diagnostics.kinetic_energy + diagnostics.potential_energy +
           internal * weir_sim_constants(sim)->particle_mass;
}

// Largest rise of the total energy above its lowest value so far, as a share of the start.
static double energy_rise(WeirScene *scene, const WeirBackend *backend, int samples, uint32_t steps_between)
{
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    double start = total_energy(sim), lowest = start, rise = 0;
    for (int n = 0; n < samples; ++n) {
        weir_test_step(sim, steps_between);
        double energy = total_energy(sim);
        lowest = fmin(lowest, energy);
        rise = fmax(rise, energy - lowest);
    }
    weir_sim_destroy(sim);
    return rise / start;
}

// The article's numbers with fewer particles, and a third of its time step: what semi-implicit Euler adds and
// takes within an oscillation goes with the step and must not hide what the equations do.
static WeirScene *article_like(double width, double height)
{
    WeirScene *scene = weir_test_scene(0.0225, 0.045, -1, 1);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_set(scene, "time_step", 0.00025);
    weir_test_box(scene, -1, -1, -1 + width, -1 + height);
    return scene;
}

static void energy_never_grows(const WeirBackend *backend)
{
    WeirScene *dam = article_like(0.45, 0.675), *column = article_like(0.2025, 0.9);
    CHECK_AT_MOST(energy_rise(dam, backend, 60, 20), 5e-4);
    CHECK_AT_MOST(energy_rise(column, backend, 60, 20), 5e-4);
    weir_scene_destroy(dam);
    weir_scene_destroy(column);
}

// The tutorial's pair of kernels creates energy; if this fails, it is not the tutorial's pair that runs.
static void tutorial_kernels_create_energy(const WeirBackend *backend)
{
    WeirScene *dam = article_like(0.45, 0.675);
    weir_test_choose(dam, "kernels", "tutorial");
    assert_true(energy_rise(dam, backend, 60, 20) > 0.3);
    weir_scene_destroy(dam);
}

static void symmetric_scene_stays_symmetric(const WeirBackend *backend)
{
    enum { COLUMNS = 20, ROWS = 12 };
    WeirScene *scene = weir_test_scene(0.02, 0.05, -0.5, 0.5);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_box(scene, -0.2, -0.5, 0.2, -0.5 + ROWS * 0.02);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    assert_int_equal(weir_sim_particle_count(sim), COLUMNS * ROWS);
    for (int turn = 1; turn <= 5; ++turn) {
        weir_test_step(sim, 40);
        // Rounding differs between the sides, for sums run from left to right; chaos lets it grow.
        double tolerance = 1e-6 * pow(4, turn);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
        for (int i = 0; i < ROWS * COLUMNS; ++i) {
            int mirror = i / COLUMNS * COLUMNS + COLUMNS - 1 - i % COLUMNS;
            CHECK_NEAR(position[2 * i], -position[2 * mirror], tolerance);
            CHECK_NEAR(position[2 * i + 1], position[2 * mirror + 1], tolerance);
        }
        free(position);
    }
    // It did move: the block has spread.
    assert_true(weir_test_diagnose(sim, 0).max_speed > 0.3);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(momentum_of_colliding_drops),
    WEIR_SHARED_TEST(energy_never_grows),
    WEIR_SHARED_TEST(tutorial_kernels_create_energy),
    WEIR_SHARED_TEST(symmetric_scene_stays_symmetric),
};
extern const WeirSharedGroup weir_shared_conservation;
WEIR_SHARED_GROUP(conservation, tests);
