// The parameter list: sound by itself, and every range checked by every way in, with a message that helps.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "common/build.h"
#include "core/parameters.h"

static uint32_t choice_count(const WeirParameterInfo *info)
{
    uint32_t count = 1;
    for (const char *c = info->choices; *c; ++c) count += *c == '|';
    return count;
}

static void list_is_sound(void **state)
{
    (void)state;
    uint32_t count = weir_parameter_count();
    assert_true(count >= 11);
    assert_null(weir_parameter_info(count));
    assert_null(weir_parameter_info(UINT32_MAX));
    for (uint32_t n = 0; n < count; ++n) {
        const WeirParameterInfo *info = weir_parameter_info(n);
        assert_non_null(info);
        assert_true(info->name && *info->name && info->unit && *info->unit && info->help);
        assert_true(strlen(info->help) > 10);
        for (const char *c = info->name; *c; ++c) assert_true(*c == '_' || (*c >= 'a' && *c <= 'z'));
        for (uint32_t other = 0; other < n; ++other)
            assert_string_not_equal(info->name, weir_parameter_info(other)->name);
        assert_int_equal(weir_parameter_find(info->name), n);
        if (info->kind == WEIR_PARAMETER_CHOICE) {
            assert_non_null(info->choices);
            assert_true(info->default_value[0] >= 0 && info->default_value[0] < choice_count(info));
            continue;
        }
        assert_null(info->choices);
        assert_true(info->minimum < info->maximum);
        for (int k = 0; k < (info->kind == WEIR_PARAMETER_VECTOR ? 3 : 1); ++k)
            assert_true(info->default_value[k] >= info->minimum && info->default_value[k] <= info->maximum);
    }
    assert_int_equal(weir_parameter_find("no_such_parameter"), -1);
    assert_int_equal(weir_parameter_find(""), -1);
}

static void defaults_are_in_a_new_scene(void **state)
{
    (void)state;
    WeirScene *scene = weir_scene_create();
    for (uint32_t n = 0; n < weir_parameter_count(); ++n) {
        const WeirParameterInfo *info = weir_parameter_info(n);
        double values[3] = {-5, -5, -5};
        assert_int_equal(weir_scene_get_parameter(scene, info->name, values), WEIR_OK);
        int used = info->kind == WEIR_PARAMETER_VECTOR ? 3 : 1;
        for (int k = 0; k < used; ++k) CHECK_NEAR(values[k], (float)info->default_value[k], 0);
    }
    double values[3];
    assert_int_equal(weir_scene_get_parameter(scene, "no_such_parameter", values), WEIR_ERROR_INPUT);
    weir_scene_destroy(scene);
}

static void parameter_path(const WeirParameterInfo *info, char path[80])
{
    assert_true(snprintf(path, 80, "parameters.%s", info->name) < 80);
}

static WeirStatus set_all(WeirScene *scene, const WeirParameterInfo *info, const double values[3])
{
    char path[80];
    parameter_path(info, path);
    return info->kind == WEIR_PARAMETER_VECTOR ? weir_scene_set_numbers(scene, path, values, 3)
                                               : weir_scene_set_number(scene, path, values[0]);
}

// A refused value: the message names field, value and both ends of the range, and the old value stays.
static void check_refused(WeirScene *scene, const WeirParameterInfo *info, double value)
{
    char path[80], text[40];
    double before[3], after[3], values[3] = {value, value, value};
    parameter_path(info, path);
    weir_scene_get_parameter(scene, info->name, before);
    CHECK_SCENE(scene, set_all(scene, info, values), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), path);
    double named[3] = {value, info->minimum, info->maximum};
    for (int k = 0; k < 3; ++k) {
        snprintf(text, sizeof text, "%g", named[k]);
        CHECK_CONTAINS(weir_scene_error(scene), text);
    }
    weir_scene_get_parameter(scene, info->name, after);
    assert_memory_equal(before, after, sizeof before);
}

