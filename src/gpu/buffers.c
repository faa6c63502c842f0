#include "gpu/buffers.h"

uint64_t weir_padded_cells(uint64_t cells)
{
    return (cells + 1 + WEIR_SCAN_BLOCK - 1) / WEIR_SCAN_BLOCK * WEIR_SCAN_BLOCK;
}

static WeirStatus check_size(const WeirBuffers *buffers, uint32_t name, const WeirConstants *constants,
                             WeirMessage *message)
{
    const WGPULimits *limits = &buffers->gpu->limits;
    uint64_t most = limits->maxStorageBufferBindingSize < limits->maxBufferSize
                        ? limits->maxStorageBufferBindingSize
                        : limits->maxBufferSize;
    uint64_t size = buffers->size[name];
    if (size <= most) return WEIR_OK;
    return weir_fail(
        message, WEIR_ERROR_MEMORY,
        "%u particles in %u cells need %llu MiB for the GPU buffer \"%s\", but %s allows %llu MiB; "
        "use about %llu particles or fewer: raise parameters.particle_spacing",
        constants->particle_count, constants->cell_count, (unsigned long long)(size >> 20),
        buffers->info[name].name, buffers->gpu->name, (unsigned long long)(most >> 20),
        (unsigned long long)((double)constants->particle_count * ((double)most / (double)size)));
}

WeirStatus weir_buffers_create(WeirBuffers *buffers, const WeirConstants *constants, WeirReport *report,
                               WeirMessage *message)
{
    for (uint32_t name = 0; name < buffers->count; ++name) {
        WeirStatus status = check_size(buffers, name, constants, message);
        if (status != WEIR_OK) return status;
    }
    for (uint32_t name = 0; name < buffers->count; ++name) {
        const WeirBufferInfo *info = &buffers->info[name];
        WGPUBufferUsage usage = WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc |
                                (info->uniform ? WGPUBufferUsage_Uniform : WGPUBufferUsage_Storage);
        weir_report_begin(report);
        buffers->handle[name] = weir_gpu_create_buffer(buffers->gpu, info->label, usage, buffers->size[name]);
        weir_report_end(report, info->label);
    }
    return WEIR_OK;
}

void weir_buffers_destroy(WeirBuffers *buffers)
{
    for (uint32_t name = 0; name < buffers->count; ++name) {
        weir_gpu_destroy_buffer(buffers->gpu, buffers->handle[name], buffers->size[name]);
        buffers->handle[name] = NULL;
    }
}

void weir_buffers_write(WeirBuffers *buffers, uint32_t name, const void *data, size_t size)
{
    wgpuQueueWriteBuffer(buffers->gpu->queue, buffers->handle[name], 0, data, size);
}
