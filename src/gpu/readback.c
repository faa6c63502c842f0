#include "gpu/readback.h"

#include <stdlib.h>

struct WeirReadback {
    WeirGpu *gpu;
    WGPUBuffer buffer;
    uint64_t size;
    WeirReadbackState state;
    bool mapped;
    bool orphaned; // nobody but the callback knows this readback any more
};

WeirReadback *weir_readback_create(WeirGpu *gpu, const char *label, uint64_t size)
{
    WeirReadback *readback = calloc(1, sizeof *readback);
    if (!readback) return NULL;
    readback->gpu = gpu;
    readback->size = size;
    readback->buffer =
        weir_gpu_create_buffer(gpu, label, WGPUBufferUsage_MapRead | WGPUBufferUsage_CopyDst, size);
    return readback;
}

void weir_readback_destroy(WeirReadback *readback)
{
    if (!readback) return;
    // Destroying a buffer cancels its mapping; the callback may come now or later.
    readback->orphaned = true;
    bool pending = readback->state == WEIR_READBACK_PENDING;
    weir_gpu_destroy_buffer(readback->gpu, readback->buffer, readback->size);
    if (!pending) free(readback);
}

void weir_readback_copy(WeirReadback *readback, WGPUCommandEncoder encoder, WGPUBuffer from,
                        uint64_t from_offset, uint64_t offset, uint64_t size)
{
    wgpuCommandEncoderCopyBufferToBuffer(encoder, from, from_offset, readback->buffer, offset, size);
}

static void on_mapped(WGPUMapAsyncStatus status, WGPUStringView text, void *userdata1, void *userdata2)
{
    (void)text, (void)userdata2; // a failure is reported by the device itself
    WeirReadback *readback = userdata1;
    if (readback->orphaned) {
        free(readback);
        return;
    }
    readback->mapped = status == WGPUMapAsyncStatus_Success;
    readback->state = WEIR_READBACK_READY;
}

void weir_readback_start(WeirReadback *readback)
{
    readback->state = WEIR_READBACK_PENDING;
    wgpuBufferMapAsync(readback->buffer, WGPUMapMode_Read, 0, readback->size,
                       (WGPUBufferMapCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                   .callback = on_mapped,
                                                   .userdata1 = readback});
}

WeirReadbackState weir_readback_state(const WeirReadback *readback)
{
    return readback->state;
}

const void *weir_readback_data(const WeirReadback *readback)
{
    if (!readback->mapped) return NULL;
    return wgpuBufferGetConstMappedRange(readback->buffer, 0, readback->size);
}

void weir_readback_finish(WeirReadback *readback)
{
    if (readback->mapped) wgpuBufferUnmap(readback->buffer);
    readback->mapped = false;
    readback->state = WEIR_READBACK_IDLE;
}
