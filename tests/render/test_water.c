// Pictures in 3D with the fluid as water: small ones, drawn off-screen and judged by their pixels.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "common/build.h"
#include "pool.h"
#include "styles.h"
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

static void draw(WeirGpu *gpu, WeirSim *sim, const WeirView *view, WeirImage *image)
{
    WeirGpuParticles particles;
    assert_true(weir_upload(gpu, sim, &particles));
    weir_test_picture(gpu, sim, &particles, view, WEIR_ALL_EFFECTS, SIZE, image);
    weir_upload_release(&particles);
}

// One particle alone; group EMPTY: none at all.
static void draw_one(WeirGpu *gpu, WeirSim *sim, uint32_t group, const WeirView *view, uint32_t effects,
                     WeirImage *image)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    int32_t coordinate[1][4] = {{0, 0, 0, (int32_t)group}};
    float motion[1][4] = {{0}};
    for (int k = 0; k < 3; k++)
        coordinate[0][k] =
            (int32_t)lroundf((view->camera_target[k] - constants->origin[k]) / constants->quantum);
    WeirGpuParticles particles;
    assert_true(weir_upload_arrays(gpu, coordinate, motion, 1, &particles));
    weir_test_picture(gpu, sim, &particles, view, effects, SIZE, image);
    weir_upload_release(&particles);
}

// Mean difference, of three channels, of pixels beside each other in the middle of the pool's surface.
static double unevenness(const WeirImage *image, const WeirView *view)
{
    const uint8_t *middle = pixel_at(image, view, 0.5f, 0.4f, 0.5f);
    double sum = 0.0;
    int count = 0;
    for (int y = -10; y < 10; y++) {
        for (int x = -20; x < 20; x++) {
            const uint8_t *pixel = middle + 4 * (y * SIZE + x);
            sum += weir_test_difference(pixel, pixel + 4) +
                   weir_test_difference(pixel, pixel + (ptrdiff_t)4 * SIZE);
            count += 2;
        }
    }
    return sum / count;
}

// How many particles were drawn of those of `view`, all of them or those that are not buried.
static uint32_t draw_shown(WeirRenderer *renderer, WeirSim *sim, const WeirGpuParticles *particles,
                           const WeirView *view, bool all_shown, WeirImage *image)
{
    WeirGpu *gpu = renderer->gpu;
    renderer->all_shown = all_shown;
    assert_true(weir_image_create(image, gpu, WGPUTextureFormat_RGBA8Unorm, SIZE, SIZE));
    assert_int_equal(weir_renderer_draw_particles(renderer, sim, particles, view, image->view, SIZE, SIZE),
                     WEIR_OK);
    assert_true(weir_image_read(image));
    uint32_t drawn[4];
    assert_true(weir_buffer_read(gpu, renderer->crowd.draw, drawn, sizeof drawn));
    return drawn[1];
}

