// Pictures in 2D of walls and bodies as shapes and of the fluid as water: small ones, drawn off-screen and judged by
// their pixels.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "common/build.h"
#include "picture.h"
#include "render/flat_shape.h"
#include "render/renderer.h"
#include "styles.h"
#include "upload.h"

enum { SIZE = 160 };
static const float scale = 140.0f; // pixels per metre

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

// A tank of 1 m, four tenths full.
static WeirScene *tank(void)
{
    WeirScene *scene = weir_scene_create();
    weir_scene_set_string(scene, "method", "wcsph");
    weir_scene_set_number(scene, "dimension", 2);
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.02);
    weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){1, 1, 0});
    weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 0.4, 0}, (double[]){0, 0, 0});
    return scene;
}

static void set(WeirScene *scene, const char *path, const double *values, size_t count)
{
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, values, count), WEIR_OK);
}

static void make_light(WeirScene *scene, uint32_t body)
{
    char path[32];
    snprintf(path, sizeof path, "bodies[%u].density", body);
    weir_scene_set_number(scene, path, 500);
}

static void add_box(WeirScene *scene, const char *piece, double x0, double y0, double x1, double y1)
{
    weir_test_box_of(scene, piece, (double[]){x0, y0, 0}, (double[]){x1, y1, 0});
    if (piece[0] == 'b') make_light(scene, (uint32_t)(piece[7] - '0'));
}

static WeirSim *started(WeirScene *scene)
{
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    weir_scene_destroy(scene);
    return sim;
}

static WeirView view_of(WeirFluidStyle style)
{
    return (WeirView){.color_by = WEIR_COLOR_SPEED,
                      .color_max = 1.0f,
                      .particle_radius = 0.0116f,
                      .center = {0.5f, 0.5f},
                      .pixels_per_meter = scale,
                      .fluid_style = style};
}

static void draw(WeirGpu *gpu, WeirSim *sim, const WeirView *view, uint32_t effects, WeirImage *image)
{
    WeirGpuParticles particles;
    assert_true(weir_upload(gpu, sim, &particles));
    weir_test_picture(gpu, sim, &particles, view, effects, SIZE, image);
    weir_upload_release(&particles);
}

// With solid `solid` turned by `angle`.
static void draw_turned(WeirGpu *gpu, WeirSim *sim, uint32_t solid, float angle, WeirImage *image)
{
    WeirView view = view_of(WEIR_FLUID_PARTICLES);
    WeirGpuParticles particles;
    WeirState now;
    assert_true(weir_upload(gpu, sim, &particles));
    assert_int_equal(weir_sim_state(sim, &now), WEIR_OK);
    WeirSolidState solids[4];
    assert_true(particles.solid_count <= 4 && solid < particles.solid_count);
    memcpy(solids, now.solids, particles.solid_count * sizeof *solids);
    solids[solid].orientation[2] = sinf(0.5f * angle);
    solids[solid].orientation[3] = cosf(0.5f * angle);
    wgpuBufferRelease(particles.solids);
    assert_true(weir_upload_solids(&particles, solids, particles.solid_count));
    weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, image);
    weir_upload_release(&particles);
}

// The pixel that shows a point of the tank.
static const uint8_t *pixel_at(const WeirImage *image, float x, float y)
{
    uint32_t column = (uint32_t)(0.5f * SIZE + (x - 0.5f) * scale);
    uint32_t row = (uint32_t)(0.5f * SIZE - (y - 0.5f) * scale);
    assert_true(column < SIZE && row < SIZE);
    return image->pixels + 4 * ((size_t)row * SIZE + column);
}

static bool is_wall(const uint8_t *pixel)
{
    return pixel[0] > 55 && abs(pixel[2] - pixel[0]) < 60;
}

static bool is_dark(const uint8_t *pixel)
{
    return pixel[0] + pixel[1] + pixel[2] < 110;
}

static bool is_fluid(const uint8_t *pixel)
{
    return pixel[2] > 80 && pixel[2] > pixel[0] + 40;
}

