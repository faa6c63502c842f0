// Walls and bodies as triangles, on the host: closed, where they belong, with the normals that they should have.
#include <math.h>
#include <stdlib.h>

#include "common/build.h"
#include "core/scene_shape.h"
#include "render/shape.h"

static WeirScene *tank(void)
{
    WeirScene *scene = weir_scene_create();
    weir_scene_set_string(scene, "method", "wcsph");
    weir_scene_set_number(scene, "dimension", 3);
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.1);
    weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){2, 1, 1});
    weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){0.4, 0.4, 0.4}, (double[]){0, 0, 0});
    return scene;
}

static void set(WeirScene *scene, const char *path, const double *values, size_t count)
{
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, values, count), WEIR_OK);
}

// Volume within the triangles of one solid, each turned the way of its normals; checks that these have length 1.
static double volume_of(const WeirTriangles *triangles, uint32_t solid)
{
    double sum = 0.0;
    for (uint32_t n = 0; n + 2 < triangles->count; n += 3) {
        const WeirCorner *c = &triangles->corners[n];
        double a[3], b[3], area[3], along = 0.0, facing = 0.0, length = 0.0;
        for (int k = 0; k < 3; k++) {
            a[k] = (double)(c[1].place[k] - c[0].place[k]);
            b[k] = (double)(c[2].place[k] - c[0].place[k]);
            length += (double)(c[0].normal[k] * c[0].normal[k]);
        }
        CHECK_NEAR(length, 1.0, 1e-5);
        if (c->solid != solid) continue;
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            area[k] = a[i] * b[j] - a[j] * b[i];
            along += area[k] * (double)c[0].place[k];
            facing += area[k] * (double)(c[0].normal[k] + c[1].normal[k] + c[2].normal[k]);
        }
        sum += (facing > 0.0 ? along : -along) / 6.0;
    }
    return sum;
}

// Bodies are solids 1, 2, ... after the domain's sides.
static void shapes_are_closed(void **state)
{
    (void)state;
    WeirScene *scene = tank();
    set(scene, "bodies[0].box.min", (double[]){0.5, 0.5, 0.2}, 3);
    set(scene, "bodies[0].box.max", (double[]){0.8, 0.7, 0.6}, 3);
    set(scene, "bodies[1].ball.center", (double[]){1.2, 0.5, 0.5}, 3);
    weir_scene_set_number(scene, "bodies[1].ball.radius", 0.2);
    set(scene, "bodies[2].cylinder.from", (double[]){1.5, 0.3, 0.3}, 3);
    set(scene, "bodies[2].cylinder.to", (double[]){1.8, 0.6, 0.4}, 3);
    weir_scene_set_number(scene, "bodies[2].cylinder.radius", 0.1);
    WeirTriangles triangles;
    weir_triangles_of(&triangles, scene);
    assert_false(triangles.failed);
    CHECK_NEAR(volume_of(&triangles, 1), 0.3 * 0.2 * 0.4, 1e-6);
    for (uint32_t n = 1; n < 3; n++) { // a little less than round
        WeirShapeMoments moments;
        weir_shape_moments(&scene->body[n].shape, 3, &moments);
        double volume = volume_of(&triangles, 1 + n);
        assert_true(volume < moments.volume && volume > 0.985 * moments.volume);
    }
    weir_triangles_free(&triangles);
    weir_scene_destroy(scene);
}

static void check_form(const WeirForm *form, WeirShapeKind kind, uint32_t solid, const double middle[3],
                       const double size[3], double reach)
{
    assert_int_equal(form->kind, kind);
    assert_int_equal(form->solid, solid);
    CHECK_NEAR((double)form->reach, reach, 1e-6);
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR((double)form->middle[k], middle[k], 1e-6);
        CHECK_NEAR((double)form->size[k], size[k], 1e-6);
    }
}

// What rays meet: the shapes themselves, in the solid's own axes.
static void forms_are_the_shapes(void **state)
{
    (void)state;
    static const double nowhere[3] = {0, 0, 0};
    WeirScene *scene = tank();
    set(scene, "walls[0].box.min", (double[]){1, -0.5, 0.4}, 3);
    set(scene, "walls[0].box.max", (double[]){1.2, 0.3, 0.6}, 3);
    set(scene, "bodies[0].ball.center", (double[]){0.5, 0.5, 0.5}, 3);
    weir_scene_set_number(scene, "bodies[0].ball.radius", 0.2);
    set(scene, "bodies[1].cylinder.from", (double[]){1.5, 0.3, 0.3}, 3);
    set(scene, "bodies[1].cylinder.to", (double[]){1.5, 0.9, 0.3}, 3);
    weir_scene_set_number(scene, "bodies[1].cylinder.radius", 0.1);
    WeirTriangles triangles;
    weir_triangles_of(&triangles, scene);
    assert_int_equal(triangles.form_count, 3);
    // The wall ends at the floor, and its reference point is what was its middle.
    check_form(&triangles.forms[0], WEIR_SHAPE_BOX, 1, (double[]){0, 0.25, 0}, (double[]){0.1, 0.15, 0.1},
               0.25 + sqrt(0.0425));
    check_form(&triangles.forms[1], WEIR_SHAPE_BALL, 2, nowhere, (double[]){0.2, 0.2, 0.2}, 0.2);
    const WeirForm *cylinder = &triangles.forms[2];
    check_form(cylinder, WEIR_SHAPE_CYLINDER, 3, nowhere, (double[]){0.1, 0.3, 0.1}, sqrt(0.11));
    CHECK_NEAR((double)cylinder->axis[1], 1.0, 1e-6);
    double length = 0.0;
    for (int k = 0; k < 3; k++) length += (double)(cylinder->across[k] * cylinder->across[k]);
    CHECK_NEAR(length, 1.0, 1e-6);
    CHECK_NEAR((double)cylinder->across[1], 0.0, 1e-6);
    weir_triangles_free(&triangles);
    weir_scene_destroy(scene);
}

