// Measuring code against made-up states: an exact state shows no error, a wrong one fails its gate; formulas against the
// tables of validation/.
#include "common/build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "validation/analytic.h"
#include "validation/measure.h"

extern const char weir_case_elliptical_drop_reference[], weir_case_oscillating_drop_reference[],
    weir_case_rotating_square_reference[], weir_case_standing_wave_reference[],
    weir_case_taylor_green_reference[], weir_case_dam_break_reference[], weir_case_solitary_wave_reference[];

// ---- A square of n x n particles on a lattice ----

typedef struct Made {
    float *position, *velocity, *density, *pressure;
    WeirParameters parameters;
    WeirConstants constants;
    WeirState state;
    WeirSample sample;
} Made;

static void make(Made *made, uint32_t n, double x0, double y0, double side)
{
    WeirScene *scene = weir_scene_create();
    *made = (Made){0};
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "parameters.particle_spacing", side / n), WEIR_OK);
    made->parameters = weir_scene_resolved(scene);
    weir_constants_make(&made->constants, scene, &made->parameters, n * n, NULL);
    weir_scene_destroy(scene);
    made->position = calloc(2 * n * n, sizeof(float));
    made->velocity = calloc(2 * n * n, sizeof(float));
    made->density = calloc(n * n, sizeof(float));
    made->pressure = calloc(n * n, sizeof(float));
    assert_non_null(made->pressure);
    for (uint32_t i = 0; i < n * n; ++i) {
        made->position[2 * i] = (float)(x0 + side / n * (i % n + 0.5));
        made->position[2 * i + 1] = (float)(y0 + side / n * (i / n + 0.5));
        made->density[i] = 1000.0f;
    }
    made->state = (WeirState){.count = n * n,
                              .dimension = 2,
                              .position = made->position,
                              .velocity = made->velocity,
                              .density = made->density,
                              .pressure = made->pressure};
    made->sample = (WeirSample){0.0, &made->state, &made->parameters, &made->constants, NULL};
}

static void unmake(Made *made)
{
    free(made->position);
    free(made->velocity);
    free(made->density);
    free(made->pressure);
}

static const WeirGate *find_gate(const WeirValidation *v, const char *name)
{
    for (uint32_t k = 0; k < weir_validation_gate_count(v); ++k) {
        if (strstr(weir_validation_gate(v, k)->name, name)) return weir_validation_gate(v, k);
    }
    fail_msg("no gate %s", name);
    return NULL;
}

static WeirValidation *create(const char *name)
{
    WeirValidation *v = weir_validation_create(weir_case_find(name), WEIR_RESOLUTION_NORMAL);
    assert_non_null(v);
    return v;
}

// ---- Taylor-Green ----

// Feeds the exact start and an end whose decay is off by the factor `wrong` in its exponent and whose velocities carry an
// error of `noise` spacing^2.
static void feed_taylor_green(WeirValidation *v, double wrong, double noise, double order)
{
    for (uint32_t run = 0; run < weir_validation_run_count(v); ++run) {
        Made made;
        const WeirRunInfo *info = weir_validation_run(v, run);
        double spacing = info->spacing;
        make(&made, 40, 0.0, 0.0, 1.0);
        for (int end = 0; end < 2; ++end) {
            double b = weir_taylor_green_exponent(0.01, 1.0), t = end ? info->end_time : 0.0, u[2];
            for (uint32_t i = 0; i < made.state.count; ++i) {
                weir_taylor_green_velocity(1.0, 1.0, exp(wrong * b * t), made.position[2 * i],
                                           made.position[2 * i + 1], u);
                double error = end ? noise * pow(spacing, order) : 0.0;
                made.velocity[2 * i] = (float)(u[0] + (i % 2 ? error : -error));
                made.velocity[2 * i + 1] = (float)u[1];
            }
            made.sample.time = t;
            weir_validation_feed(v, run, &made.sample);
        }
        v->runs[run].complete = true;
        unmake(&made);
    }
}

