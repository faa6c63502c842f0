// A copy from the device to the host that may take a while: idle -> (copy queued) -> pending ->
// ready -> idle.
#pragma once

#include "gpu/device.h"

typedef enum WeirReadbackState {
    WEIR_READBACK_IDLE,
    WEIR_READBACK_PENDING,
    WEIR_READBACK_READY,
} WeirReadbackState;

typedef struct WeirReadback WeirReadback;

// `label` is a static text. NULL if memory runs out.
WeirReadback *weir_readback_create(WeirGpu *gpu, const char *label, uint64_t size);
// A copy under way in a browser: the readback frees itself when it arrived.
void weir_readback_destroy(WeirReadback *readback); // NULL is allowed
// Queues one piece of the copy, from byte `from_offset` on; only while idle.
void weir_readback_copy(WeirReadback *readback, WGPUCommandEncoder encoder, WGPUBuffer from,
                        uint64_t from_offset, uint64_t offset, uint64_t size);
// Starts to wait for the copy, after its commands were submitted.
void weir_readback_start(WeirReadback *readback);
WeirReadbackState weir_readback_state(const WeirReadback *readback);
// The bytes, while ready; NULL if the device failed.
const void *weir_readback_data(const WeirReadback *readback);
// Done with the bytes: idle again.
void weir_readback_finish(WeirReadback *readback);
