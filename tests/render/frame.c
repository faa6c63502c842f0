// weir_frame [--water] SCENE.json|built-in OUT.ppm WIDTH HEIGHT TIME [COLOR_BY MIN MAX [ZOOM X Y [TOOL_PRESSED]]]
// Draws one frame of a scene as the page would and writes it as a PPM file, to be looked at. The time is simulated
// on the CPU, which is quicker than a software adapter; the picture comes from the device. In 3D, X and Y are the
// camera's yaw and pitch in degrees; --water draws the fluid as water in place of particles.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "adapter.h"
#include "image.h"
#include "render/renderer.h"
#include "upload.h"
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

// The state of a simulation on the CPU, on the device: in a simulation of its own (mueller) or in buffers (wcsph).
typedef struct Shown {
    WeirSim *cpu, *sim;
    WeirGpuParticles particles;
} Shown;

static void release(Shown *shown)
{
    weir_upload_release(&shown->particles);
    weir_sim_destroy(shown->sim);
    weir_sim_destroy(shown->cpu);
}

static int make_state(Shown *shown, const WeirScene *scene, WeirGpu *gpu, double time)
{
    shown->cpu = weir_sim_create(scene, NULL);
    WeirState state;
    WeirStatus status = weir_sim_status(shown->cpu);
    if (status == WEIR_OK) status = weir_sim_run_until(shown->cpu, time);
    if (status == WEIR_OK) status = weir_sim_state(shown->cpu, &state);
    if (status != WEIR_OK) return complain("simulation on the CPU", weir_sim_error(shown->cpu));
    if (state.group)
        return weir_upload(gpu, shown->cpu, &shown->particles) ? 0 : complain("device", "no memory");
    shown->sim = weir_sim_create(scene, &(WeirSimOptions){.backend = weir_gpu_backend(gpu)});
    status = weir_sim_set_state(shown->sim, state.position, state.velocity);
    if (status == WEIR_OK) status = weir_sim_wait(shown->sim);
    if (status != WEIR_OK) return complain("simulation on the device", weir_sim_error(shown->sim));
    return weir_gpu_particles(shown->sim, &shown->particles) ? 0 : complain("device", "no particles");
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

static float number(int count, char **values, int index, float otherwise)
{
    return index < count ? strtof(values[index], NULL) : otherwise;
}

static WeirView make_view(WeirSim *sim, uint32_t width, uint32_t height, int count, char **values)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    float zoom = number(count, values, 3, 1.0f), size[3], diagonal = 0.0f;
    WeirView view = {
        .color_by = (WeirColorBy)number(count, values, 0, 0.0f),
        .color_min = number(count, values, 1, 0.0f),
        .color_max = number(count, values, 2, 5.0f),
        .particle_radius = 0.58f * weir_sim_parameters(sim)->particle_spacing,
        .camera_yaw = number(count, values, 4, 32.0f) * 0.0174533f,
        .camera_pitch = number(count, values, 5, 20.0f) * 0.0174533f,
        .camera_field_of_view = 0.61f,
    };
    for (int k = 0; k < 3; k++) {
        size[k] = constants->domain_max[k] - constants->domain_min[k];
        view.camera_target[k] = 0.5f * (constants->domain_min[k] + constants->domain_max[k]);
        diagonal = hypotf(diagonal, size[k]);
    }
    view.camera_distance = 1.55f * diagonal / zoom;
    view.pixels_per_meter = 0.94f * zoom * fminf((float)width / size[0], (float)height / size[1]);
    for (int k = 0; k < 2; k++) view.center[k] = number(count, values, 4 + k, view.camera_target[k]);
    if (count > 6) {
        view.tool_radius = 0.1f * size[0];
        view.tool_pressed = number(count, values, 6, 0.0f);
        for (int k = 0; k < 3; k++) view.tool_position[k] = view.camera_target[k];
    }
    return view;
}

static int draw(WeirGpu *gpu, Shown *shown, WeirFluidStyle style, int argc, char **argv)
{
    uint32_t width = (uint32_t)atoi(argv[3]), height = (uint32_t)atoi(argv[4]);
    WeirImage image;
    if (!weir_image_create(&image, gpu, WGPUTextureFormat_BGRA8Unorm, width, height)) {
        return complain("picture", "no device memory");
    }
    WeirRenderer *renderer = weir_renderer_create(gpu, WGPUTextureFormat_BGRA8Unorm);
    WeirView view = make_view(shown->cpu, width, height, argc - 6, argv + 6);
    view.fluid_style = style;
    int result = 0;
    if (weir_renderer_draw_particles(renderer, shown->cpu, &shown->particles, &view, image.view, width,
                                     height) != WEIR_OK) {
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
    WeirFluidStyle style = WEIR_FLUID_PARTICLES;
    if (argc > 1 && strcmp(argv[1], "--water") == 0) {
        style = WEIR_FLUID_WATER;
        argc--;
        argv++;
    }
    if (argc < 6) {
        return complain(
            "usage", "weir_frame [--water] SCENE.json|built-in OUT.ppm WIDTH HEIGHT TIME [COLOR_BY MIN MAX "
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
    Shown shown = {.cpu = NULL};
    int result = make_state(&shown, scene, gpu, strtod(argv[5], NULL));
    if (result == 0) result = draw(gpu, &shown, style, argc, argv);
    release(&shown);
    weir_gpu_destroy(gpu);
    weir_scene_destroy(scene);
    return result;
}
