// Command encoders, passes and the queue. These run many times per frame: no call allocates.
#include "webgpu_web/imports.h"

static double query_index(uint32_t index)
{
    return index == WGPU_QUERY_SET_INDEX_UNDEFINED ? -1.0 : index;
}

static double stride(uint32_t size)
{
    return size == WGPU_COPY_STRIDE_UNDEFINED ? -1.0 : size;
}

static const WGPUPassTimestampWrites no_timestamps = WGPU_PASS_TIMESTAMP_WRITES_INIT;

WGPUCommandEncoder wgpuDeviceCreateCommandEncoder(WGPUDevice device,
                                                  const WGPUCommandEncoderDescriptor *descriptor)
{
    WGPUStringView label = descriptor ? descriptor->label : (WGPUStringView){NULL, 0};
    return WEIR_OBJECT(WGPUCommandEncoder, weir_js_encoder_create(WEIR_ID(device), WEIR_TEXT(label)));
}

WGPUCommandBuffer wgpuCommandEncoderFinish(WGPUCommandEncoder encoder,
                                           const WGPUCommandBufferDescriptor *descriptor)
{
    WGPUStringView label = descriptor ? descriptor->label : (WGPUStringView){NULL, 0};
    return WEIR_OBJECT(WGPUCommandBuffer, weir_js_encoder_finish(WEIR_ID(encoder), WEIR_TEXT(label)));
}

void wgpuCommandEncoderRelease(WGPUCommandEncoder encoder)
{
    weir_js_release(WEIR_ID(encoder));
}

void wgpuCommandBufferRelease(WGPUCommandBuffer commands)
{
    weir_js_release(WEIR_ID(commands));
}

void wgpuCommandEncoderCopyBufferToBuffer(WGPUCommandEncoder encoder, WGPUBuffer source,
                                          uint64_t source_offset, WGPUBuffer destination,
                                          uint64_t destination_offset, uint64_t size)
{
    weir_js_copy_buffer(WEIR_ID(encoder), WEIR_ID(source), (double)source_offset, WEIR_ID(destination),
                        (double)destination_offset, (double)size);
}

void wgpuCommandEncoderClearBuffer(WGPUCommandEncoder encoder, WGPUBuffer buffer, uint64_t offset,
                                   uint64_t size)
{
    weir_js_clear_buffer(WEIR_ID(encoder), WEIR_ID(buffer), (double)offset,
                         size == WGPU_WHOLE_SIZE ? -1 : (double)size);
}

void wgpuCommandEncoderCopyTextureToBuffer(WGPUCommandEncoder encoder, const WGPUTexelCopyTextureInfo *source,
                                           const WGPUTexelCopyBufferInfo *destination,
                                           const WGPUExtent3D *size)
{
    weir_js_copy_texture(WEIR_ID(encoder), WEIR_ID(source->texture), source->mipLevel, source->origin.x,
                         source->origin.y, source->origin.z, source->aspect, WEIR_ID(destination->buffer),
                         (double)destination->layout.offset, stride(destination->layout.bytesPerRow),
                         stride(destination->layout.rowsPerImage), size->width, size->height,
                         size->depthOrArrayLayers);
}

void wgpuCommandEncoderResolveQuerySet(WGPUCommandEncoder encoder, WGPUQuerySet query_set, uint32_t first,
                                       uint32_t count, WGPUBuffer destination, uint64_t offset)
{
    weir_js_resolve_queries(WEIR_ID(encoder), WEIR_ID(query_set), first, count, WEIR_ID(destination),
                            (double)offset);
}

// ---------------------------------------------------------------------------------------------------------
// Compute pass

WGPUComputePassEncoder wgpuCommandEncoderBeginComputePass(WGPUCommandEncoder encoder,
                                                          const WGPUComputePassDescriptor *descriptor)
{
    WGPUStringView label = descriptor ? descriptor->label : (WGPUStringView){NULL, 0};
    const WGPUPassTimestampWrites *writes = descriptor ? descriptor->timestampWrites : NULL;
    if (!writes) writes = &no_timestamps;
    return WEIR_OBJECT(WGPUComputePassEncoder,
                       weir_js_compute_pass(WEIR_ID(encoder), WEIR_TEXT(label), WEIR_ID(writes->querySet),
                                            query_index(writes->beginningOfPassWriteIndex),
                                            query_index(writes->endOfPassWriteIndex)));
}

void wgpuComputePassEncoderSetPipeline(WGPUComputePassEncoder pass, WGPUComputePipeline pipeline)
{
    weir_js_pass_pipeline(WEIR_ID(pass), WEIR_ID(pipeline));
}

void wgpuComputePassEncoderSetBindGroup(WGPUComputePassEncoder pass, uint32_t index, WGPUBindGroup group,
                                        size_t offset_count, const uint32_t *offsets)
{
    weir_js_pass_group(WEIR_ID(pass), index, WEIR_ID(group), offsets, offset_count);
}

