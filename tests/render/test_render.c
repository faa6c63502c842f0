// The renderer's pictures, read back: colours, areas, brightness, sizes, several renderers, bad input.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "common/build.h"
#include "image.h"
#include "render/renderer.h"

static const double pi = 3.14159265358979;
static const uint32_t discs_only = 1u << WEIR_EFFECT_PARTICLES;
static const uint32_t discs_on_background = 1u << WEIR_EFFECT_PARTICLES | 1u << WEIR_EFFECT_BACKGROUND;

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

// A simulation of `count` particles at places in pixels of a picture whose middle is (0.5, 0.5) in metres,
// with 100 pixels per metre. `speeds` NULL: at rest. No gravity; the particles are too far apart to act on
// each other.
typedef struct Spot {
    float x, y;
} Spot;

static WeirSim *spots_sim(WeirGpu *gpu, uint32_t count, const Spot *spots, const float *speeds,
                          uint32_t width, uint32_t height)
{
    WeirScene *scene = weir_test_count_scene(count, 1.0, 0.02, 0.05);
    WeirSim *sim = weir_test_sim(scene, weir_gpu_backend(gpu), 0);
    float *positions = calloc(count, 2 * sizeof(float)), *velocities = calloc(count, 2 * sizeof(float));
    assert_true(positions && velocities);
    for (uint32_t i = 0; i < count; i++) {
        positions[2 * i] = 0.5f + (spots[i].x - 0.5f * (float)width) / 100.0f;
        positions[2 * i + 1] = 0.5f - (spots[i].y - 0.5f * (float)height) / 100.0f;
        if (speeds) velocities[2 * i] = speeds[i];
    }
    weir_test_set_state(sim, positions, velocities);
    free(positions);
    free(velocities);
    weir_scene_destroy(scene);
    return sim;
}

// Radius in pixels.
static WeirView spots_view(float radius)
{
    return (WeirView){.color_by = WEIR_COLOR_SPEED,
                      .color_max = 2.0f,
                      .center = {0.5f, 0.5f},
                      .pixels_per_meter = 100.0f,
                      .particle_radius = radius / 100.0f};
}

static void draw(WeirGpu *gpu, WeirSim *sim, const WeirView *view, uint32_t effects, WeirImage *image)
{
    WeirRenderer *renderer = weir_renderer_create(gpu, image->format);
    assert_non_null(renderer);
    renderer->effects = effects;
    WeirStatus status = weir_renderer_draw(renderer, sim, view, image->view, image->width, image->height);
    if (status != WEIR_OK) fail_msg("%s", weir_renderer_error(renderer));
    assert_true(weir_image_read(image));
    weir_renderer_destroy(renderer);
    if (weir_gpu_poll(gpu) != WEIR_OK) fail_msg("%s", weir_gpu_error(gpu));
}

static void create_image(WeirImage *image, WeirGpu *gpu, WGPUTextureFormat format, uint32_t width,
                         uint32_t height)
{
    assert_true(weir_image_create(image, gpu, format, width, height));
}

static const uint8_t *pixel(const WeirImage *image, uint32_t x, uint32_t y)
{
    assert_true(x < image->width && y < image->height);
    return image->pixels + 4 * ((size_t)y * image->width + x);
}

static void check_color(const WeirImage *image, uint32_t x, uint32_t y, const uint8_t rgb[3], int tolerance)
{
    const uint8_t *found = pixel(image, x, y);
    for (int k = 0; k < 3; k++) CHECK_NEAR(found[k], rgb[k], tolerance);
}

// Blue of all pixels in a square, in units of a whole pixel of the colour whose blue is `full`.
static double blue_sum(const WeirImage *image, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1,
                       uint8_t full)
{
    double sum = 0;
    for (uint32_t y = y0; y < y1; y++) {
        for (uint32_t x = x0; x < x1; x++) sum += pixel(image, x, y)[2];
    }
    return sum / full;
}