// As particles it would be a hollow outline.
static void a_wall_is_filled_to_its_edges(void **state)
{
    WeirScene *scene = tank();
    add_box(scene, "walls[0].box", 0.3, 0.5, 0.7, 0.9);
    set(scene, "walls[1].polygon", (double[]){0.05, 0.5, 0.25, 0.5, 0.05, 0.9}, 6);
    WeirSim *sim = started(scene);
    WeirView view = view_of(WEIR_FLUID_PARTICLES);
    WeirImage image;
    draw(*state, sim, &view, WEIR_ALL_EFFECTS, &image);
    const float pixel = 1.0f / scale;
    for (int k = 0; k <= 10; k++) {
        float along = 0.3f + 3 * pixel + (0.4f - 6 * pixel) * 0.1f * (float)k;
        assert_true(is_wall(pixel_at(&image, along, 0.7f)) && is_wall(pixel_at(&image, 0.5f, along + 0.2f)));
        assert_true(is_wall(pixel_at(&image, along, 0.9f - 2 * pixel)));
        assert_true(is_dark(pixel_at(&image, along, 0.9f + 2 * pixel)));
        // Both sides of the triangle's long edge, 2 x + y = 1.
        float y = 0.55f + 0.03f * (float)k, x = 0.5f - 0.5f * y;
        assert_true(is_wall(pixel_at(&image, x - 2 * pixel, y)));
        assert_true(is_dark(pixel_at(&image, x + 2.5f * pixel, y)));
    }
    weir_image_destroy(&image);
    weir_sim_destroy(sim);
}

static void a_turned_body_has_its_edges_where_its_state_says(void **state)
{
    WeirScene *scene = tank();
    add_box(scene, "bodies[0].box", 0.35, 0.6, 0.65, 0.8); // half sizes 0.15 and 0.1 m about 0.5, 0.7
    WeirSim *sim = started(scene);
    WeirImage image;
    for (int k = 0; k < 4; k++) {
        float angle = 0.4f * (float)k, sine = sinf(angle), cosine = cosf(angle);
        draw_turned(*state, sim, 1, angle, &image);
        const float half[2] = {0.15f, 0.1f};
        for (int axis = 0; axis < 2; axis++) {
            float way[2] = {axis ? -sine : cosine, axis ? cosine : sine};
            for (int side = -1; side <= 1; side += 2) {
                float in = (float)side * (half[axis] - 2 / scale),
                      out = (float)side * (half[axis] + 2 / scale);
                const uint8_t *within = pixel_at(&image, 0.5f + in * way[0], 0.7f + in * way[1]);
                assert_true(within[0] > within[2] + 50); // warm
                assert_true(is_dark(pixel_at(&image, 0.5f + out * way[0], 0.7f + out * way[1])));
            }
        }
        weir_image_destroy(&image);
    }
    weir_sim_destroy(sim);
}

// Two quarters are darker; half a turn further they are the same ones, a quarter further the others.
static void a_ball_shows_how_it_turns(void **state)
{
    WeirScene *scene = tank();
    set(scene, "bodies[0].ball.center", (double[]){0.5, 0.7}, 2);
    weir_scene_set_number(scene, "bodies[0].ball.radius", 0.15);
    make_light(scene, 0);
    WeirSim *sim = started(scene);
    int red[3][2];
    for (int k = 0; k < 3; k++) {
        WeirImage image;
        draw_turned(*state, sim, 1, 1.5707963f * (float)k, &image);
        for (int side = 0; side < 2; side++) red[k][side] = pixel_at(&image, side ? 0.55f : 0.45f, 0.75f)[0];
        weir_image_destroy(&image);
    }
    assert_true(abs(red[0][0] - red[0][1]) > 15);
    for (int side = 0; side < 2; side++) {
        CHECK_NEAR(red[1][side], red[0][1 - side], 2);
        CHECK_NEAR(red[2][side], red[0][side], 2);
    }
    weir_sim_destroy(sim);
}

