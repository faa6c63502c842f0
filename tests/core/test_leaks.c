// Fluid thrown at walls of random shape, up to the speed of sound, ten times what Weir warns of: nothing gets past the
// second layer of particles, nothing blows up, and all fluid stays in the simulation.
#include <math.h>
#include <stdlib.h>

#include "common/random_shapes.h"
#include "core/scene_shape.h"

static const double sound = 20, machs[] = {0.3, 1};
#ifdef NDEBUG
enum { THROWS = 20, OBSTACLES = 15 };
#else
enum { THROWS = 4, OBSTACLES = 3 }; // sanitizers are twenty times slower, and look for other faults
#endif

// Fluid around (x, 0, 0).
static WeirScene *ball(uint32_t dimension, double spacing, double radius, double x)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    weir_test_set(scene, "sound_speed", sound);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "parameters.gravity", (double[]){0, 0, 0}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "domain.min", (double[]){-2, -2, -2}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "domain.max", (double[]){2, 2, 2}, dimension), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "fluid[0].ball.center", (double[]){x, 0, 0}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "fluid[0].ball.radius", radius), WEIR_OK);
    return scene;
}

// All of it moves along `direction` at `speed`, against the wall around it or in its way.
static void throw(WeirScene * scene, bool around, double speed, const double direction[3], double time)
{
    double v[3];
    for (int k = 0; k < 3; ++k) v[k] = speed * direction[k];
    CHECK_SCENE(scene, weir_scene_set_boolean(scene, "walls[0].inside", around), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "fluid[0].velocity", v, scene->dimension), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, NULL, 0);
    CHECK_SIM(sim, weir_sim_run_until(sim, time), WEIR_OK);
    WeirSurface surface;
    assert_true(weir_surface_start(&surface, &scene->wall[0].shape, scene->dimension));
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
    double spacing = scene->parameters.particle_spacing, deepest = -1e9;
    for (uint32_t i = 0; i < weir_sim_fluid_slots(sim); ++i) {
        double point[3] = {0};
        for (uint32_t k = 0; k < scene->dimension; ++k) point[k] = position[scene->dimension * i + k];
        deepest = fmax(deepest, (around ? 1 : -1) * weir_surface_distance(&surface, point));
    }
    if (deepest > 1.5 * spacing) fail_msg("a particle %g spacings behind the surface", deepest / spacing);
    assert_int_equal(weir_sim_clock(sim).fluid_particles, weir_sim_fluid_slots(sim));
    free(position);
    weir_surface_end(&surface);
    weir_sim_destroy(sim);
}

static void polygons_hold(void **state)
{
    (void)state;
    WeirRandom random = {.state = 21};
    for (int round = 0; round < THROWS; ++round) {
        WeirScene *scene = ball(2, 0.04, 0.25, 0);
        weir_test_random_polygon(scene, "walls", &random);
        double angle = weir_random_range(&random, 0, 6.28);
        throw(scene, true, machs[round % 2] * sound, (double[3]){cos(angle), sin(angle), 0}, 0.15);
        weir_scene_destroy(scene);
    }
}

static void meshes_hold(void **state)
{
    (void)state;
    WeirRandom random = {.state = 22};
    for (int round = 0; round < THROWS; ++round) {
        WeirScene *scene = ball(3, 0.08, 0.25, 0);
        weir_test_random_mesh(scene, "walls", &random);
        double angle = weir_random_range(&random, 0, 6.28);
        throw(scene, true, machs[round % 2] * sound, (double[3]){0.6 * cos(angle), sin(angle) * 0.6, 0.8},
              0.1);
        weir_scene_destroy(scene);
    }
}

static void obstacles_hold(void **state)
{
    (void)state;
    WeirRandom random = {.state = 23};
    for (int round = 0; round < OBSTACLES; ++round) {
        bool deep = round % 3 == 2;
        WeirScene *scene = ball(deep ? 3 : 2, deep ? 0.08 : 0.04, 0.25, deep ? 1.05 : 1.5);
        (deep ? weir_test_random_mesh : weir_test_random_polygon)(scene, "walls", &random);
        double aside = weir_random_range(&random, -0.3, 0.3);
        throw(scene, false, sound, (double[3]){-1, aside, 0.5 * aside}, 0.06);
        weir_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_hold),
        cmocka_unit_test(meshes_hold),
        cmocka_unit_test(obstacles_hold),
    };
    return cmocka_run_group_tests_name("leaks", tests, NULL, NULL);
}