// Rays try every triangle of a mesh, so not those of a large one.
static void large_meshes_are_not_tried(void **state)
{
    (void)state;
    enum { MOST = WEIR_FORM_CORNERS };
    static double indices[MOST + 3];
    for (int k = 0; k < MOST + 3; k++) indices[k] = k % 3;
    for (int extra = 0; extra < 2; extra++) {
        WeirScene *scene = tank();
        set(scene, "walls[0].box.min", (double[]){1, 0, 0.4}, 3);
        set(scene, "walls[0].box.max", (double[]){1.2, 0.3, 0.6}, 3);
        set(scene, "walls[1].mesh.vertices", (double[]){0, 0, 0, 0.2, 0, 0, 0, 0.2, 0}, 9);
        set(scene, "walls[1].mesh.triangles", indices, MOST + 3 * (size_t)extra);
        set(scene, "walls[1].motion.velocity", (double[]){0.1, 0, 0}, 3);
        set(scene, "walls[1].motion.pivot", (double[]){0.1, 0.1, 0}, 3);
        WeirTriangles triangles;
        weir_triangles_of(&triangles, scene);
        assert_int_equal(triangles.form_count, 2);
        assert_int_equal(triangles.forms[1].first, extra ? 0 : 36);
        assert_int_equal(triangles.forms[1].last, extra ? 0 : 36 + MOST);
        assert_true(triangles.forms[1].reach > 0.14f);
        weir_triangles_free(&triangles);
        weir_scene_destroy(scene);
    }
}

// Of a mesh: a cube keeps its edges. A driven solid is kept about its pivot.
static void meshes_keep_their_edges(void **state)
{
    (void)state;
    static const double corners[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                       0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
    static const double triangles_of_cube[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    WeirScene *scene = tank();
    set(scene, "walls[0].mesh.vertices", corners, 24);
    set(scene, "walls[0].mesh.triangles", triangles_of_cube, 36);
    weir_scene_set_number(scene, "walls[0].mesh.scale", 0.25);
    set(scene, "walls[0].motion.velocity", (double[]){0.1, 0, 0}, 3);
    set(scene, "walls[0].motion.pivot", (double[]){0.25, 0, 0}, 3);
    WeirTriangles triangles;
    weir_triangles_of(&triangles, scene);
    assert_int_equal(triangles.count, 36);
    CHECK_NEAR(volume_of(&triangles, 1), 0.25 * 0.25 * 0.25, 1e-6);
    for (uint32_t n = 0; n < triangles.count; n++) {
        const WeirCorner *corner = &triangles.corners[n];
        float largest =
            fmaxf(fabsf(corner->normal[0]), fmaxf(fabsf(corner->normal[1]), fabsf(corner->normal[2])));
        CHECK_NEAR(largest, 1.0, 1e-6);
        assert_true(corner->place[0] <= 1e-6f && corner->place[0] >= -0.250001f);
    }
    weir_triangles_free(&triangles);
    weir_scene_destroy(scene);
}

// A fixed box ends where the domain does; walls around the fluid are not drawn, for they would hide it.
static void walls_hide_no_fluid(void **state)
{
    (void)state;
    WeirScene *scene = tank();
    set(scene, "walls[0].box.min", (double[]){1, -0.5, 0.4}, 3);
    set(scene, "walls[0].box.max", (double[]){1.2, 0.3, 0.6}, 3);
    set(scene, "walls[1].ball.center", (double[]){1, 0.5, 0.5}, 3);
    weir_scene_set_number(scene, "walls[1].ball.radius", 0.4);
    weir_scene_set_boolean(scene, "walls[1].inside", true);
    WeirTriangles triangles;
    weir_triangles_of(&triangles, scene);
    assert_int_equal(triangles.count, 36);
    CHECK_NEAR(volume_of(&triangles, 1), 0.2 * 0.3 * 0.2, 1e-6);
    weir_triangles_free(&triangles);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_are_closed),          cmocka_unit_test(forms_are_the_shapes),
        cmocka_unit_test(large_meshes_are_not_tried), cmocka_unit_test(meshes_keep_their_edges),
        cmocka_unit_test(walls_hide_no_fluid),
    };
    return cmocka_run_group_tests_name("render: shapes", tests, NULL, NULL);
}