// The wall around a shape is a band; the domain's own sides are not drawn at all.
static void walls_around_the_fluid_are_bands(void **state)
{
    WeirScene *scene = tank();
    weir_scene_set_string(scene, "domain.open", "-x +x -y +y");
    set(scene, "fluid[0].box.min", (double[]){0.3, 0.3}, 2);
    set(scene, "fluid[0].box.max", (double[]){0.7, 0.4}, 2);
    add_box(scene, "walls[0].box", 0.3, 0.3, 0.7, 0.7);
    weir_scene_set_boolean(scene, "walls[0].inside", true);
    WeirSim *sim = started(scene);
    WeirView view = view_of(WEIR_FLUID_PARTICLES);
    WeirImage image;
    draw(*state, sim, &view, WEIR_ALL_EFFECTS, &image);
    const float pixel = 1.0f / scale;
    float band = 0.02f * ceilf(weir_sim_parameters(sim)->support_radius / 0.02f - 1e-3f);
    assert_true(is_dark(pixel_at(&image, 0.5f, 0.6f)) && is_fluid(pixel_at(&image, 0.5f, 0.35f)));
    for (float x = 0.4f; x < 0.6f; x += 0.02f) {
        assert_true(is_wall(pixel_at(&image, x, 0.7f + 2 * pixel)));
        assert_true(is_wall(pixel_at(&image, x, 0.7f + band - 2 * pixel)));
        assert_true(is_dark(pixel_at(&image, x, 0.7f + band + 2 * pixel)));
        assert_true(is_dark(pixel_at(&image, x, 0.7f - 2 * pixel)));
    }
    weir_image_destroy(&image);
    weir_sim_destroy(sim);
}

// A polygon of so many edges that it is drawn as its particles.
static void too_many_edges_stay_particles(void **state)
{
    enum { POINTS = WEIR_FLAT_EDGES + 10 };
    double *points = malloc(2 * POINTS * sizeof *points);
    for (int k = 0; k < POINTS; k++) {
        points[2 * k] = 0.5 + 0.15 * cos(2.0 * 3.14159265358979 * k / POINTS);
        points[2 * k + 1] = 0.7 + 0.15 * sin(2.0 * 3.14159265358979 * k / POINTS);
    }
    WeirScene *scene = tank();
    set(scene, "bodies[0].polygon", points, (size_t)2 * POINTS);
    make_light(scene, 0);
    WeirFlatShapes *flat = calloc(1, sizeof *flat);
    weir_flat_shapes_of(flat, scene);
    assert_true(flat->failed);
    free(flat);
    WeirSim *sim = started(scene);
    WeirView view = view_of(WEIR_FLUID_WATER);
    WeirImage image;
    draw(*state, sim, &view, WEIR_ALL_EFFECTS, &image);
    const uint8_t *middle = pixel_at(&image, 0.5f, 0.7f);
    assert_true(middle[0] > middle[2] + 50);
    weir_image_destroy(&image);
    free(points);
    weir_sim_destroy(sim);
}

// Up to walls, corners and a body, and nowhere else.
static void check_covered(const WeirImage *image, const WeirImage *plain)
{
    for (int row = 0; row < SIZE; row++) {
        for (int column = 0; column < SIZE; column++) {
            float x = 0.5f + ((float)column + 0.5f - 0.5f * SIZE) / scale;
            float y = 0.5f - ((float)row + 0.5f - 0.5f * SIZE) / scale;
            const uint8_t *pixel = image->pixels + 4 * ((size_t)row * SIZE + (size_t)column);
            bool inside = x > 0.0f && x < 1.0f && y > 0.0f && y < 1.0f;
            if (inside && y < 0.385f && !is_fluid(pixel))
                fail_msg("no water at %g, %g: %d %d %d", (double)x, (double)y, pixel[0], pixel[1], pixel[2]);
            bool beyond = x < -0.02f || x > 1.02f || y < -0.02f || y > 0.45f;
            if (beyond) assert_memory_equal(pixel, plain->pixels + (pixel - image->pixels), 4);
        }
    }
}

static const uint32_t fluid_only = 1u << WEIR_EFFECT_BACKGROUND | 1u << WEIR_EFFECT_FIELD |
                                   1u << WEIR_EFFECT_LIQUID | 1u << WEIR_EFFECT_PARTICLES;

