// Simulations as objects: side by side, reset, read, written, changed while they run.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

static uint64_t hash_after(const WeirScene *scene, const WeirBackend *backend, uint32_t steps)
{
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_step(sim, steps);
    uint64_t hash = weir_test_hash(sim);
    weir_sim_destroy(sim);
    return hash;
}

static void two_runs_have_equal_bits(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    uint64_t hash = hash_after(scene, backend, 60);
    assert_true(hash_after(scene, backend, 60) == hash);
    assert_true(hash_after(scene, backend, 61) != hash);
    weir_scene_destroy(scene);
}

static void two_simulations_do_not_disturb_each_other(const WeirBackend *backend)
{
    WeirScene *dam = weir_test_dam(), *drops = weir_test_drops();
    weir_test_choose(drops, "search", "all_pairs");
    uint64_t dam_alone = hash_after(dam, backend, 50), drops_alone = hash_after(drops, backend, 30);
    WeirSim *first = weir_test_sim(dam, backend, 1), *second = weir_test_sim(drops, backend, 1);
    for (int n = 0; n < 10; ++n) {
        weir_test_step(first, 5);
        if (n == 4) weir_test_hash(first);
        weir_test_step(second, 3);
    }
    assert_true(weir_test_hash(first) == dam_alone);
    assert_true(weir_test_hash(second) == drops_alone);
    weir_sim_destroy(first);
    weir_test_step(second, 1);
    weir_sim_destroy(second);
    weir_scene_destroy(dam);
    weir_scene_destroy(drops);
}

