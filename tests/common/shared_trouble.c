// States that cannot be: refused where they enter, detected where they arise.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

// Steps until the simulation stops; the GPU may learn of the fault some steps late.
static WeirStatus run_until_stop(WeirSim *sim, int steps)
{
    WeirStatus status = WEIR_OK;
    for (int n = 0; n < steps && status == WEIR_OK; ++n) {
        status = weir_sim_step(sim, 1);
        if (status == WEIR_OK) status = weir_sim_wait(sim);
        if (status == WEIR_OK) status = weir_sim_poll(sim);
    }
    return status;
}

static void blow_up_is_reported(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    double stable = weir_scene_stable_time_step(scene);
    weir_test_set(scene, "time_step", 5 * stable);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    assert_true(strlen(weir_sim_warning(sim)) > 0);
    CHECK_SIM(sim, run_until_stop(sim, 2000), WEIR_ERROR_UNSTABLE);
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_ERROR_UNSTABLE);
    const char *message = weir_sim_error(sim);
    CHECK_CONTAINS(message, "step");
    CHECK_CONTAINS(message, "time_step");
    char hint[32];
    snprintf(hint, sizeof hint, "%.2g", stable);
    CHECK_CONTAINS(message, hint);
    // It stays stopped until the reset, then it can go on.
    assert_int_equal(weir_sim_step(sim, 1), WEIR_ERROR_UNSTABLE);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "time_step", (double[]){0.5 * stable}, 1), WEIR_OK);
    CHECK_SIM(sim, weir_sim_reset(sim), WEIR_OK);
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
    weir_test_step(sim, 20);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// The step in the message is the one at which the first particle was too fast.
static void blow_up_names_its_step(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_count_scene(1, 1, 0.05, 0.12);
    weir_test_gravity(scene, 0, -1000);
    weir_test_set(scene, "time_step", 0.001);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    float limit = weir_sim_constants(sim)->speed_limit;
    assert_true(limit > 10 && limit < 1000);
    float position[2] = {0.5f, 0.9f}, velocity[2] = {0, -limit + 2.5f};
    weir_test_set_state(sim, position, velocity);
    CHECK_SIM(sim, run_until_stop(sim, 10), WEIR_ERROR_UNSTABLE);
    CHECK_CONTAINS(weir_sim_error(sim), "step 3");
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void impossible_states_are_refused(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_step(sim, 3);
    uint64_t hash = weir_test_hash(sim);
    static const float bad[] = {NAN, INFINITY, -INFINITY, 1e30f, -0.5f, 1.5f};
    for (size_t n = 0; n < sizeof bad / sizeof bad[0]; ++n) {
        for (int which = 0; which < 2; ++which) {
            if (which == 1 && fabsf(bad[n]) < 2) continue; // a fair velocity
            if (which == 1 && bad[n] == 1e30f) continue;   // absurd, but a number: the next step detects it
            float *values[2] = {weir_test_read(sim, WEIR_FIELD_POSITION),
                                weir_test_read(sim, WEIR_FIELD_VELOCITY)};
            values[which][101] = bad[n];
            CHECK_SIM(sim, weir_sim_set_state(sim, values[0], values[1]), WEIR_ERROR_INPUT);
            CHECK_CONTAINS(weir_sim_error(sim), "50"); // the particle's id
            free(values[0]);
            free(values[1]);
            CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
            assert_true(weir_test_hash(sim) == hash);
        }
    }
    weir_test_step(sim, 1);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void absurd_speed_is_a_blow_up(const WeirBackend *backend)
{
    static const float speeds[] = {1e4f, 1e30f};
    for (int n = 0; n < 2; ++n) {
        WeirScene *scene = weir_test_dam();
        WeirSim *sim = weir_test_sim(scene, backend, 1);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
        float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
        velocity[100] = speeds[n];
        WeirStatus status = weir_sim_set_state(sim, position, velocity);
        if (status == WEIR_OK) status = run_until_stop(sim, 5);
        assert_true(status == WEIR_ERROR_UNSTABLE || status == WEIR_ERROR_INPUT);
        assert_true(strlen(weir_sim_error(sim)) > 0);
        free(position);
        free(velocity);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(blow_up_is_reported),
    WEIR_SHARED_TEST(blow_up_names_its_step),
    WEIR_SHARED_TEST(impossible_states_are_refused),
    WEIR_SHARED_TEST(absurd_speed_is_a_blow_up),
};
extern const WeirSharedGroup weir_shared_trouble;
WEIR_SHARED_GROUP(trouble, tests);