static void water_fills_its_pool(void **state)
{
    WeirScene *scene = tank();
    add_box(scene, "bodies[0].box", 0.35, 0.1, 0.65, 0.3);
    add_box(scene, "bodies[1].box", 0.1, 0.6, 0.3, 0.8); // dry
    WeirSim *sim = started(scene);
    WeirView view = view_of(WEIR_FLUID_WATER);
    WeirImage all_of_it, image, plain, particles;
    draw(*state, sim, &view, fluid_only, &image);
    draw(*state, sim, &view, 1u << WEIR_EFFECT_BACKGROUND, &plain);
    draw(*state, sim, &view, WEIR_ALL_EFFECTS, &all_of_it);
    view.fluid_style = WEIR_FLUID_PARTICLES;
    draw(*state, sim, &view, WEIR_ALL_EFFECTS, &particles);
    for (float x = 0.02f; x < 0.99f; x += 0.02f) { // beside the bodies
        for (float y = 0.02f; y < 0.38f; y += 0.02f) {
            bool solid = x > 0.33f && x < 0.67f && y > 0.08f && y < 0.32f;
            if (!solid) assert_true(is_fluid(pixel_at(&image, x, y)));
        }
    }
    assert_memory_equal(pixel_at(&image, 0.2f, 0.7f), pixel_at(&plain, 0.2f, 0.7f), 4);
    for (float y = 0.11f; y < 0.29f; y += 0.01f) // over a body lies no water
        assert_memory_equal(pixel_at(&all_of_it, 0.5f, y), pixel_at(&particles, 0.5f, y), 4);
    weir_image_destroy(&all_of_it);
    weir_image_destroy(&image);
    weir_image_destroy(&plain);
    weir_image_destroy(&particles);
    weir_sim_destroy(sim);
}

static void water_ends_at_walls_and_surface(void **state)
{
    WeirSim *sims[2] = {started(tank()), NULL};
    WeirScene *scene = weir_test_scene(0.02, 0.06, 0.0, 1.0);
    weir_test_box(scene, 0.0, 0.0, 1.0, 0.4);
    sims[1] = weir_test_sim(scene, weir_gpu_backend(*state), 1);
    weir_scene_destroy(scene);
    for (int k = 0; k < 2; k++) {
        WeirView view = view_of(WEIR_FLUID_WATER);
        WeirImage image, plain;
        WeirGpuParticles particles;
        bool uploaded =
            k == 0 ? weir_upload(*state, sims[0], &particles) : weir_gpu_particles(sims[1], &particles);
        assert_true(uploaded);
        weir_test_picture(*state, sims[k], &particles, &view, fluid_only, SIZE, &image);
        weir_test_picture(*state, sims[k], &particles, &view, 1u << WEIR_EFFECT_BACKGROUND, SIZE, &plain);
        check_covered(&image, &plain);
        if (k == 0) weir_upload_release(&particles);
        weir_image_destroy(&image);
        weir_image_destroy(&plain);
        weir_sim_destroy(sims[k]);
    }
}

// Some particles of their own, at rest or at a speed, in m from the tank's middle.
static void draw_spots(WeirGpu *gpu, const WeirSim *sim, const WeirView *view, const float (*spots)[2],
                       uint32_t count, float speed, WeirImage *image)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    int32_t coordinate[8][4] = {{0}};
    float motion[8][4] = {{0}};
    assert_true(count <= 8);
    for (uint32_t n = 0; n < count; n++) {
        for (int k = 0; k < 2; k++)
            coordinate[n][k] =
                (int32_t)lroundf((0.5f + spots[n][k] - constants->origin[k]) / constants->quantum);
        motion[n][0] = speed;
    }
    WeirGpuParticles particles;
    assert_true(weir_upload_arrays(gpu, coordinate, motion, count, &particles));
    weir_test_picture(gpu, sim, &particles, view, fluid_only, SIZE, image);
    weir_upload_release(&particles);
}

static double covered(const WeirImage *image)
{
    double sum = 0.0;
    for (size_t k = 0; k < (size_t)SIZE * SIZE; k++) sum += is_fluid(image->pixels + 4 * k);
    return sum;
}

