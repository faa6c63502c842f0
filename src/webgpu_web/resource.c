// Buffers, textures, query sets, shader modules, layouts, bind groups and pipelines.
#include "webgpu_web/imports.h"

#include <stdlib.h>

// ---------------------------------------------------------------------------------------------------------
// Buffers. A mapped range lies outside of wasm memory, so that C gets a copy of it; what was written is
// copied back when the range is closed.

static double map_size(size_t size)
{
    return size == WGPU_WHOLE_MAP_SIZE ? -1 : (double)size;
}

static double whole_size(uint64_t size)
{
    return size == WGPU_WHOLE_SIZE ? -1 : (double)size;
}

WGPUBuffer wgpuDeviceCreateBuffer(WGPUDevice device, const WGPUBufferDescriptor *descriptor)
{
    return WEIR_OBJECT(WGPUBuffer,
                       weir_js_buffer_create(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                             (uint32_t)descriptor->usage, (double)descriptor->size,
                                             descriptor->mappedAtCreation));
}

static void close_ranges(uint32_t buffer)
{
    uint32_t range;
    while ((range = weir_js_buffer_close_range(buffer)) != 0) free(WEIR_OBJECT(void *, range));
}

static void *open_range(uint32_t buffer, size_t offset, size_t size, bool writable)
{
    uint32_t known = weir_js_buffer_find_range(buffer, (double)offset, map_size(size));
    if (known) return WEIR_OBJECT(void *, known);
    double bytes = size == WGPU_WHOLE_MAP_SIZE ? weir_js_buffer_size(buffer) - (double)offset : (double)size;
    if (!(bytes > 0 && bytes < (double)SIZE_MAX)) return NULL;
    void *range = malloc((size_t)bytes);
    if (range && weir_js_buffer_open_range(buffer, (double)offset, map_size(size), range, writable))
        return range;
    free(range);
    return NULL;
}

WGPUFuture wgpuBufferMapAsync(WGPUBuffer buffer, WGPUMapMode mode, size_t offset, size_t size,
                              WGPUBufferMapCallbackInfo info)
{
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (record) weir_js_buffer_map(WEIR_ID(buffer), (uint32_t)mode, (double)offset, map_size(size), record);
    return weir_webgpu_future(record);
}

const void *wgpuBufferGetConstMappedRange(WGPUBuffer buffer, size_t offset, size_t size)
{
    return open_range(WEIR_ID(buffer), offset, size, false);
}

void *wgpuBufferGetMappedRange(WGPUBuffer buffer, size_t offset, size_t size)
{
    return open_range(WEIR_ID(buffer), offset, size, true);
}

WGPUBufferMapState wgpuBufferGetMapState(WGPUBuffer buffer)
{
    return weir_js_buffer_map_state(WEIR_ID(buffer));
}

uint64_t wgpuBufferGetSize(WGPUBuffer buffer)
{
    return (uint64_t)weir_js_buffer_size(WEIR_ID(buffer));
}

WGPUBufferUsage wgpuBufferGetUsage(WGPUBuffer buffer)
{
    return weir_js_buffer_usage(WEIR_ID(buffer));
}

void wgpuBufferUnmap(WGPUBuffer buffer)
{
    close_ranges(WEIR_ID(buffer));
    weir_js_buffer_unmap(WEIR_ID(buffer));
}

void wgpuBufferDestroy(WGPUBuffer buffer)
{
    close_ranges(WEIR_ID(buffer));
    weir_js_buffer_destroy(WEIR_ID(buffer));
}

void wgpuBufferAddRef(WGPUBuffer buffer)
{
    weir_js_add_reference(WEIR_ID(buffer));
}

void wgpuBufferRelease(WGPUBuffer buffer)
{
    // The ranges outlive the handle in JavaScript, so that the last release can still find them.
    if (weir_js_release(WEIR_ID(buffer)) == 0) close_ranges(WEIR_ID(buffer));
}

