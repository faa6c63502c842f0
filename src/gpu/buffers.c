#include "gpu/buffers.h"

static const struct {
    const char *name;
    const char *label;
    uint32_t per_particle, per_cell;
} table[WEIR_BUFFER_TOTAL] = {[WEIR_BUFFER_parameters] = {"parameters", "buffer parameters", 0, 0},
                              [WEIR_BUFFER_constants] = {"constants", "buffer constants", 0, 0},
#define WEIR_BUFFER(name, per_particle, per_cell)                                                            \
    [WEIR_BUFFER_##name] = {#name, "buffer " #name, per_particle, per_cell},
                              WEIR_BUFFERS
#undef WEIR_BUFFER
};

const char *weir_buffer_name(WeirBufferName name)
{
    return table[name].name;
}

// Whole blocks of the scan, and one element more than cells: cell_start ends with the particle count.
static uint64_t padded_cells(const WeirConstants *constants)
{
    uint64_t cells = (uint64_t)constants->cell_count + 1;
    return (cells + WEIR_SCAN_BLOCK - 1) / WEIR_SCAN_BLOCK * WEIR_SCAN_BLOCK;
}

static uint64_t size_of(WeirBufferName name, const WeirConstants *constants)
{
    switch (name) {
    case WEIR_BUFFER_parameters:
        return sizeof(WeirParameters);
    case WEIR_BUFFER_constants:
        return sizeof(WeirConstants);
    case WEIR_BUFFER_health:
        return sizeof(WeirDeviceHealth);
    case WEIR_BUFFER_block_sum:
        return 4 * (padded_cells(constants) / WEIR_SCAN_BLOCK);
    default:
        return (uint64_t)table[name].per_particle * constants->particle_count +
               (table[name].per_cell ? table[name].per_cell * padded_cells(constants) : 0);
    }
}

static WeirStatus check_size(const WeirBuffers *buffers, WeirBufferName name, const WeirConstants *constants,
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
        constants->particle_count, constants->cell_count, (unsigned long long)(size >> 20), table[name].name,
        buffers->gpu->name, (unsigned long long)(most >> 20),
        (unsigned long long)((double)constants->particle_count * ((double)most / (double)size)));
}

WeirStatus weir_buffers_create(WeirBuffers *buffers, WeirGpu *gpu, const WeirConstants *constants,
                               WeirReport *report, WeirMessage *message)
{
    *buffers = (WeirBuffers){.gpu = gpu};
    buffers->scan_blocks = (uint32_t)(padded_cells(constants) / WEIR_SCAN_BLOCK);
    for (int name = 0; name < WEIR_BUFFER_TOTAL; ++name) {
        buffers->size[name] = size_of(name, constants);
        WeirStatus status = check_size(buffers, name, constants, message);
        if (status != WEIR_OK) return status;
    }
    for (int name = 0; name < WEIR_BUFFER_TOTAL; ++name) {
        bool uniform = name == WEIR_BUFFER_parameters || name == WEIR_BUFFER_constants;
        WGPUBufferUsage usage = WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc |
                                (uniform ? WGPUBufferUsage_Uniform : WGPUBufferUsage_Storage);
        weir_report_begin(report);
        buffers->handle[name] = weir_gpu_create_buffer(gpu, table[name].label, usage, buffers->size[name]);
        weir_report_end(report, table[name].label);
    }
    return WEIR_OK;
}

void weir_buffers_destroy(WeirBuffers *buffers)
{
    for (int name = 0; name < WEIR_BUFFER_TOTAL; ++name) {
        weir_gpu_destroy_buffer(buffers->gpu, buffers->handle[name], buffers->size[name]);
        buffers->handle[name] = NULL;
    }
}

void weir_buffers_write(WeirBuffers *buffers, WeirBufferName name, const void *data, size_t size)
{
    wgpuQueueWriteBuffer(buffers->gpu->queue, buffers->handle[name], 0, data, size);
}
