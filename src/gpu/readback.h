// A copy from the device to the host that may take a while: idle -> (copy queued) -> pending ->
// ready -> idle. In pieces, since a device's buffers may be too small for all together.
#pragma once

#include "gpu/device.h"

enum { WEIR_MAX_PIECES = 8 };

typedef enum WeirReadbackState {
    WEIR_READBACK_IDLE,
    WEIR_READBACK_PENDING,
    WEIR_READBACK_READY,
} WeirReadbackState;

typedef struct WeirReadback WeirReadback;

// `label` is a static text, `sizes` the bytes of each piece. NULL if memory runs out.
WeirReadback *weir_readback_create(WeirGpu *gpu, const char *label, uint32_t pieces, const uint64_t *sizes);
// A copy under way in a browser: the readback frees itself when it arrived.
void weir_readback_destroy(WeirReadback *readback); // NULL is allowed
// Queues a piece of the copy, from byte `from_offset` on; only while idle. Pieces that are not queued do not come.
void weir_readback_copy(WeirReadback *readback, WGPUCommandEncoder encoder, uint32_t piece, WGPUBuffer from,
                        uint64_t from_offset);
// Starts to wait for the copy, after its commands were submitted.
void weir_readback_start(WeirReadback *readback);
WeirReadbackState weir_readback_state(const WeirReadback *readback);
// The bytes of a piece that was queued, while ready; NULL if the device failed.
const void *weir_readback_data(const WeirReadback *readback, uint32_t piece);
// Done with the bytes: idle again.
void weir_readback_finish(WeirReadback *readback);