static void test_taylor_green_exact_state(void **state)
{
    (void)state;
    WeirValidation *v = create("taylor_green");
    feed_taylor_green(v, 1.0, 0.0, 1.0);
    weir_validation_judge(v);
    CHECK_AT_MOST(find_gate(v, "L1 error at the finest, lattice")->value, 1e-6);
    const WeirGate *decay = find_gate(v, "decay exponent at the finest, disturbed");
    CHECK_NEAR(decay->value, decay->reference, 1e-4);
    assert_true(decay->passed);
    weir_validation_destroy(v);
}

static void test_taylor_green_order_and_wrong_decay(void **state)
{
    (void)state;
    WeirValidation *v = create("taylor_green");
    feed_taylor_green(v, 1.0, 10.0, 2.0);
    assert_true(weir_validation_judge(v));
    CHECK_NEAR(find_gate(v, "order of convergence, lattice")->value, 2.0, 0.05);
    weir_validation_destroy(v);
    v = create("taylor_green");
    feed_taylor_green(v, 1.03, 0.05, 1.0);
    assert_false(weir_validation_judge(v));
    assert_false(find_gate(v, "decay exponent at the finest, lattice")->passed);
    assert_false(find_gate(v, "order of convergence, lattice")->passed);
    weir_validation_destroy(v);
}

// ---- Channel, tank, dam ----

static void feed_poiseuille(WeirValidation *v, double factor)
{
    Made made;
    make(&made, 40, 0.0, 0.0, 1.0);
    for (double t = 0.0; t <= 60.0; t += 2.0) {
        for (uint32_t i = 0; i < made.state.count; ++i)
            made.velocity[2 * i] =
                (float)(factor * weir_poiseuille_speed(1e-5, 0.01, 1.0, made.position[2 * i + 1], t));
        made.sample.time = t;
        weir_validation_feed(v, 0, &made.sample);
    }
    v->runs[0].complete = true;
    unmake(&made);
}

static void test_poiseuille_profiles(void **state)
{
    (void)state;
    WeirValidation *v = create("poiseuille");
    feed_poiseuille(v, 1.0);
    assert_true(weir_validation_judge(v));
    assert_int_equal(weir_validation_gate_count(v), 5);
    CHECK_AT_MOST(weir_validation_gate(v, 4)->value, 1e-6);
    weir_validation_destroy(v);
    v = create("poiseuille");
    feed_poiseuille(v, 1.011);
    assert_false(weir_validation_judge(v));
    for (uint32_t k = 0; k < 5; ++k) CHECK_NEAR(weir_validation_gate(v, k)->value, 0.011, 1e-4);
    weir_validation_destroy(v);
}

static void feed_tank(WeirValidation *v, double pressure_error, double lift)
{
    Made made;
    make(&made, 30, 0.0, 0.0, 0.9);
    made.parameters.gravity[1] = -9.81f;
    for (int k = 0; k <= 100; ++k) {
        for (uint32_t i = 0; i < made.state.count; ++i) {
            if (k == 1) made.position[2 * i + 1] += (float)lift;
            double y = made.position[2 * i + 1];
            made.pressure[i] = (float)((1.0 + pressure_error) * 9810.0 * (0.9 - y));
        }
        made.sample.time = 0.1 * k;
        weir_validation_feed(v, 0, &made.sample);
    }
    v->runs[0].complete = true;
    unmake(&made);
}