// Many of the pool's particles are hidden by others on all sides: pictures without them are the same ones.
static void who_is_buried_is_left_out_unseen(void **state)
{
    WeirSim *sim = pool(true);
    assert_int_equal(weir_sim_step(sim, 60), WEIR_OK); // no lattice any more
    WeirGpuParticles particles;
    assert_true(weir_upload(*state, sim, &particles));
    WeirRenderer *renderer = weir_renderer_create(*state, WGPUTextureFormat_RGBA8Unorm);
    const struct {
        WeirFluidStyle style;
        float radius;       // of the spheres, spacings
        double least, most; // shares that are drawn
    } cases[] = {{WEIR_FLUID_WATER, 0.58f, 0.2, 0.6},
                 {WEIR_FLUID_PARTICLES, 0.58f, 0.3, 0.95},
                 {WEIR_FLUID_PARTICLES, 0.3f, 1.0, 1.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        WeirView view = view_of(cases[k].style);
        view.particle_radius = cases[k].radius * 0.04f;
        view.camera_yaw = 0.5f; // two sides of the domain are seen
        WeirImage some, every;
        double drawn = draw_shown(renderer, sim, &particles, &view, false, &some);
        drawn /= draw_shown(renderer, sim, &particles, &view, true, &every);
        if (drawn < cases[k].least || drawn > cases[k].most) fail_msg("case %zu: %.3f are drawn", k, drawn);
        for (size_t p = 0; p < (size_t)SIZE * SIZE; p++) {
            int off = weir_test_difference(some.pixels + 4 * p, every.pixels + 4 * p);
            if (off > 12) fail_msg("case %zu, pixel %zu: off by %d", k, p, off);
        }
        weir_image_destroy(&some);
        weir_image_destroy(&every);
    }
    weir_upload_release(&particles);
    weir_renderer_destroy(renderer);
    weir_sim_destroy(sim);
}

static void water_is_blue_and_even(void **state)
{
    WeirSim *sim = pool(false);
    WeirView water = view_of(WEIR_FLUID_WATER), spheres = view_of(WEIR_FLUID_PARTICLES);
    WeirImage smooth, bumpy;
    draw(*state, sim, &water, &smooth);
    draw(*state, sim, &spheres, &bumpy);
    const uint8_t *seen = pixel_at(&smooth, &water, 0.5f, 0.4f, 0.5f);
    assert_true(seen[2] > seen[0] + 30 && seen[1] > seen[0]); // blue-green
    assert_true(weir_test_difference(seen, pixel_at(&bumpy, &spheres, 0.5f, 0.4f, 0.5f)) > 20);
    double even = unevenness(&smooth, &water), uneven = unevenness(&bumpy, &spheres);
    if (!(even < 6.0 && even < 0.12 * uneven)) fail_msg("water varies by %g, spheres by %g", even, uneven);
    weir_image_destroy(&smooth);
    weir_image_destroy(&bumpy);
    weir_sim_destroy(sim);
}

// Seen at an angle so flat that neighbouring pixels lie two or three spacings apart, the surface is one still.
static void water_seen_flat_has_no_specks(void **state)
{
    WeirSim *sim = pool(false);
    WeirImage image;
    double worst = 0.0;
    for (int k = 0; k < 4; k++) {
        WeirView view = view_of(WEIR_FLUID_WATER);
        view.camera_pitch = 0.05f + 0.01f * (float)k;
        draw(*state, sim, &view, &image);
        for (int n = 0; n < 250; n++) {
            float x = 0.25f + 0.01f * (float)(n % 50), z = 0.3f + 0.1f * (float)(n / 50);
            const uint8_t *pixel = pixel_at(&image, &view, x, 0.4f, z);
            worst = fmax(
                worst, fmin(weir_test_difference(pixel, pixel - 4), weir_test_difference(pixel, pixel + 4)));
        }
        weir_image_destroy(&image);
    }
    if (!(worst < 24.0)) fail_msg("a pixel differs by %g from both beside it", worst);
    weir_sim_destroy(sim);
}

// Its upper half as it is; its lower half through the water, darker and bluer, but there.
static void a_body_is_seen_in_and_above_the_water(void **state)
{
    WeirSim *with = pool(true), *without = pool(false);
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_pitch = 0.2f;
    WeirImage body, plain;
    draw(*state, with, &view, &body);
    draw(*state, without, &view, &plain);
    const uint8_t *above = pixel_at(&body, &view, 0.5f, 0.52f, 0.64f);
    assert_true(above[0] > above[2] + 25); // warm
    const uint8_t *below = pixel_at(&body, &view, 0.5f, 0.30f, 0.64f);
    assert_true(weir_test_difference(below, pixel_at(&plain, &view, 0.5f, 0.30f, 0.64f)) > 25);
    assert_true(below[2] - below[0] > above[2] - above[0] + 25);
    weir_image_destroy(&body);
    weir_image_destroy(&plain);
    weir_sim_destroy(with);
    weir_sim_destroy(without);
}

// The body's upper half hides the pool behind it: the same colour with water and without.
static void what_stands_before_the_water_hides_it(void **state)
{
    WeirSim *sim = pool(true);
    WeirView water = view_of(WEIR_FLUID_WATER), spheres = view_of(WEIR_FLUID_PARTICLES);
    WeirImage one, other;
    draw(*state, sim, &water, &one);
    draw(*state, sim, &spheres, &other);
    for (int k = 0; k < 5; k++) {
        float x = 0.42f + 0.04f * (float)k;
        assert_true(weir_test_difference(pixel_at(&one, &water, x, 0.58f, 0.5f),
                                         pixel_at(&other, &spheres, x, 0.58f, 0.5f)) < 24);
    }
    weir_image_destroy(&one);
    weir_image_destroy(&other);
    weir_sim_destroy(sim);
}

// The pool's body moved to `position` and turned about y by the angle whose half has this sine.
static void draw_moved(WeirGpu *gpu, WeirSim *sim, const WeirView *view, const float position[3],
                       float half_sine, WeirImage *image)
{
    WeirGpuParticles particles;
    WeirState now;
    assert_true(weir_upload(gpu, sim, &particles));
    assert_int_equal(weir_sim_state(sim, &now), WEIR_OK);
    WeirSolidState solids[2] = {now.solids[0], now.solids[1]};
    memcpy(solids[1].position, position, 3 * sizeof *position);
    solids[1].orientation[1] = half_sine;
    solids[1].orientation[3] = sqrtf(1.0f - half_sine * half_sine);
    wgpuBufferRelease(particles.solids);
    assert_true(weir_upload_solids(&particles, solids, 2));
    weir_test_picture(gpu, sim, &particles, view, WEIR_ALL_EFFECTS, SIZE, image);
    weir_upload_release(&particles);
}

// A box of 0.28 x 0.32 x 0.28 m: its faces are plain, its edges where its state says, in both styles. As balls its
// face had bumps, and was where its particles are.
static void a_body_is_its_shape_at_its_pose(void **state)
{
    const float middle[3] = {0.5f, 0.75f, 0.5f}, half = 0.14f, eighth_turn = 0.38268343f;
    WeirSim *sim = pool(true);
    for (int style = 0; style < 2; style++) {
        WeirView view = view_of(style ? WEIR_FLUID_WATER : WEIR_FLUID_PARTICLES);
        view.camera_pitch = 0.0f;
        WeirImage straight, turned, away;
        draw_moved(*state, sim, &view, middle, 0.0f, &straight);
        draw_moved(*state, sim, &view, middle, eighth_turn, &turned);
        draw_moved(*state, sim, &view, (const float[3]){0.5f, 0.2f, 0.5f}, 0.0f, &away);
        const uint8_t *face = pixel_at(&straight, &view, 0.5f, 0.75f, 0.64f);
        assert_true(face[0] > face[2] + 40); // warm
        for (int k = 0; k < 25; k++) {
            float x = 0.5f + 0.8f * half * (float)(k % 5 - 2) / 2.0f, y = 0.75f + 0.05f * (float)(k / 5 - 2);
            assert_true(weir_test_difference(face, pixel_at(&straight, &view, x, y, 0.64f)) < 15);
        }
        // Two pixels within and beyond the edge.
        const float pixel = 2.2f * 2.0f * 0.3093f / SIZE, y = 0.75f;
        assert_true(
            weir_test_difference(face, pixel_at(&straight, &view, 0.5f + half - 2 * pixel, y, 0.64f)) < 15);
        assert_true(
            weir_test_difference(face, pixel_at(&straight, &view, 0.5f + half + 2 * pixel, y, 0.64f)) > 90);
        // Turned, its edge looks at the eye, and it is as wide as its diagonal.
        const float wide = half * 1.41421356f;
        assert_true(weir_test_difference(pixel_at(&turned, &view, 0.5f - wide + 3 * pixel, y, 0.5f),
                                         pixel_at(&away, &view, 0.5f - wide + 3 * pixel, y, 0.5f)) > 60);
        assert_true(weir_test_difference(pixel_at(&turned, &view, 0.5f - wide - 2 * pixel, y, 0.5f),
                                         pixel_at(&away, &view, 0.5f - wide - 2 * pixel, y, 0.5f)) < 15);
        const uint8_t *left = pixel_at(&turned, &view, 0.5f - half / 2, y, 0.5f),
                      *right = pixel_at(&turned, &view, 0.5f + half / 2, y, 0.5f);
        assert_true(weir_test_difference(left, right) > 15); // each face has its light
        weir_image_destroy(&straight);
        weir_image_destroy(&turned);
        weir_image_destroy(&away);
    }
    weir_sim_destroy(sim);
}

static void no_fluid_no_water(void **state)
{
    WeirSim *sim = pool(false);
    WeirView view = view_of(WEIR_FLUID_WATER);
    const uint32_t water = 1u << WEIR_EFFECT_HEIGHT | 1u << WEIR_EFFECT_SURFACE |
                           1u << WEIR_EFFECT_THICKNESS | 1u << WEIR_EFFECT_SMOOTH;
    WeirImage empty, scene;
    draw_one(*state, sim, WEIR_GROUP_EMPTY, &view, WEIR_ALL_EFFECTS, &empty);
    draw_one(*state, sim, WEIR_GROUP_EMPTY, &view, WEIR_ALL_EFFECTS & ~water, &scene);
    assert_memory_equal(empty.pixels, scene.pixels, (size_t)4 * SIZE * SIZE);
    weir_image_destroy(&empty);
    weir_image_destroy(&scene);
    weir_sim_destroy(sim);
}

// A particle that flies alone is a bright drop, smaller than its sphere.
static void a_lonely_particle_is_a_drop(void **state)
{
    WeirSim *sim = pool(false);
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_distance = 0.6f;
    WeirImage drop, plain;
    draw_one(*state, sim, WEIR_GROUP_FLUID, &view, WEIR_ALL_EFFECTS, &drop);
    draw_one(*state, sim, WEIR_GROUP_EMPTY, &view, WEIR_ALL_EFFECTS, &plain);
    uint32_t covered = 0;
    for (uint32_t k = 0; k < SIZE * SIZE; k++)
        covered += weir_test_difference(drop.pixels + 4 * k, plain.pixels + 4 * k) > 60;
    double across = 2.0 * sqrt(covered / 3.14159265); // pixels
    double sphere = 0.04 / (0.6 * 2.0 * tan(0.3)) * SIZE;
    assert_true(across > 0.3 * sphere && across < sphere);
    const uint8_t *middle = drop.pixels + (size_t)4 * (SIZE / 2 * SIZE + SIZE / 2);
    assert_true(middle[0] > 100 && middle[2] > 120);
    weir_image_destroy(&drop);
    weir_image_destroy(&plain);
    weir_sim_destroy(sim);
}

// Columns and rows that a drop covers which flies to the right at `share` of the speed of sound.
static void size_of_drop(WeirGpu *gpu, WeirSim *sim, float share, uint32_t size[2])
{
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_distance = 0.6f;
    view.camera_pitch = 0.0f;
    const WeirConstants *constants = weir_sim_constants(sim);
    WeirImage images[2];
    for (uint32_t shown = 0; shown < 2; shown++) {
        int32_t coordinate[1][4] = {{0, 0, 0, shown ? WEIR_GROUP_FLUID : WEIR_GROUP_EMPTY}};
        float motion[1][4] = {{share * constants->sound_speed, 0, 0, 0}};
        for (int k = 0; k < 3; k++)
            coordinate[0][k] =
                (int32_t)lroundf((view.camera_target[k] - constants->origin[k]) / constants->quantum);
        WeirGpuParticles particles;
        assert_true(weir_upload_arrays(gpu, coordinate, motion, 1, &particles));
        weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, &images[shown]);
        weir_upload_release(&particles);
    }
    bool columns[SIZE] = {false}, rows[SIZE] = {false};
    for (uint32_t k = 0; k < SIZE * SIZE; k++) {
        bool covered = weir_test_difference(images[0].pixels + 4 * k, images[1].pixels + 4 * k) > 60;
        columns[k % SIZE] |= covered;
        rows[k / SIZE] |= covered;
    }
    size[0] = size[1] = 0;
    for (uint32_t k = 0; k < SIZE; k++) {
        size[0] += columns[k];
        size[1] += rows[k];
    }
    weir_image_destroy(&images[0]);
    weir_image_destroy(&images[1]);
}

