// Diagnostics against values computed by hand.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "common/reference.h"
#include "common/shared.h"
#include "core/sim.h"

// Three particles, two of them a quarter of the support radius apart, in the square from (0,0) to (4,4).
static const float position[6] = {1, 1, 1.01875f, 1, 3, 2.5f};
static const float velocity[6] = {1, 2, -3, 0, 0.5f, -0.25f};

static WeirSim *three_particles(const WeirBackend *backend, double gravity_x, double gravity_y)
{
    WeirScene *scene = weir_test_count_scene(3, 4, 0.05, 0.075);
    weir_test_gravity(scene, gravity_x, gravity_y);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_set_state(sim, position, velocity);
    weir_scene_destroy(scene);
    return sim;
}

static void motion_by_hand(const WeirBackend *backend)
{
    WeirSim *sim = three_particles(backend, 0, -9.81);
    double mass = weir_sim_constants(sim)->particle_mass;
    WeirDiagnostics d = weir_test_diagnose(sim, true);
    CHECK_NEAR(d.kinetic_energy, 0.5 * mass * (1 + 4 + 9 + 0.25 + 0.0625), 1e-9 * mass);
    CHECK_NEAR(d.momentum[0], mass * (1 - 3 + 0.5), 1e-9 * mass);
    CHECK_NEAR(d.momentum[1], mass * (2 - 0.25), 1e-9 * mass);
    CHECK_NEAR(d.momentum[2], 0, 0);
    CHECK_NEAR(d.max_speed, 3, 1e-7);
    CHECK_NEAR(d.mean_neighbors, 2.0 / 3, 1e-12);
    assert_int_equal(d.lost_particles, 0);
    assert_int_equal(d.step, 0);
    CHECK_NEAR(d.time, 0, 0);
    assert_true(weir_test_diagnose(sim, false).mean_neighbors < 0);
    weir_test_step(sim, 7);
    d = weir_test_diagnose(sim, false);
    assert_int_equal(d.step, 7);
    CHECK_NEAR(d.time, 7 * (double)weir_sim_parameters(sim)->time_step, 1e-15);
    weir_sim_destroy(sim);
}

// Zero at the domain's lowest point along gravity, whichever way that points.
static void potential_energy_by_hand(const WeirBackend *backend)
{
    WeirSim *sim = three_particles(backend, 0, -9.81);
    double mass = weir_sim_constants(sim)->particle_mass;
    CHECK_NEAR(weir_test_diagnose(sim, false).potential_energy, mass * 9.81 * (1 + 1 + 2.5), 1e-5 * mass);
    weir_sim_destroy(sim);
    sim = three_particles(backend, 3, 4); // lowest at (4, 4)
    double height_sum = 3 * (3 + 2.98125 + 1) + 4 * (3 + 3 + 1.5);
    CHECK_NEAR(weir_test_diagnose(sim, false).potential_energy, mass * height_sum, 1e-5 * mass);
    weir_sim_destroy(sim);
    sim = three_particles(backend, 0, 0);
    CHECK_NEAR(weir_test_diagnose(sim, false).potential_energy, 0, 0);
    weir_sim_destroy(sim);
}

static void density_error_by_hand(const WeirBackend *backend)
{
    WeirSim *sim = three_particles(backend, 0, 0);
    const WeirParameters *parameters = weir_sim_parameters(sim);
    double mass = weir_reference_mass(parameters), h = parameters->support_radius;
    double alone = mass * weir_reference_spiky(0, h), rest = parameters->rest_density;
    double pair = alone + mass * weir_reference_spiky((double)position[2] - position[0], h);
    // Compression counts, missing neighbours at a free surface do not.
    assert_true(alone < 0.95 * rest && pair > 1.05 * rest);
    WeirDiagnostics d = weir_test_diagnose(sim, false);
    CHECK_NEAR(d.density_error_mean, 2 * (pair - rest) / (3 * rest), 1e-6);
    CHECK_NEAR(d.density_error_max, (pair - rest) / rest, 1e-6);
    weir_sim_destroy(sim);
}

static void hash_depends_on_every_bit(const WeirBackend *backend)
{
    WeirSim *sim = three_particles(backend, 0, -9.81);
    uint64_t hash = weir_test_hash(sim);
    assert_true(weir_test_hash(sim) == hash);
    for (int k = 0; k < 12; ++k) {
        float p[6], v[6];
        memcpy(p, position, sizeof p);
        memcpy(v, velocity, sizeof v);
        float *value = k < 6 ? &p[k] : &v[k - 6];
        *value = nextafterf(*value, 10);
        weir_test_set_state(sim, p, v);
        assert_true(weir_test_hash(sim) != hash);
    }
    // Two particles that change places are another state: the hash goes by id.
    float swapped[6], swapped_velocity[6];
    for (int k = 0; k < 6; ++k) {
        swapped[k] = position[(k + 2) % 6];
        swapped_velocity[k] = velocity[(k + 2) % 6];
    }
    weir_test_set_state(sim, swapped, swapped_velocity);
    assert_true(weir_test_hash(sim) != hash);
    weir_test_set_state(sim, position, velocity);
    assert_true(weir_test_hash(sim) == hash);
    weir_sim_destroy(sim);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(motion_by_hand),
    WEIR_SHARED_TEST(potential_energy_by_hand),
    WEIR_SHARED_TEST(density_error_by_hand),
    WEIR_SHARED_TEST(hash_depends_on_every_bit),
};
extern const WeirSharedGroup weir_shared_diagnostics;
WEIR_SHARED_GROUP(diagnostics, tests);