// ---------------------------------------------------------------------------------------------------------
// Textures and query sets

WGPUTexture wgpuDeviceCreateTexture(WGPUDevice device, const WGPUTextureDescriptor *descriptor)
{
    if (descriptor->viewFormatCount > 0)
        weir_webgpu_refuse(WEIR_ID(device), "texture view formats are not served");
    return WEIR_OBJECT(WGPUTexture,
                       weir_js_texture_create(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                              (uint32_t)descriptor->usage, descriptor->dimension,
                                              descriptor->size.width, descriptor->size.height,
                                              descriptor->size.depthOrArrayLayers, descriptor->format,
                                              descriptor->mipLevelCount, descriptor->sampleCount));
}

WGPUTextureView wgpuTextureCreateView(WGPUTexture texture, const WGPUTextureViewDescriptor *descriptor)
{
    static const WGPUTextureViewDescriptor defaults = WGPU_TEXTURE_VIEW_DESCRIPTOR_INIT;
    if (!descriptor) descriptor = &defaults;
    uint32_t levels = descriptor->mipLevelCount, layers = descriptor->arrayLayerCount;
    return WEIR_OBJECT(
        WGPUTextureView,
        weir_js_texture_view(WEIR_ID(texture), WEIR_TEXT(descriptor->label), descriptor->format,
                             descriptor->dimension, descriptor->baseMipLevel,
                             levels == WGPU_MIP_LEVEL_COUNT_UNDEFINED ? -1.0 : levels,
                             descriptor->baseArrayLayer,
                             layers == WGPU_ARRAY_LAYER_COUNT_UNDEFINED ? -1.0 : layers, descriptor->aspect));
}

void wgpuTextureDestroy(WGPUTexture texture)
{
    weir_js_texture_destroy(WEIR_ID(texture));
}

uint32_t wgpuTextureGetWidth(WGPUTexture texture)
{
    return weir_js_texture_number(WEIR_ID(texture), 0);
}

uint32_t wgpuTextureGetHeight(WGPUTexture texture)
{
    return weir_js_texture_number(WEIR_ID(texture), 1);
}

WGPUTextureFormat wgpuTextureGetFormat(WGPUTexture texture)
{
    return weir_js_texture_number(WEIR_ID(texture), 2);
}

void wgpuTextureRelease(WGPUTexture texture)
{
    weir_js_release(WEIR_ID(texture));
}

void wgpuTextureViewRelease(WGPUTextureView view)
{
    weir_js_release(WEIR_ID(view));
}

WGPUQuerySet wgpuDeviceCreateQuerySet(WGPUDevice device, const WGPUQuerySetDescriptor *descriptor)
{
    return WEIR_OBJECT(WGPUQuerySet, weir_js_query_set_create(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                                              descriptor->type, descriptor->count));
}

void wgpuQuerySetDestroy(WGPUQuerySet query_set)
{
    weir_js_query_set_destroy(WEIR_ID(query_set));
}

void wgpuQuerySetRelease(WGPUQuerySet query_set)
{
    weir_js_release(WEIR_ID(query_set));
}

// ---------------------------------------------------------------------------------------------------------
// Shader modules

WGPUShaderModule wgpuDeviceCreateShaderModule(WGPUDevice device, const WGPUShaderModuleDescriptor *descriptor)
{
    const WGPUChainedStruct *chain = descriptor->nextInChain;
    if (!chain || chain->sType != WGPUSType_ShaderSourceWGSL) {
        weir_webgpu_refuse(WEIR_ID(device), "shader modules are made from WGSL only");
        return NULL;
    }
    const WGPUShaderSourceWGSL *source = (const WGPUShaderSourceWGSL *)chain;
    return WEIR_OBJECT(WGPUShaderModule, weir_js_shader_create(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                                               WEIR_TEXT(source->code)));
}

