// The effects' pipelines: frame.wgsl and the effect's own file make one shader; no vertex buffers, no depth.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/renderer.h"

extern const char weir_wgsl_render_frame[];
extern const char weir_wgsl_render_background[];
extern const char weir_wgsl_render_body[];
extern const char weir_wgsl_render_particles[];
extern const char weir_wgsl_render_overlay[];

typedef struct EffectText {
    const char *name; // of the WGSL file; its entry points are NAME_vertex and NAME_fragment
    const char *source;
} EffectText;

static const EffectText effect_texts[WEIR_EFFECTS] = {
    [WEIR_EFFECT_BACKGROUND] = {"background", weir_wgsl_render_background},
    [WEIR_EFFECT_BODY] = {"body", weir_wgsl_render_body},
    [WEIR_EFFECT_PARTICLES] = {"particles", weir_wgsl_render_particles},
    [WEIR_EFFECT_OVERLAY] = {"overlay", weir_wgsl_render_overlay},
};

static WGPUStringView text_view(const char *text)
{
    return (WGPUStringView){.data = text, .length = strlen(text)};
}

static WGPUShaderModule create_module(WGPUDevice device, const EffectText *text)
{
    size_t shared = strlen(weir_wgsl_render_frame), own = strlen(text->source);
    char *source = malloc(shared + own + 1);
    if (!source) return NULL;
    memcpy(source, weir_wgsl_render_frame, shared);
    memcpy(source + shared, text->source, own + 1);
    WGPUShaderSourceWGSL wgsl = {.chain = {.sType = WGPUSType_ShaderSourceWGSL},
                                 .code = {.data = source, .length = shared + own}};
    WGPUShaderModuleDescriptor descriptor = {.nextInChain = &wgsl.chain, .label = text_view(text->name)};
    WGPUShaderModule module = wgpuDeviceCreateShaderModule(device, &descriptor);
    free(source);
    return module;
}

WGPURenderPipeline weir_effect_create(WeirEffectKind kind, const WeirEffectSetup *setup)
{
    const EffectText *text = &effect_texts[kind];
    WGPUShaderModule module = create_module(setup->device, text);
    if (!module) return NULL;
    char vertex_entry[32], fragment_entry[32];
    snprintf(vertex_entry, sizeof vertex_entry, "%s_vertex", text->name);
    snprintf(fragment_entry, sizeof fragment_entry, "%s_fragment", text->name);
    WGPUBlendComponent over = {.operation = WGPUBlendOperation_Add,
                               .srcFactor = WGPUBlendFactor_One,
                               .dstFactor = WGPUBlendFactor_OneMinusSrcAlpha};
    WGPUBlendState blend = {.color = over, .alpha = over};
    WGPUColorTargetState target = {.format = setup->format,
                                   .blend = kind == WEIR_EFFECT_BACKGROUND ? NULL : &blend,
                                   .writeMask = WGPUColorWriteMask_All};
    WGPUFragmentState fragment = {
        .module = module, .entryPoint = text_view(fragment_entry), .targetCount = 1, .targets = &target};
    WGPURenderPipelineDescriptor descriptor = {
        .label = text_view(text->name),
        .layout = setup->layout,
        .vertex = {.module = module, .entryPoint = text_view(vertex_entry)},
        .primitive = {.topology = WGPUPrimitiveTopology_TriangleStrip,
                      .frontFace = WGPUFrontFace_CCW,
                      .cullMode = WGPUCullMode_None},
        .multisample = {.count = 1, .mask = 0xFFFFFFFF},
        .fragment = &fragment,
    };
    WGPURenderPipeline pipeline = wgpuDeviceCreateRenderPipeline(setup->device, &descriptor);
    wgpuShaderModuleRelease(module);
    return pipeline;
}

void weir_effect_draw(WeirEffectKind kind, WGPURenderPipeline pipeline, WGPURenderPassEncoder pass,
                      const WeirFrame *frame, uint32_t particle_count)
{
    uint32_t vertices = 4, instances = particle_count;
    if (kind == WEIR_EFFECT_BACKGROUND) {
        vertices = 3;
        instances = 1;
    } else if (kind == WEIR_EFFECT_OVERLAY) {
        instances = frame->tool_radius > 0.0f ? 5 : 4; // four sides of the outline, then the ring
    }
    wgpuRenderPassEncoderSetPipeline(pass, pipeline);
    wgpuRenderPassEncoderDraw(pass, vertices, instances, 0, 0);
}
