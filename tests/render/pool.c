#include "pool.h"

#include <math.h>
#include <stdlib.h>

#include "adapter.h"
#include "common/build.h"
#include "upload.h"

WeirScene *pool_scene(void)
{
    WeirScene *scene = weir_scene_create();
    weir_scene_set_string(scene, "method", "wcsph");
    weir_scene_set_number(scene, "dimension", 3);
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.04);
    weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1});
    weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 0.4, 1}, (double[]){0, 0, 0});
    return scene;
}

WeirSim *pool_of(WeirScene *scene, bool with_body)
{
    if (with_body) weir_scene_set_number(scene, "bodies[0].density", 500);
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    weir_scene_destroy(scene);
    return sim;
}

WeirSim *pool(bool with_body)
{
    WeirScene *scene = pool_scene();
    if (with_body) {
        weir_scene_set_numbers(scene, "bodies[0].box.min", (double[]){0.36, 0.24, 0.36}, 3);
        weir_scene_set_numbers(scene, "bodies[0].box.max", (double[]){0.64, 0.56, 0.64}, 3);
    }
    return pool_of(scene, with_body);
}

WeirView view_of(WeirFluidStyle style)
{
    return (WeirView){.color_by = WEIR_COLOR_SPEED,
                      .color_max = 1.0f,
                      .particle_radius = 0.024f,
                      .camera_target = {0.5f, 0.4f, 0.5f},
                      .camera_distance = 2.2f,
                      .camera_pitch = 0.6f,
                      .camera_field_of_view = 0.6f,
                      .fluid_style = style};
}

const uint8_t *pixel_at(const WeirImage *image, const WeirView *view, float x, float y, float z)
{
    float matrix[16], clip[4], point[4] = {x, y, z, 1.0f};
    weir_view_matrix(view, SIZE, SIZE, matrix);
    for (int row = 0; row < 4; row++) {
        clip[row] = 0.0f;
        for (int column = 0; column < 4; column++) clip[row] += matrix[4 * column + row] * point[column];
    }
    uint32_t column = (uint32_t)((clip[0] / clip[3] + 1.0f) * SIZE / 2);
    uint32_t row = (uint32_t)((1.0f - clip[1] / clip[3]) * SIZE / 2);
    assert_true(column < SIZE && row < SIZE);
    return image->pixels + 4 * ((size_t)row * SIZE + column);
}

void upload_waves(WeirGpu *gpu, WeirSim *sim, float waves, bool none, WeirGpuParticles *particles)
{
    enum { SIDE = 25, LAYERS = 10, COUNT = SIDE * SIDE * LAYERS };
    const WeirConstants *constants = weir_sim_constants(sim);
    int32_t(*coordinate)[4] = calloc(COUNT, sizeof *coordinate);
    float(*motion)[4] = calloc(COUNT, sizeof *motion);
    assert_true(coordinate && motion);
    for (int i = 0; i < COUNT; i++) {
        float place[3] = {0.04f * ((float)(i % SIDE) + 0.5f), 0.04f * ((float)(i / SIDE % LAYERS) + 0.5f),
                          0.04f * ((float)(i / (SIDE * LAYERS)) + 0.5f)};
        place[1] *= 1.0f + waves * cosf(4.0f * 3.14159265f * place[0]);
        for (int k = 0; k < 3; k++)
            coordinate[i][k] = (int32_t)lroundf((place[k] - constants->origin[k]) / constants->quantum);
        coordinate[i][3] = (int32_t)(none ? WEIR_GROUP_EMPTY : WEIR_GROUP_FLUID);
    }
    assert_true(weir_upload_arrays(gpu, coordinate, motion, COUNT, particles));
    free(coordinate);
    free(motion);
}

void draw_waves(WeirGpu *gpu, WeirSim *sim, float waves, bool none, const WeirView *view, uint32_t effects,
                WeirImage *image)
{
    WeirGpuParticles particles;
    upload_waves(gpu, sim, waves, none, &particles);
    weir_test_picture(gpu, sim, &particles, view, effects, SIZE, image);
    weir_upload_release(&particles);
}

double light_of(uint8_t value)
{
    double s = value / 255.0, shown = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
    return shown < 0.5 ? shown : 0.5 - 0.5 * log(1.0 - (shown - 0.5) / 0.5);
}