void wgpuComputePassEncoderDispatchWorkgroups(WGPUComputePassEncoder pass, uint32_t x, uint32_t y, uint32_t z)
{
    weir_js_dispatch(WEIR_ID(pass), x, y, z);
}

void wgpuComputePassEncoderDispatchWorkgroupsIndirect(WGPUComputePassEncoder pass, WGPUBuffer sizes,
                                                      uint64_t offset)
{
    weir_js_dispatch_indirect(WEIR_ID(pass), WEIR_ID(sizes), (double)offset);
}

void wgpuComputePassEncoderEnd(WGPUComputePassEncoder pass)
{
    weir_js_pass_end(WEIR_ID(pass));
}

void wgpuComputePassEncoderRelease(WGPUComputePassEncoder pass)
{
    weir_js_release(WEIR_ID(pass));
}

// ---------------------------------------------------------------------------------------------------------
// Render pass

WGPURenderPassEncoder wgpuCommandEncoderBeginRenderPass(WGPUCommandEncoder encoder,
                                                        const WGPURenderPassDescriptor *descriptor)
{
    const WGPUPassTimestampWrites *writes = descriptor->timestampWrites;
    if (!writes) writes = &no_timestamps;
    if (descriptor->occlusionQuerySet)
        weir_webgpu_refuse(WEIR_ID(encoder), "occlusion queries are not served");
    for (size_t k = 0; k < descriptor->colorAttachmentCount; k++) {
        const WGPURenderPassColorAttachment *color = &descriptor->colorAttachments[k];
        uint32_t slice = color->depthSlice;
        weir_js_color_attachment(WEIR_ID(color->view), slice == WGPU_DEPTH_SLICE_UNDEFINED ? -1.0 : slice,
                                 WEIR_ID(color->resolveTarget), color->loadOp, color->storeOp,
                                 color->clearValue.r, color->clearValue.g, color->clearValue.b,
                                 color->clearValue.a);
    }
    const WGPURenderPassDepthStencilAttachment *depth = descriptor->depthStencilAttachment;
    if (depth) { // without a stencil: none is served
        weir_js_depth_attachment(WEIR_ID(depth->view), depth->depthLoadOp, depth->depthStoreOp,
                                 depth->depthClearValue, depth->depthReadOnly);
    }
    return WEIR_OBJECT(WGPURenderPassEncoder,
                       weir_js_render_pass(WEIR_ID(encoder), WEIR_TEXT(descriptor->label),
                                           WEIR_ID(writes->querySet),
                                           query_index(writes->beginningOfPassWriteIndex),
                                           query_index(writes->endOfPassWriteIndex)));
}

void wgpuRenderPassEncoderSetPipeline(WGPURenderPassEncoder pass, WGPURenderPipeline pipeline)
{
    weir_js_pass_pipeline(WEIR_ID(pass), WEIR_ID(pipeline));
}

void wgpuRenderPassEncoderSetBindGroup(WGPURenderPassEncoder pass, uint32_t index, WGPUBindGroup group,
                                       size_t offset_count, const uint32_t *offsets)
{
    weir_js_pass_group(WEIR_ID(pass), index, WEIR_ID(group), offsets, offset_count);
}

void wgpuRenderPassEncoderDraw(WGPURenderPassEncoder pass, uint32_t vertices, uint32_t instances,
                               uint32_t first_vertex, uint32_t first_instance)
{
    weir_js_draw(WEIR_ID(pass), vertices, instances, first_vertex, first_instance);
}

void wgpuRenderPassEncoderDrawIndirect(WGPURenderPassEncoder pass, WGPUBuffer drawn, uint64_t offset)
{
    weir_js_draw_indirect(WEIR_ID(pass), WEIR_ID(drawn), (double)offset);
}

void wgpuRenderPassEncoderEnd(WGPURenderPassEncoder pass)
{
    weir_js_pass_end(WEIR_ID(pass));
}

void wgpuRenderPassEncoderRelease(WGPURenderPassEncoder pass)
{
    weir_js_release(WEIR_ID(pass));
}

// ---------------------------------------------------------------------------------------------------------
// Queue

void wgpuQueueSubmit(WGPUQueue queue, size_t count, const WGPUCommandBuffer *commands)
{
    weir_js_submit(WEIR_ID(queue), commands, count);
}

void wgpuQueueWriteBuffer(WGPUQueue queue, WGPUBuffer buffer, uint64_t offset, const void *data, size_t size)
{
    weir_js_write_buffer(WEIR_ID(queue), WEIR_ID(buffer), (double)offset, data, size);
}

WGPUFuture wgpuQueueOnSubmittedWorkDone(WGPUQueue queue, WGPUQueueWorkDoneCallbackInfo info)
{
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (record) weir_js_work_done(WEIR_ID(queue), record);
    return weir_webgpu_future(record);
}

void wgpuQueueRelease(WGPUQueue queue)
{
    weir_js_release(WEIR_ID(queue));
}