static void ranges_are_checked(void **state)
{
    (void)state;
    WeirScene *scene = weir_scene_create();
    for (uint32_t n = 0; n < weir_parameter_count(); ++n) {
        const WeirParameterInfo *info = weir_parameter_info(n);
        if (info->kind == WEIR_PARAMETER_CHOICE) continue;
        double size = fabs(info->maximum) + fabs(info->minimum);
        const double bad[] = {info->minimum - 0.01 * size,
                              info->maximum + 0.01 * size,
                              nextafter(info->minimum, -DBL_MAX),
                              nextafter(info->maximum, DBL_MAX),
                              NAN,
                              INFINITY,
                              -INFINITY,
                              DBL_MAX};
        for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) check_refused(scene, info, bad[k]);
        // Both ends are allowed, and stay inside the range as floats.
        double ends[2] = {info->minimum, info->maximum}, values[3];
        for (int k = 0; k < 2; ++k) {
            CHECK_SCENE(scene, set_all(scene, info, (double[3]){ends[k], ends[k], ends[k]}), WEIR_OK);
            weir_scene_get_parameter(scene, info->name, values);
            CHECK_NEAR(values[0], (float)ends[k], 0);
        }
    }
    weir_scene_destroy(scene);
}

static void wrong_types_are_refused(void **state)
{
    (void)state;
    WeirScene *scene = weir_scene_create();
    for (uint32_t n = 0; n < weir_parameter_count(); ++n) {
        const WeirParameterInfo *info = weir_parameter_info(n);
        char path[80];
        parameter_path(info, path);
        CHECK_SCENE(scene, weir_scene_set_string(scene, path, "soup"), WEIR_ERROR_INPUT);
        CHECK_CONTAINS(weir_scene_error(scene), path);
        CHECK_CONTAINS(weir_scene_error(scene), "soup");
        CHECK_SCENE(scene, weir_scene_refuse(scene, path, "null"), WEIR_ERROR_INPUT);
        CHECK_CONTAINS(weir_scene_error(scene), path);
        CHECK_CONTAINS(weir_scene_error(scene), "null");
        static const double many[5] = {0.5, 0.5, 0.5, 0.5, 0.5};
        for (size_t count = 0; count <= 5; ++count) {
            bool fits = info->kind == WEIR_PARAMETER_VECTOR ? count == 2 || count == 3 : count == 1;
            if (fits) continue;
            CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, many, count), WEIR_ERROR_INPUT);
            CHECK_CONTAINS(weir_scene_error(scene), path);
        }
        if (info->kind != WEIR_PARAMETER_CHOICE) continue;
        CHECK_SCENE(scene, weir_scene_set_number(scene, path, 0),
                    WEIR_ERROR_INPUT); // names only, as in files
        CHECK_CONTAINS(weir_scene_error(scene), info->choices);
    }
    weir_scene_destroy(scene);
}

static void choices_go_by_name(void **state)
{
    (void)state;
    WeirScene *scene = weir_scene_create();
    double values[3];
    CHECK_SCENE(scene, weir_scene_set_string(scene, "parameters.kernels", "tutorial"), WEIR_OK);
    weir_scene_get_parameter(scene, "kernels", values);
    CHECK_NEAR(values[0], WEIR_KERNELS_TUTORIAL, 0);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "parameters.kernels", "consistent"), WEIR_OK);
    weir_scene_get_parameter(scene, "kernels", values);
    CHECK_NEAR(values[0], WEIR_KERNELS_CONSISTENT, 0);
    static const char *const bad[] = {"",        "tutoria", "tutorial2", "tutorial|", "consistent|tutorial",
                                      "Tutorial"};
    for (size_t n = 0; n < sizeof bad / sizeof bad[0]; ++n) {
        CHECK_SCENE(scene, weir_scene_set_string(scene, "parameters.kernels", bad[n]), WEIR_ERROR_INPUT);
        CHECK_CONTAINS(weir_scene_error(scene), "consistent|tutorial");
    }
    weir_scene_destroy(scene);
}