static void a_fast_drop_is_a_streak(void **state)
{
    WeirSim *sim = pool(false);
    uint32_t slow[2], fast[2];
    size_of_drop(*state, sim, 0.0f, slow);
    size_of_drop(*state, sim, 0.1f, fast);
    assert_true(slow[0] > 8 && abs((int)slow[0] - (int)slow[1]) <= 1);
    if (!(fast[0] > 2 * fast[1] && fast[0] > slow[0] + 3 && fast[1] < slow[1]))
        fail_msg("%u x %u pixels, at rest %u x %u", fast[0], fast[1], slow[0], slow[1]);
    weir_sim_destroy(sim);
}

// Mean red of a standing sheet, one particle thick, that moves at `share` of the speed of sound: as one, or every other
// particle the other way.
static double redness_of_sheet(WeirGpu *gpu, WeirSim *sim, float share, bool against)
{
    enum { SIDE = 16 };
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_pitch = 0.35f; // before the dark floor
    const WeirConstants *constants = weir_sim_constants(sim);
    int32_t coordinate[SIDE * SIDE][4];
    float motion[SIDE * SIDE][4] = {{0}};
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float place[3] = {0.18f + 0.04f * (float)(i % SIDE), 0.1f + 0.04f * (float)(i / SIDE), 0.5f};
        for (int k = 0; k < 3; k++)
            coordinate[i][k] = (int32_t)lroundf((place[k] - constants->origin[k]) / constants->quantum);
        coordinate[i][3] = WEIR_GROUP_FLUID;
        motion[i][1] = against && (i + i / SIDE) % 2 ? -share : share;
        motion[i][1] *= constants->sound_speed;
    }
    WeirImage image;
    WeirGpuParticles particles;
    assert_true(weir_upload_arrays(gpu, coordinate, motion, SIDE * SIDE, &particles));
    weir_test_picture(gpu, sim, &particles, &view, WEIR_ALL_EFFECTS, SIZE, &image);
    weir_upload_release(&particles);
    const uint8_t *middle = pixel_at(&image, &view, 0.5f, 0.4f, 0.5f);
    double sum = 0.0;
    for (int y = -20; y < 20; y++) {
        for (int x = -20; x < 20; x++) sum += middle[4 * (y * SIZE + x)];
    }
    weir_image_destroy(&image);
    return sum / 1600.0;
}

