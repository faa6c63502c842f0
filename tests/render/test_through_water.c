// What is seen through still water in 3D: where Snell's law has it, joined at the waterline, mirrored in the sides.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "common/build.h"
#include "pool.h"
#include "render/camera.h"
#include "upload.h"

static int start(void **state)
{
    *state = weir_test_gpu(NULL);
    return 0;
}

static int end(void **state)
{
    weir_gpu_destroy(*state);
    return 0;
}

static const double surface_height =
    0.41; // half a spacing above the highest layer, and a little: it is made of balls

static WeirSim *pool_of_ball(double radius)
{
    WeirScene *scene = pool_scene();
    weir_scene_set_numbers(scene, "bodies[0].ball.center", (double[]){0.5, 0.7, 0.5}, 3);
    weir_scene_set_number(scene, "bodies[0].ball.radius", radius);
    return pool_of(scene, true);
}

static WeirSim *pool_of_cylinder(void)
{
    WeirScene *scene = pool_scene();
    weir_scene_set_numbers(scene, "bodies[0].cylinder.from", (double[]){0.5, 0.6, 0.5}, 3);
    weir_scene_set_numbers(scene, "bodies[0].cylinder.to", (double[]){0.5, 0.8, 0.5}, 3);
    weir_scene_set_number(scene, "bodies[0].cylinder.radius", 0.2);
    return pool_of(scene, true);
}

// Still water, and the pool's body at `position`.
static void draw_body(WeirGpu *gpu, WeirSim *sim, const WeirView *view, const float position[3],
                      WeirImage *image)
{
    WeirGpuParticles particles;
    WeirState now;
    upload_waves(gpu, sim, 0.0f, false, &particles);
    assert_int_equal(weir_sim_state(sim, &now), WEIR_OK);
    WeirSolidState solids[2] = {now.solids[0], now.solids[1]};
    memcpy(solids[1].position, position, 3 * sizeof *position);
    assert_true(weir_upload_solids(&particles, solids, 2));
    weir_test_picture(gpu, sim, &particles, view, WEIR_ALL_EFFECTS, SIZE, image);
    weir_upload_release(&particles);
}

// The point of the surface at which the eye sees a point of the water, by Snell's law.
static void seen_at(const WeirView *view, const double point[3], float place[3])
{
    WeirCameraAxes axes = weir_camera_axes(view, SIZE, SIZE);
    const double height = (double)axes.eye[1] - surface_height, depth = surface_height - point[1];
    const double x = point[0] - (double)axes.eye[0], z = point[2] - (double)axes.eye[2];
    const double across = hypot(x, z);
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 60; k++) {
        double part = 0.5 * (low + high), above = part * across, below = across - above;
        if (above / hypot(above, height) < 1.33 * below / hypot(below, depth))
            low = part;
        else
            high = part;
    }
    place[0] = axes.eye[0] + (float)(low * x);
    place[1] = (float)surface_height;
    place[2] = axes.eye[2] + (float)(low * z);
}

static const uint8_t *pixel_of(const WeirImage *image, const WeirView *view, const double point[3])
{
    float place[3];
    seen_at(view, point, place);
    return pixel_at(image, view, place[0], place[1], place[2]);
}

// The middle of the pixels that are redder with the body than without, near one: columns and rows from it.
static void middle_of_body(const uint8_t *with, const uint8_t *without, double middle[2])
{
    enum { REACH = 14 };
    double sum = 0.0;
    middle[0] = middle[1] = 0.0;
    for (int y = -REACH; y <= REACH; y++) {
        for (int x = -REACH; x <= REACH; x++) {
            ptrdiff_t at = 4 * ((ptrdiff_t)y * SIZE + x);
            if (with[at] - with[at + 2] < without[at] - without[at + 2] + 40) continue;
            sum += 1.0;
            middle[0] += x;
            middle[1] += y;
        }
    }
    for (int k = 0; k < 2; k++) middle[k] /= fmax(sum, 1.0);
    if (!(sum > 60.0)) fail_msg("only %g pixels of the ball", sum);
}

