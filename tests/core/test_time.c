// The accumulator: wall time in, the right number of steps out, and never a debt that grows.
#include <math.h>
#include <stdio.h>

#include "common/build.h"
#include "core/sim.h"

static WeirSim *clock_sim(double time_step, double time_scale, uint32_t max_steps, double max_lag)
{
    WeirScene *scene = weir_test_count_scene(1, 1, 0.05, 0.12);
    weir_test_set(scene, "time_step", time_step);
    weir_test_set(scene, "time_scale", time_scale);
    WeirSim *sim =
        weir_sim_create(scene, &(WeirSimOptions){.threads = 1, .max_steps = max_steps, .max_lag = max_lag});
    assert_non_null(sim);
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
    weir_scene_destroy(scene);
    return sim;
}

static uint32_t advance(WeirSim *sim, double wall_seconds)
{
    uint32_t taken = 12345;
    uint64_t before = weir_sim_step_count(sim);
    CHECK_SIM(sim, weir_sim_advance(sim, wall_seconds, &taken), WEIR_OK);
    assert_int_equal(weir_sim_step_count(sim) - before, taken);
    return taken;
}

static void real_time_for_any_frame_rate(void **state)
{
    (void)state;
    static const double rates[] = {24, 30, 59.94, 60, 75, 144, 1000.0 / 7, 240, 997};
    for (size_t n = 0; n < sizeof rates / sizeof rates[0]; ++n) {
        WeirSim *sim = clock_sim(0.0008, 1, 0, 0);
        double wall = 0;
        uint32_t least = UINT32_MAX, most = 0;
        while (wall < 3) {
            uint32_t taken = advance(sim, 1 / rates[n]);
            wall += 1 / rates[n];
            if (taken < least) least = taken;
            if (taken > most) most = taken;
            CHECK_NEAR(weir_sim_time(sim), wall, 0.0008 * 1.01);
        }
        assert_true(most - least <= 1); // even frames, even steps
        weir_sim_destroy(sim);
    }
}

static void jitter_loses_nothing(void **state)
{
    (void)state;
    WeirRandom random = {.state = 99};
    WeirSim *sim = clock_sim(0.0005, 1, 0, 0);
    double wall = 0;
    for (int frame = 0; frame < 500; ++frame) {
        double elapsed = weir_random_range(&random, 0, 0.03);
        if (frame % 50 == 0) elapsed = 0;
        wall += elapsed;
        advance(sim, elapsed);
        CHECK_NEAR(weir_sim_time(sim), wall, 0.0005 * 1.01);
    }
    weir_sim_destroy(sim);
}

// The same wall time in other slices gives the same number of steps, and so the same bits.
static void slices_do_not_matter(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    uint64_t hash = 0;
    static const int slices[] = {1, 2, 5, 16};
    for (int n = 0; n < 4; ++n) {
        WeirSim *sim = weir_test_sim(scene, NULL, 1);
        // 40.5 steps of 0.0005 s, so that rounding cannot decide about the last one.
        for (int slice = 0; slice < slices[n]; ++slice) advance(sim, 0.02025 / slices[n]);
        assert_int_equal(weir_sim_step_count(sim), 40);
        if (n == 0) hash = weir_test_hash(sim);
        assert_true(weir_test_hash(sim) == hash);
        weir_sim_destroy(sim);
    }
    weir_scene_destroy(scene);
}

static void time_scale_is_simulated_per_wall_second(void **state)
{
    (void)state;
    static const double scales[] = {0.01, 0.5, 1, 2.5, 10};
    for (int n = 0; n < 5; ++n) {
        WeirSim *sim = clock_sim(0.001, scales[n], 1000, 0);
        for (int frame = 0; frame < 120; ++frame) advance(sim, 1.0 / 60);
        CHECK_NEAR(weir_sim_time(sim), 2 * scales[n], 0.0011);
        weir_sim_destroy(sim);
    }
}

