// Random but repeatable paths and values: whatever comes in, the answer is a status and a message.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene_shape.h"
#include "core/world_build.h"

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
    "method",
    "method",
    "dimension",
    "dimension",
    "domain.periodic",
    "domain.open",
    "domain.free_slip",
    "fluid[0].flow",
    "fluid[0].flow_rate",
    "fluid[0].hydrostatic",
    "fluid[1].polygon[0]",
    "fluid[1].polygon",
    "walls[0].box.min",
    "walls[0].box.max",
    "walls[0].name",
    "walls[0].inside",
    "walls[0].motion.velocity",
    "walls[0].motion.angle",
    "walls[0].motion.period",
    "walls[0].motion.rows",
    "walls[0].motion.rows[0]",
    "walls[0].motion.repeats",
    "walls[1].polygon",
    "walls[1].polygon[1]",
    "walls[1].surface_velocity",
    "walls[0].mesh.vertices",
    "walls[0].mesh.triangles",
    "walls[0].mesh.file",
    "walls[0].cylinder.radius",
    "bodies[0].ball.center",
    "bodies[0].ball.radius",
    "bodies[0].density",
    "bodies[0].fixed",
    "bodies[0].angular_velocity",
    "emitters[0].center",
    "emitters[0].direction",
    "emitters[0].size",
    "emitters[0].speed",
    "emitters[0].capacity",
    "drains[0].min",
    "drains[0].max",
    "probes[0].kind",
    "probes[0].position",
    "probes[0].target",
};
static const char *const texts[] = {"grid",    "all_pairs", "tutorial", "consistent", "mueller",
                                    "",        "%s%s%n%p",  "1,2",      "wcsph",      "wcsph",
                                    "x",       "xy",        "+y -x",    "domain",     "pressure",
                                    "stretch", "nan",       "1e999",    "\xff\xfe",   "consistent|tutorial"};
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
    double values[16];
    random_path(random, path);
    for (int k = 0; k < 16; ++k) values[k] = random_number(random);
    switch (weir_random_next(random) % 9) {
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
    case 5:
        return weir_scene_set_boolean(scene, path, weir_random_next(random) % 2);
    case 6:
        return weir_scene_set_numbers(scene, path, values, weir_random_next(random) % 16);
    default:
        return weir_scene_set_numbers(scene, path, values, weir_random_next(random) % 5);
    }
}

// What a piece owns, for comparison: the pointers themselves differ between a scene and its copy.
static bool is_same_shape(WeirShape *a, WeirShape *b)
{
    bool same = a->point_count == b->point_count && a->mesh.vertex_count == b->mesh.vertex_count &&
                a->mesh.triangle_count == b->mesh.triangle_count;
    if (same && a->points) same &= memcmp(a->points, b->points, 2 * a->point_count * sizeof(double)) == 0;
    if (same && a->mesh.vertices)
        same &= memcmp(a->mesh.vertices, b->mesh.vertices, 3 * a->mesh.vertex_count * sizeof(double)) == 0;
    a->points = b->points = a->mesh.vertices = b->mesh.vertices = NULL;
    a->mesh.triangles = b->mesh.triangles = NULL;
    return same;
}

static bool is_same_fluid(WeirFluid a, WeirFluid b)
{
    return is_same_shape(&a.shape, &b.shape) && memcmp(&a, &b, sizeof a) == 0;
}

static bool is_same_solid(WeirSolidPiece a, WeirSolidPiece b)
{
    bool same = is_same_shape(&a.shape, &b.shape) && a.motion.row_count == b.motion.row_count;
    if (same && a.motion.rows)
        same &= memcmp(a.motion.rows, b.motion.rows, a.motion.row_count * sizeof(WeirMotionRow)) == 0;
    a.motion.rows = b.motion.rows = NULL;
    return same && memcmp(&a, &b, sizeof a) == 0;
}