// And not where it is: there the floor behind it shows.
static void a_ball_under_water_is_where_snell_says(void **state)
{
    WeirSim *with = pool_of_ball(0.06), *without = pool(false);
    const float yaws[] = {0.0f, 0.7f};
    for (int k = 0; k < 2; k++) {
        WeirView view = view_of(WEIR_FLUID_WATER);
        view.camera_yaw = yaws[k];
        WeirImage plain, ball;
        draw_waves(*state, without, 0.0f, false, &view, WEIR_ALL_EFFECTS, &plain);
        const double at[3] = {0.5, 0.12, 0.45};
        draw_body(*state, with, &view, (const float[3]){0.5f, 0.12f, 0.45f}, &ball);
        double off[2];
        middle_of_body(pixel_of(&ball, &view, at), pixel_of(&plain, &view, at), off);
        if (!(hypot(off[0], off[1]) < 1.6)) fail_msg("%g, %g pixels off", off[0], off[1]);
        const uint8_t *straight = pixel_at(&ball, &view, 0.5f, 0.12f, 0.45f);
        ptrdiff_t shift = (pixel_of(&ball, &view, at) - straight) / 4 / SIZE;
        assert_true(labs(shift) >= 10); // rows: more than it is high
        const uint8_t *floor = plain.pixels + (straight - ball.pixels);
        if (weir_test_difference(straight, floor) > 24)
            fail_msg("the floor differs by %d", weir_test_difference(straight, floor));
        weir_image_destroy(&plain);
        weir_image_destroy(&ball);
    }
    weir_sim_destroy(with);
    weir_sim_destroy(without);
}

static void deeper_is_bluer(void **state)
{
    WeirSim *sim = pool_of_ball(0.06);
    WeirView view = view_of(WEIR_FLUID_WATER);
    int last = 0;
    for (int k = 0; k < 4; k++) {
        const float position[3] = {0.5f, k == 0 ? 0.6f : 0.4f - 0.1f * (float)k,
                                   0.5f}; // the first in the air
        const double at[3] = {0.5, (double)position[1] + 0.03, 0.5};
        WeirImage image;
        draw_body(*state, sim, &view, position, &image);
        const uint8_t *seen =
            k == 0 ? pixel_at(&image, &view, 0.5f, position[1] + 0.03f, 0.5f) : pixel_of(&image, &view, at);
        int warm = seen[0] - seen[2];
        if (k > 0 && !(warm < last - 12)) fail_msg("red over blue %d, less deep %d", warm, last);
        last = warm;
        weir_image_destroy(&image);
    }
    weir_sim_destroy(sim);
}

// From above into the water and flat onto a side: nothing leaves there, and the ball before it is seen again behind it.
static void a_side_mirrors_a_ball(void **state)
{
    WeirSim *with = pool_of_ball(0.05), *without = pool(false);
    WeirView view = view_of(WEIR_FLUID_WATER);
    WeirCameraAxes axes = weir_camera_axes(&view, SIZE, SIZE);
    assert_true(axes.eye[2] > 1.5f); // it looks to the side z = 0
    WeirImage plain, ball;
    draw_waves(*state, without, 0.0f, false, &view, WEIR_ALL_EFFECTS, &plain);
    draw_body(*state, with, &view, (const float[3]){0.5f, 0.18f, 0.08f}, &ball);
    for (int k = 0; k < 2; k++) {
        const double at[3] = {0.5, 0.18, k ? -0.08 : 0.08};
        double off[2];
        middle_of_body(pixel_of(&ball, &view, at), pixel_of(&plain, &view, at), off);
        if (!(fabs(off[0]) < 1.0 && fabs(off[1]) < 6.0)) fail_msg("%d: %g, %g off", k, off[0], off[1]);
        const uint8_t *seen = pixel_of(&ball, &view, at), *before = pixel_of(&plain, &view, at);
        assert_true(seen[0] - seen[2] > before[0] - before[2] + 40);
    }
    weir_image_destroy(&plain);
    weir_image_destroy(&ball);
    weir_sim_destroy(with);
    weir_sim_destroy(without);
}

// From its top down to where Snell's law has its lower edge there is body, without a gap, and then no more.
static void a_body_half_in_water_is_one(void **state)
{
    WeirSim *with = pool(true), *without = pool(false);
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_pitch = 0.5f;
    WeirImage body, plain;
    draw_waves(*state, without, 0.0f, false, &view, WEIR_ALL_EFFECTS, &plain);
    draw_body(*state, with, &view, (const float[3]){0.5f, 0.40f, 0.5f}, &body);
    const uint8_t *top = pixel_at(&body, &view, 0.5f, 0.56f, 0.64f),
                  *bottom = pixel_of(&body, &view, (const double[3]){0.5, 0.24, 0.64});
    int rows = (int)((bottom - top) / 4 / SIZE);
    assert_true(rows > 15);
    for (int row = 0; row < rows + 8; row++) {
        const uint8_t *seen = top + 4 * row * SIZE, *other = plain.pixels + (seen - body.pixels);
        int warmer = seen[0] - seen[2] - (other[0] - other[2]);
        if (row < rows - 1 && warmer < 120) fail_msg("a gap in row %d of %d: %d", row, rows, warmer);
        if (row > rows + 2 && warmer > 80) fail_msg("still body in row %d of %d: %d", row, rows, warmer);
    }
    weir_image_destroy(&body);
    weir_image_destroy(&plain);
    weir_sim_destroy(with);
    weir_sim_destroy(without);
}

