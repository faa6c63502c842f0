// Values by path and by calls: every key, every way to be wrong, and nothing changed after a refusal.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene.h"

// A valid scene with a box and a ball.
static WeirScene *valid_scene(void)
{
    WeirScene *scene = weir_test_scene(0.05, 0.12, 0, 2);
    weir_test_box(scene, 0.1, 0.1, 0.6, 0.6);
    weir_test_ball(scene, 1.5, 1.5, 0.2, 1, -1);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "title", "two pieces"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
    return scene;
}

// All of a scene but its messages.
static void assert_same(const WeirScene *a, const WeirScene *b)
{
    assert_string_equal(a->title, b->title);
    assert_int_equal(a->dimension, b->dimension);
    assert_memory_equal(&a->parameters, &b->parameters, sizeof a->parameters);
    assert_memory_equal(a->domain_min, b->domain_min, sizeof a->domain_min);
    assert_memory_equal(a->domain_max, b->domain_max, sizeof a->domain_max);
    assert_int_equal(a->fluid_count, b->fluid_count);
    for (uint32_t n = 0; n < a->fluid_count; ++n) {
        const WeirFluid *p = &a->fluid[n], *q = &b->fluid[n];
        assert_int_equal(p->shape.kind, q->shape.kind);
        assert_true(p->shape.has_min == q->shape.has_min && p->shape.has_max == q->shape.has_max &&
                    p->shape.has_center == q->shape.has_center && p->shape.has_radius == q->shape.has_radius);
        assert_memory_equal(p->shape.min, q->shape.min, sizeof p->shape.min);
        assert_memory_equal(p->shape.max, q->shape.max, sizeof p->shape.max);
        assert_memory_equal(p->shape.center, q->shape.center, sizeof p->shape.center);
        assert_memory_equal(p->velocity, q->velocity, sizeof p->velocity);
        CHECK_NEAR(p->shape.radius, q->shape.radius, 0);
    }
}

static uint64_t start_hash(const WeirScene *scene)
{
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    uint64_t hash = weir_test_hash(sim);
    weir_sim_destroy(sim);
    return hash;
}

static void paths_equal_calls(void **state)
{
    (void)state;
    WeirScene *calls = valid_scene(), *paths = weir_scene_create();
    CHECK_SCENE(paths, weir_scene_set_number(paths, "version", 1), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_string(paths, "title", "two pieces"), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_number(paths, "dimension", 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_string(paths, "method", "mueller"), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_number(paths, "parameters.particle_spacing", 0.05), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_number(paths, "parameters.support_radius", 0.12), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_number(paths, "parameters.time_step", 0.0005), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "parameters.gravity", (double[]){0, 0}, 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "domain.min", (double[]){0, 0}, 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "domain.max", (double[]){2, 2}, 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "fluid[0].box.max", (double[]){0.6, 0.6}, 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "fluid[0].box.min", (double[]){0.1, 0.1}, 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "fluid[1].velocity", (double[]){1, -1}, 2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_number(paths, "fluid[1].ball.radius", 0.2), WEIR_OK);
    CHECK_SCENE(paths, weir_scene_set_numbers(paths, "fluid[1].ball.center", (double[]){1.5, 1.5}, 2),
                WEIR_OK);
    assert_same(calls, paths);
    assert_true(start_hash(calls) == start_hash(paths));
    assert_string_equal(weir_scene_title(paths), "two pieces");
    assert_string_equal(weir_scene_method(paths), "mueller");
    assert_int_equal(weir_scene_dimension(paths), 2);
    assert_string_equal(weir_scene_error(paths), "");
    double min[3], max[3];
    weir_scene_domain(paths, min, max);
    CHECK_NEAR(min[0], 0, 0);
    CHECK_NEAR(max[1], 2, 0);
    weir_scene_destroy(calls);
    weir_scene_destroy(paths);
}

static void copies_are_deep(void **state)
{
    (void)state;
    WeirScene *scene = valid_scene(), *copy = weir_scene_copy(scene), *kept = weir_scene_copy(scene);
    assert_true(copy && kept);
    assert_same(scene, copy);
    weir_test_set(copy, "viscosity", 9);
    weir_test_box(copy, 0.8, 0.1, 1, 0.3);
    CHECK_SCENE(copy, weir_scene_set_string(copy, "title", "other"), WEIR_OK);
    assert_same(scene, kept);
    weir_scene_destroy(scene);
    assert_string_equal(weir_scene_title(kept), "two pieces");
    assert_int_equal(copy->fluid_count, 3);
    weir_scene_destroy(copy);
    weir_scene_destroy(kept);
    weir_scene_destroy(NULL);
}

// ---- Refusals ----

typedef enum Kind { NUMBER, NUMBERS, STRING, OTHER } Kind;

typedef struct Bad {
    Kind kind;
    const char *path;
    double numbers[4];
    size_t count;
    const char *text;
    const char *says[3]; // parts of the message beside the path
} Bad;

static WeirStatus set_bad(WeirScene *scene, const Bad *bad)
{
    switch (bad->kind) {
    case NUMBER:
        return weir_scene_set_number(scene, bad->path, bad->numbers[0]);
    case NUMBERS:
        return weir_scene_set_numbers(scene, bad->path, bad->numbers, bad->count);
    case STRING:
        return weir_scene_set_string(scene, bad->path, bad->text);
    default:
        return weir_scene_refuse(scene, bad->path, bad->text);
    }
}

static void check_all_refused(const Bad *bad, size_t count)
{
    WeirScene *scene = valid_scene(), *before = weir_scene_copy(scene);
    for (size_t n = 0; n < count; ++n) {
        WeirStatus status = set_bad(scene, &bad[n]);
        if (status != WEIR_ERROR_INPUT) fail_msg("%s (row %zu) gave status %d", bad[n].path, n, (int)status);
        CHECK_CONTAINS(weir_scene_error(scene), bad[n].path);
        for (int k = 0; k < 3 && bad[n].says[k]; ++k) CHECK_CONTAINS(weir_scene_error(scene), bad[n].says[k]);
        assert_same(scene, before);
    }
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK); // still as good as before
    weir_scene_destroy(scene);
    weir_scene_destroy(before);
}
#define CHECK_ALL_REFUSED(bad) check_all_refused(bad, sizeof bad / sizeof bad[0])