static void texts_are_parsed_whole(void **state)
{
    (void)state;
    WeirScene *scene = weir_scene_create();
    double values[3];
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, "viscosity", "0.25"), WEIR_OK);
    weir_scene_get_parameter(scene, "viscosity", values);
    CHECK_NEAR(values[0], 0.25, 0);
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, "time_step", "2.5e-4"), WEIR_OK);
    weir_scene_get_parameter(scene, "time_step", values);
    CHECK_NEAR(values[0], 2.5e-4f, 0);
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, "gravity", "1.5,-2"), WEIR_OK);
    weir_scene_get_parameter(scene, "gravity", values);
    CHECK_NEAR(values[0], 1.5, 0);
    CHECK_NEAR(values[1], -2, 0);
    CHECK_NEAR(values[2], 0, 0);
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, "search", "all_pairs"), WEIR_OK);
    weir_scene_get_parameter(scene, "search", values);
    CHECK_NEAR(values[0], WEIR_SEARCH_ALL_PAIRS, 0);
    static const char *const bad[][2] = {
        {"viscosity", ""},      {"viscosity", "x"},   {"viscosity", "1x"},
        {"viscosity", "1 2"},   {"viscosity", "1,2"}, {"viscosity", "1,"},
        {"viscosity", ","},     {"viscosity", "nan"}, {"viscosity", "inf"},
        {"viscosity", "1e999"}, {"viscosity", "-1"},  {"viscosity", "grid"},
        {"gravity", "1"},       {"gravity", "1,"},    {"gravity", "1,2,3,4"},
        {"gravity", "1,,2"},    {"gravity", "1,nan"}, {"gravity", "1,2,3,4,5,6,7,8,9"},
        {"search", "quick"},    {"search", "0"},      {"search", ""},
    };
    for (size_t n = 0; n < sizeof bad / sizeof bad[0]; ++n) {
        double before[3], after[3];
        weir_scene_get_parameter(scene, bad[n][0], before);
        WeirStatus status = weir_scene_set_parameter_text(scene, bad[n][0], bad[n][1]);
        if (status != WEIR_ERROR_INPUT) fail_msg("%s=%s was accepted", bad[n][0], bad[n][1]);
        CHECK_CONTAINS(weir_scene_error(scene), bad[n][0]);
        weir_scene_get_parameter(scene, bad[n][0], after);
        assert_memory_equal(before, after, sizeof before);
    }
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, "colour", "1"), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "colour");
    weir_scene_destroy(scene);
}

// The struct, the list and the WGSL text name the same fields in the same order.
static void wgsl_names_every_field_in_order(void **state)
{
    (void)state;
    const char *place = strstr(weir_wgsl_structs, "struct Parameters");
    assert_non_null(place);
    const char *end = strstr(weir_wgsl_structs, "struct Constants");
    assert_non_null(end);
    for (uint32_t n = 0; n < weir_parameter_count(); ++n) {
        const WeirParameterInfo *info = weir_parameter_info(n);
        char field[100];
        snprintf(field, sizeof field, " %s: %s", info->name,
                 info->kind == WEIR_PARAMETER_VECTOR   ? "vec4f"
                 : info->kind == WEIR_PARAMETER_CHOICE ? "u32"
                                                       : "f32");
        place = strstr(place, field);
        assert_non_null(place);
        assert_true(place < end);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(list_is_sound),
        cmocka_unit_test(defaults_are_in_a_new_scene),
        cmocka_unit_test(ranges_are_checked),
        cmocka_unit_test(wrong_types_are_refused),
        cmocka_unit_test(choices_go_by_name),
        cmocka_unit_test(texts_are_parsed_whole),
        cmocka_unit_test(wgsl_names_every_field_in_order),
    };
    return cmocka_run_group_tests_name("parameters", tests, NULL, NULL);
}