static void disc_center_has_map_color(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spots[4] = {{16.5f, 16.5f}, {48.5f, 16.5f}, {16.5f, 48.5f}, {48.5f, 48.5f}};
    const float speeds[4] = {0.0f, 0.5f, 1.3f, 5.0f};
    const WGPUTextureFormat formats[4] = {WGPUTextureFormat_BGRA8Unorm, WGPUTextureFormat_RGBA8Unorm,
                                          WGPUTextureFormat_BGRA8UnormSrgb, WGPUTextureFormat_RGBA8UnormSrgb};
    WeirSim *sim = spots_sim(gpu, 4, spots, speeds, 64, 64);
    for (int f = 0; f < 4; f++) {
        for (float radius = 1.5f; radius < 12.0f; radius += 3.0f) {
            WeirImage image;
            create_image(&image, gpu, formats[f], 64, 64);
            WeirView view = spots_view(radius);
            draw(gpu, sim, &view, (1u << WEIR_EFFECTS) - 1, &image);
            for (int k = 0; k < 4; k++) {
                uint8_t rgb[3];
                weir_color_map(WEIR_COLOR_SPEED, speeds[k] / 2.0f, rgb);
                check_color(&image, (uint32_t)spots[k].x, (uint32_t)spots[k].y, rgb, 1);
            }
            weir_image_destroy(&image);
        }
    }
    weir_sim_destroy(sim);
}

// Every step of every map, one particle each, is what weir_color_map() says.
static void shader_map_is_the_library_map(void **state)
{
    WeirGpu *gpu = *state;
    enum { COUNT = 256 };
    Spot spots[COUNT];
    float speeds[COUNT];
    for (int i = 0; i < COUNT; i++) {
        spots[i] = (Spot){4.5f + 6.0f * (float)(i % 16), 4.5f + 6.0f * (float)(i / 16)};
        speeds[i] = 2.0f * (float)i / 255.0f;
    }
    WeirSim *sim = spots_sim(gpu, COUNT, spots, speeds, 100, 100);
    WeirImage image;
    create_image(&image, gpu, WGPUTextureFormat_RGBA8Unorm, 100, 100);
    WeirView view = spots_view(2.0f);
    draw(gpu, sim, &view, discs_only, &image);
    for (int i = 0; i < COUNT; i++) {
        uint8_t rgb[3];
        weir_color_map(WEIR_COLOR_SPEED, (float)i / 255.0f, rgb);
        check_color(&image, (uint32_t)spots[i].x, (uint32_t)spots[i].y, rgb, 0);
    }
    weir_image_destroy(&image);
    weir_sim_destroy(sim);
}

// Four particles squeezed into one place: compressed, each as much as the others.
static void each_quantity_uses_its_map(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spots[4] = {{16.4f, 16.4f}, {16.6f, 16.4f}, {16.4f, 16.6f}, {16.6f, 16.6f}};
    WeirSim *sim = spots_sim(gpu, 4, spots, (const float[]){3, 3, 3, 3}, 33, 33);
    float *density = weir_test_read(sim, WEIR_FIELD_DENSITY),
          *pressure = weir_test_read(sim, WEIR_FIELD_PRESSURE);
    assert_true(*density > 1100.0f && *pressure > 1e5f);
    const float values[WEIR_COLOR_MAPS] = {3.0f, *density, (float)(*density / 1000.0 - 1.0), *pressure};
    for (int by = 0; by < WEIR_COLOR_MAPS; by++) {
        // The value lies at 0.3 of the range.
        float range = values[by];
        WeirView view = spots_view(4.0f);
        view.color_by = (WeirColorBy)by;
        view.color_min = values[by] - 0.3f * range;
        view.color_max = values[by] + 0.7f * range;
        WeirImage image;
        create_image(&image, gpu, WGPUTextureFormat_RGBA8Unorm, 33, 33);
        draw(gpu, sim, &view, discs_only, &image);
        uint8_t rgb[3];
        weir_color_map((WeirColorBy)by, 0.3f, rgb);
        check_color(&image, 16, 16, rgb, 2);
        weir_image_destroy(&image);
    }
    free(density);
    free(pressure);
    weir_sim_destroy(sim);
}

