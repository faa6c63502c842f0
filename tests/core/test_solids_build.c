// Walls and bodies as particles: nothing outside the solid, nothing too close, no hole that fluid could use.
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene_shape.h"

static const double spacing = 0.05;

static WeirScene *start(uint32_t dimension)
{
    WeirScene *scene = weir_scene_create();
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

// A star with corners at random distances; the middle is inside.
static void add_polygon(WeirScene *scene, const char *list, WeirRandom *random)
{
    char path[64];
    uint32_t count = 5 + weir_random_next(random) % 8;
    for (uint32_t n = 0; n < count; ++n) {
        double angle = 2 * 3.14159265358979 * n / count, r = weir_random_range(random, 0.5, 1.1);
        snprintf(path, sizeof path, "%s[0].polygon[%u]", list, n);
        CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, (double[]){r * cos(angle), r * sin(angle)}, 2),
                    WEIR_OK);
    }
}

// ---- Meshes: an octahedron whose triangles are divided, its corners at random distances ----

enum { MOST = 600 };
typedef struct Ball {
    double vertex[MOST][3];
    double triangle[MOST][3];
    uint32_t vertices, triangles;
} Ball;

static uint32_t vertex_at(Ball *ball, const double v[3])
{
    for (uint32_t n = 0; n < ball->vertices; ++n) {
        double d = fabs(ball->vertex[n][0] - v[0]) + fabs(ball->vertex[n][1] - v[1]) +
                   fabs(ball->vertex[n][2] - v[2]);
        if (d < 1e-9) return n;
    }
    assert_true(ball->vertices < MOST);
    memcpy(ball->vertex[ball->vertices], v, sizeof ball->vertex[0]);
    return ball->vertices++;
}

static void divide(Ball *ball, const double a[3], const double b[3], const double c[3], int level)
{
    if (level == 0) {
        double *triangle = ball->triangle[ball->triangles++];
        assert_true(ball->triangles <= MOST);
        triangle[0] = vertex_at(ball, a);
        triangle[1] = vertex_at(ball, b);
        triangle[2] = vertex_at(ball, c);
        return;
    }
    double ab[3], bc[3], ca[3];
    for (int k = 0; k < 3; ++k) {
        ab[k] = a[k] + b[k];
        bc[k] = b[k] + c[k];
        ca[k] = c[k] + a[k];
    }
    double *const middles[3] = {ab, bc, ca};
    for (int n = 0; n < 3; ++n) {
        double *m = middles[n], length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
        for (int k = 0; k < 3; ++k) m[k] /= length;
    }
    divide(ball, a, ab, ca, level - 1);
    divide(ball, ab, b, bc, level - 1);
    divide(ball, ca, bc, c, level - 1);
    divide(ball, ab, bc, ca, level - 1);
}

static void make_ball(Ball *ball, int level)
{
    memset(ball, 0, sizeof *ball);
    for (int octant = 0; octant < 8; ++octant) {
        double x[3] = {octant & 1 ? -1 : 1, 0, 0}, y[3] = {0, octant & 2 ? -1 : 1, 0},
               z[3] = {0, 0, octant & 4 ? -1 : 1};
        bool turned = ((octant & 1) + (octant >> 1 & 1) + (octant >> 2 & 1)) % 2;
        divide(ball, x, turned ? z : y, turned ? y : z, level);
    }
}

static void set_mesh(WeirScene *scene, const char *list, const Ball *ball)
{
    char path[64];
    snprintf(path, sizeof path, "%s[0].mesh.vertices", list);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, ball->vertex[0], 3 * (size_t)ball->vertices),
                WEIR_OK);
    snprintf(path, sizeof path, "%s[0].mesh.triangles", list);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, ball->triangle[0], 3 * (size_t)ball->triangles),
                WEIR_OK);
}

static void add_mesh(WeirScene *scene, const char *list, WeirRandom *random)
{
    static Ball ball;
    make_ball(&ball, 1);
    for (uint32_t n = 0; n < ball.vertices; ++n) {
        double r = weir_random_range(random, 0.4, 0.7);
        for (int k = 0; k < 3; ++k) ball.vertex[n][k] *= r;
    }
    set_mesh(scene, list, &ball);
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
        add_polygon(scene, "walls", &random);
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
        add_mesh(scene, "walls", &random);
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
