// Pictures in 3D, from states that the test itself puts on the device: depth, groups, colours, the camera's maths.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "common/build.h"
#include "picture.h"
#include "render/renderer.h"
#include "upload.h"

enum { SIZE = 96 };

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

// A tank of 1 m with some fluid, on the CPU.
static WeirSim *tank(void)
{
    WeirScene *scene = weir_scene_create();
    weir_scene_set_string(scene, "method", "wcsph");
    weir_scene_set_number(scene, "dimension", 3);
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.1);
    weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1});
    weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){0.4, 0.4, 0.4}, (double[]){0, 0, 0});
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    weir_scene_destroy(scene);
    return sim;
}

// Particles that the test places itself.
typedef struct Dot {
    float position[3];
    uint32_t group;
    float speed;
} Dot;

static WeirGpuParticles place(WeirGpu *gpu, const WeirSim *sim, const Dot *dots, uint32_t count)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    int32_t coordinate[8][4] = {{0}};
    float motion[8][4] = {{0}};
    assert_true(count <= 8);
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            coordinate[i][k] =
                (int32_t)lroundf((dots[i].position[k] - constants->origin[k]) / constants->quantum);
        }
        coordinate[i][3] = (int32_t)dots[i].group;
        motion[i][0] = dots[i].speed;
        motion[i][3] = 1000.0f;
    }
    WeirGpuParticles particles = {.gpu = gpu, .method = WEIR_METHOD_WCSPH, .count = count};
    assert_true(weir_upload_arrays(gpu, coordinate, motion, count, &particles));
    return particles;
}

// From +z, the middle of the tank in the middle of the picture.
static WeirView front_view(void)
{
    return (WeirView){.color_by = WEIR_COLOR_SPEED,
                      .color_max = 1.0f,
                      .particle_radius = 0.06f,
                      .camera_target = {0.5f, 0.5f, 0.5f},
                      .camera_distance = 2.0f,
                      .camera_field_of_view = 0.6f};
}

static const uint8_t *pixel(const WeirImage *image, uint32_t x, uint32_t y)
{
    return image->pixels + 4 * ((size_t)y * SIZE + x);
}

static const uint8_t middle = SIZE / 2;

// Two spheres behind one another, the near one slow (blue), the far one fast (white), in both orders.
static void nearer_sphere_hides_the_other(void **state)
{
    WeirGpu *gpu = *state;
    WeirSim *sim = tank();
    const Dot dots[2] = {{{0.5f, 0.5f, 0.8f}, 0, 0.0f}, {{0.5f, 0.5f, 0.2f}, 0, 1.0f}};
    WeirView view = front_view();
    WeirImage images[2], from_behind;
    for (int order = 0; order < 2; order++) {
        const Dot turned[2] = {dots[order], dots[1 - order]};
        WeirGpuParticles particles = place(gpu, sim, turned, 2);
        weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, &images[order]);
        weir_upload_release(&particles);
    }
    const uint8_t *seen = pixel(&images[0], middle, middle);
    assert_true(seen[2] > seen[0] + 60); // blue
    assert_memory_equal(images[0].pixels, images[1].pixels, (size_t)4 * SIZE * SIZE);
    view.camera_yaw = 3.14159265f;
    WeirGpuParticles particles = place(gpu, sim, dots, 2);
    weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, &from_behind);
    weir_upload_release(&particles);
    const uint8_t *white = pixel(&from_behind, middle, middle);
    assert_true(white[0] > 120 && abs(white[0] - white[2]) < 70);
    for (int k = 0; k < 2; k++) weir_image_destroy(&images[k]);
    weir_image_destroy(&from_behind);
    weir_sim_destroy(sim);
}

