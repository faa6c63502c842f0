// A picture in 3D: shadow map, the scene with several samples per pixel, the occlusion of its hollows, and the whole.
#include "render/renderer.h"

void weir_space_create_layouts(WeirRenderer *renderer, WGPUDevice device)
{
    WGPUTextureBindingLayout samples = {.sampleType = WGPUTextureSampleType_Depth,
                                        .viewDimension = WGPUTextureViewDimension_2D,
                                        .multisampled = true};
    WGPUTextureBindingLayout map = {.sampleType = WGPUTextureSampleType_Depth,
                                    .viewDimension = WGPUTextureViewDimension_2D};
    WGPUTextureBindingLayout color = {.sampleType = WGPUTextureSampleType_Float,
                                      .viewDimension = WGPUTextureViewDimension_2D};
    const WGPUTextureBindingLayout bound[WEIR_TEXTURE_GROUPS][3] = {
        [WEIR_TEXTURES_SHADOW] = {map},
        [WEIR_TEXTURES_OCCLUSION] = {samples},
        [WEIR_TEXTURES_COMPOSE] = {samples, color, color},
    };
    for (int group = WEIR_TEXTURES_SHADOW; group < WEIR_TEXTURE_GROUPS; group++) {
        WGPUBindGroupLayoutEntry entries[3];
        uint32_t count = group == WEIR_TEXTURES_COMPOSE ? 3 : 1;
        for (uint32_t k = 0; k < count; k++) {
            entries[k] =
                (WGPUBindGroupLayoutEntry){.binding = k,
                                           .visibility = WGPUShaderStage_Vertex | WGPUShaderStage_Fragment,
                                           .texture = bound[group][k]};
        }
        renderer->texture_layouts[group] = wgpuDeviceCreateBindGroupLayout(
            device, &(WGPUBindGroupLayoutDescriptor){.entryCount = count, .entries = entries});
    }
}

static void release_sized(WeirSpace *space)
{
    for (int group = 0; group < WEIR_TEXTURE_GROUPS; group++) {
        if (space->groups[group]) wgpuBindGroupRelease(space->groups[group]);
        space->groups[group] = NULL;
    }
    for (int k = 0; k < WEIR_SPACE_TEXTURES; k++) {
        if (space->views[k]) wgpuTextureViewRelease(space->views[k]);
        if (space->textures[k]) {
            wgpuTextureDestroy(space->textures[k]);
            wgpuTextureRelease(space->textures[k]);
        }
        space->views[k] = NULL;
        space->textures[k] = NULL;
    }
    space->width = space->height = 0;
}

void weir_space_release(WeirRenderer *renderer)
{
    release_sized(&renderer->space);
    for (int group = 0; group < WEIR_TEXTURE_GROUPS; group++) {
        if (renderer->texture_layouts[group]) wgpuBindGroupLayoutRelease(renderer->texture_layouts[group]);
    }
}

static bool create_textures(WeirSpace *space, WGPUDevice device, uint32_t width, uint32_t height)
{
    const WGPUTextureUsage drawn = WGPUTextureUsage_RenderAttachment;
    const WGPUTextureUsage read = WGPUTextureUsage_RenderAttachment | WGPUTextureUsage_TextureBinding;
    const struct {
        WGPUTextureFormat format;
        WGPUTextureUsage usage;
        uint32_t width, height, samples;
    } wanted[WEIR_SPACE_TEXTURES] = {
        [WEIR_SPACE_SHADOW] = {WEIR_DEPTH_FORMAT, read, WEIR_SHADOW_SIZE, WEIR_SHADOW_SIZE, 1},
        [WEIR_SPACE_SAMPLES] = {WEIR_SCENE_FORMAT, drawn, width, height, WEIR_SCENE_SAMPLES},
        [WEIR_SPACE_DEPTH] = {WEIR_DEPTH_FORMAT, read, width, height, WEIR_SCENE_SAMPLES},
        [WEIR_SPACE_COLOR] = {WEIR_SCENE_FORMAT, read, width, height, 1},
        [WEIR_SPACE_OCCLUSION] = {WEIR_OCCLUSION_FORMAT, read, (width + 1) / 2, (height + 1) / 2, 1},
    };
    for (int k = 0; k < WEIR_SPACE_TEXTURES; k++) {
        space->textures[k] = wgpuDeviceCreateTexture(
            device, &(WGPUTextureDescriptor){.usage = wanted[k].usage,
                                             .dimension = WGPUTextureDimension_2D,
                                             .size = {wanted[k].width, wanted[k].height, 1},
                                             .format = wanted[k].format,
                                             .mipLevelCount = 1,
                                             .sampleCount = wanted[k].samples});
        if (!space->textures[k]) return false;
        space->views[k] = wgpuTextureCreateView(space->textures[k], NULL);
        if (!space->views[k]) return false;
    }
    return true;
}

