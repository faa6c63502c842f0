// Random but repeatable paths and values: whatever comes in, the answer is a status and a message.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene.h"

static const char *const pieces[] = {
    "fluid",
    "[0]",
    "[1]",
    "[2]",
    "[63]",
    "[64]",
    "[",
    "]",
    ".",
    "box",
    "ball",
    "min",
    "max",
    "center",
    "radius",
    "velocity",
    "domain",
    "parameters",
    "gravity",
    "viscosity",
    "kernels",
    "search",
    "time_step",
    "particle_spacing",
    "support_radius",
    "title",
    "version",
    "method",
    "dimension",
    " ",
    "-1",
    "99999999999",
    "\xc3\xa9",
    "%s%n",
    "",
    "x",
    "..",
    "[0]]",
    "[00]",
    "[+1]",
};
static const char *const paths[] = {
    "fluid[0].box.min",
    "fluid[0].box.max",
    "fluid[0].velocity",
    "fluid[1].ball.center",
    "fluid[1].ball.radius",
    "fluid[2].box.min",
    "fluid[2].box.max",
    "domain.min",
    "domain.max",
    "parameters.gravity",
    "parameters.viscosity",
    "parameters.particle_spacing",
    "parameters.support_radius",
    "parameters.gas_constant",
    "parameters.rest_density",
    "parameters.time_step",
    "parameters.restitution",
    "parameters.negative_pressure",
    "parameters.kernels",
    "parameters.search",
    "title",
    "version",
};
static const char *const texts[] = {"grid",    "all_pairs", "tutorial", "consistent",
                                    "mueller", "",          "%s%s%n%p", "1,2",
                                    "nan",     "1e999",     "\xff\xfe", "consistent|tutorial"};
static const double numbers[] = {0,        -0.0,   1,        -1,        2,     0.1,     0.5,
                                 1e-5,     1e-300, 1e5,      -1e5,      1e300, DBL_MAX, DBL_MIN,
                                 4.9e-324, NAN,    INFINITY, -INFINITY, 0.05,  0.025};
#define PICK(random, list) list[weir_random_next(random) % (sizeof list / sizeof list[0])]

static void random_path(WeirRandom *random, char path[400])
{
    if (weir_random_next(random) % 2) {
        strcpy(path, PICK(random, paths));
        return;
    }
    path[0] = '\0';
    uint32_t count = weir_random_next(random) % 8;
    for (uint32_t n = 0; n < count; ++n) strcat(path, PICK(random, pieces));
}

static double random_number(WeirRandom *random)
{
    return weir_random_next(random) % 3 == 0 ? PICK(random, numbers) : weir_random_range(random, -2, 2);
}

static WeirStatus random_call(WeirScene *scene, WeirRandom *random)
{
    char path[400];
    double values[4];
    random_path(random, path);
    for (int k = 0; k < 4; ++k) values[k] = random_number(random);
    switch (weir_random_next(random) % 8) {
    case 0:
        return weir_scene_set_string(scene, path, PICK(random, texts));
    case 1:
        return weir_scene_refuse(scene, path, "an object");
    case 2:
        return weir_scene_set_parameter_text(scene, PICK(random, pieces), PICK(random, texts));
    case 3:
        return weir_scene_add_box(scene, values, values + 1, values);
    case 4:
        return weir_scene_set_number(scene, path, values[0]);
    default:
        return weir_scene_set_numbers(scene, path, values, weir_random_next(random) % 5);
    }
}

// All but the messages. `b` is a copy of `a` as it was, padding included.
static bool is_same(const WeirScene *a, const WeirScene *b)
{
    return strcmp(a->title, b->title) == 0 && a->fluid_count == b->fluid_count &&
           memcmp(a->fluid, b->fluid, a->fluid_count * sizeof a->fluid[0]) == 0 &&
           memcmp(&a->parameters, &b->parameters, sizeof a->parameters) == 0 &&
           memcmp(a->domain_min, b->domain_min, sizeof a->domain_min) == 0 &&
           memcmp(a->domain_max, b->domain_max, sizeof a->domain_max) == 0;
}

