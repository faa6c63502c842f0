// What the public header promises beside the physics.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/solver.h"

static void null_is_allowed_where_the_header_says(void **state)
{
    (void)state;
    weir_scene_destroy(NULL);
    weir_sim_destroy(NULL);
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_sim_create(scene, NULL); // all defaults
    assert_non_null(sim);
    weir_scene_destroy(scene); // the simulation has its own copy
    CHECK_SIM(sim, weir_sim_set_tool(sim, NULL), WEIR_OK);
    CHECK_SIM(sim, weir_sim_advance(sim, 0.01025, NULL), WEIR_OK);
    assert_int_equal(weir_sim_step_count(sim), 20);
    weir_sim_destroy(sim);
    // Zeroed options are the defaults too.
    scene = weir_test_dam();
    sim = weir_sim_create(scene, &(WeirSimOptions){0});
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void cpu_backend_describes_itself(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    for (uint32_t threads = 0; threads < 4; ++threads) {
        WeirSim *sim = weir_test_sim(scene, weir_cpu_backend(), threads);
        assert_string_equal(weir_sim_backend(sim), "cpu");
        char text[32];
        snprintf(text, sizeof text, "%u thread", (unsigned)weir_sim_threads(sim));
        CHECK_CONTAINS(weir_sim_device(sim), "CPU");
        CHECK_CONTAINS(weir_sim_device(sim), text);
        if (threads)
            assert_int_equal(weir_sim_threads(sim), threads);
        else
            assert_true(weir_sim_threads(sim) >= 1);
        assert_int_equal(weir_sim_particle_count(sim), 400);
        assert_string_equal(weir_sim_error(sim), "");
        assert_string_equal(weir_sim_warning(sim), "");
        weir_sim_destroy(sim);
    }
    weir_scene_destroy(scene);
}

static void absurd_thread_counts_are_survived(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_sim_create(scene, &(WeirSimOptions){.threads = 1000000});
    assert_non_null(sim);
    if (weir_sim_status(sim) == WEIR_OK) {
        assert_true(weir_sim_threads(sim) >= 1 && weir_sim_threads(sim) <= 1024);
        weir_test_step(sim, 2);
    } else {
        assert_true(strlen(weir_sim_error(sim)) > 0);
    }
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void field_components(void **state)
{
    (void)state;
    assert_int_equal(weir_field_components(WEIR_FIELD_POSITION, 2), 2);
    assert_int_equal(weir_field_components(WEIR_FIELD_VELOCITY, 2), 2);
    assert_int_equal(weir_field_components(WEIR_FIELD_ACCELERATION, 2), 2);
    assert_int_equal(weir_field_components(WEIR_FIELD_DENSITY, 2), 1);
    assert_int_equal(weir_field_components(WEIR_FIELD_PRESSURE, 2), 1);
    assert_int_equal(weir_field_components(WEIR_FIELD_VELOCITY, 3), 3);
    assert_int_equal(weir_field_components(WEIR_FIELD_GROUP, 3), 1);
    WeirScene *scene = weir_test_count_scene(1, 1, 0.05, 0.12);
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    float values[8];
    CHECK_SIM(sim, weir_sim_read(sim, (WeirField)99, values, 8), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_sim_error(sim), "99");
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// The same six names, in order, as the shader files.
static void passes_have_their_names(void **state)
{
    (void)state;
    static const char *const names[] = {"count", "scan", "scatter", "density", "forces", "integrate"};
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    weir_test_step(sim, 1);
    WeirPassTime times[8];
    assert_int_equal(weir_sim_pass_times(sim, NULL, 0), 6);
    assert_int_equal(weir_sim_pass_times(sim, times, 8), 6);
    double total = 0;
    for (int n = 0; n < 6; ++n) {
        assert_string_equal(times[n].name, names[n]);
        assert_true(times[n].milliseconds >= 0 && times[n].milliseconds < 60000);
        total += times[n].milliseconds;
    }
    assert_true(total > 0);
    times[1].name = "untouched";
    assert_int_equal(weir_sim_pass_times(sim, times, 1), 6);
    assert_string_equal(times[1].name, "untouched");
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void zero_steps_are_no_steps(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    uint64_t hash = weir_test_hash(sim);
    weir_test_step(sim, 0);
    assert_int_equal(weir_sim_step_count(sim), 0);
    assert_true(weir_test_hash(sim) == hash);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// A parameter that changes midway changes the clock from then on only.
static void time_counts_the_steps_as_taken(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    double first = 0.0004f, second = 0.0001f;
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "time_step", &first, 1), WEIR_OK);
    weir_test_step(sim, 10);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "time_step", &second, 1), WEIR_OK);
    weir_test_step(sim, 10);
    CHECK_NEAR(weir_sim_time(sim), 10 * first + 10 * second, 1e-15);
    CHECK_NEAR(weir_test_diagnose(sim, 0).time, 10 * first + 10 * second, 1e-15);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Reset starts the scene again with the parameters as they were changed, not as they once were.
static void reset_keeps_changed_parameters(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_dam();
    WeirSim *changed = weir_test_sim(scene, NULL, 1);
    weir_test_step(changed, 5);
    CHECK_SIM(changed, weir_sim_set_parameter(changed, "viscosity", (double[]){2}, 1), WEIR_OK);
    CHECK_SIM(changed, weir_sim_set_parameter(changed, "kernels", (double[]){1}, 1), WEIR_OK);
    CHECK_SIM(changed, weir_sim_reset(changed), WEIR_OK);
    weir_test_set(scene, "viscosity", 2);
    weir_test_choose(scene, "kernels", "tutorial");
    WeirSim *fresh = weir_test_sim(scene, NULL, 1);
    weir_test_step(changed, 20);
    weir_test_step(fresh, 20);
    assert_true(weir_test_hash(changed) == weir_test_hash(fresh));
    weir_sim_destroy(changed);
    weir_sim_destroy(fresh);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(null_is_allowed_where_the_header_says),
        cmocka_unit_test(cpu_backend_describes_itself),
        cmocka_unit_test(absurd_thread_counts_are_survived),
        cmocka_unit_test(field_components),
        cmocka_unit_test(passes_have_their_names),
        cmocka_unit_test(zero_steps_are_no_steps),
        cmocka_unit_test(time_counts_the_steps_as_taken),
        cmocka_unit_test(reset_keeps_changed_parameters),
    };
    return cmocka_run_group_tests_name("api", tests, NULL, NULL);
}