// Spheres that cut into each other: each shows where its own surface is nearer, so the seam lies in the middle.
static void spheres_cut_by_depth(void **state)
{
    WeirGpu *gpu = *state;
    WeirSim *sim = tank();
    const Dot dots[2] = {{{0.4f, 0.5f, 0.5f}, 0, 0.0f}, {{0.6f, 0.5f, 0.5f}, 0, 1.0f}};
    WeirView view = front_view();
    view.particle_radius = 0.3f;
    WeirImage image;
    WeirGpuParticles particles = place(gpu, sim, dots, 2);
    weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, &image);
    weir_upload_release(&particles);
    const uint8_t *left = pixel(&image, middle - 6, middle), *right = pixel(&image, middle + 6, middle);
    assert_true(left[2] > left[0] + 60);
    assert_true(right[0] > 120);
    weir_image_destroy(&image);
    weir_sim_destroy(sim);
}

// How large a sphere appears: radius 0.2 m at 2 m, seen under 0.6 rad.
static void sphere_has_its_size_in_perspective(void **state)
{
    WeirGpu *gpu = *state;
    WeirSim *sim = tank();
    const Dot dot = {{0.5f, 0.5f, 0.5f}, 0, 0.0f}; // blue, before the bright horizon and the floor
    WeirView view = front_view();
    view.particle_radius = 0.2f;
    WeirImage plain, image;
    WeirGpuParticles particles = place(gpu, sim, &dot, 1);
    weir_test_picture(gpu, sim, &particles, &view, 1u << WEIR_EFFECT_BACKDROP | 1u << WEIR_EFFECT_COMPOSE,
                      SIZE, &plain);
    weir_test_picture(gpu, sim, &particles, &view,
                      1u << WEIR_EFFECT_BACKDROP | 1u << WEIR_EFFECT_SPHERES | 1u << WEIR_EFFECT_COMPOSE |
                          1u << WEIR_EFFECT_SHADOW,
                      SIZE, &image);
    weir_upload_release(&particles);
    uint32_t covered = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++)
            covered += weir_test_difference(pixel(&plain, x, y), pixel(&image, x, y)) > 60;
    }
    double tangent = 0.2 / sqrt(2.0 * 2.0 - 0.2 * 0.2);
    double radius = tangent / tan(0.3) * SIZE / 2;
    CHECK_NEAR(covered, 3.14159265 * radius * radius, 0.06 * 3.14159265 * radius * radius);
    weir_image_destroy(&plain);
    weir_image_destroy(&image);
    weir_sim_destroy(sim);
}

// The scene has no walls of its own: group 1 is the domain's side, which the outline shows, group 2 a body.
static void groups_have_their_looks(void **state)
{
    WeirGpu *gpu = *state;
    WeirSim *sim = tank();
    WeirView view = front_view();
    const uint32_t spheres = 1u << WEIR_EFFECT_BACKDROP | 1u << WEIR_EFFECT_SPHERES |
                             1u << WEIR_EFFECT_SHADOW | 1u << WEIR_EFFECT_COMPOSE;
    const struct {
        uint32_t group;
        enum { NOTHING, BLUE, WARM } look;
    } cases[] = {{WEIR_GROUP_FLUID, BLUE},     {WEIR_GROUP_INLET + 3, BLUE}, {WEIR_GROUP_EMPTY, NOTHING},
                 {WEIR_GROUP_SOLID, NOTHING},  {WEIR_GROUP_SOLID + 1, WARM}, {WEIR_GROUP_SOLID + 2, WARM},
                 {WEIR_GROUP_SOLID + 65, WARM}};
    WeirImage plain, image;
    const Dot fluid = {{0.5f, 0.5f, 0.5f}, 0, 0.0f};
    WeirGpuParticles particles = place(gpu, sim, &fluid, 1);
    weir_test_picture(gpu, sim, &particles, &view, 1u << WEIR_EFFECT_BACKDROP | 1u << WEIR_EFFECT_COMPOSE,
                      SIZE, &plain);
    weir_upload_release(&particles);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        Dot dot = fluid;
        dot.group = cases[k].group;
        particles = place(gpu, sim, &dot, 1);
        weir_test_picture(gpu, sim, &particles, &view, spheres, SIZE, &image);
        weir_upload_release(&particles);
        const uint8_t *seen = pixel(&image, middle, middle);
        if (cases[k].look == BLUE) assert_true(seen[2] > seen[0] + 60);
        if (cases[k].look == WARM) assert_true(seen[0] > seen[2] + 25);
        if (cases[k].look == NOTHING)
            assert_memory_equal(plain.pixels, image.pixels, (size_t)4 * SIZE * SIZE);
        weir_image_destroy(&image);
    }
    weir_image_destroy(&plain);
    weir_sim_destroy(sim);
}