WGPUFuture wgpuShaderModuleGetCompilationInfo(WGPUShaderModule shader, WGPUCompilationInfoCallbackInfo info)
{
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (record) weir_js_shader_messages(WEIR_ID(shader), record);
    return weir_webgpu_future(record);
}

void wgpuShaderModuleRelease(WGPUShaderModule shader)
{
    weir_js_release(WEIR_ID(shader));
}

// ---------------------------------------------------------------------------------------------------------
// Layouts and bind groups: buffers and textures are all that Weir binds

WGPUBindGroupLayout wgpuDeviceCreateBindGroupLayout(WGPUDevice device,
                                                    const WGPUBindGroupLayoutDescriptor *descriptor)
{
    for (size_t k = 0; k < descriptor->entryCount; k++) {
        const WGPUBindGroupLayoutEntry *entry = &descriptor->entries[k];
        if (entry->bindingArraySize <= 1 &&
            entry->texture.sampleType != WGPUTextureSampleType_BindingNotUsed) {
            weir_js_layout_texture(entry->binding, (uint32_t)entry->visibility, entry->texture.sampleType,
                                   entry->texture.viewDimension, entry->texture.multisampled);
            continue;
        }
        if (entry->buffer.type == WGPUBufferBindingType_BindingNotUsed || entry->bindingArraySize > 1) {
            weir_webgpu_refuse(WEIR_ID(device),
                               "bind group layouts of single buffers and textures only are served");
            continue; // an empty binding, which every pipeline that uses it then refuses
        }
        weir_js_layout_buffer(entry->binding, (uint32_t)entry->visibility, entry->buffer.type,
                              entry->buffer.hasDynamicOffset, (double)entry->buffer.minBindingSize);
    }
    return WEIR_OBJECT(WGPUBindGroupLayout,
                       weir_js_layout_create(WEIR_ID(device), WEIR_TEXT(descriptor->label)));
}

void wgpuBindGroupLayoutRelease(WGPUBindGroupLayout layout)
{
    weir_js_release(WEIR_ID(layout));
}

WGPUPipelineLayout wgpuDeviceCreatePipelineLayout(WGPUDevice device,
                                                  const WGPUPipelineLayoutDescriptor *descriptor)
{
    if (descriptor->immediateSize > 0) weir_webgpu_refuse(WEIR_ID(device), "immediates are not served");
    for (size_t k = 0; k < descriptor->bindGroupLayoutCount; k++)
        weir_js_pipeline_layout_group(WEIR_ID(descriptor->bindGroupLayouts[k]));
    return WEIR_OBJECT(WGPUPipelineLayout,
                       weir_js_pipeline_layout_create(WEIR_ID(device), WEIR_TEXT(descriptor->label)));
}

void wgpuPipelineLayoutRelease(WGPUPipelineLayout layout)
{
    weir_js_release(WEIR_ID(layout));
}

WGPUBindGroup wgpuDeviceCreateBindGroup(WGPUDevice device, const WGPUBindGroupDescriptor *descriptor)
{
    for (size_t k = 0; k < descriptor->entryCount; k++) {
        const WGPUBindGroupEntry *entry = &descriptor->entries[k];
        if (entry->textureView) {
            weir_js_group_texture(entry->binding, WEIR_ID(entry->textureView));
            continue;
        }
        if (!entry->buffer) {
            weir_webgpu_refuse(WEIR_ID(device), "bind groups of buffers and textures only are served");
            continue;
        }
        weir_js_group_buffer(entry->binding, WEIR_ID(entry->buffer), (double)entry->offset,
                             whole_size(entry->size));
    }
    return WEIR_OBJECT(WGPUBindGroup, weir_js_group_create(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                                           WEIR_ID(descriptor->layout)));
}

void wgpuBindGroupRelease(WGPUBindGroup group)
{
    weir_js_release(WEIR_ID(group));
}

// ---------------------------------------------------------------------------------------------------------
// Pipelines