static void unknown_paths_are_refused(void **state)
{
    (void)state;
    static const Bad bad[] = {
        {NUMBER, "gravity", {1}, 1, NULL, {"unknown"}},
        {NUMBER, "parameters.colour", {1}, 1, NULL, {"no such parameter"}},
        {NUMBER, "parameters.", {1}, 1, NULL, {"no such parameter"}},
        {NUMBER, "parameters.viscosity.x", {1}, 1, NULL, {"no such parameter"}},
        {NUMBER, "parameters.viscosity ", {1}, 1, NULL, {"no such parameter"}},
        {NUMBERS, "domain.middle", {0, 0}, 2, NULL, {"unknown", "min", "max"}},
        {NUMBERS, "domain.", {0, 0}, 2, NULL, {"unknown"}},
        {STRING, "Title", {0}, 0, "x", {"unknown"}},
        {STRING, "titles", {0}, 0, "x", {"unknown"}},
        {NUMBER, "fluid[0].colour", {1}, 1, NULL, {"unknown", "box", "ball"}},
        {NUMBER, "fluid[0].", {1}, 1, NULL, {"unknown"}},
        {NUMBERS, "fluid[0].box.middle", {1, 1}, 2, NULL, {"unknown"}},
        {NUMBERS, "fluid[0].box.", {1, 1}, 2, NULL, {"unknown"}},
        {NUMBERS, "fluids[0].box.min", {1, 1}, 2, NULL, {"unknown"}},
        {OTHER, "obstacles", {0}, 0, "an object", {"unknown"}},
        {OTHER, "parameters.colour", {0}, 0, "null", {"no such parameter"}},
    };
    CHECK_ALL_REFUSED(bad);
}