// A sphere high above the floor darkens the floor behind it, away from the light, and nothing else far off.
static void shadow_falls_on_the_floor(void **state)
{
    WeirGpu *gpu = *state;
    WeirSim *sim = tank();
    WeirView view = front_view();
    view.camera_pitch = 1.2f;
    const Dot dot = {{0.5f, 0.6f, 0.5f}, 0, 0.0f};
    WeirImage lit, shaded;
    WeirGpuParticles particles = place(gpu, sim, &dot, 1);
    view.particle_radius = 0.12f;
    const uint32_t floor_only =
        1u << WEIR_EFFECT_BACKDROP | 1u << WEIR_EFFECT_GROUND | 1u << WEIR_EFFECT_COMPOSE;
    weir_test_picture(gpu, sim, &particles, &view, floor_only, SIZE, &lit);
    weir_test_picture(gpu, sim, &particles, &view, floor_only | 1u << WEIR_EFFECT_SHADOW, SIZE, &shaded);
    weir_upload_release(&particles);
    // Where the light through the sphere meets the floor: 0.6 m below, along (0.35, -0.86, -0.37).
    const float foot[4] = {0.5f + 0.6f * 0.3496f / 0.8591f, 0.0f, 0.5f - 0.6f * 0.3737f / 0.8591f, 1.0f};
    float matrix[16], clip[4] = {0};
    weir_view_matrix(&view, SIZE, SIZE, matrix);
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) clip[row] += matrix[4 * column + row] * foot[column];
    }
    uint32_t x = (uint32_t)((clip[0] / clip[3] + 1) * SIZE / 2),
             y = (uint32_t)((1 - clip[1] / clip[3]) * SIZE / 2);
    assert_true(weir_test_difference(pixel(&lit, x, y), pixel(&shaded, x, y)) > 12);
    uint32_t changed = 0;
    for (uint32_t k = 0; k < SIZE * SIZE; k++)
        changed += weir_test_difference(lit.pixels + 4 * k, shaded.pixels + 4 * k) > 6;
    assert_true(changed > 20 && changed < SIZE * SIZE / 8);
    weir_image_destroy(&lit);
    weir_image_destroy(&shaded);
    weir_sim_destroy(sim);
}

// Between two big spheres, where little light gets to, the picture is darker than without that effect.
static void hollows_are_darker(void **state)
{
    WeirGpu *gpu = *state;
    WeirSim *sim = tank();
    WeirView view = front_view();
    view.particle_radius = 0.15f;
    const Dot dots[3] = {
        {{0.36f, 0.5f, 0.5f}, 0, 1.0f}, {{0.64f, 0.5f, 0.5f}, 0, 1.0f}, {{0.5f, 0.5f, 0.3f}, 0, 1.0f}};
    WeirImage with, without;
    WeirGpuParticles particles = place(gpu, sim, dots, 3);
    weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, &with);
    weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS & ~(1u << WEIR_EFFECT_OCCLUSION), SIZE,
                      &without);
    weir_upload_release(&particles);
    assert_true(pixel(&with, middle, middle)[1] + 8 < pixel(&without, middle, middle)[1]);
    uint32_t brighter = 0;
    for (uint32_t k = 0; k < SIZE * SIZE; k++)
        brighter += with.pixels[4 * k + 1] > without.pixels[4 * k + 1] + 1;
    assert_int_equal(brighter, 0);
    weir_image_destroy(&with);
    weir_image_destroy(&without);
    weir_sim_destroy(sim);
}