// Foam is where torn water moves against itself; speed alone makes none.
static void a_sheet_that_moves_as_one_is_clear(void **state)
{
    WeirSim *sim = pool(false);
    double still = redness_of_sheet(*state, sim, 0.0f, false),
           one = redness_of_sheet(*state, sim, 0.06f, false),
           torn = redness_of_sheet(*state, sim, 0.06f, true);
    if (!(fabs(one - still) < 12.0 && torn > one + 25.0))
        fail_msg("red at rest %g, moving %g, against itself %g", still, one, torn);
    weir_sim_destroy(sim);
}

// Of the ratio of two pictures' green light on the floor, but for `margin` at its edges.
typedef struct Ratio {
    double least, most, mean;
} Ratio;

static Ratio ratio_on_floor(const WeirImage *one, const WeirImage *other, const WeirView *view, float margin)
{
    enum { STEPS = 40 };
    Ratio ratio = {1e9, 0.0, 0.0};
    for (int k = 0; k < STEPS * STEPS; k++) {
        float x = margin + (1.0f - 2.0f * margin) * ((float)(k % STEPS) + 0.5f) / STEPS,
              z = margin + (1.0f - 2.0f * margin) * ((float)(k / STEPS) + 0.5f) / STEPS;
        double part = light_of(pixel_at(one, view, x, 0, z)[1]) / light_of(pixel_at(other, view, x, 0, z)[1]);
        ratio.least = fmin(ratio.least, part);
        ratio.most = fmax(ratio.most, part);
        ratio.mean += part / (STEPS * STEPS);
    }
    return ratio;
}

