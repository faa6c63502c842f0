// The checks of a scene as a whole, and that a bad scene gives a simulation with a message, never a crash.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene.h"

// Refused by check, count and simulation, with one message that holds all of `says`.
static void check_refused(WeirScene *scene, const char *const says[], size_t count)
{
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_ERROR_INPUT);
    for (size_t n = 0; n < count; ++n) CHECK_CONTAINS(weir_scene_error(scene), says[n]);
    assert_int_equal(weir_scene_particle_count(scene), 0);
    WeirSim *sim = weir_sim_create(scene, NULL);
    assert_non_null(sim);
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_ERROR_INPUT);
    assert_string_equal(weir_sim_error(sim), weir_scene_error(scene));
    // Nothing that is called on it crashes.
    float values[2];
    WeirDiagnostics diagnostics;
    assert_int_equal(weir_sim_step(sim, 1), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_advance(sim, 1, NULL), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_poll(sim), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_wait(sim), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_reset(sim), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_read(sim, WEIR_FIELD_POSITION, values, 2), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS, &diagnostics), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_set_state(sim, values, values), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_set_parameter(sim, "viscosity", (double[]){1}, 1), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_set_tool(sim, NULL), WEIR_ERROR_INPUT);
    assert_int_equal(weir_sim_pass_times(sim, NULL, 0), 0);
    assert_int_equal(weir_sim_particle_count(sim), 0);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}
#define CHECK_REFUSED(scene, ...)                                                                            \
    check_refused(scene, (const char *const[]){__VA_ARGS__},                                                 \
                  sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

static WeirScene *empty(void)
{
    return weir_test_scene(0.05, 0.12, 0, 2);
}

static void set_pair(WeirScene *scene, const char *path, double x, double y)
{
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, (double[]){x, y}, 2), WEIR_OK);
}

static void some_fluid_is_needed(void **state)
{
    (void)state;
    CHECK_REFUSED(empty(), "fluid", "box");
    WeirScene *scene = empty();
    weir_test_box(scene, 1, 1, 1.01, 1.5); // thinner than half a spacing
    CHECK_REFUSED(scene, "fluid[0]", "particle_spacing", "0.05");
    scene = empty();
    weir_test_ball(scene, 1, 1, 1e-6, 0, 0);
    CHECK_REFUSED(scene, "fluid[0]", "particle_spacing");
}

static void missing_keys_are_named(void **state)
{
    (void)state;
    static const char *const given[] = {"fluid[0].box.min", "fluid[0].box.max", "fluid[0].ball.center",
                                        "fluid[0].velocity"};
    static const char *const missing[] = {"box.max", "box.min", "ball.radius", "box or ball"};
    for (int n = 0; n < 4; ++n) {
        WeirScene *scene = empty();
        set_pair(scene, given[n], 1, 1);
        CHECK_REFUSED(scene, "fluid[0]", missing[n], "missing");
    }
    WeirScene *scene = empty();
    CHECK_SCENE(scene, weir_scene_set_number(scene, "fluid[0].ball.radius", 0.1), WEIR_OK);
    CHECK_REFUSED(scene, "fluid[0]", "ball.center", "missing");
}

static void fluid_stays_in_the_domain(void **state)
{
    (void)state;
    static const double boxes[][4] = {
        {-0.1, 0.5, 1, 1}, {0.5, -0.1, 1, 1}, {0.5, 0.5, 2.1, 1}, {0.5, 0.5, 1, 2.1}, {3, 3, 4, 4}};
    for (int n = 0; n < 5; ++n) {
        WeirScene *scene = empty();
        weir_test_box(scene, 0.1, 0.1, 0.3, 0.3);
        weir_test_box(scene, boxes[n][0], boxes[n][1], boxes[n][2], boxes[n][3]);
        CHECK_REFUSED(scene, "fluid[1]", "domain", "0", "2");
    }
    WeirScene *scene = empty();
    weir_test_ball(scene, 1.9, 1, 0.2, 0, 0);
    CHECK_REFUSED(scene, "fluid[0]", "domain", "2.1");
}

static void turned_boxes_are_refused(void **state)
{
    (void)state;
    WeirScene *scene = empty();
    weir_test_box(scene, 1, 1, 0.5, 1.5);
    CHECK_REFUSED(scene, "fluid[0]", "min", "max", "0.5");
    scene = empty();
    weir_test_box(scene, 1, 1, 1.5, 1);
    CHECK_REFUSED(scene, "fluid[0]", "min", "max");
    scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1, 1);
    set_pair(scene, "domain.min", 3, 0);
    CHECK_REFUSED(scene, "domain", "min", "max", "3", "2");
    scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1, 1);
    set_pair(scene, "domain.max", 0, 0);
    CHECK_REFUSED(scene, "domain");
}

