#include "gpu/buffers.h"

uint64_t weir_padded_cells(uint64_t cells)
{
    return (cells + 1 + WEIR_SCAN_BLOCK - 1) / WEIR_SCAN_BLOCK * WEIR_SCAN_BLOCK;
}

uint64_t weir_buffers_most_bytes(const WeirGpu *gpu)
{
    const WGPULimits *limits = &gpu->limits;
    return limits->maxStorageBufferBindingSize < limits->maxBufferSize ? limits->maxStorageBufferBindingSize
                                                                       : limits->maxBufferSize;
}

uint64_t weir_buffers_bytes(const WeirBuffers *buffers, uint32_t name)
{
    return weir_buffers_part_bytes(buffers, name) * buffers->parts[name];
}

uint64_t weir_buffers_part_bytes(const WeirBuffers *buffers, uint32_t name)
{
    const WeirBufferSize *size = &buffers->size[name];
    return size->bytes * (size->shares / buffers->parts[name]) + size->slack;
}

WeirStatus weir_buffers_plan(WeirBuffers *buffers, const WeirBufferSize *sizes,
                             const WeirConstants *constants, WeirMessage *message)
{
    uint64_t most = weir_buffers_most_bytes(buffers->gpu);
    for (uint32_t name = 0; name < buffers->count; ++name) {
        buffers->size[name] = sizes[name];
        if (buffers->size[name].shares == 0) buffers->size[name].shares = 1;
        buffers->parts[name] = 1;
        if (weir_buffers_part_bytes(buffers, name) > most && buffers->info[name].element)
            buffers->parts[name] = buffers->size[name].shares;
        uint64_t size = weir_buffers_part_bytes(buffers, name);
        if (size <= most) continue;
        return weir_fail(
            message, WEIR_ERROR_MEMORY,
            "%u particles in %u cells need %llu MiB for the GPU buffer \"%s\", but %s allows %llu MiB; "
            "use about %llu particles or fewer: raise parameters.particle_spacing",
            constants->particle_count, constants->cell_count, (unsigned long long)(size >> 20),
            buffers->info[name].name, buffers->gpu->name, (unsigned long long)(most >> 20),
            (unsigned long long)((double)constants->particle_count * ((double)most / (double)size)));
    }
    return WEIR_OK;
}

void weir_buffers_create(WeirBuffers *buffers, WeirReport *report)
{
    for (uint32_t name = 0; name < buffers->count; ++name) {
        const WeirBufferInfo *info = &buffers->info[name];
        WGPUBufferUsage usage = WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc |
                                (info->uniform ? WGPUBufferUsage_Uniform : WGPUBufferUsage_Storage) |
                                (info->indirect ? WGPUBufferUsage_Indirect : 0);
        weir_report_begin(report);
        for (uint32_t part = 0; part < buffers->parts[name]; ++part)
            buffers->handle[name][part] = weir_gpu_create_buffer(buffers->gpu, info->label, usage,
                                                                 weir_buffers_part_bytes(buffers, name));
        weir_report_end(report, info->label);
    }
}

void weir_buffers_destroy(WeirBuffers *buffers)
{
    for (uint32_t name = 0; name < buffers->count; ++name) {
        for (uint32_t part = 0; part < buffers->parts[name]; ++part) {
            weir_gpu_destroy_buffer(buffers->gpu, buffers->handle[name][part],
                                    weir_buffers_part_bytes(buffers, name));
            buffers->handle[name][part] = NULL;
        }
    }
}

void weir_buffers_write(WeirBuffers *buffers, uint32_t name, const void *data, size_t size)
{
    wgpuQueueWriteBuffer(buffers->gpu->queue, buffers->handle[name][0], 0, data, size);
}