// The same box as twelve triangles.
static void a_mesh_is_seen_as_what_it_is(void **state)
{
    static const double triangles[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    double corners[24];
    for (int k = 0; k < 24; k++) {
        bool high = (k / 3) >> (k % 3) & 1;
        corners[k] = k % 3 == 1 ? (high ? 0.56 : 0.24) : (high ? 0.64 : 0.36);
    }
    WeirScene *scene = pool_scene();
    weir_scene_set_numbers(scene, "bodies[0].mesh.vertices", corners, 24);
    weir_scene_set_numbers(scene, "bodies[0].mesh.triangles", triangles, 36);
    WeirSim *sims[2] = {pool(true), pool_of(scene, true)};
    WeirView view = view_of(WEIR_FLUID_WATER);
    WeirImage images[2];
    for (int k = 0; k < 2; k++)
        draw_body(*state, sims[k], &view, (const float[3]){0.5f, 0.18f, 0.5f}, &images[k]);
    const uint8_t *seen = pixel_of(&images[1], &view, (const double[3]){0.5, 0.34, 0.5});
    assert_true(seen[0] > seen[2] - 40); // warmer than any water
    uint32_t other = 0;
    for (uint32_t k = 0; k < SIZE * SIZE; k++)
        other += weir_test_difference(images[0].pixels + 4 * k, images[1].pixels + 4 * k) > 30;
    if (other > 12) fail_msg("%u pixels differ", other);
    for (int k = 0; k < 2; k++) {
        weir_image_destroy(&images[k]);
        weir_sim_destroy(sims[k]);
    }
}

// Straight from above: which of eight directions show a brighter tone than those beside them, as bits.
static uint32_t tones(const WeirImage *image, const WeirView *view, double radius, double height)
{
    double light[8];
    for (int k = 0; k < 8; k++) {
        double angle = (k + 0.5) * 3.14159265 / 4.0;
        const double at[3] = {0.5 + radius * cos(angle), height, 0.5 + radius * sin(angle)};
        const uint8_t *seen = height < surface_height
                                  ? pixel_of(image, view, at)
                                  : pixel_at(image, view, (float)at[0], (float)height, (float)at[2]);
        light[k] = light_of(seen[1]);
    }
    uint32_t bits = 0;
    for (int k = 0; k < 8; k++)
        bits |= (uint32_t)(2.0 * light[k] > light[(k + 1) % 8] + light[(k + 7) % 8]) << k;
    return bits;
}

static void wet_tones_are_the_dry_ones(void **state)
{
    for (int shape = 0; shape < 2; shape++) {
        WeirSim *sim = shape == 0 ? pool_of_ball(0.2) : pool_of_cylinder();
        WeirView view = view_of(WEIR_FLUID_WATER);
        view.camera_pitch = 1.57f;
        const double top = shape == 0 ? 0.173 : 0.1; // where its distance from the axis is 0.1
        WeirImage dry, wet;
        draw_body(*state, sim, &view, (const float[3]){0.5f, 0.7f, 0.5f}, &dry);
        draw_body(*state, sim, &view, (const float[3]){0.5f, 0.18f, 0.5f}, &wet);
        uint32_t one = tones(&dry, &view, 0.1, 0.7 + top), other = tones(&wet, &view, 0.1, 0.18 + top);
        if (!(one == other && (one == 0x55 || one == 0xaa))) fail_msg("dry %x, wet %x", one, other);
        weir_image_destroy(&dry);
        weir_image_destroy(&wet);
        weir_sim_destroy(sim);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_under_water_is_where_snell_says),
        cmocka_unit_test(deeper_is_bluer),
        cmocka_unit_test(a_side_mirrors_a_ball),
        cmocka_unit_test(a_body_half_in_water_is_one),
        cmocka_unit_test(a_mesh_is_seen_as_what_it_is),
        cmocka_unit_test(wet_tones_are_the_dry_ones),
    };
    return cmocka_run_group_tests_name("render: through water in 3D", tests, start, end);
}