// All but the messages. `b` is a copy of `a` as it was, padding included.
static bool is_same(const WeirScene *a, const WeirScene *b)
{
    bool same =
        strcmp(a->title, b->title) == 0 && a->method == b->method && a->dimension == b->dimension &&
        a->fluid_count == b->fluid_count && a->wall_count == b->wall_count &&
        a->body_count == b->body_count && memcmp(&a->parameters, &b->parameters, sizeof a->parameters) == 0 &&
        memcmp(a->domain_min, b->domain_min, sizeof a->domain_min) == 0 &&
        memcmp(a->domain_max, b->domain_max, sizeof a->domain_max) == 0 &&
        memcmp(a->periodic, b->periodic, sizeof a->periodic) == 0 &&
        memcmp(a->open, b->open, sizeof a->open) == 0 &&
        memcmp(a->emitter, b->emitter, sizeof a->emitter) == 0 &&
        memcmp(a->drain, b->drain, sizeof a->drain) == 0 && memcmp(a->probe, b->probe, sizeof a->probe) == 0;
    for (uint32_t n = 0; same && n < a->fluid_count; ++n) same = is_same_fluid(a->fluid[n], b->fluid[n]);
    for (uint32_t n = 0; same && n < a->wall_count; ++n) same = is_same_solid(a->wall[n], b->wall[n]);
    for (uint32_t n = 0; same && n < a->body_count; ++n) same = is_same_solid(a->body[n], b->body[n]);
    return same;
}

// Particles that the scene would make, about; NaN and infinite values count as none.
static double particles_of(const WeirScene *scene)
{
    double spacing = scene->parameters.particle_spacing, count = 0;
    WeirParameters parameters = weir_scene_resolved(scene);
    uint32_t layers = (uint32_t)fmin(parameters.support_radius / spacing + 1, 50);
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        double low[3], high[3], sites = 1;
        weir_shape_bounds(&scene->fluid[n].shape, scene->dimension, low, high);
        for (uint32_t k = 0; k < scene->dimension; ++k) sites *= fabs(high[k] - low[k]) / spacing + 1;
        count += sites;
    }
    if (scene->method == WEIR_METHOD_MUELLER) return count;
    for (uint32_t n = 0; n < scene->emitter_count; ++n)
        count += scene->emitter[n].capacity + pow(scene->emitter[n].size / spacing, scene->dimension);
    count += weir_solids_count(scene, spacing, layers);
    return count + weir_sides_count(scene, spacing, layers);
}

// A scene that came out of it must either be refused or run without losing a particle.
static void try_to_run(WeirScene *scene)
{
    double few = 20000, count = particles_of(scene);
    bool absurd = count > 4.0 * WEIR_MAX_PARTICLES;
    if (count > few && !absurd) return; // would only cost time and memory
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
    assert_int_equal(weir_test_diagnose(sim, 0).lost_particles, 0);
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
        assert_int_equal(weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).lost_particles, 0);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// ---- Scenes of wcsph with everything in them ----

static void random_vector(WeirScene *scene, WeirRandom *random, const char *list, int n, const char *key,
                          double low, double high)
{
    char path[80];
    double values[3];
    snprintf(path, sizeof path, "%s[%d].%s", list, n, key);
    for (int k = 0; k < 3; ++k) values[k] = weir_random_range(random, low, high);
    weir_scene_set_numbers(scene, path, values, scene->dimension);
}

static void random_value(WeirScene *scene, WeirRandom *random, const char *list, int n, const char *key,
                         double low, double high)
{
    char path[80];
    snprintf(path, sizeof path, "%s[%d].%s", list, n, key);
    weir_scene_set_number(scene, path, weir_random_range(random, low, high));
}