static void test_hydrostatic_column(void **state)
{
    (void)state;
    WeirValidation *v = create("hydrostatic_2d");
    feed_tank(v, 0.0, 0.0);
    assert_true(weir_validation_judge(v));
    CHECK_AT_MOST(find_gate(v, "pressure profile")->value, 1e-6);
    CHECK_AT_MOST(find_gate(v, "drift")->value, 1e-4);
    weir_validation_destroy(v);
    v = create("hydrostatic_2d");
    feed_tank(v, 0.02, 0.3 * 0.01);
    assert_false(weir_validation_judge(v));
    CHECK_NEAR(find_gate(v, "pressure profile")->value, 0.02, 1e-5);
    CHECK_NEAR(find_gate(v, "drift")->value, 0.3, 0.01);
    assert_false(find_gate(v, "drift")->passed);
    weir_validation_destroy(v);
}

// A front that follows the table, late by the gate's delay, and then one that is 5 % too far.
static void feed_dam(WeirValidation *v, double factor)
{
    Made made;
    double rows[128], a = 0.05715, unit = sqrt(a / (2.0 * 9.81));
    uint32_t count = weir_reference_read(weir_case_dam_break_reference, 2, rows, 64);
    assert_int_equal(count, 13);
    make(&made, 10, 0.0, 0.0, a);
    double half = 0.5 * (double)made.parameters.particle_spacing;
    for (uint32_t k = 0; k < count; ++k) {
        made.position[0] = (float)(factor * rows[2 * k + 1] * a - half);
        made.sample.time = (rows[2 * k] - 0.175) * unit;
        weir_validation_feed(v, 0, &made.sample);
        if (k + 1 < count) continue;
        made.sample.time += 1e-6 * unit;
        weir_validation_feed(v, 0, &made.sample);
    }
    v->runs[0].complete = true;
    unmake(&made);
}

static void test_dam_front(void **state)
{
    (void)state;
    WeirValidation *v = create("dam_break");
    feed_dam(v, 1.0);
    assert_true(weir_validation_judge(v));
    CHECK_AT_MOST(find_gate(v, "largest deviation, gate delay")->value, 1e-4);
    weir_validation_destroy(v);
    v = create("dam_break");
    feed_dam(v, 1.05);
    assert_false(weir_validation_judge(v));
    CHECK_NEAR(find_gate(v, "RMS deviation, gate delay")->value, 0.05, 1e-4);
    weir_validation_destroy(v);
}

// ---- Formulas and tables ----

static void test_formulas_give_the_tables(void **state)
{
    (void)state;
    double rows[16], axes[2];
    assert_int_equal(weir_reference_read(weir_case_elliptical_drop_reference, 2, rows, 8), 3);
    for (int k = 0; k < 3; ++k) {
        weir_drop_axes(0.0, -100.0, 1.0, rows[2 * k], axes);
        CHECK_NEAR(axes[1], rows[2 * k + 1], 1e-4);
        CHECK_NEAR(axes[0] * axes[1], 1.0, 1e-9);
    }
    assert_int_equal(weir_reference_read(weir_case_oscillating_drop_reference, 2, rows, 8), 1);
    CHECK_NEAR(weir_drop_period(1.0, 0.5, 1.0), rows[0], 2e-6);
    CHECK_NEAR(weir_drop_largest_axis(1.0, 0.5, 1.0), rows[1], 1e-6);
    assert_int_equal(weir_reference_read(weir_case_rotating_square_reference, 1, rows, 8), 1);
    CHECK_NEAR(weir_rotating_square_pressure(1.0, 1.0, 1.0, 0.5, 0.5), rows[0], 1e-4);
    assert_int_equal(weir_reference_read(weir_case_standing_wave_reference, 2, rows, 8), 2);
    for (int k = 0; k < 2; ++k)
        CHECK_NEAR(2.0 * weir_pi / weir_wave_frequency(rows[2 * k], weir_pi, 1.0), rows[2 * k + 1], 1e-4);
    assert_int_equal(weir_reference_read(weir_case_taylor_green_reference, 2, rows, 8), 1);
    CHECK_NEAR(weir_taylor_green_exponent(1.0 / rows[0], 1.0), rows[1], 1e-8);
}