static void reading_changes_nothing(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    uint64_t hash = hash_after(scene, backend, 40);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    for (int n = 0; n < 40; ++n) {
        weir_test_step(sim, 1);
        for (int field = WEIR_FIELD_POSITION; field <= WEIR_FIELD_PRESSURE; ++field)
            free(weir_test_read(sim, (WeirField)field));
    }
    assert_true(weir_test_hash(sim) == hash);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void reset_returns_to_the_start(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    uint64_t start = weir_test_hash(sim);
    weir_test_step(sim, 30);
    uint64_t later = weir_test_hash(sim);
    assert_true(later != start);
    CHECK_SIM(sim, weir_sim_reset(sim), WEIR_OK);
    assert_int_equal(weir_sim_step_count(sim), 0);
    CHECK_NEAR(weir_sim_time(sim), 0, 0);
    assert_true(weir_test_hash(sim) == start);
    weir_test_step(sim, 30);
    assert_true(weir_test_hash(sim) == later);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void state_makes_the_round_trip(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    WeirSim *first = weir_test_sim(scene, backend, 1), *second = weir_test_sim(scene, backend, 1);
    weir_test_step(first, 25);
    float *position = weir_test_read(first, WEIR_FIELD_POSITION);
    float *velocity = weir_test_read(first, WEIR_FIELD_VELOCITY);
    weir_test_step(second, 3);
    weir_test_set_state(second, position, velocity);
    assert_true(weir_test_hash(first) == weir_test_hash(second));
    float *same = weir_test_read(second, WEIR_FIELD_POSITION);
    assert_memory_equal(same, position, 2 * weir_sim_particle_count(first) * sizeof(float));
    // The state is the whole state: both go on alike.
    weir_test_step(first, 25);
    weir_test_step(second, 25);
    assert_true(weir_test_hash(first) == weir_test_hash(second));
    free(position);
    free(velocity);
    free(same);
    weir_sim_destroy(first);
    weir_sim_destroy(second);
    weir_scene_destroy(scene);
}

// What the acceleration field says is what the next step uses: v' = v + a dt, x' = x + v' dt away from walls.
static void step_follows_the_acceleration(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_drops();
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_step(sim, 60);
    float *x = weir_test_read(sim, WEIR_FIELD_POSITION), *v = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    float *a = weir_test_read(sim, WEIR_FIELD_ACCELERATION);
    weir_test_step(sim, 1);
    float *next_x = weir_test_read(sim, WEIR_FIELD_POSITION),
          *next_v = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    double dt = weir_sim_parameters(sim)->time_step, largest = 0;
    for (uint32_t k = 0; k < 2 * weir_sim_particle_count(sim); ++k) {
        CHECK_NEAR(next_v[k], v[k] + a[k] * dt, 3e-7 * (fabs(v[k]) + fabs(a[k]) * dt));
        CHECK_NEAR(next_x[k], x[k] + next_v[k] * dt, 2e-7);
        largest = fmax(largest, fabs(a[k]));
    }
    assert_true(largest > 10); // they do collide by now
    float *fields[] = {x, v, a, next_x, next_v};
    for (int n = 0; n < 5; ++n) free(fields[n]);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void parameters_change_while_it_runs(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_step(sim, 5);
    uint64_t hash = weir_test_hash(sim);
    // Refused: not live, unknown, out of range, wrong count. Nothing changes.
    static const double one = 1, two[2] = {1, 2}, bad = -1, nan = NAN;
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "support_radius", &one, 1), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_sim_error(sim), "support_radius");
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "colour", &one, 1), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_sim_error(sim), "colour");
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "viscosity", &bad, 1), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_sim_error(sim), "-1");
    CHECK_CONTAINS(weir_sim_error(sim), "viscosity");
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "viscosity", &nan, 1), WEIR_ERROR_INPUT);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "viscosity", two, 2), WEIR_ERROR_INPUT);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "gravity", &one, 1), WEIR_ERROR_INPUT);
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
    assert_true(weir_test_hash(sim) == hash);
    // Accepted: visible in the scene as it runs, felt by the particles, and not in the caller's scene.
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "gravity", (double[]){50, 0}, 2), WEIR_OK);
    double values[3];
    CHECK_SCENE(weir_sim_scene(sim), weir_scene_get_parameter(weir_sim_scene(sim), "gravity", values),
                WEIR_OK);
    CHECK_NEAR(values[0], 50, 0);
    CHECK_NEAR(values[1], 0, 0);
    CHECK_SCENE(scene, weir_scene_get_parameter(scene, "gravity", values), WEIR_OK);
    CHECK_NEAR(values[1], -9.81, 1e-6);
    double before = weir_test_diagnose(sim, 0).momentum[0];
    weir_test_step(sim, 10);
    WeirDiagnostics after = weir_test_diagnose(sim, 0);
    double mass = weir_sim_constants(sim)->particle_mass * weir_sim_particle_count(sim);
    double pushed = 50 * 10 * weir_sim_parameters(sim)->time_step * mass;
    CHECK_NEAR(after.momentum[0] - before, pushed, 0.25 * pushed); // the left wall pushes as well
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Every live parameter can be set to its current value, every other one is refused.
static void live_means_live(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    for (uint32_t n = 0; n < weir_parameter_count(); ++n) {
        const WeirParameterInfo *info = weir_parameter_info(n);
        double values[3];
        CHECK_SCENE(scene, weir_scene_get_parameter(scene, info->name, values), WEIR_OK);
        WeirStatus status =
            weir_sim_set_parameter(sim, info->name, values, info->kind == WEIR_PARAMETER_VECTOR ? 3 : 1);
        CHECK_SIM(sim, status, info->live ? WEIR_OK : WEIR_ERROR_INPUT);
    }
    weir_test_step(sim, 2);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void reading_needs_room(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_count_scene(4, 1, 0.05, 0.12);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    float values[8];
    for (int field = WEIR_FIELD_POSITION; field <= WEIR_FIELD_PRESSURE; ++field) {
        uint32_t needed = 4 * weir_field_components((WeirField)field, 2);
        for (int k = 0; k < 8; ++k) values[k] = -7;
        CHECK_SIM(sim, weir_sim_read(sim, (WeirField)field, values, needed - 1), WEIR_ERROR_INPUT);
        char number[16];
        snprintf(number, sizeof number, "%u", (unsigned)needed);
        CHECK_CONTAINS(weir_sim_error(sim), number);
        for (int k = 0; k < 8; ++k) CHECK_NEAR(values[k], -7, 0);
        CHECK_SIM(sim, weir_sim_read(sim, (WeirField)field, values, needed), WEIR_OK);
        if (needed == 4) CHECK_NEAR(values[4], -7, 0);
    }
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Places and velocities are read without evaluating; they are those of a full read, walls that move and slide included, and
// change nothing that follows.
static void reads_of_motion_are_those_of_full_reads(const WeirBackend *backend)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    weir_test_set(scene, "particle_spacing", 0.05);
    weir_test_set(scene, "support_radius", 0.15);
    weir_scene_set_domain(scene, (double[3]){0, 0, 0}, (double[3]){2, 1, 1});
    weir_scene_add_box(scene, (double[3]){0, 0, 0}, (double[3]){1, 0.4, 0}, NULL);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[0].box.min", (double[]){1.5, 0.2}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[0].box.max", (double[]){1.7, 0.4}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[0].motion.velocity", (double[]){-1, 0}, 2),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "walls[0].motion.angular_velocity", 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[1].box.min", (double[]){1.1, 0.6}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[1].box.max", (double[]){1.3, 0.8}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[1].surface_velocity", (double[]){0, 0.3}, 2),
                WEIR_OK);
    WeirSim *motion = weir_test_sim(scene, backend, 1), *full = weir_test_sim(scene, backend, 2);
    size_t bytes = 2 * weir_sim_particle_count(motion) * sizeof(float);
    float *both = malloc(2 * bytes);
    assert_non_null(both);
    for (int n = 0; n < 3; ++n) {
        weir_test_step(motion, 20);
        weir_test_step(full, 20);
        free(weir_test_read(full, WEIR_FIELD_PRESSURE));
        size_t floats = bytes / sizeof *both;
        CHECK_SIM(motion, weir_sim_read_motion(motion, both, both + floats, floats), WEIR_OK);
        assert_int_equal(weir_sim_read_motion(motion, both, both + floats, floats - 1), WEIR_ERROR_INPUT);
        for (int field = WEIR_FIELD_POSITION; field <= WEIR_FIELD_VELOCITY; ++field) {
            float *a = weir_test_read(motion, (WeirField)field), *b = weir_test_read(full, (WeirField)field);
            assert_memory_equal(a, b, bytes);
            assert_memory_equal(a, both + (field == WEIR_FIELD_VELOCITY ? floats : 0), bytes);
            free(a);
            free(b);
        }
    }
    assert_true(weir_test_hash(motion) == weir_test_hash(full)); // reads the densities too
    free(both);
    weir_sim_destroy(motion);
    weir_sim_destroy(full);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(reads_of_motion_are_those_of_full_reads),
    WEIR_SHARED_TEST(two_runs_have_equal_bits),
    WEIR_SHARED_TEST(two_simulations_do_not_disturb_each_other),
    WEIR_SHARED_TEST(reading_changes_nothing),
    WEIR_SHARED_TEST(reset_returns_to_the_start),
    WEIR_SHARED_TEST(state_makes_the_round_trip),
    WEIR_SHARED_TEST(step_follows_the_acceleration),
    WEIR_SHARED_TEST(parameters_change_while_it_runs),
    WEIR_SHARED_TEST(live_means_live),
    WEIR_SHARED_TEST(reading_needs_room),
};
extern const WeirSharedGroup weir_shared_lifecycle;
WEIR_SHARED_GROUP(lifecycle, tests);