static void random_shape(WeirScene *scene, WeirRandom *random, const char *list, int n)
{
    char path[24];
    switch (weir_random_next(random) % 3) {
    case 0:
        random_vector(scene, random, list, n, "box.min", 0, 0.6);
        random_vector(scene, random, list, n, "box.max", 0.5, 1);
        break;
    case 1:
        random_vector(scene, random, list, n, "ball.center", 0.2, 0.8);
        random_value(scene, random, list, n, "ball.radius", 0.01, 0.3);
        break;
    default:
        for (int k = 0; k < 5 && scene->dimension == 2; ++k) {
            snprintf(path, sizeof path, "polygon[%d]", k);
            random_vector(scene, random, list, n, path, 0, 1);
        }
        random_vector(scene, random, list, n, "cylinder.from", 0, 0.6);
        random_vector(scene, random, list, n, "cylinder.to", 0.5, 1);
        random_value(scene, random, list, n, "cylinder.radius", 0.01, 0.4);
    }
}

static void random_solids(WeirScene *scene, WeirRandom *random)
{
    for (int n = 0; n < 2 && weir_random_next(random) % 2; ++n) {
        char path[80];
        random_shape(scene, random, "walls", n);
        snprintf(path, sizeof path, "walls[%d].inside", n);
        weir_scene_set_boolean(scene, path, weir_random_next(random) % 4 == 0);
        if (weir_random_next(random) % 2) random_vector(scene, random, "walls", n, "motion.velocity", -1, 1);
        if (weir_random_next(random) % 4 == 0)
            random_vector(scene, random, "walls", n, "surface_velocity", -1, 1);
    }
    for (int n = 0; n < 2 && weir_random_next(random) % 2; ++n) {
        random_shape(scene, random, "bodies", n);
        random_value(scene, random, "bodies", n, "density", 100, 3000);
    }
}

static void random_worlds_run_or_are_refused(void **state)
{
    (void)state;
    static const char *const open[] = {"", "+y", "+x -x", "+y -y +x -x"}, *const periodic[] = {"", "", "x",
                                                                                               "xy"};
    WeirRandom random = {.state = 77};
    int ran = 0, refused = 0;
    for (int round = 0; round < 300; ++round) {
        WeirScene *scene = weir_scene_create();
        uint32_t dimension = 2 + weir_random_next(&random) % 2;
        CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
        CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
        weir_test_set(scene, "particle_spacing", dimension == 3 ? 0.1 : 0.05);
        const double zero[3] = {0}, one[3] = {1, 1, 1};
        CHECK_SCENE(scene, weir_scene_set_domain(scene, zero, one), WEIR_OK);
        if (weir_random_next(&random) % 3)
            CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", PICK(&random, open)), WEIR_OK);
        else
            CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", PICK(&random, periodic)),
                        WEIR_OK);
        random_shape(scene, &random, "fluid", 0);
        random_solids(scene, &random);
        if (weir_random_next(&random) % 3 == 0) {
            random_vector(scene, &random, "emitters", 0, "center", 0, 1);
            random_vector(scene, &random, "emitters", 0, "direction", -1, 1);
            random_value(scene, &random, "emitters", 0, "size", 0, 0.4);
            random_value(scene, &random, "emitters", 0, "speed", 0, 3);
        }
        if (weir_random_next(&random) % 3 == 0) {
            random_vector(scene, &random, "drains", 0, "min", 0, 0.5);
            random_vector(scene, &random, "drains", 0, "max", 0.4, 1);
        }
        WeirSim *sim = weir_sim_create(scene, &(WeirSimOptions){.threads = 1});
        assert_non_null(sim);
        WeirStatus status = weir_sim_step(sim, 3);
        assert_true(status == WEIR_OK || status == WEIR_ERROR_UNSTABLE || status == WEIR_ERROR_INPUT);
        if (status != WEIR_OK) assert_true(strlen(weir_sim_error(sim)) > 0);
        if (status == WEIR_OK)
            assert_true(isfinite(weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).kinetic_energy));
        ++*(status == WEIR_ERROR_INPUT ? &refused : &ran);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
    assert_true(ran > 30 && refused > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_calls_never_crash),
        cmocka_unit_test(random_scenes_run),
        cmocka_unit_test(random_worlds_run_or_are_refused),
    };
    return cmocka_run_group_tests_name("fuzz", tests, NULL, NULL);
}