static void overlaps_are_refused(void **state)
{
    (void)state;
    WeirScene *scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1, 1);
    weir_test_box(scene, 0.9, 0.9, 1.5, 1.5);
    CHECK_REFUSED(scene, "fluid[0]", "fluid[1]", "overlaps");
    scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1.5, 1.5);
    weir_test_box(scene, 0.9, 0.9, 1, 1); // inside the other one
    CHECK_REFUSED(scene, "overlaps");
    scene = empty();
    weir_test_ball(scene, 1, 1, 0.3, 0, 0);
    weir_test_ball(scene, 1.4, 1, 0.3, 0, 0);
    CHECK_REFUSED(scene, "overlaps");
    scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1, 1);
    weir_test_ball(scene, 1.1, 0.75, 0.3, 0, 0);
    CHECK_REFUSED(scene, "overlaps");
    scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1, 1);
    weir_test_box(scene, 0.5, 0.5, 1, 1); // the same twice
    CHECK_REFUSED(scene, "overlaps");
    // Side by side is fine, and so is a ball that almost touches a box.
    scene = empty();
    weir_test_box(scene, 0, 0, 1, 1);
    weir_test_box(scene, 1, 0, 2, 1);
    weir_test_box(scene, 0, 1, 1, 2);
    weir_test_ball(scene, 1.5, 1.6, 0.39, 0, 0);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
    assert_true(weir_scene_particle_count(scene) > 1200);
    weir_scene_destroy(scene);
}

static void absurd_counts_are_refused_at_once(void **state)
{
    (void)state;
    static const double sizes[] = {1, 1e4, 1e5};
    for (int n = 0; n < 3; ++n) {
        for (int ball = 0; ball < 2; ++ball) {
            WeirScene *scene = weir_test_scene(1e-5, 2.5e-5, -sizes[n], sizes[n]);
            if (ball)
                weir_test_ball(scene, 0, 0, sizes[n], 0, 0);
            else
                weir_test_box(scene, -sizes[n], -sizes[n], sizes[n], sizes[n]);
            CHECK_REFUSED(scene, "particles", "particle_spacing", "1e-05");
        }
    }
}

static void support_must_fit_the_spacing(void **state)
{
    (void)state;
    static const double ratios[] = {0.5, 1.0, 41, 1000};
    for (int n = 0; n < 4; ++n) {
        WeirScene *scene = weir_test_scene(0.05, 0.05 * ratios[n], 0, 2);
        weir_test_box(scene, 0.5, 0.5, 1, 1);
        CHECK_REFUSED(scene, "support_radius", "particle_spacing", "40");
    }
}

static void counts_are_exact(void **state)
{
    (void)state;
    WeirScene *scene = empty();
    weir_test_box(scene, 0, 0, 2, 0.5);
    assert_int_equal(weir_scene_particle_count(scene), 40 * 10);
    weir_test_box(scene, 0.5, 1, 0.55, 1.05);
    assert_int_equal(weir_scene_particle_count(scene), 40 * 10 + 1);
    weir_scene_destroy(scene);
    // A ball holds about pi r^2 / spacing^2.
    scene = empty();
    weir_test_ball(scene, 1, 1, 0.8, 0, 0);
    CHECK_NEAR(weir_scene_particle_count(scene), 3.14159265 * 0.64 / 0.0025, 25);
    weir_scene_destroy(scene);
}

static void warning_names_the_stable_step(void **state)
{
    (void)state;
    WeirScene *scene = empty();
    weir_test_box(scene, 0.5, 0.5, 1, 1);
    double stable = weir_scene_stable_time_step(scene);
    weir_test_set(scene, "time_step", 0.9 * stable);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
    assert_string_equal(weir_scene_warning(scene), "");
    weir_test_set(scene, "time_step", 1.1 * stable);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK); // advice, no error
    char number[32];
    snprintf(number, sizeof number, "%.2g", stable);
    CHECK_CONTAINS(weir_scene_warning(scene), "time_step");
    CHECK_CONTAINS(weir_scene_warning(scene), number);
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    assert_string_equal(weir_sim_warning(sim), weir_scene_warning(scene));
    // The advice follows a change while it runs.
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "time_step", (double[]){0.9 * stable}, 1), WEIR_OK);
    assert_string_equal(weir_sim_warning(sim), "");
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(some_fluid_is_needed),          cmocka_unit_test(missing_keys_are_named),
        cmocka_unit_test(fluid_stays_in_the_domain),     cmocka_unit_test(turned_boxes_are_refused),
        cmocka_unit_test(overlaps_are_refused),          cmocka_unit_test(absurd_counts_are_refused_at_once),
        cmocka_unit_test(support_must_fit_the_spacing),  cmocka_unit_test(counts_are_exact),
        cmocka_unit_test(warning_names_the_stable_step),
    };
    return cmocka_run_group_tests_name("scene_check", tests, NULL, NULL);
}