static void bad_cameras_are_refused(void **state)
{
    (void)state;
    const WeirView good = front_view();
    const struct {
        size_t offset;
        float value;
        const char *part;
    } cases[] = {
        {offsetof(WeirView, camera_target) + 4, NAN, "camera_target[1]"},
        {offsetof(WeirView, camera_yaw), INFINITY, "camera_yaw"},
        {offsetof(WeirView, camera_pitch), 2.0f, "camera_pitch is 2"},
        {offsetof(WeirView, camera_distance), 0.0f, "camera_distance is 0"},
        {offsetof(WeirView, camera_field_of_view), 3.5f, "camera_field_of_view is 3.5"},
        {offsetof(WeirView, camera_shift), NAN, "camera_shift[0]"},
    };
    WeirMessage message = {0};
    int target = 0;
    assert_int_equal(weir_frame_check(&good, 3, &target, 8, 8, &message), WEIR_OK);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        WeirView view = good;
        memcpy((char *)&view + cases[k].offset, &cases[k].value, sizeof(float));
        assert_int_equal(weir_frame_check(&view, 3, &target, 8, 8, &message), WEIR_ERROR_INPUT);
        CHECK_CONTAINS(message.text, cases[k].part);
    }
}

static void camera_maths(void **state)
{
    (void)state;
    WeirView view = front_view();
    view.camera_yaw = 0.7f;
    view.camera_pitch = 0.4f;
    view.camera_shift[0] = 0.2f;
    view.camera_shift[1] = -0.1f;
    float matrix[16];
    weir_view_matrix(&view, 320, 200, matrix);
    WeirRandom random = {7};
    for (int n = 0; n < 100; n++) {
        float point[4] = {0, 0, 0, 1}, clip[4] = {0};
        for (int k = 0; k < 3; k++) point[k] = (float)weir_random_range(&random, 0, 1);
        for (int row = 0; row < 4; row++) {
            for (int column = 0; column < 4; column++) clip[row] += matrix[4 * column + row] * point[column];
        }
        assert_true(clip[3] > 0 && clip[2] > 0 && clip[2] < clip[3]);
        float x = (clip[0] / clip[3] + 1) * 160, y = (1 - clip[1] / clip[3]) * 100;
        // The ray through that pixel passes the point.
        float origin[3], direction[3], along = 0, length = 0;
        weir_view_ray(&view, 320, 200, x, y, origin, direction);
        for (int k = 0; k < 3; k++) {
            along += (point[k] - origin[k]) * direction[k];
            length += direction[k] * direction[k];
        }
        CHECK_NEAR(length, 1.0, 1e-5);
        for (int k = 0; k < 3; k++) CHECK_NEAR(origin[k] + along * direction[k], point[k], 1e-4);
    }
    // The target appears where the shift says.
    float origin[3], direction[3];
    weir_view_ray(&view, 320, 200, 160 * 1.2f, 100 * 1.1f, origin, direction);
    for (int k = 0; k < 3; k++) CHECK_NEAR(origin[k] + 2.0f * direction[k], view.camera_target[k], 1e-5);
    // Without turning it looks along -z; a positive yaw goes to +x, a positive pitch up.
    view = front_view();
    weir_view_ray(&view, 320, 200, 160, 100, origin, direction);
    CHECK_NEAR(origin[2], 2.5, 1e-5);
    CHECK_NEAR(direction[2], -1.0, 1e-6);
    view.camera_yaw = view.camera_pitch = 0.5f;
    weir_view_ray(&view, 320, 200, 160, 100, origin, direction);
    assert_true(origin[0] > 1.0f && origin[1] > 1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearer_sphere_hides_the_other),
        cmocka_unit_test(spheres_cut_by_depth),
        cmocka_unit_test(sphere_has_its_size_in_perspective),
        cmocka_unit_test(groups_have_their_looks),
        cmocka_unit_test(shadow_falls_on_the_floor),
        cmocka_unit_test(hollows_are_darker),
        cmocka_unit_test(bad_cameras_are_refused),
        cmocka_unit_test(camera_maths),
    };
    return cmocka_run_group_tests_name("render: pictures in 3D", tests, start, end);
}