// A scene that came out of it must either be refused or run without losing a particle.
static void try_to_run(WeirScene *scene)
{
    uint32_t few = 20000;
    double area = 0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        const WeirShape *fluid = &scene->fluid[n].shape;
        area += fabs((fluid->max[0] - fluid->min[0]) * (fluid->max[1] - fluid->min[1]));
        area += 4 * fluid->radius * fluid->radius;
    }
    double spacing = scene->parameters.particle_spacing;
    bool absurd = area / (spacing * spacing) > 2.0 * WEIR_MAX_PARTICLES;
    if (area / (spacing * spacing) > few && !absurd) return; // would only cost time and memory
    if (weir_scene_check(scene) != WEIR_OK) {
        assert_true(strlen(weir_scene_error(scene)) > 0);
        return;
    }
    assert_true(weir_scene_particle_count(scene) > 0);
    double stable = weir_scene_stable_time_step(scene);
    assert_true(stable > 0 && isfinite(stable));
    if (weir_scene_particle_count(scene) > 2000) return;
    WeirSim *sim = weir_sim_create(scene, &(WeirSimOptions){.threads = 1});
    assert_non_null(sim);
    WeirStatus status = weir_sim_step(sim, 2);
    assert_true(status == WEIR_OK || status == WEIR_ERROR_UNSTABLE);
    assert_int_equal(weir_test_diagnose(sim, false).lost_particles, 0);
    weir_sim_destroy(sim);
}

static void random_calls_never_crash(void **state)
{
    (void)state;
    WeirRandom random = {.state = 2024};
    int accepted = 0, refused = 0;
    for (int round = 0; round < 300; ++round) {
        WeirScene *scene = weir_scene_create();
        for (int n = 0; n < 60; ++n) {
            WeirScene *before = weir_scene_copy(scene);
            WeirStatus status = random_call(scene, &random);
            if (status == WEIR_OK) {
                ++accepted;
            } else {
                ++refused;
                assert_int_equal(status, WEIR_ERROR_INPUT);
                assert_true(strlen(weir_scene_error(scene)) > 0);
                assert_true(is_same(scene, before));
            }
            weir_scene_destroy(before);
        }
        try_to_run(scene);
        weir_scene_destroy(scene);
    }
    assert_true(accepted > 1000 && refused > 1000);
}

// Random valid scenes at the ends of what parameters allow: every one runs and stays inside.
static void random_scenes_run(void **state)
{
    (void)state;
    WeirRandom random = {.state = 31};
    for (int round = 0; round < 200; ++round) {
        double spacing = pow(10, weir_random_range(&random, -4.9, 0.9)), size = spacing * 12;
        double low = weir_random_next(&random) % 2 ? 0 : weir_random_range(&random, -1, 1) * spacing * 500;
        WeirScene *scene =
            weir_test_scene(spacing, spacing * weir_random_range(&random, 1.2, 6), low, low + size);
        weir_test_set(scene, "rest_density", pow(10, weir_random_range(&random, -3, 5)));
        weir_test_set(scene, "gas_constant", pow(10, weir_random_range(&random, -3, 7)));
        weir_test_set(scene, "viscosity", pow(10, weir_random_range(&random, -4, 4)));
        weir_test_set(scene, "time_step", pow(10, weir_random_range(&random, -7, -1)));
        weir_test_set(scene, "restitution", weir_random_range(&random, 0, 1));
        weir_test_set(scene, "negative_pressure", weir_random_next(&random) % 2);
        weir_test_gravity(scene, weir_random_range(&random, -1000, 1000),
                          weir_random_range(&random, -1000, 1000));
        weir_test_choose(scene, "kernels", weir_random_next(&random) % 2 ? "tutorial" : "consistent");
        weir_test_choose(scene, "search", weir_random_next(&random) % 4 ? "grid" : "all_pairs");
        weir_test_box(scene, low + spacing, low + spacing, low + 7 * spacing, low + 6 * spacing);
        CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
        double stable = weir_scene_stable_time_step(scene);
        assert_true(stable > 0 && isfinite(stable));
        WeirSim *sim = weir_test_sim(scene, NULL, 1);
        WeirStatus status = weir_sim_step(sim, 20);
        assert_true(status == WEIR_OK || status == WEIR_ERROR_UNSTABLE);
        assert_int_equal(weir_test_diagnose(sim, true).lost_particles, 0);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_calls_never_crash),
        cmocka_unit_test(random_scenes_run),
    };
    return cmocka_run_group_tests_name("fuzz", tests, NULL, NULL);
}
