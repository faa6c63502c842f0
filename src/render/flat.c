// A picture in 2D. Water: sums over the particles first, as a picture of their own; what that tells of each pixel is the
// liquid.
#include "render/renderer.h"

#include "render/flat_shape.h"

void weir_flat_create_layouts(WeirRenderer *renderer, WGPUDevice device)
{
    WGPUBindGroupLayoutEntry entries[WEIR_FLAT_TEXTURES];
    for (uint32_t k = 0; k < WEIR_FLAT_TEXTURES; k++) {
        entries[k] = (WGPUBindGroupLayoutEntry){
            .binding = k,
            .visibility = WGPUShaderStage_Fragment,
            .texture = {.sampleType = WGPUTextureSampleType_UnfilterableFloat,
                        .viewDimension = WGPUTextureViewDimension_2D},
        };
    }
    renderer->texture_layouts[WEIR_TEXTURES_FIELD] = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = WEIR_FLAT_TEXTURES, .entries = entries});
    WGPUBindGroupLayoutEntry edges = {
        .visibility = WGPUShaderStage_Fragment,
        .buffer = {.type = WGPUBufferBindingType_Uniform,
                   .minBindingSize = sizeof((WeirFlatShapes *)NULL)->edges},
    };
    renderer->texture_layouts[WEIR_TEXTURES_EDGES] = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 1, .entries = &edges});
}

static void release_sized(WeirFlat *flat)
{
    if (flat->group) wgpuBindGroupRelease(flat->group);
    for (int k = 0; k < WEIR_FLAT_TEXTURES; k++) {
        if (flat->views[k]) wgpuTextureViewRelease(flat->views[k]);
        if (!flat->textures[k]) continue;
        wgpuTextureDestroy(flat->textures[k]);
        wgpuTextureRelease(flat->textures[k]);
    }
    *flat = (WeirFlat){.group = NULL};
}

void weir_flat_release(WeirRenderer *renderer)
{
    release_sized(&renderer->flat);
    const WeirTextures own[] = {WEIR_TEXTURES_FIELD, WEIR_TEXTURES_EDGES};
    for (int k = 0; k < 2; k++) {
        WGPUBindGroupLayout layout = renderer->texture_layouts[own[k]];
        if (layout) wgpuBindGroupLayoutRelease(layout);
    }
}

static bool create(WeirRenderer *renderer, uint32_t width, uint32_t height)
{
    WeirFlat *flat = &renderer->flat;
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    WGPUBindGroupEntry entries[WEIR_FLAT_TEXTURES];
    for (uint32_t k = 0; k < WEIR_FLAT_TEXTURES; k++) {
        flat->textures[k] = wgpuDeviceCreateTexture(
            device, &(WGPUTextureDescriptor){.usage = WGPUTextureUsage_RenderAttachment |
                                                      WGPUTextureUsage_TextureBinding,
                                             .dimension = WGPUTextureDimension_2D,
                                             .size = {width, height, 1},
                                             .format = WEIR_FIELD_FORMAT,
                                             .mipLevelCount = 1,
                                             .sampleCount = 1});
        if (!flat->textures[k]) return false;
        flat->views[k] = wgpuTextureCreateView(flat->textures[k], NULL);
        if (!flat->views[k]) return false;
        entries[k] = (WGPUBindGroupEntry){.binding = k, .textureView = flat->views[k]};
    }
    flat->group = wgpuDeviceCreateBindGroup(
        device, &(WGPUBindGroupDescriptor){.layout = renderer->texture_layouts[WEIR_TEXTURES_FIELD],
                                           .entryCount = WEIR_FLAT_TEXTURES,
                                           .entries = entries});
    return flat->group != NULL;
}

WeirStatus weir_flat_prepare(WeirRenderer *renderer, const WeirFrame *frame)
{
    WeirFlat *flat = &renderer->flat;
    uint32_t texel = frame->field_texel;
    uint32_t width = ((uint32_t)frame->size[0] + texel - 1) / texel;
    uint32_t height = ((uint32_t)frame->size[1] + texel - 1) / texel;
    if (flat->width == width && flat->height == height) return WEIR_OK;
    release_sized(flat);
    if (!create(renderer, width, height)) {
        release_sized(flat);
        return weir_fail(&renderer->message, WEIR_ERROR_MEMORY,
                         "No device memory for the textures of a picture of %g x %g pixels.",
                         (double)frame->size[0], (double)frame->size[1]);
    }
    flat->width = width;
    flat->height = height;
    return WEIR_OK;
}

// A pass over the effects from `first` to `last` that the picture has and that are switched on.
static void draw_pass(WeirRenderer *renderer, const WeirDrawing *drawing, WGPUTextureView target,
                      double alpha, WeirEffectKind first, WeirEffectKind last,
                      const WGPUPassTimestampWrites *writes)
{
    WGPURenderPassColorAttachment color = {.view = target,
                                           .depthSlice = WGPU_DEPTH_SLICE_UNDEFINED,
                                           .loadOp = WGPULoadOp_Clear,
                                           .storeOp = WGPUStoreOp_Store,
                                           .clearValue = {.a = alpha}};
    WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(
        drawing->encoder, &(WGPURenderPassDescriptor){.colorAttachmentCount = 1,
                                                      .colorAttachments = &color,
                                                      .timestampWrites = writes});
    for (int kind = (int)first; kind <= (int)last; kind++) {
        if (!(renderer->effects & 1u << kind)) continue;
        if (!weir_effect_needed((WeirEffectKind)kind, 2, drawing->water)) continue;
        WeirTextures textures = weir_effect_textures((WeirEffectKind)kind);
        WGPUBindGroup group = NULL;
        if (textures == WEIR_TEXTURES_FIELD) group = renderer->flat.group;
        if (textures == WEIR_TEXTURES_EDGES) group = renderer->solids.edged;
        weir_renderer_effect(renderer, pass, (WeirEffectKind)kind, group, 0, drawing);
    }
    wgpuRenderPassEncoderEnd(pass);
    wgpuRenderPassEncoderRelease(pass);
}

void weir_flat_draw(WeirRenderer *renderer, const WeirDrawing *drawing)
{
    for (int k = 0; k < WEIR_FLAT_TEXTURES && drawing->water; k++) {
        WeirEffectKind kind = k == 0 ? WEIR_EFFECT_FIELD : WEIR_EFFECT_SOLID_FIELD;
        draw_pass(renderer, drawing, renderer->flat.views[k], 0.0, kind, kind,
                  k == 0 ? drawing->begins : NULL);
    }
    const WGPUPassTimestampWrites *ends = drawing->ends;
    WGPUPassTimestampWrites both; // of a picture of one pass
    if (ends && !drawing->water) {
        both = *ends;
        both.beginningOfPassWriteIndex = drawing->begins->beginningOfPassWriteIndex;
        ends = &both;
    }
    draw_pass(renderer, drawing, drawing->target, 1.0, WEIR_EFFECT_BACKGROUND, WEIR_EFFECT_OVERLAY, ends);
}