static void test_series_meet_their_ends(void **state)
{
    (void)state;
    for (double y = 0.1; y < 0.95; y += 0.2) {
        CHECK_NEAR(weir_poiseuille_speed(2.0, 0.5, 1.0, y, 0.0), 0.0, 1e-5);
        CHECK_NEAR(weir_poiseuille_speed(2.0, 0.5, 1.0, y, 100.0), 2.0 * y * (1.0 - y), 1e-9);
        CHECK_NEAR(weir_couette_speed(3.0, 0.5, 1.0, y, 1e-4), 0.0, 1e-6);
        CHECK_NEAR(weir_couette_speed(3.0, 0.5, 1.0, y, 100.0), 3.0 * y, 1e-9);
    }
    double speed_and_stroke[2], depth = 0.25, height = 0.05;
    assert_int_equal(weir_reference_read(weir_case_solitary_wave_reference, 2, speed_and_stroke, 1), 1);
    CHECK_NEAR(weir_solitary_speed(9.81, depth, height), speed_and_stroke[0], 1e-6);
    CHECK_NEAR(weir_solitary_surface(depth, height, 0.0), height, 1e-12);
}

static void test_reference_reader(void **state)
{
    (void)state;
    double rows[9];
    assert_int_equal(weir_reference_read("# c\na,b,c\n1,2,3\n\n4,,6\r\n# d\n7,8", 3, rows, 3), 3);
    const double expected[9] = {1, 2, 3, 4, NAN, 6, 7, 8, NAN};
    for (int k = 0; k < 9; ++k) {
        if (isnan(expected[k])) {
            assert_true(isnan(rows[k]));
        } else {
            CHECK_NEAR(rows[k], expected[k], 0.0);
        }
    }
    assert_int_equal(weir_reference_read("h\n1\n2\n3\n", 1, rows, 2), 2);
    assert_int_equal(weir_reference_read("# nothing", 1, rows, 2), 0);
}

static void test_velocity_beside_a_wall_is_linear(void **state)
{
    (void)state;
    Made made;
    make(&made, 30, 0.0, 0.0, 1.0);
    for (uint32_t i = 0; i < made.state.count; ++i) {
        made.velocity[2 * i] = 3.0f * made.position[2 * i + 1] - 1.0f;
        made.velocity[2 * i + 1] = 2.0f * made.position[2 * i];
    }
    const double points[3][3] = {{0.5, 1.0, 0.0}, {0.01, 0.02, 0.0}, {0.437, 0.61, 0.0}};
    for (int k = 0; k < 3; ++k) {
        double velocity[3];
        weir_measure_linear_velocity(&made.sample, points[k], velocity);
        CHECK_NEAR(velocity[0], 3.0 * points[k][1] - 1.0, 1e-5);
        CHECK_NEAR(velocity[1], 2.0 * points[k][0], 1e-5);
    }
    double outside[3];
    weir_measure_linear_velocity(&made.sample, (double[]){3.0, 3.0, 0.0}, outside);
    assert_true(isnan(outside[0]));
    unmake(&made);
}

static void test_depth_is_that_of_water_alone(void **state)
{
    (void)state;
    Made made;
    make(&made, 30, 0.0, 0.0, 1.0);
    CHECK_NEAR(weir_measure_depth(&made.sample, 0.5, 0.0), 1.0, 0.005);
    CHECK_NEAR(weir_measure_depth(&made.sample, 0.0, 0.0), 0.5, 0.005);
    CHECK_NEAR(weir_measure_depth(&made.sample, 3.0, 0.0), 0.0, 0.0);
    for (uint32_t i = 0; i < made.state.count; ++i) // the upper third flies
        if (i / 30 >= 20) made.position[2 * i + 1] += 0.4f;
    CHECK_NEAR(weir_measure_depth(&made.sample, 0.5, 0.0), 1.0, 0.005);
    CHECK_NEAR(weir_measure_height(&made.sample, 0.5, 0.0), 1.4, 0.01);
    for (uint32_t i = 0; i < made.state.count; ++i) made.density[i] = 1010.0f;
    CHECK_NEAR(weir_measure_depth(&made.sample, 0.5, 0.0), 1.0 / 1.01, 0.005);
    unmake(&made);
}

