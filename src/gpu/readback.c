#include "gpu/readback.h"
#include "gpu/platform.h"

#include <stdlib.h>

typedef struct Piece {
    WGPUBuffer buffer;
    uint64_t size;
    bool queued, mapped;
} Piece;

struct WeirReadback {
    WeirGpu *gpu;
    Piece pieces[WEIR_MAX_PIECES];
    uint32_t count, waiting; // pieces; those that are on their way
    WeirReadbackState state;
    bool failed;   // a piece did not arrive
    bool orphaned; // nobody but the callbacks knows this readback any more
};

WeirReadback *weir_readback_create(WeirGpu *gpu, const char *label, uint32_t pieces, const uint64_t *sizes)
{
    WeirReadback *readback = calloc(1, sizeof *readback);
    if (!readback) return NULL;
    readback->gpu = gpu;
    readback->count = pieces;
    for (uint32_t n = 0; n < pieces; ++n) {
        Piece *piece = &readback->pieces[n];
        piece->size = sizes[n];
        piece->buffer =
            weir_gpu_create_buffer(gpu, label, WGPUBufferUsage_MapRead | WGPUBufferUsage_CopyDst, sizes[n]);
    }
    return readback;
}

void weir_readback_destroy(WeirReadback *readback)
{
    if (!readback) return;
    // Destroying a buffer cancels its mapping; the callback may come now or later. This one counts too, so that
    // the last of them frees.
    readback->orphaned = true;
    ++readback->waiting;
    for (uint32_t n = 0; n < readback->count; ++n)
        weir_gpu_destroy_buffer(readback->gpu, readback->pieces[n].buffer, readback->pieces[n].size);
    if (--readback->waiting == 0) free(readback);
}

void weir_readback_copy(WeirReadback *readback, WGPUCommandEncoder encoder, uint32_t piece, WGPUBuffer from,
                        uint64_t from_offset)
{
    Piece *to = &readback->pieces[piece];
    to->queued = true;
    wgpuCommandEncoderCopyBufferToBuffer(encoder, from, from_offset, to->buffer, 0, to->size);
}

static void on_mapped(WGPUMapAsyncStatus status, WGPUStringView text, void *userdata1, void *userdata2)
{
    (void)text; // a failure is reported by the device itself
    WeirReadback *readback = userdata1;
    Piece *piece = userdata2;
    --readback->waiting;
    if (readback->orphaned) {
        if (readback->waiting == 0) free(readback);
        return;
    }
    piece->mapped = status == WGPUMapAsyncStatus_Success;
    readback->failed = readback->failed || !piece->mapped;
    if (readback->waiting == 0) readback->state = WEIR_READBACK_READY;
}

void weir_readback_start(WeirReadback *readback)
{
    readback->state = WEIR_READBACK_PENDING;
    readback->failed = false;
    readback->waiting = 0;
    for (uint32_t n = 0; n < readback->count; ++n) readback->waiting += readback->pieces[n].queued;
    for (uint32_t n = 0; n < readback->count; ++n) {
        Piece *piece = &readback->pieces[n];
        if (!piece->queued) continue;
        piece->queued = false;
        wgpuBufferMapAsync(piece->buffer, WGPUMapMode_Read, 0, piece->size,
                           (WGPUBufferMapCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                       .callback = on_mapped,
                                                       .userdata1 = readback,
                                                       .userdata2 = piece});
    }
}

WeirReadbackState weir_readback_state(const WeirReadback *readback)
{
    return readback->state;
}

const void *weir_readback_data(const WeirReadback *readback, uint32_t piece)
{
    const Piece *from = &readback->pieces[piece];
    // It may have arrived before the device was lost.
    if (readback->failed || !weir_platform_may_look(readback->gpu)) return NULL;
    return wgpuBufferGetConstMappedRange(from->buffer, 0, from->size);
}

void weir_readback_finish(WeirReadback *readback)
{
    for (uint32_t n = 0; n < readback->count; ++n) {
        if (readback->pieces[n].mapped) wgpuBufferUnmap(readback->pieces[n].buffer);
        readback->pieces[n].mapped = false;
    }
    readback->state = WEIR_READBACK_IDLE;
}
