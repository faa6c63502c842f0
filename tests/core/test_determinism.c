// The same bits for every number of threads, for both neighbour searches where the order of sums is the same,
// and for every way to cut a run into calls.
#include <stdio.h>

#include "common/build.h"
#include "core/sim.h"

static uint64_t hash_with_threads(const WeirScene *scene, uint32_t threads, uint32_t steps)
{
    WeirSim *sim = weir_test_sim(scene, NULL, threads);
    assert_int_equal(weir_sim_threads(sim), threads);
    weir_test_step(sim, steps);
    uint64_t hash = weir_test_hash(sim);
    weir_sim_destroy(sim);
    return hash;
}

static void check_scene(WeirScene *scene, uint32_t steps)
{
    uint64_t hash = hash_with_threads(scene, 1, steps);
    assert_true(hash_with_threads(scene, 2, steps) == hash);
    assert_true(hash_with_threads(scene, 7, steps) == hash);
    weir_scene_destroy(scene);
}

// Enough particles that every thread has work (cpu/mueller.c hands out 512 at a time), fast enough that they
// change cells, and crowded enough that cells hold many.
static WeirScene *busy_scene(void)
{
    WeirScene *scene = weir_test_scene(0.01, 0.035, 0, 1);
    weir_test_gravity(scene, 30, -60);
    weir_test_set(scene, "time_step", 0.0003);
    weir_test_box(scene, 0.3, 0.2, 0.8, 0.6);
    weir_test_ball(scene, 0.6, 0.8, 0.12, -3, -4);
    return scene;
}

static void threads_do_not_change_bits(void **state)
{
    (void)state;
    check_scene(busy_scene(), 60);
}

static void threads_do_not_change_bits_of_all_pairs(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    weir_test_choose(scene, "search", "all_pairs");
    weir_test_choose(scene, "kernels", "tutorial");
    weir_test_box(scene, 0.6, 0, 1, 0.4);
    check_scene(scene, 12);
}

// Everything in one cell, where the order within the cell is all that counts.
static void threads_do_not_change_bits_of_a_crowd(void **state)
{
    (void)state;
    enum { COUNT = 1500 };
    static float position[2 * COUNT], velocity[2 * COUNT];
    WeirRandom random = {.state = 5};
    for (int k = 0; k < 2 * COUNT; ++k) {
        position[k] = (float)weir_random_range(&random, 0.5, 0.52);
        velocity[k] = (float)weir_random_range(&random, -1, 1);
    }
    WeirScene *scene = weir_test_count_scene(COUNT, 1, 0.02, 0.05);
    weir_test_set(scene, "gas_constant", 1);
    weir_test_set(scene, "time_step", 1e-5);
    uint64_t hash = 0;
    for (int n = 0; n < 3; ++n) {
        WeirSim *sim = weir_test_sim(scene, NULL, (uint32_t[]){1, 2, 7}[n]);
        weir_test_set_state(sim, position, velocity);
        weir_test_step(sim, 5);
        if (n == 0) hash = weir_test_hash(sim);
        assert_true(weir_test_hash(sim) == hash);
        weir_sim_destroy(sim);
    }
    weir_scene_destroy(scene);
}

static void calls_do_not_change_bits(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    WeirSim *once = weir_test_sim(scene, NULL, 2), *many = weir_test_sim(scene, NULL, 2);
    weir_test_step(once, 40);
    for (int n = 0; n < 40; ++n) weir_test_step(many, 1);
    assert_true(weir_test_hash(once) == weir_test_hash(many));
    CHECK_NEAR(weir_sim_time(once), weir_sim_time(many), 1e-15);
    weir_sim_destroy(once);
    weir_sim_destroy(many);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_change_bits),
        cmocka_unit_test(threads_do_not_change_bits_of_all_pairs),
        cmocka_unit_test(threads_do_not_change_bits_of_a_crowd),
        cmocka_unit_test(calls_do_not_change_bits),
    };
    return cmocka_run_group_tests_name("determinism", tests, NULL, NULL);
}