// The floor alone, from above: still water dims it evenly, up to the walls; waves gather the same light here and miss it
// there.
static void waves_gather_light_on_the_floor(void **state)
{
    WeirSim *sim = pool(false);
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_pitch = 1.5f;
    view.camera_target[1] = 0.0f;
    const uint32_t seen = WEIR_ALL_EFFECTS & ~(1u << WEIR_EFFECT_SURFACE | 1u << WEIR_EFFECT_SPHERES |
                                               1u << WEIR_EFFECT_OCCLUSION | 1u << WEIR_EFFECT_THICKNESS);
    WeirImage dry, still, waves, again;
    draw_waves(*state, sim, 0.0f, true, &view, seen, &dry);
    draw_waves(*state, sim, 0.0f, false, &view, seen, &still);
    draw_waves(*state, sim, 0.06f, false, &view, seen, &waves);
    draw_waves(*state, sim, 0.06f, false, &view, seen, &again);
    Ratio even = ratio_on_floor(&still, &dry, &view, 0.04f);
    if (!(even.most < 0.97 && even.least > 0.85 * even.most))
        fail_msg("still water leaves %g to %g of the light", even.least, even.most);
    Ratio gathered = ratio_on_floor(&waves, &still, &view, 0.02f);
    if (!(gathered.least < 0.9 && gathered.most > 1.25 && fabs(gathered.mean - 1.0) < 0.03))
        fail_msg("waves leave %g to %g of it, %g in the mean", gathered.least, gathered.most, gathered.mean);
    assert_memory_equal(waves.pixels, again.pixels, (size_t)4 * SIZE * SIZE);
    weir_image_destroy(&dry);
    weir_image_destroy(&still);
    weir_image_destroy(&waves);
    weir_image_destroy(&again);
    weir_sim_destroy(sim);
}

