// Diagnostics against values computed by hand, and against sums over the state that may be read.
#include <math.h>
#include <stddef.h>
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
    WeirDiagnostics d = weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS);
    CHECK_NEAR(d.kinetic_energy, 0.5 * mass * (1 + 4 + 9 + 0.25 + 0.0625), 1e-9 * mass);
    CHECK_NEAR(d.momentum[0], mass * (1 - 3 + 0.5), 1e-9 * mass);
    CHECK_NEAR(d.momentum[1], mass * (2 - 0.25), 1e-9 * mass);
    CHECK_NEAR(d.momentum[2], 0, 0);
    CHECK_NEAR(d.max_speed, 3, 1e-7);
    CHECK_NEAR(d.mean_neighbors, 2.0 / 3, 1e-12);
    assert_int_equal(d.lost_particles, 0);
    assert_int_equal(d.step, 0);
    CHECK_NEAR(d.time, 0, 0);
    assert_true(weir_test_diagnose(sim, 0).mean_neighbors < 0);
    weir_test_step(sim, 7);
    d = weir_test_diagnose(sim, 0);
    assert_int_equal(d.step, 7);
    CHECK_NEAR(d.time, 7 * (double)weir_sim_parameters(sim)->time_step, 1e-15);
    weir_sim_destroy(sim);
}

