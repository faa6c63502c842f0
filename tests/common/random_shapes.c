#include "common/random_shapes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// A star with corners at random distances; the middle is inside.
void weir_test_random_polygon(WeirScene *scene, const char *list, WeirRandom *random)
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

void weir_test_random_mesh(WeirScene *scene, const char *list, WeirRandom *random)
{
    static Ball ball;
    make_ball(&ball, 1);
    for (uint32_t n = 0; n < ball.vertices; ++n) {
        double r = weir_random_range(random, 0.4, 0.7);
        for (int k = 0; k < 3; ++k) ball.vertex[n][k] *= r;
    }
    set_mesh(scene, list, &ball);
}