// Mean red of a still pool's surface in its middle, seen from a direction.
static double redness_of_pool(WeirGpu *gpu, WeirSim *sim, float yaw, float pitch)
{
    WeirView view = view_of(WEIR_FLUID_WATER);
    view.camera_yaw = yaw;
    view.camera_pitch = pitch;
    WeirImage image;
    draw_waves(gpu, sim, 0.0f, false, &view, WEIR_ALL_EFFECTS, &image);
    double sum = 0.0;
    for (int k = 0; k < 25; k++)
        sum += pixel_at(&image, &view, 0.4f + 0.05f * (float)(k % 5), 0.4f, 0.4f + 0.05f * (float)(k / 5))[0];
    weir_image_destroy(&image);
    return sum / 25.0;
}

// The horizon is golden at one side (space.wgsl: glow_side). Seen flat towards it the water mirrors that; not seen the
// other way, nor from above.
static void still_water_mirrors_the_horizon(void **state)
{
    const float toward_glow = 0.5236f, away = toward_glow + 3.14159265f;
    WeirSim *sim = pool(false);
    double golden = redness_of_pool(*state, sim, toward_glow, 0.1f),
           blue = redness_of_pool(*state, sim, away, 0.1f),
           above = redness_of_pool(*state, sim, toward_glow, 1.3f),
           above_away = redness_of_pool(*state, sim, away, 1.3f);
    if (!(golden > blue + 25.0 && golden > above + 25.0 && fabs(above - above_away) < 10.0))
        fail_msg("red towards the glow %g, away %g; from above %g, %g", golden, blue, above, above_away);
    weir_sim_destroy(sim);
}

