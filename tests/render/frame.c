// weir_frame SCENE.json|built-in OUT.ppm WIDTH HEIGHT STEPS [COLOR_BY MIN MAX [ZOOM X Y [TOOL_PRESSED]]]
// Draws one frame of a scene as the page would and writes it as a PPM file, to be looked at. The steps are
// taken on the CPU, which is quicker than a software adapter; the picture comes from the device.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "core/sim.h"
#include "image.h"
#include "weir/weir_render.h"
#include "json/json_scene.h"

static int complain(const char *what, const char *message)
{
    fprintf(stderr, "%s: %s\n", what, message);
    return 1;
}

// A dam break of 32,768 particles.
static WeirScene *built_in_scene(void)
{
    WeirScene *scene = weir_scene_create();
    if (!scene) return NULL;
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.007);
    weir_scene_set_number(scene, "parameters.support_radius", 0.045);
    weir_scene_set_number(scene, "parameters.time_step", 0.0008);
    weir_scene_add_box(scene, (double[]){-1, -1, 0}, (double[]){-1 + 128 * 0.007, -1 + 256 * 0.007, 0},
                       (double[]){0, 0, 0});
    return scene;
}

// Steps the scene on the CPU and hands the state to a simulation on the device.
static WeirSim *make_state(const WeirScene *scene, WeirGpu *gpu, uint32_t steps)
{
    WeirSim *cpu = weir_sim_create(scene, NULL);
    WeirSim *sim = weir_sim_create(scene, &(WeirSimOptions){.backend = weir_gpu_backend(gpu)});
    WeirState state;
    WeirStatus status = weir_sim_status(cpu);
    if (status == WEIR_OK) status = weir_sim_step(cpu, steps);
    if (status == WEIR_OK) status = weir_sim_state(cpu, &state);
    if (status != WEIR_OK) complain("simulation on the CPU", weir_sim_error(cpu));
    if (status == WEIR_OK) {
        status = weir_sim_set_state(sim, state.position, state.velocity);
        if (status == WEIR_OK) status = weir_sim_wait(sim);
        if (status != WEIR_OK) complain("simulation on the device", weir_sim_error(sim));
    }
    weir_sim_destroy(cpu);
    if (status == WEIR_OK) return sim;
    weir_sim_destroy(sim);
    return NULL;
}

static bool write_ppm(const char *path, const WeirImage *image)
{
    FILE *file = fopen(path, "wb");
    if (!file) return false;
    fprintf(file, "P6\n%u %u\n255\n", image->width, image->height);
    for (size_t k = 0; k < (size_t)image->width * image->height; k++)
        fwrite(image->pixels + 4 * k, 1, 3, file);
    return fclose(file) == 0;
}

static WeirView make_view(WeirSim *sim, uint32_t width, uint32_t height, int count, char **values)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    float zoom = count > 3 ? strtof(values[3], NULL) : 1.0f;
    float domain_width = constants->domain_max[0] - constants->domain_min[0];
    float domain_height = constants->domain_max[1] - constants->domain_min[1];
    WeirView view = {
        .color_by = count > 0 ? (WeirColorBy)atoi(values[0]) : WEIR_COLOR_SPEED,
        .color_min = count > 1 ? strtof(values[1], NULL) : 0.0f,
        .color_max = count > 2 ? strtof(values[2], NULL) : 5.0f,
        .pixels_per_meter = 0.94f * zoom * fminf((float)width / domain_width, (float)height / domain_height),
        .particle_radius = 0.58f * weir_sim_parameters(sim)->particle_spacing,
    };
    for (int k = 0; k < 2; k++) {
        view.center[k] = count > 5 ? strtof(values[4 + k], NULL)
                                   : 0.5f * (constants->domain_min[k] + constants->domain_max[k]);
    }
    if (count > 6) {
        view.tool_radius = 0.1f * domain_width;
        view.tool_pressed = strtof(values[6], NULL);
        memcpy(view.tool_position, view.center, sizeof view.center);
    }
    return view;
}

static int draw(WeirGpu *gpu, WeirSim *sim, int argc, char **argv)
{
    uint32_t width = (uint32_t)atoi(argv[3]), height = (uint32_t)atoi(argv[4]);
    WeirImage image;
    if (!weir_image_create(&image, gpu, WGPUTextureFormat_BGRA8Unorm, width, height)) {
        return complain("picture", "no device memory");
    }
    WeirRenderer *renderer = weir_renderer_create(gpu, WGPUTextureFormat_BGRA8Unorm);
    WeirView view = make_view(sim, width, height, argc - 6, argv + 6);
    int result = 0;
    if (weir_renderer_draw(renderer, sim, &view, image.view, width, height) != WEIR_OK) {
        result = complain("drawing", weir_renderer_error(renderer));
    } else if (!weir_image_read(&image)) {
        result = complain("reading back", weir_gpu_error(gpu));
    } else if (!write_ppm(argv[2], &image)) {
        result = complain(argv[2], "cannot be written");
    }
    weir_renderer_destroy(renderer);
    weir_image_destroy(&image);
    return result;
}

int main(int argc, char **argv)
{
    if (argc < 6) {
        return complain("usage",
                        "weir_frame SCENE.json|built-in OUT.ppm WIDTH HEIGHT STEPS [COLOR_BY MIN MAX "
                        "[ZOOM X Y [TOOL_PRESSED]]]");
    }
    WeirScene *scene = NULL;
    char message[512] = "no memory";
    if (strcmp(argv[1], "built-in") == 0)
        scene = built_in_scene();
    else
        weir_json_load_scene(argv[1], &scene, message, sizeof message);
    if (!scene) return complain("scene", message);
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirSim *sim = make_state(scene, gpu, (uint32_t)atoi(argv[5]));
    int result = sim ? draw(gpu, sim, argc, argv) : 1;
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
    weir_scene_destroy(scene);
    return result;
}