static void wrong_types_are_refused(void **state)
{
    (void)state;
    static const Bad bad[] = {
        {NUMBER, "title", {3}, 1, NULL, {"number", "text"}},
        {NUMBERS, "title", {3, 4}, 2, NULL, {"list"}},
        {OTHER, "title", {0}, 0, "null", {"null", "text"}},
        {NUMBER, "method", {3}, 1, NULL, {"number"}},
        {STRING, "version", {0}, 0, "one", {"one", "number"}},
        {STRING, "dimension", {0}, 0, "2", {"number"}},
        {NUMBER, "parameters", {1}, 1, NULL, {"object"}},
        {NUMBER, "domain", {1}, 1, NULL, {"object"}},
        {STRING, "fluid", {0}, 0, "water", {"water", "list"}},
        {NUMBER, "fluid[0]", {1}, 1, NULL, {"object"}},
        {NUMBER, "fluid[0].box", {1}, 1, NULL, {"object"}},
        {NUMBER, "fluid[1].ball", {1}, 1, NULL, {"object"}},
        {STRING, "domain.min", {0}, 0, "left", {"left", "[x, y]"}},
        {NUMBER, "domain.min", {1}, 1, NULL, {"number", "[x, y]"}},
        {NUMBERS, "domain.max", {3}, 1, NULL, {"[x, y]"}},
        {NUMBERS, "domain.max", {3, 3, 3}, 3, NULL, {"[x, y]"}},
        {NUMBERS, "domain.max", {0}, 0, NULL, {"[x, y]"}},
        {NUMBER, "fluid[0].box.min", {1}, 1, NULL, {"[x, y]"}},
        {NUMBERS, "fluid[0].velocity", {1, 2, 3}, 3, NULL, {"[x, y]"}},
        {STRING, "fluid[1].ball.radius", {0}, 0, "big", {"big", "number"}},
        {NUMBERS, "fluid[1].ball.radius", {1, 2}, 2, NULL, {"list", "number"}},
        {OTHER, "fluid[1].ball.center", {0}, 0, "true", {"true"}},
        {OTHER, "domain.min", {0}, 0, "a list that holds more than numbers", {"[x, y]"}},
    };
    CHECK_ALL_REFUSED(bad);
}

static void impossible_values_are_refused(void **state)
{
    (void)state;
    static const Bad bad[] = {
        {NUMBER, "version", {2}, 1, NULL, {"2", "1"}},
        {NUMBER, "version", {NAN}, 1, NULL, {"nan"}},
        {NUMBER, "version", {1.5}, 1, NULL, {"1.5"}},
        {NUMBER, "dimension", {3}, 1, NULL, {"3", "2", "mueller"}},
        {NUMBER, "dimension", {NAN}, 1, NULL, {"nan"}},
        {STRING, "method", {0}, 0, "pbf", {"pbf", "mueller", "wcsph"}},
        {STRING, "method", {0}, 0, "", {"mueller"}},
        {NUMBERS, "domain.min", {NAN, 0}, 2, NULL, {"nan"}},
        {NUMBERS, "domain.min", {0, -INFINITY}, 2, NULL, {"-inf"}},
        {NUMBERS, "domain.max", {0, 1e300}, 2, NULL, {"1e+300", "100000"}},
        {NUMBERS, "fluid[0].velocity", {0, 1e6}, 2, NULL, {"1e+06", "100000"}},
        {NUMBERS, "fluid[0].velocity", {NAN, 0}, 2, NULL, {"nan"}},
        {NUMBERS, "fluid[0].box.max", {INFINITY, 0}, 2, NULL, {"inf"}},
        {NUMBERS, "fluid[1].ball.center", {0, NAN}, 2, NULL, {"nan"}},
        {NUMBER, "fluid[1].ball.radius", {0}, 1, NULL, {"0"}},
        {NUMBER, "fluid[1].ball.radius", {-0.1}, 1, NULL, {"-0.1"}},
        {NUMBER, "fluid[1].ball.radius", {NAN}, 1, NULL, {"nan"}},
        {NUMBER, "fluid[1].ball.radius", {INFINITY}, 1, NULL, {"inf"}},
    };
    CHECK_ALL_REFUSED(bad);
}

