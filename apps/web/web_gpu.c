// Adapters for the device and for drawing into a canvas.
#include "gpu/gpu.h"
#include "web.h"
#include "webgpu_web/webgpu_web.h"
#include "weir/weir_render.h"

#include <stdlib.h>

// `parallelism`: of `device`, as it was told before; 0: not known.
WEIR_WEB(weir_web_gpu_create)
WeirGpu *weir_web_gpu_create(bool low_power, bool timestamps, uint32_t parallelism, const char *device)
{
    return weir_gpu_create(&(WeirGpuOptions){.low_power = low_power,
                                             .no_timestamps = !timestamps,
                                             .parallelism = parallelism,
                                             .parallelism_device = device});
}

WEIR_WEB(weir_web_gpu_memory)
double weir_web_gpu_memory(const WeirGpu *gpu)
{
    return (double)weir_gpu_memory(gpu);
}

// 256 colours of a map, 3 bytes each.
WEIR_WEB(weir_web_color_map)
void weir_web_color_map(uint32_t color_by, uint8_t *colors)
{
    for (int k = 0; k < 256; k++) weir_color_map(color_by, (float)k / 255.0f, colors + 3 * k);
}

// A renderer with the canvas that it draws into.
typedef struct WeirWebRenderer {
    WeirGpu *gpu;
    WeirRenderer *renderer;
    WGPUSurface surface;
    WGPUTextureFormat format;
    uint32_t width, height; // as configured
} WeirWebRenderer;

WEIR_WEB(weir_web_renderer_destroy)
void weir_web_renderer_destroy(WeirWebRenderer *web)
{
    if (!web) return;
    weir_renderer_destroy(web->renderer);
    if (web->surface) {
        if (web->width) wgpuSurfaceUnconfigure(web->surface);
        wgpuSurfaceRelease(web->surface);
    }
    free(web);
}

// NULL if the canvas gives no WebGPU context or memory ran out.
WEIR_WEB(weir_web_renderer_create)
WeirWebRenderer *weir_web_renderer_create(WeirGpu *gpu, uint32_t canvas_id)
{
    WeirWebRenderer *web = calloc(1, sizeof *web);
    if (!web) return NULL;
    web->gpu = gpu;
    web->surface = weir_webgpu_canvas_surface(weir_gpu_wgpu_instance(gpu), canvas_id);
    if (web->surface) {
        WGPUSurfaceCapabilities capabilities = {0};
        wgpuSurfaceGetCapabilities(web->surface, NULL, &capabilities);
        web->format = capabilities.formats[0];
        wgpuSurfaceCapabilitiesFreeMembers(capabilities);
        web->renderer = weir_renderer_create(gpu, web->format);
    }
    if (web->renderer) return web;
    weir_web_renderer_destroy(web);
    return NULL;
}

static void configure(WeirWebRenderer *web, uint32_t width, uint32_t height)
{
    if (web->width == width && web->height == height) return;
    wgpuSurfaceConfigure(web->surface, &(WGPUSurfaceConfiguration){
                                           .device = weir_gpu_wgpu_device(web->gpu),
                                           .format = web->format,
                                           .usage = WGPUTextureUsage_RenderAttachment,
                                           .width = width,
                                           .height = height,
                                           .alphaMode = WGPUCompositeAlphaMode_Opaque,
                                           .presentMode = WGPUPresentMode_Fifo,
                                       });
    web->width = width;
    web->height = height;
}

// A view as JavaScript hands it over: WEIR_WEB_VIEW floats in the order of the lines below.
enum { WEIR_WEB_VIEW = 22 };

static WeirView read_view(const float v[WEIR_WEB_VIEW])
{
    return (WeirView){
        .color_by = (WeirColorBy)v[0],
        .color_min = v[1],
        .color_max = v[2],
        .particle_radius = v[3],
        .tool_position = {v[4], v[5], v[6]},
        .tool_radius = v[7],
        .tool_pressed = v[8],
        .center = {v[9], v[10]},
        .pixels_per_meter = v[11],
        .camera_target = {v[12], v[13], v[14]},
        .camera_yaw = v[15],
        .camera_pitch = v[16],
        .camera_distance = v[17],
        .camera_field_of_view = v[18],
        .camera_shift = {v[19], v[20]},
        .fluid_style = (WeirFluidStyle)v[21],
    };
}

WEIR_WEB(weir_web_renderer_prepare)
WeirStatus weir_web_renderer_prepare(WeirWebRenderer *web, const WeirScene *scene, WeirFluidStyle style)
{
    return weir_renderer_prepare(web->renderer, scene, style);
}

WEIR_WEB(weir_web_renderer_draw_time)
double weir_web_renderer_draw_time(const WeirWebRenderer *web)
{
    return weir_renderer_draw_time(web->renderer);
}

WEIR_WEB(weir_web_renderer_draw)
WeirStatus weir_web_renderer_draw(WeirWebRenderer *web, WeirSim *sim, uint32_t width, uint32_t height,
                                  const float *view)
{
    if (width == 0 || height == 0) return WEIR_OK; // a canvas that is not shown
    configure(web, width, height);
    WGPUSurfaceTexture texture = {0};
    wgpuSurfaceGetCurrentTexture(web->surface, &texture);
    if (!texture.texture) return WEIR_ERROR_DEVICE; // weir_gpu_poll() has the reason
    WGPUTextureView target = wgpuTextureCreateView(texture.texture, NULL);
    const WeirView shown = read_view(view);
    WeirStatus status = weir_renderer_draw(web->renderer, sim, &shown, target, width, height);
    wgpuTextureViewRelease(target);
    wgpuTextureRelease(texture.texture);
    wgpuSurfacePresent(web->surface);
    return status;
}

WEIR_WEB(weir_web_view_matrix)
void weir_web_view_matrix(const float *view, uint32_t width, uint32_t height, float matrix[16])
{
    const WeirView shown = read_view(view);
    weir_view_matrix(&shown, width, height, matrix);
}

// Origin and direction of the ray through a pixel.
WEIR_WEB(weir_web_view_ray)
void weir_web_view_ray(const float *view, uint32_t width, uint32_t height, float x, float y, float ray[6])
{
    const WeirView shown = read_view(view);
    weir_view_ray(&shown, width, height, x, y, ray, ray + 3);
}
