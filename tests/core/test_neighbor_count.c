// Neighbours and candidates from a sample: the whole fluid as sample gives what weir_sim_diagnose() counts.
#include <math.h>

#include "common/build.h"

// A small wcsph dam in its tank, in motion.
static WeirSim *wcsph_dam(uint32_t dimension, const char *periodic)
{
    WeirScene *scene = weir_scene_create();
    assert_non_null(scene);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", 0.05);
    weir_test_set(scene, "support_radius", 0.11);
    weir_scene_set_domain(scene, (double[3]){0}, (double[3]){1.0, 0.6, 0.4});
    weir_scene_add_box(scene, (double[3]){0}, (double[3]){0.5, 0.5, 0.4}, NULL);
    if (periodic) CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", periodic), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, weir_cpu_backend(), 1);
    weir_test_step(sim, 60);
    weir_scene_destroy(scene);
    return sim;
}

static WeirNeighborCount count(WeirSim *sim, uint32_t particles)
{
    WeirNeighborCount found;
    CHECK_SIM(sim, weir_sim_count_neighbors(sim, particles, &found), WEIR_OK);
    return found;
}

static void check_against_diagnosis(WeirSim *sim, double most_candidates)
{
    double mean = weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).mean_neighbors;
    uint32_t fluid = weir_sim_clock(sim).fluid_particles;
    WeirNeighborCount all = count(sim, UINT32_MAX), some = count(sim, fluid / 3);
    assert_int_equal(all.particles, fluid);
    CHECK_NEAR(all.neighbors, mean, 1e-3 * mean); // on the rim of a support float and double may differ
    CHECK_NEAR(some.neighbors, mean, 0.1 * mean);
    assert_true(some.particles < fluid && some.particles >= fluid / 4);
    assert_true(all.candidates > 1.1 * all.neighbors);
    CHECK_AT_MOST(all.candidates, most_candidates * all.neighbors);
}

static void a_sample_of_all_is_the_diagnosis(void **state)
{
    (void)state;
    WeirSim *sim = wcsph_dam(2, NULL);
    check_against_diagnosis(sim, 2.6);
    weir_sim_destroy(sim);
    sim = wcsph_dam(3, NULL);
    check_against_diagnosis(sim, 5.0);
    weir_sim_destroy(sim);
    WeirScene *scene = weir_test_dam();
    sim = weir_test_sim(scene, weir_cpu_backend(), 1);
    weir_test_step(sim, 100);
    check_against_diagnosis(sim, 2.8);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void all_pairs_offers_everybody(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    weir_test_choose(scene, "search", "all_pairs");
    WeirSim *sim = weir_test_sim(scene, weir_cpu_backend(), 1);
    WeirNeighborCount found = count(sim, 0);
    CHECK_NEAR(found.candidates, 399.0, 0.0);
    CHECK_NEAR(found.neighbors, weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).mean_neighbors, 1e-2);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void across_a_periodic_border_all_are_counted(void **state)
{
    (void)state;
    WeirSim *sim = wcsph_dam(2, "x");
    WeirNeighborCount found = count(sim, 10);
    CHECK_NEAR(found.neighbors, weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).mean_neighbors, 0.0);
    assert_true(isnan(found.candidates));
    weir_sim_destroy(sim);
}

static void the_cpu_has_no_device_memory(void **state)
{
    (void)state;
    WeirSim *sim = wcsph_dam(2, NULL);
    assert_int_equal(weir_sim_device_memory(sim), 0);
    weir_sim_destroy(sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sample_of_all_is_the_diagnosis),
        cmocka_unit_test(all_pairs_offers_everybody),
        cmocka_unit_test(across_a_periodic_border_all_are_counted),
        cmocka_unit_test(the_cpu_has_no_device_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