static bool create_groups(WeirRenderer *renderer, WGPUDevice device)
{
    WeirSpace *space = &renderer->space;
    static const WeirSpaceTexture bound[WEIR_TEXTURE_GROUPS][3] = {
        [WEIR_TEXTURES_SHADOW] = {WEIR_SPACE_SHADOW},
        [WEIR_TEXTURES_OCCLUSION] = {WEIR_SPACE_DEPTH},
        [WEIR_TEXTURES_COMPOSE] = {WEIR_SPACE_DEPTH, WEIR_SPACE_COLOR, WEIR_SPACE_OCCLUSION},
    };
    for (int group = WEIR_TEXTURES_SHADOW; group < WEIR_TEXTURE_GROUPS; group++) {
        WGPUBindGroupEntry entries[3];
        uint32_t count = group == WEIR_TEXTURES_COMPOSE ? 3 : 1;
        for (uint32_t k = 0; k < count; k++) {
            entries[k] = (WGPUBindGroupEntry){.binding = k, .textureView = space->views[bound[group][k]]};
        }
        space->groups[group] =
            wgpuDeviceCreateBindGroup(device, &(WGPUBindGroupDescriptor){
                                                  .layout = renderer->texture_layouts[group],
                                                  .entryCount = count,
                                                  .entries = entries,
                                              });
        if (!space->groups[group]) return false;
    }
    return true;
}

WeirStatus weir_space_prepare(WeirRenderer *renderer, uint32_t width, uint32_t height)
{
    WeirSpace *space = &renderer->space;
    if (space->width == width && space->height == height) return WEIR_OK;
    release_sized(space);
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    if (!create_textures(space, device, width, height) || !create_groups(renderer, device)) {
        release_sized(space);
        return weir_fail(&renderer->message, WEIR_ERROR_MEMORY,
                         "No device memory for the textures of a picture of %u x %u pixels.", width, height);
    }
    space->width = width;
    space->height = height;
    return WEIR_OK;
}

// A pass over the effects from `first` to `last` that are switched on.
static void draw_pass(WeirRenderer *renderer, const WeirDrawing *drawing,
                      const WGPURenderPassColorAttachment *color,
                      const WGPURenderPassDepthStencilAttachment *depth, WeirEffectKind first,
                      WeirEffectKind last)
{
    WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(
        drawing->encoder, &(WGPURenderPassDescriptor){.colorAttachmentCount = color ? 1 : 0,
                                                      .colorAttachments = color,
                                                      .depthStencilAttachment = depth});
    for (int kind = (int)first; kind <= (int)last; kind++) {
        if (renderer->effects & 1u << kind)
            weir_renderer_effect(renderer, pass, (WeirEffectKind)kind, drawing);
    }
    wgpuRenderPassEncoderEnd(pass);
    wgpuRenderPassEncoderRelease(pass);
}

static WGPURenderPassColorAttachment cleared(WGPUTextureView view)
{
    return (WGPURenderPassColorAttachment){.view = view,
                                           .depthSlice = WGPU_DEPTH_SLICE_UNDEFINED,
                                           .loadOp = WGPULoadOp_Clear,
                                           .storeOp = WGPUStoreOp_Store,
                                           .clearValue = {.a = 1.0}};
}

void weir_space_draw(WeirRenderer *renderer, const WeirDrawing *drawing)
{
    const WGPUTextureView *views = renderer->space.views;
    WGPURenderPassDepthStencilAttachment depth = {.view = views[WEIR_SPACE_SHADOW],
                                                  .depthLoadOp = WGPULoadOp_Clear,
                                                  .depthStoreOp = WGPUStoreOp_Store,
                                                  .depthClearValue = 1.0f};
    draw_pass(renderer, drawing, NULL, &depth, WEIR_EFFECT_SHADOW, WEIR_EFFECT_SHADOW);
    WGPURenderPassColorAttachment color = cleared(views[WEIR_SPACE_SAMPLES]);
    color.resolveTarget = views[WEIR_SPACE_COLOR];
    color.storeOp = WGPUStoreOp_Discard;
    depth.view = views[WEIR_SPACE_DEPTH];
    depth.depthClearValue = 0.0f;
    draw_pass(renderer, drawing, &color, &depth, WEIR_EFFECT_BACKDROP, WEIR_EFFECT_EDGES);
    color = cleared(views[WEIR_SPACE_OCCLUSION]);
    draw_pass(renderer, drawing, &color, NULL, WEIR_EFFECT_OCCLUSION, WEIR_EFFECT_OCCLUSION);
    color = cleared(drawing->target);
    draw_pass(renderer, drawing, &color, NULL, WEIR_EFFECT_COMPOSE, WEIR_EFFECT_COMPOSE);
}