static void steps_are_capped_and_the_rest_is_dropped(void **state)
{
    (void)state;
    WeirSim *sim = clock_sim(0.0005, 1, 20, 0);
    for (int frame = 0; frame < 100; ++frame) assert_int_equal(advance(sim, 1.0 / 60), 20); // 33 are due
    assert_int_equal(advance(sim, 0), 0);                                                   // nothing is owed
    assert_true(advance(sim, 0.00501) <= 11);
    weir_sim_set_max_steps(sim, 5);
    assert_int_equal(advance(sim, 1.0 / 60), 5);
    weir_sim_set_max_steps(sim, 0); // the default
    assert_int_equal(advance(sim, 0.09), 64);
    weir_sim_destroy(sim);
}

static void a_long_pause_is_forgotten(void **state)
{
    (void)state;
    WeirSim *sim = clock_sim(0.0005, 1, 1000000, 0);
    uint32_t taken = advance(sim, 3600);
    assert_true(taken >= 199 && taken <= 201); // max_lag is 0.1 s by default
    assert_true(advance(sim, 0.0) <= 1);
    weir_sim_destroy(sim);
    sim = clock_sim(0.0005, 1, 1000000, 0.02);
    taken = advance(sim, 5);
    assert_true(taken >= 39 && taken <= 41);
    assert_true(advance(sim, 1.0 / 60) <= 34);
    weir_sim_destroy(sim);
}

// A machine far too slow for the scene: every frame takes as long as its steps did. The frame time
// must settle.
static void overload_never_spirals(void **state)
{
    (void)state;
    WeirSim *sim = clock_sim(0.0005, 1, 0, 0);
    double frame = 1.0 / 60, cost_per_step = 0.002;
    for (int n = 0; n < 200; ++n) {
        frame = advance(sim, frame) * cost_per_step;
        CHECK_AT_MOST(frame, 64 * cost_per_step);
    }
    weir_sim_destroy(sim);
}

static void strange_times_are_harmless(void **state)
{
    (void)state;
    static const double strange[] = {NAN, -1, -INFINITY, -1e-300};
    for (int n = 0; n < 4; ++n) {
        WeirSim *sim = clock_sim(0.0005, 1, 0, 0);
        uint32_t taken = 7;
        WeirStatus status = weir_sim_advance(sim, strange[n], &taken);
        assert_true(status == WEIR_OK || status == WEIR_ERROR_INPUT);
        assert_int_equal(taken, 0);
        // The clock still runs as before.
        assert_int_equal(advance(sim, 0.01025), 20);
        weir_sim_destroy(sim);
    }
    WeirSim *sim = clock_sim(0.0005, 1, 0, 0);
    uint32_t taken = 7;
    WeirStatus status = weir_sim_advance(sim, INFINITY, &taken);
    assert_true(status == WEIR_OK || status == WEIR_ERROR_INPUT);
    assert_true(taken <= 64);
    CHECK_SIM(sim, weir_sim_advance(sim, 0.01, NULL), WEIR_OK); // NULL is allowed
    weir_sim_destroy(sim);
}

static void reset_empties_the_accumulator(void **state)
{
    (void)state;
    WeirSim *sim = clock_sim(0.01, 1, 0, 0);
    assert_int_equal(advance(sim, 0.0099), 0);
    CHECK_SIM(sim, weir_sim_reset(sim), WEIR_OK);
    assert_int_equal(advance(sim, 0.0099), 0);
    assert_int_equal(advance(sim, 0.0099), 1);
    weir_sim_destroy(sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(real_time_for_any_frame_rate),
        cmocka_unit_test(jitter_loses_nothing),
        cmocka_unit_test(slices_do_not_matter),
        cmocka_unit_test(time_scale_is_simulated_per_wall_second),
        cmocka_unit_test(steps_are_capped_and_the_rest_is_dropped),
        cmocka_unit_test(a_long_pause_is_forgotten),
        cmocka_unit_test(overload_never_spirals),
        cmocka_unit_test(strange_times_are_harmless),
        cmocka_unit_test(reset_empties_the_accumulator),
    };
    return cmocka_run_group_tests_name("time", tests, NULL, NULL);
}