// Zero at the domain's lowest point along gravity, whichever way that points.
static void potential_energy_by_hand(const WeirBackend *backend)
{
    WeirSim *sim = three_particles(backend, 0, -9.81);
    double mass = weir_sim_constants(sim)->particle_mass;
    CHECK_NEAR(weir_test_diagnose(sim, 0).potential_energy, mass * 9.81 * (1 + 1 + 2.5), 1e-5 * mass);
    weir_sim_destroy(sim);
    sim = three_particles(backend, 3, 4); // lowest at (4, 4)
    double height_sum = 3 * (3 + 2.98125 + 1) + 4 * (3 + 3 + 1.5);
    CHECK_NEAR(weir_test_diagnose(sim, 0).potential_energy, mass * height_sum, 1e-5 * mass);
    weir_sim_destroy(sim);
    sim = three_particles(backend, 0, 0);
    CHECK_NEAR(weir_test_diagnose(sim, 0).potential_energy, 0, 0);
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
    WeirDiagnostics d = weir_test_diagnose(sim, 0);
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

// ---- Sums over the state ----

// The formulas of WeirDiagnostics, once more.
static WeirDiagnostics sum_up(WeirSim *sim, const double lowest[3], const double gravity[3],
                              double *momentum_scale)
{
    WeirState state;
    CHECK_SIM(sim, weir_sim_state(sim, &state), WEIR_OK);
    WeirDiagnostics sum = {0};
    double mass = weir_sim_constants(sim)->particle_mass, rest = weir_sim_parameters(sim)->rest_density;
    size_t fluid = 0;
    *momentum_scale = 0;
    for (size_t i = 0; i < state.count; ++i) {
        if (state.group && state.group[i] != WEIR_GROUP_FLUID) continue;
        double speed2 = 0, excess = fmax((double)state.density[i] - rest, 0) / rest;
        for (uint32_t axis = 0; axis < state.dimension; ++axis) {
            double x = state.position[state.dimension * i + axis],
                   v = state.velocity[state.dimension * i + axis];
            speed2 += v * v;
            sum.momentum[axis] += mass * v;
            sum.potential_energy += mass * gravity[axis] * (lowest[axis] - x);
        }
        *momentum_scale += mass * sqrt(speed2);
        sum.kinetic_energy += 0.5 * mass * speed2;
        sum.max_speed = fmax(sum.max_speed, sqrt(speed2));
        sum.density_error_max = fmax(sum.density_error_max, excess);
        sum.density_error_mean += excess;
        ++fluid;
    }
    sum.density_error_mean /= (double)fluid;
    return sum;
}

static void check_sums(WeirSim *sim, const double lowest[3], const double gravity[3])
{
    double momentum_scale;
    WeirDiagnostics found = weir_test_diagnose(sim, 0), again = weir_test_diagnose(sim, 0);
    assert_memory_equal(&found, &again,
                        offsetof(WeirDiagnostics, lost_particles)); // bits of the same order of sums
    WeirDiagnostics wanted = sum_up(sim, lowest, gravity, &momentum_scale);
    assert_true(wanted.kinetic_energy > 0 && wanted.potential_energy > 0 && wanted.density_error_mean > 0);
    CHECK_NEAR(found.kinetic_energy, wanted.kinetic_energy, 2e-6 * wanted.kinetic_energy);
    CHECK_NEAR(found.potential_energy, wanted.potential_energy, 2e-6 * wanted.potential_energy);
    for (int axis = 0; axis < 3; ++axis)
        CHECK_NEAR(found.momentum[axis], wanted.momentum[axis], 2e-6 * momentum_scale);
    CHECK_NEAR(found.max_speed, wanted.max_speed, 1e-6 * wanted.max_speed);
    // A density of 1000 is known to 6e-5.
    CHECK_NEAR(found.density_error_mean, wanted.density_error_mean, 1e-7);
    CHECK_NEAR(found.density_error_max, wanted.density_error_max, 1e-7);
    assert_int_equal(found.lost_particles, 0);
    assert_true(found.state_hash == 0 && found.mean_neighbors < 0);
    assert_int_equal(found.step, weir_sim_step_count(sim));
    CHECK_NEAR(found.time, weir_sim_time(sim), 1e-12);
    // Whoever asks for more gets the same.
    WeirDiagnostics more = weir_test_diagnose(sim, WEIR_DIAGNOSE_HASH | WEIR_DIAGNOSE_NEIGHBORS);
    assert_true(more.state_hash != 0 && more.mean_neighbors > 1);
    CHECK_NEAR(more.kinetic_energy, wanted.kinetic_energy, 1e-12 * wanted.kinetic_energy);
    CHECK_NEAR(more.potential_energy, wanted.potential_energy, 1e-9 * wanted.potential_energy);
}

static void are_sums_over_the_state(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = weir_test_everything(dimension);
        WeirSim *sim = weir_test_sim(scene, backend, 1);
        const double down[3] = {0, -(double)9.81f, 0}, up_and_right[3] = {-2, 5, 0};
        weir_test_step(sim, 20);
        check_sums(sim, (double[]){-3, 7, 1}, down);
        CHECK_SIM(sim, weir_sim_set_parameter(sim, "gravity", up_and_right, dimension), WEIR_OK);
        CHECK_SIM(sim, weir_sim_run_until(sim, 0.15), WEIR_OK);
        check_sums(sim, (double[]){-3, (double)7.6f, 1}, up_and_right);
        // It has shown all that does not count.
        WeirState state;
        CHECK_SIM(sim, weir_sim_state(sim, &state), WEIR_OK);
        uint32_t empty = 0, inlet = 0, solid = 0;
        for (uint32_t i = 0; i < state.count; ++i) {
            empty += state.group[i] == WEIR_GROUP_EMPTY;
            solid += weir_group_is_solid(state.group[i]);
            inlet += state.group[i] >= WEIR_GROUP_INLET && state.group[i] != WEIR_GROUP_EMPTY;
        }
        assert_true(empty > 0 && inlet > 0 && solid > 0 && weir_sim_clock(sim).drained_particles > 0);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

static void are_sums_over_the_tutorials_state(const WeirBackend *backend)
{
    static const char *const searches[] = {"grid", "all_pairs"};
    for (int n = 0; n < 2; ++n) {
        WeirScene *scene = weir_test_dam();
        weir_test_choose(scene, "search", searches[n]);
        WeirSim *sim = weir_test_sim(scene, backend, 1), *undisturbed = weir_test_sim(scene, backend, 1);
        double *gravity = (double[3]){0};
        weir_scene_get_parameter(scene, "gravity", gravity);
        gravity[1] = (double)(float)gravity[1];
        for (int k = 0; k < 3; ++k) {
            weir_test_step(sim, 9);
            check_sums(sim, (double[]){0, 0, 0}, gravity);
            weir_test_diagnose(sim, 0);
        }
        weir_test_step(undisturbed, 27);
        assert_true(weir_test_hash(sim) == weir_test_hash(undisturbed));
        weir_sim_destroy(undisturbed);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// A state that replaces one of which a copy may be under way.
static void follow_a_new_state(const WeirBackend *backend)
{
    WeirSim *sim = three_particles(backend, 0, -9.81);
    double mass = weir_sim_constants(sim)->particle_mass;
    static const float at_rest[6] = {0};
    weir_test_diagnose(sim, 0);
    weir_test_set_state(sim, position, at_rest);
    CHECK_NEAR(weir_test_diagnose(sim, 0).kinetic_energy, 0, 0);
    weir_test_set_state(sim, position, velocity);
    CHECK_NEAR(weir_test_diagnose(sim, 0).kinetic_energy, 0.5 * mass * 14.3125, 1e-6 * mass);
    weir_sim_destroy(sim);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(are_sums_over_the_state),   WEIR_SHARED_TEST(are_sums_over_the_tutorials_state),
    WEIR_SHARED_TEST(follow_a_new_state),        WEIR_SHARED_TEST(motion_by_hand),
    WEIR_SHARED_TEST(potential_energy_by_hand),  WEIR_SHARED_TEST(density_error_by_hand),
    WEIR_SHARED_TEST(hash_depends_on_every_bit),
};
extern const WeirSharedGroup weir_shared_diagnostics;
WEIR_SHARED_GROUP(diagnostics, tests);