WGPUComputePipeline wgpuDeviceCreateComputePipeline(WGPUDevice device,
                                                    const WGPUComputePipelineDescriptor *descriptor)
{
    const WGPUComputeState *compute = &descriptor->compute;
    if (compute->constantCount > 0) weir_webgpu_refuse(WEIR_ID(device), "pipeline constants are not served");
    return WEIR_OBJECT(WGPUComputePipeline,
                       weir_js_compute_pipeline(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                                WEIR_ID(descriptor->layout), WEIR_ID(compute->module),
                                                WEIR_TEXT(compute->entryPoint)));
}

WGPUFuture wgpuDeviceCreateComputePipelineAsync(WGPUDevice device,
                                                const WGPUComputePipelineDescriptor *descriptor,
                                                WGPUCreateComputePipelineAsyncCallbackInfo info)
{
    const WGPUComputeState *compute = &descriptor->compute;
    if (compute->constantCount > 0) weir_webgpu_refuse(WEIR_ID(device), "pipeline constants are not served");
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (record) {
        weir_js_compute_pipeline_async(WEIR_ID(device), WEIR_TEXT(descriptor->label),
                                       WEIR_ID(descriptor->layout), WEIR_ID(compute->module),
                                       WEIR_TEXT(compute->entryPoint), record);
    }
    return weir_webgpu_future(record);
}

void wgpuComputePipelineAddRef(WGPUComputePipeline pipeline)
{
    weir_js_add_reference(WEIR_ID(pipeline));
}

void wgpuComputePipelineRelease(WGPUComputePipeline pipeline)
{
    weir_js_release(WEIR_ID(pipeline));
}

static void add_target(const WGPUColorTargetState *target)
{
    const WGPUBlendState *blend = target->blend;
    if (blend) {
        weir_js_blend(blend->color.operation, blend->color.srcFactor, blend->color.dstFactor,
                      blend->alpha.operation, blend->alpha.srcFactor, blend->alpha.dstFactor);
    }
    weir_js_color_target(target->format, (uint32_t)target->writeMask);
}

WGPURenderPipeline wgpuDeviceCreateRenderPipeline(WGPUDevice device,
                                                  const WGPURenderPipelineDescriptor *descriptor)
{
    const WGPUVertexState *vertex = &descriptor->vertex;
    const WGPUFragmentState *fragment = descriptor->fragment;
    const WGPUPrimitiveState *primitive = &descriptor->primitive;
    if (vertex->bufferCount > 0) weir_webgpu_refuse(WEIR_ID(device), "vertex buffers are not served");
    if (vertex->constantCount > 0 || (fragment && fragment->constantCount > 0))
        weir_webgpu_refuse(WEIR_ID(device), "pipeline constants are not served");
    const WGPUDepthStencilState *depth = descriptor->depthStencil;
    weir_js_vertex_stage(WEIR_ID(vertex->module), WEIR_TEXT(vertex->entryPoint));
    if (fragment) {
        for (size_t k = 0; k < fragment->targetCount; k++) add_target(&fragment->targets[k]);
        weir_js_fragment_stage(WEIR_ID(fragment->module), WEIR_TEXT(fragment->entryPoint));
    }
    if (depth) { // without a stencil: none is served
        weir_js_depth_state(depth->format, depth->depthWriteEnabled == WGPUOptionalBool_True,
                            depth->depthCompare);
    }
    return WEIR_OBJECT(WGPURenderPipeline,
                       weir_js_render_pipeline(
                           WEIR_ID(device), WEIR_TEXT(descriptor->label), WEIR_ID(descriptor->layout),
                           primitive->topology, primitive->stripIndexFormat, primitive->frontFace,
                           primitive->cullMode, descriptor->multisample.count, descriptor->multisample.mask,
                           descriptor->multisample.alphaToCoverageEnabled));
}

void wgpuRenderPipelineRelease(WGPURenderPipeline pipeline)
{
    weir_js_release(WEIR_ID(pipeline));
}