static void test_clusters(void **state)
{
    (void)state;
    Made made;
    make(&made, 20, 0.0, 0.0, 1.0);
    CHECK_NEAR(weir_largest_cluster(&made.sample, 0.1), 1.0, 0.0);
    for (uint32_t i = 0; i < made.state.count; ++i)
        if (i % 20 >= 15) made.position[2 * i] += 0.06f;
    CHECK_NEAR(weir_largest_cluster(&made.sample, 0.1), 0.75, 1e-12);
    unmake(&made);
}

// ---- Engine ----

static void test_every_case_is_complete(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < weir_case_count(); ++k) {
        const WeirCaseInfo *info = weir_case_info(k);
        assert_int_equal(weir_case_find(info->name), k);
        assert_true(*info->title && *info->summary && *info->source);
        for (int resolution = 0; resolution < 3; ++resolution) {
            WeirValidation *v = weir_validation_create(k, (WeirResolution)resolution);
            assert_non_null(v);
            for (uint32_t run = 0; run < weir_validation_run_count(v); ++run) {
                const WeirRunInfo *planned = weir_validation_run(v, run);
                assert_true(planned->spacing > 0.0 && planned->interval > 0.0 && planned->end_time >= 0.0);
                assert_non_null(strstr(planned->scene_text, "\"wcsph\""));
            }
            // Nothing was measured, so whatever needs a simulation fails.
            assert_int_equal(weir_validation_judge(v), weir_validation_run_count(v) == 0);
            assert_true(weir_validation_gate_count(v) > 0);
            weir_validation_destroy(v);
        }
    }
    assert_null(weir_case_info(weir_case_count()));
    assert_null(weir_validation_create(weir_case_count(), WEIR_RESOLUTION_COARSE));
    assert_int_equal(weir_case_find("nonsense"), weir_case_count());
}

static void test_gates_judge(void **state)
{
    (void)state;
    WeirValidation *v = create("dam_break");
    weir_gate_add(v, "a", "1", WEIR_GATE_AT_MOST, 1.0, NAN, 1.0);
    weir_gate_add(v, "b", "1", WEIR_GATE_AT_LEAST, 0.99, NAN, 1.0);
    weir_gate_add(v, "c", "1", WEIR_GATE_RELATIVE, -1.02, -1.0, 0.03);
    weir_gate_add(v, "d", "1", WEIR_GATE_RELATIVE, 1.02, 1.0, 0.01);
    weir_gate_add(v, "e", "1", WEIR_GATE_AT_MOST, NAN, NAN, 1.0);
    weir_gate_add(v, "f", "1", WEIR_GATE_REPORTED, NAN, NAN, NAN);
    const bool expected[6] = {true, false, true, false, false, true};
    for (uint32_t k = 0; k < 6; ++k) assert_int_equal(weir_validation_gate(v, k)->passed, expected[k]);
    weir_validation_destroy(v);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_taylor_green_exact_state),
        cmocka_unit_test(test_taylor_green_order_and_wrong_decay),
        cmocka_unit_test(test_poiseuille_profiles),
        cmocka_unit_test(test_hydrostatic_column),
        cmocka_unit_test(test_dam_front),
        cmocka_unit_test(test_formulas_give_the_tables),
        cmocka_unit_test(test_series_meet_their_ends),
        cmocka_unit_test(test_reference_reader),
        cmocka_unit_test(test_velocity_beside_a_wall_is_linear),
        cmocka_unit_test(test_depth_is_that_of_water_alone),
        cmocka_unit_test(test_clusters),
        cmocka_unit_test(test_every_case_is_complete),
        cmocka_unit_test(test_gates_judge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