// At the fastest colour, nearly white, the sum of blue is the covered area.
static void disc_area_and_sub_pixel_brightness(void **state)
{
    WeirGpu *gpu = *state;
    // Four places within a pixel.
    const Spot spots[4] = {{20.5f, 20.5f}, {60.0f, 20.0f}, {20.3f, 60.8f}, {60.5f, 60.0f}};
    const float speeds[4] = {9, 9, 9, 9};
    uint8_t rgb[3];
    weir_color_map(WEIR_COLOR_SPEED, 1, rgb);
    WeirSim *sim = spots_sim(gpu, 4, spots, speeds, 80, 80);
    // Beyond a radius of 1.5 pixels the rim is shaded, which changes no area: see the next test.
    const float radii[] = {0.1f, 0.25f, 0.4f, 0.5f, 0.6f, 0.7f, 0.8f, 1.0f, 1.25f, 1.5f};
    for (size_t k = 0; k < sizeof radii / sizeof *radii; k++) {
        WeirImage image;
        create_image(&image, gpu, WGPUTextureFormat_RGBA8Unorm, 80, 80);
        WeirView view = spots_view(radii[k]);
        draw(gpu, sim, &view, discs_only, &image);
        double area = pi * radii[k] * radii[k];
        for (uint32_t q = 0; q < 4; q++) {
            uint32_t x = q % 2 * 40, y = q / 2 * 40;
            double sum = blue_sum(&image, x, y, x + 40, y + 40, rgb[2]);
            CHECK_NEAR(sum, area, 0.06 * area + 0.02);
        }
        weir_image_destroy(&image);
    }
    weir_sim_destroy(sim);
}

// How much of the background a big disc covers, from the alpha it writes onto the cleared target.
static void big_disc_covers_its_area(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spot = {40.2f, 39.7f};
    WeirSim *sim = spots_sim(gpu, 1, &spot, NULL, 80, 80);
    for (float radius = 3.0f; radius <= 30.0f; radius *= 1.7f) {
        WeirImage plain, with;
        create_image(&plain, gpu, WGPUTextureFormat_RGBA8Unorm, 80, 80);
        create_image(&with, gpu, WGPUTextureFormat_RGBA8Unorm, 80, 80);
        WeirView view = spots_view(radius);
        draw(gpu, sim, &view, 1u << WEIR_EFFECT_BACKGROUND, &plain);
        draw(gpu, sim, &view, discs_on_background, &with);
        // Counts pixels that differ; those half covered by the edge count when the disc covers most of them.
        double area = 0;
        for (uint32_t y = 0; y < 80; y++) {
            for (uint32_t x = 0; x < 80; x++) {
                double d = hypot(x + 0.5 - spot.x, y + 0.5 - spot.y);
                bool same = memcmp(pixel(&plain, x, y), pixel(&with, x, y), 4) == 0;
                if (d > radius + 0.6) assert_true(same);
                if (d < radius - 0.6) assert_false(same);
                int rise = pixel(&with, x, y)[2] - pixel(&plain, x, y)[2];
                uint8_t rgb[3];
                weir_color_map(WEIR_COLOR_SPEED, 0, rgb);
                // The rim has at least 0.72 of the blue; half of that marks a covered pixel.
                area += rise > 0.36 * (rgb[2] - pixel(&plain, x, y)[2]);
            }
        }
        CHECK_NEAR(area, pi * radius * radius, 0.04 * pi * radius * radius + 2);
        weir_image_destroy(&plain);
        weir_image_destroy(&with);
    }
    weir_sim_destroy(sim);
}

// Far from the particle the whole picture is the background, whatever is drawn, and it is deep and opaque.
static void outside_is_background(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spot = {60.0f, 45.0f};
    WeirSim *sim = spots_sim(gpu, 1, &spot, &(float){1.9f}, 120, 90);
    WeirImage plain, with;
    create_image(&plain, gpu, WGPUTextureFormat_BGRA8Unorm, 120, 90);
    create_image(&with, gpu, WGPUTextureFormat_BGRA8Unorm, 120, 90);
    WeirView view = spots_view(3.0f);
    draw(gpu, sim, &view, 1u << WEIR_EFFECT_BACKGROUND, &plain);
    draw(gpu, sim, &view, (1u << WEIR_EFFECTS) - 1 - (1u << WEIR_EFFECT_OVERLAY), &with);
    for (uint32_t y = 0; y < 90; y++) {
        for (uint32_t x = 0; x < 120; x++) {
            for (int k = 0; k < 3; k++) assert_true(pixel(&plain, x, y)[k] < 64);
            assert_int_equal(pixel(&plain, x, y)[3], 255);
            assert_int_equal(pixel(&with, x, y)[3], 255);
            if (hypot(x + 0.5 - 60, y + 0.5 - 45) < 12) continue;
            assert_memory_equal(pixel(&plain, x, y), pixel(&with, x, y), 4);
        }
    }
    weir_image_destroy(&plain);
    weir_image_destroy(&with);
    weir_sim_destroy(sim);
}

static double brightness(const WeirImage *image, uint32_t x, uint32_t y)
{
    const uint8_t *rgb = pixel(image, x, y);
    return rgb[0] + rgb[1] + rgb[2];
}

