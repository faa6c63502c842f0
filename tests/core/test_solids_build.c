// Walls and bodies as particles: nothing outside the solid, nothing too close, no hole that fluid could use.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/random_shapes.h"
#include "core/scene_shape.h"

static double spacing; // coarser in 3D

static WeirScene *start(uint32_t dimension)
{
    WeirScene *scene = weir_scene_create();
    spacing = dimension == 3 ? 0.07 : 0.05;
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "domain.min", (double[]){-2, -2, -2}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "domain.max", (double[]){2, 2, 2}, dimension), WEIR_OK);
    CHECK_SCENE(
        scene,
        weir_scene_set_string(scene, "domain.open", dimension == 3 ? "-x +x -y +y -z +z" : "-x +x -y +y"),
        WEIR_OK);
    // Some fluid where neither kind of wall is.
    CHECK_SCENE(scene,
                weir_scene_set_numbers(scene, "fluid[0].ball.center", (double[]){1.6, 0, 0}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "fluid[0].ball.radius", 0.2), WEIR_OK);
    return scene;
}

// For a wall around its shape: fluid in its middle.
static void put_fluid_inside(WeirScene *scene)
{
    CHECK_SCENE(scene,
                weir_scene_set_numbers(scene, "fluid[0].ball.center", (double[]){0, 0, 0}, scene->dimension),
                WEIR_OK);
}

// ---- What must hold of a solid's particles ----

static double nearest(const WeirParticles *particles, uint32_t first, uint32_t count, const double *point,
                      uint32_t but)
{
    double best = DBL_MAX;
    for (uint32_t i = first; i < first + count; ++i) {
        double sum = 0;
        for (uint32_t k = 0; k < particles->dimension; ++k) {
            double d = particles->position[(size_t)particles->dimension * i + k] - point[k];
            sum += d * d;
        }
        if (i != but) best = fmin(best, sum);
    }
    return sqrt(best);
}

// `layers` of them, with a particle within `widest` spacings of every place that one may be in: half a spacing below the
// surface and deeper. (In the tip of a spike there is no such place.)
static void check_solid(WeirScene *scene, const WeirShape *shape, bool around, double layers, double widest)
{
    WeirWorld world;
    WeirSurface surface;
    CHECK_SCENE(scene, weir_scene_make_world(scene, &world), WEIR_OK);
    assert_true(weir_surface_start(&surface, shape, scene->dimension));
    const WeirParticles *particles = &world.particles;
    uint32_t first = world.solids[0].first, count = world.solids[0].count;
    double sign = around ? 1 : -1;
    uint32_t step = scene->dimension == 3 ? 7 : 1; // some of many
    for (uint32_t i = first; i < first + count; i += step) {
        const double *point = &particles->position[(size_t)scene->dimension * i];
        double depth = sign * weir_surface_distance(&surface, point);
        if (!(depth > 0.44 * spacing && depth < (layers + 0.01) * spacing))
            fail_msg("particle %u of %u at depth %g", i - first, count, depth / spacing);
        assert_true(nearest(particles, first, count, point, i) > 0.67 * spacing);
    }
    WeirRandom random = {.state = 99};
    for (int n = 0, tested = 0; tested < 400 && n < 400000; ++n) {
        double point[3];
        for (int k = 0; k < 3; ++k) point[k] = weir_random_range(&random, -1.3, 1.3);
        double depth = sign * weir_surface_distance(&surface, point);
        if (depth < 0.5 * spacing || depth > (layers - 0.5) * spacing) continue;
        ++tested;
        double gap = nearest(particles, first, count, point, UINT32_MAX);
        if (gap > widest * spacing)
            fail_msg("a hole of %g spacings at depth %g", gap / spacing, depth / spacing);
    }
    weir_surface_end(&surface);
    weir_world_free(&world);
}

static void random_polygons_are_tight(void **state)
{
    (void)state;
    WeirRandom random = {.state = 7};
    for (int round = 0; round < 20; ++round) {
        bool around = round % 2;
        WeirScene *scene = start(2);
        weir_test_random_polygon(scene, "walls", &random);
        if (around) put_fluid_inside(scene);
        CHECK_SCENE(scene, weir_scene_set_boolean(scene, "walls[0].inside", around), WEIR_OK);
        check_solid(scene, &scene->wall[0].shape, around, 4, 0.82);
        weir_scene_destroy(scene);
    }
}

static void random_meshes_are_tight(void **state)
{
    (void)state;
    WeirRandom random = {.state = 8};
    for (int round = 0; round < 10; ++round) {
        bool around = round % 2;
        WeirScene *scene = start(3);
        weir_test_random_mesh(scene, "walls", &random);
        if (around) put_fluid_inside(scene);
        CHECK_SCENE(scene, weir_scene_set_boolean(scene, "walls[0].inside", around), WEIR_OK);
        check_solid(scene, &scene->wall[0].shape, around, 3, 0.95);
        weir_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_polygons_are_tight),
        cmocka_unit_test(random_meshes_are_tight),
    };
    return cmocka_run_group_tests_name("solids_build", tests, NULL, NULL);
}
