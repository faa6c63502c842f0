// Adapters for the device and for drawing into a canvas.
#include "gpu/gpu.h"
#include "web.h"
#include "webgpu_web/webgpu_web.h"
#include "weir/weir_render.h"

#include <stdlib.h>

WEIR_WEB(weir_web_gpu_create)
WeirGpu *weir_web_gpu_create(bool low_power, bool timestamps)
{
    return weir_gpu_create(&(WeirGpuOptions){.low_power = low_power, .no_timestamps = !timestamps});
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

WEIR_WEB(weir_web_renderer_draw)
WeirStatus weir_web_renderer_draw(WeirWebRenderer *web, WeirSim *sim, uint32_t width, uint32_t height,
                                  uint32_t color_by, float color_min, float color_max, float center_x,
                                  float center_y, float pixels_per_meter, float particle_radius, float tool_x,
                                  float tool_y, float tool_radius, float tool_pressed)
{
    if (width == 0 || height == 0) return WEIR_OK; // a canvas that is not shown
    configure(web, width, height);
    WGPUSurfaceTexture texture = {0};
    wgpuSurfaceGetCurrentTexture(web->surface, &texture);
    if (!texture.texture) return WEIR_ERROR_DEVICE; // weir_gpu_poll() has the reason
    WGPUTextureView view = wgpuTextureCreateView(texture.texture, NULL);
    const WeirView shown = {
        .color_by = color_by,
        .color_min = color_min,
        .color_max = color_max,
        .center = {center_x, center_y},
        .pixels_per_meter = pixels_per_meter,
        .particle_radius = particle_radius,
        .tool_position = {tool_x, tool_y},
        .tool_radius = tool_radius,
        .tool_pressed = tool_pressed,
    };
    WeirStatus status = weir_renderer_draw(web->renderer, sim, &shown, view, width, height);
    wgpuTextureViewRelease(view);
    wgpuTextureRelease(texture.texture);
    wgpuSurfacePresent(web->surface);
    return status;
}