static void outline_and_ring(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spot = {100.5f, 100.5f};
    WeirSim *sim = spots_sim(gpu, 1, &spot, NULL, 200, 200);
    WeirImage plain, image, pressed;
    create_image(&plain, gpu, WGPUTextureFormat_RGBA8Unorm, 200, 200);
    create_image(&image, gpu, WGPUTextureFormat_RGBA8Unorm, 200, 200);
    create_image(&pressed, gpu, WGPUTextureFormat_RGBA8Unorm, 200, 200);
    // The domain is 1 m, 100 pixels, so its sides are at 50 and 150; discs of 2 pixels move the line out
    // to 48.
    WeirView view = spots_view(2.0f);
    draw(gpu, sim, &view, (1u << WEIR_EFFECTS) - 1, &plain);
    view.tool_position[0] = 0.5f;
    view.tool_position[1] = 0.6f;
    view.tool_radius = 0.3f;
    draw(gpu, sim, &view, (1u << WEIR_EFFECTS) - 1, &image);
    view.tool_pressed = 1.0f;
    draw(gpu, sim, &view, (1u << WEIR_EFFECTS) - 1, &pressed);
    for (uint32_t at = 60; at < 140; at += 20) {
        const uint32_t line[4][2] = {{48, at}, {151, at}, {at, 48}, {at, 151}};
        const uint32_t beside[4][2] = {{32, at}, {167, at}, {at, 32}, {at, 167}};
        for (int k = 0; k < 4; k++) {
            double on = brightness(&plain, line[k][0], line[k][1]);
            CHECK_AT_MOST(brightness(&plain, beside[k][0], beside[k][1]) + 100, on);
        }
    }
    // The ring's top is at y = 200 / 2 - 10 - 30 = 60 pixels.
    CHECK_AT_MOST(brightness(&plain, 100, 60) + 80, brightness(&image, 100, 60));
    CHECK_AT_MOST(brightness(&image, 100, 60) + 40, brightness(&pressed, 100, 60));
    CHECK_AT_MOST(brightness(&image, 100, 66) + 10, brightness(&pressed, 100, 66));
    weir_image_destroy(&plain);
    weir_image_destroy(&image);
    weir_image_destroy(&pressed);
    weir_sim_destroy(sim);
}

// One renderer, targets of several sizes: the particle stays where the view puts it.
static void target_may_change_size(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spot = {8.5f, 8.5f}; // of a picture of 17 x 17: its middle
    WeirSim *sim = spots_sim(gpu, 1, &spot, NULL, 17, 17);
    WeirRenderer *renderer = weir_renderer_create(gpu, WGPUTextureFormat_BGRA8Unorm);
    const uint32_t sizes[4][2] = {{17, 17}, {301, 33}, {33, 257}, {1, 1}};
    uint8_t rgb[3];
    weir_color_map(WEIR_COLOR_SPEED, 0, rgb);
    for (int k = 0; k < 4; k++) {
        WeirImage image;
        create_image(&image, gpu, WGPUTextureFormat_BGRA8Unorm, sizes[k][0], sizes[k][1]);
        WeirView view = spots_view(4.0f);
        assert_int_equal(weir_renderer_draw(renderer, sim, &view, image.view, sizes[k][0], sizes[k][1]),
                         WEIR_OK);
        assert_true(weir_image_read(&image));
        check_color(&image, sizes[k][0] / 2, sizes[k][1] / 2, rgb, 1);
        weir_image_destroy(&image);
    }
    weir_renderer_destroy(renderer);
    weir_sim_destroy(sim);
}