static void pieces_are_made_in_order(void **state)
{
    (void)state;
    static const Bad bad[] = {
        {NUMBERS, "fluid[3].box.min", {1, 1}, 2, NULL, {"fluid[2]"}}, // the next one is 2
        {NUMBERS, "fluid[64].box.min", {1, 1}, 2, NULL, {"64"}},
        {NUMBERS, "fluid[4294967296].box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[18446744073709551616].box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[-1].box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[].box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[ 1].box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[1", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[x].box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[1]box.min", {1, 1}, 2, NULL, {NULL}},
        {NUMBERS, "fluid[0].ball.center", {1, 1}, 2, NULL, {"box and a ball"}},
        {NUMBERS, "fluid[1].box.min", {1, 1}, 2, NULL, {"box and a ball"}},
    };
    CHECK_ALL_REFUSED(bad);
}

static void long_texts_are_refused_whole(void **state)
{
    (void)state;
    WeirScene *scene = valid_scene(), *before = weir_scene_copy(scene);
    char text[WEIR_TITLE_LENGTH + 1], path[3000];
    memset(text, 't', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    CHECK_SCENE(scene, weir_scene_set_string(scene, "title", text), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "120");
    assert_same(scene, before);
    text[WEIR_TITLE_LENGTH - 1] = '\0';
    CHECK_SCENE(scene, weir_scene_set_string(scene, "title", text), WEIR_OK);
    assert_string_equal(weir_scene_title(scene), text);
    // Absurdly long paths, names and values still give one readable message.
    memset(path, 'p', sizeof path - 1);
    path[sizeof path - 1] = '\0';
    CHECK_SCENE(scene, weir_scene_set_number(scene, path, 1), WEIR_ERROR_INPUT);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", path), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "mueller");
    CHECK_SCENE(scene, weir_scene_set_string(scene, "parameters.kernels", path), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "tutorial");
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, path, path), WEIR_ERROR_INPUT);
    weir_scene_destroy(scene);
    weir_scene_destroy(before);
}

static void refused_calls_change_nothing(void **state)
{
    (void)state;
    WeirScene *scene = valid_scene(), *before = weir_scene_copy(scene);
    const double fine[3] = {0.9, 0.1, 0}, high[3] = {1, 0.3, 0}, bad[3] = {0.5, NAN, 0};
    CHECK_SCENE(scene, weir_scene_add_box(scene, bad, high, fine), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_add_box(scene, fine, bad, fine), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_add_box(scene, fine, high, bad), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_add_ball(scene, bad, 0.1, fine), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_add_ball(scene, fine, -1, fine), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_add_ball(scene, fine, 0.1, bad), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, bad, high), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){-3, -3, 0}, bad), WEIR_ERROR_INPUT);
    assert_same(scene, before);
    // The next good call is not disturbed by the refused ones.
    CHECK_SCENE(scene, weir_scene_add_box(scene, fine, high, (double[3]){0}), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
    weir_scene_destroy(scene);
    weir_scene_destroy(before);
}

// Messages quote values and cut them; the cut must not leave half a character, or JSON output would
// refuse it.
static void messages_are_utf8(void **state)
{
    (void)state;
    WeirScene *scene = weir_scene_create();
    char text[64] = "";
    for (int n = 0; n < 15; ++n) strcat(text, "\xe2\x82\xac"); // 3 bytes each: 40 is no whole number of them
    assert_int_equal(weir_scene_set_string(scene, "method", text), WEIR_ERROR_INPUT);
    const unsigned char *message = (const unsigned char *)weir_scene_error(scene);
    int euros = 0, broken = 0;
    for (; *message; ++message) {
        if (message[0] == 0xe2 && message[1] == 0x82 && message[2] == 0xac) {
            ++euros;
            message += 2;
        } else if (*message >= 0x80) {
            ++broken;
        }
    }
    assert_int_equal(euros, 13);
    assert_int_equal(broken, 0);
    weir_scene_destroy(scene);
}

static void too_many_pieces_are_refused(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_scene(0.01, 0.025, 0, 1);
    for (int n = 0; n < WEIR_MAX_FLUIDS; ++n) weir_test_box(scene, 0.015 * n, 0, 0.015 * n + 0.01, 0.01);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
    const double min[3] = {0, 0.5, 0}, max[3] = {0.1, 0.6, 0}, rest[3] = {0};
    CHECK_SCENE(scene, weir_scene_add_box(scene, min, max, rest), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "64");
    CHECK_SCENE(scene, weir_scene_add_ball(scene, max, 0.05, rest), WEIR_ERROR_INPUT);
    assert_int_equal(weir_scene_particle_count(scene), WEIR_MAX_FLUIDS);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_equal_calls),
        cmocka_unit_test(copies_are_deep),
        cmocka_unit_test(unknown_paths_are_refused),
        cmocka_unit_test(wrong_types_are_refused),
        cmocka_unit_test(impossible_values_are_refused),
        cmocka_unit_test(pieces_are_made_in_order),
        cmocka_unit_test(long_texts_are_refused_whole),
        cmocka_unit_test(refused_calls_change_nothing),
        cmocka_unit_test(too_many_pieces_are_refused),
        cmocka_unit_test(messages_are_utf8),
    };
    return cmocka_run_group_tests_name("scene", tests, NULL, NULL);
}