static void styles_and_sizes_change(void **state)
{
    WeirSim *sim = pool(false);
    weir_test_styles_and_sizes(*state, sim, view_of);
    weir_sim_destroy(sim);
}

static void unknown_styles_are_refused(void **state)
{
    WeirView view = view_of((WeirFluidStyle)2);
    WeirMessage message = {0};
    int target = 0;
    assert_int_equal(weir_frame_check(&view, 3, &target, 8, 8, &message), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(message.text, "fluid_style is 2");
    WeirRenderer *renderer = weir_renderer_create(*state, WGPUTextureFormat_RGBA8Unorm);
    WeirScene *scene = weir_scene_create();
    assert_int_equal(weir_renderer_prepare(renderer, scene, (WeirFluidStyle)2), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_renderer_error(renderer), "fluid_style is 2");
    weir_scene_destroy(scene);
    weir_renderer_destroy(renderer);
}

// All pipelines that the first picture needs, and it makes no others.
static void pipelines_come_before_the_picture(void **state)
{
    WeirSim *sim = pool(false);
    WeirRenderer *renderer = weir_renderer_create(*state, WGPUTextureFormat_RGBA8Unorm);
    assert_int_equal(weir_renderer_prepare(renderer, weir_sim_scene(sim), WEIR_FLUID_WATER), WEIR_OK);
    WGPURenderPipeline made[WEIR_EFFECTS];
    memcpy(made, renderer->pipelines[WEIR_METHOD_WCSPH], sizeof made);
    for (int kind = WEIR_EFFECT_SHADOW; kind < WEIR_EFFECTS; kind++) assert_non_null(made[kind]);
    WeirGpuParticles particles;
    WeirImage image;
    WeirView view = view_of(WEIR_FLUID_WATER);
    assert_true(weir_upload(*state, sim, &particles));
    assert_true(weir_image_create(&image, *state, WGPUTextureFormat_RGBA8Unorm, SIZE, SIZE));
    assert_int_equal(weir_renderer_draw_particles(renderer, sim, &particles, &view, image.view, SIZE, SIZE),
                     WEIR_OK);
    assert_memory_equal(made, renderer->pipelines[WEIR_METHOD_WCSPH], sizeof made);
    weir_image_destroy(&image);
    weir_upload_release(&particles);
    weir_renderer_destroy(renderer);
    weir_sim_destroy(sim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_is_blue_and_even),
        cmocka_unit_test(who_is_buried_is_left_out_unseen),
        cmocka_unit_test(water_seen_flat_has_no_specks),
        cmocka_unit_test(a_body_is_seen_in_and_above_the_water),
        cmocka_unit_test(what_stands_before_the_water_hides_it),
        cmocka_unit_test(a_body_is_its_shape_at_its_pose),
        cmocka_unit_test(no_fluid_no_water),
        cmocka_unit_test(a_lonely_particle_is_a_drop),
        cmocka_unit_test(a_fast_drop_is_a_streak),
        cmocka_unit_test(a_sheet_that_moves_as_one_is_clear),
        cmocka_unit_test(waves_gather_light_on_the_floor),
        cmocka_unit_test(still_water_mirrors_the_horizon),
        cmocka_unit_test(styles_and_sizes_change),
        cmocka_unit_test(unknown_styles_are_refused),
        cmocka_unit_test(pipelines_come_before_the_picture),
    };
    return cmocka_run_group_tests_name("render: water in 3D", tests, start, end);
}