// Two simulations through one renderer and one through a second renderer, in turn, while they step and one is
// replaced: each picture shows its own particles.
static void simulations_side_by_side(void **state)
{
    WeirGpu *gpu = *state;
    const Spot left = {10.5f, 20.5f}, right = {30.5f, 20.5f};
    WeirSim *sims[2] = {spots_sim(gpu, 1, &left, NULL, 41, 41),
                        spots_sim(gpu, 1, &right, &(float){0.0f}, 41, 41)};
    WeirRenderer *renderers[2] = {weir_renderer_create(gpu, WGPUTextureFormat_BGRA8Unorm),
                                  weir_renderer_create(gpu, WGPUTextureFormat_BGRA8Unorm)};
    WeirImage image;
    create_image(&image, gpu, WGPUTextureFormat_BGRA8Unorm, 41, 41);
    uint8_t rgb[3];
    weir_color_map(WEIR_COLOR_SPEED, 0, rgb);
    for (int round = 0; round < 12; round++) {
        int which = round % 2;
        if (round == 6) { // a new simulation may get the old one's addresses
            weir_sim_destroy(sims[0]);
            sims[0] = spots_sim(gpu, 1, &left, NULL, 41, 41);
        }
        CHECK_SIM(sims[which], weir_sim_step(sims[which], 1), WEIR_OK);
        WeirRenderer *renderer = renderers[round % 3 == 0];
        renderer->effects = discs_on_background;
        WeirView view = spots_view(4.0f);
        assert_int_equal(weir_renderer_draw(renderer, sims[which], &view, image.view, 41, 41), WEIR_OK);
        assert_true(weir_image_read(&image));
        check_color(&image, which ? 30 : 10, 20, rgb, 1);
        CHECK_AT_MOST(pixel(&image, which ? 10 : 30, 20)[2], 64); // the other one is not there
    }
    weir_image_destroy(&image);
    for (int k = 0; k < 2; k++) {
        weir_renderer_destroy(renderers[k]);
        weir_sim_destroy(sims[k]);
    }
    assert_int_equal(weir_gpu_poll(gpu), WEIR_OK);
}

static void check_refused(WeirRenderer *renderer, WeirSim *sim, const WeirView *view, void *target,
                          uint32_t width, const char *part)
{
    assert_int_equal(weir_renderer_draw(renderer, sim, view, target, width, 32), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_renderer_error(renderer), part);
}

static void bad_input_is_refused(void **state)
{
    WeirGpu *gpu = *state;
    const Spot spot = {16.5f, 16.5f};
    WeirSim *sim = spots_sim(gpu, 1, &spot, NULL, 32, 32);
    WeirRenderer *renderer = weir_renderer_create(gpu, WGPUTextureFormat_BGRA8Unorm);
    WeirImage image;
    create_image(&image, gpu, WGPUTextureFormat_BGRA8Unorm, 32, 32);
    const WeirView good = spots_view(4.0f);

    WeirSim *cpu = weir_test_sim(weir_sim_scene(sim), NULL, 1);
    check_refused(renderer, cpu, &good, image.view, 32, "renderer's device");
    check_refused(renderer, NULL, &good, image.view, 32, "renderer's device");
    check_refused(renderer, sim, NULL, image.view, 32, "view");
    check_refused(renderer, sim, &good, NULL, 32, "target");
    check_refused(renderer, sim, &good, image.view, 0, "0 x 32");
    WeirView view = good;
    view.color_by = (WeirColorBy)17;
    check_refused(renderer, sim, &view, image.view, 32, "color_by is 17");
    view = good;
    view.pixels_per_meter = 0.0f;
    check_refused(renderer, sim, &view, image.view, 32, "pixels_per_meter is 0");
    view = good;
    view.center[1] = NAN;
    check_refused(renderer, sim, &view, image.view, 32, "center[1]");
    view = good;
    view.particle_radius = -1.0f;
    check_refused(renderer, sim, &view, image.view, 32, "particle_radius is -1");

    WeirGpu *other = weir_test_gpu(NULL);
    WeirRenderer *stranger = weir_renderer_create(other, WGPUTextureFormat_BGRA8Unorm);
    check_refused(stranger, sim, &good, image.view, 32, "renderer's device");
    weir_renderer_destroy(stranger);
    weir_gpu_destroy(other);

    // And after all that it still draws.
    assert_int_equal(weir_renderer_draw(renderer, sim, &good, image.view, 32, 32), WEIR_OK);
    weir_renderer_destroy(NULL);
    weir_renderer_destroy(renderer);
    weir_image_destroy(&image);
    weir_sim_destroy(cpu);
    weir_sim_destroy(sim);
    assert_int_equal(weir_gpu_poll(gpu), WEIR_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(disc_center_has_map_color),  cmocka_unit_test(shader_map_is_the_library_map),
        cmocka_unit_test(each_quantity_uses_its_map), cmocka_unit_test(disc_area_and_sub_pixel_brightness),
        cmocka_unit_test(big_disc_covers_its_area),   cmocka_unit_test(outside_is_background),
        cmocka_unit_test(outline_and_ring),           cmocka_unit_test(target_may_change_size),
        cmocka_unit_test(simulations_side_by_side),   cmocka_unit_test(bad_input_is_refused),
    };
    return cmocka_run_group_tests_name("render: pictures", tests, start, end);
}