// A drop of about a particle's own size; two that are near flow together, two far apart leave nothing between them.
static void lonely_particles_are_drops(void **state)
{
    WeirSim *sim = started(tank());
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.pixels_per_meter = 4.0f * scale;
    view.particle_radius = 0.003f; // small discs, which hardly show
    WeirImage image;
    draw_spots(*state, sim, &view, (const float[][2]){{0, 0}}, 1, 0.0f, &image);
    double across = 2.0 * sqrt(covered(&image) / 3.14159265), spacing = 0.02 * 4.0 * (double)scale;
    if (!(across > 0.9 * spacing && across < 1.5 * spacing)) fail_msg("%g of %g pixels", across, spacing);
    weir_image_destroy(&image);
    const float apart[2] = {0.011f, 0.035f};
    for (int k = 0; k < 2; k++) {
        const float spots[2][2] = {{-apart[k], 0}, {apart[k], 0}};
        draw_spots(*state, sim, &view, spots, 2, 0.0f, &image);
        assert_int_equal(is_fluid(pixel_at(&image, 0.5f, 0.5f)), k == 0);
        weir_image_destroy(&image);
    }
    weir_sim_destroy(sim);
}

// The colour map holds in the middle of the water.
static void water_has_the_colours_of_the_map(void **state)
{
    WeirSim *sim = started(tank());
    WeirView view = view_of(WEIR_FLUID_WATER);
    for (int by = 0; by < 3; by++) {
        view.color_by = (WeirColorBy)by;
        const float ranges[3][2] = {{0, 1}, {900, 1300}, {-0.1f, 0.1f}};
        view.color_min = ranges[by][0];
        view.color_max = ranges[by][1];
        const float values[3] = {0.0f, 1000.0f, 0.0f};
        WeirImage image;
        draw(*state, sim, &view, fluid_only, &image);
        uint8_t wanted[3];
        weir_color_map(view.color_by, (values[by] - view.color_min) / (view.color_max - view.color_min),
                       wanted);
        const uint8_t *found = pixel_at(&image, 0.5f, 0.2f);
        for (int k = 0; k < 3; k++) CHECK_NEAR(found[k], wanted[k], 24);
        weir_image_destroy(&image);
    }
    weir_sim_destroy(sim);
}

// Fluid at one end of a periodic axis goes on at the other: no surface there, and no gap.
static void water_goes_on_across_a_periodic_side(void **state)
{
    WeirScene *scene = tank();
    weir_scene_set_string(scene, "domain.periodic", "x");
    WeirSim *sim = started(scene);
    WeirView view = view_of(WEIR_FLUID_WATER);
    WeirImage image;
    draw(*state, sim, &view, fluid_only, &image);
    for (float y = 0.05f; y < 0.3f; y += 0.05f) {
        const uint8_t *middle = pixel_at(&image, 0.5f, y);
        assert_true(weir_test_difference(pixel_at(&image, 1.5f / scale, y), middle) < 12);
        assert_true(weir_test_difference(pixel_at(&image, 1.0f - 1.5f / scale, y), middle) < 12);
    }
    weir_image_destroy(&image);
    weir_sim_destroy(sim);
}

static void styles_and_sizes_change(void **state)
{
    WeirSim *sim = started(tank());
    weir_test_styles_and_sizes(*state, sim, view_of);
    weir_sim_destroy(sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_is_filled_to_its_edges),
        cmocka_unit_test(a_turned_body_has_its_edges_where_its_state_says),
        cmocka_unit_test(a_ball_shows_how_it_turns),
        cmocka_unit_test(walls_around_the_fluid_are_bands),
        cmocka_unit_test(too_many_edges_stay_particles),
        cmocka_unit_test(water_fills_its_pool),
        cmocka_unit_test(water_ends_at_walls_and_surface),
        cmocka_unit_test(lonely_particles_are_drops),
        cmocka_unit_test(water_has_the_colours_of_the_map),
        cmocka_unit_test(water_goes_on_across_a_periodic_side),
        cmocka_unit_test(styles_and_sizes_change),
    };
    return cmocka_run_group_tests_name("render: shapes and water in 2D", tests, start, end);
}
