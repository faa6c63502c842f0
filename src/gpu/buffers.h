// The buffers of a solver on the GPU. A buffer has one name and one binding number in C and in every WGSL file
// (BINDING_<name>), listed once per method.
#pragma once

#include "gpu/report.h"

enum { WEIR_MAX_BUFFERS = 32, WEIR_MAX_PARTS = 16 };

typedef struct WeirBufferInfo {
    const char *name, *label;
    bool uniform;        // bound to every pass as a uniform buffer, otherwise a storage buffer
    bool indirect;       // sizes of dispatches too
    const char *element; // WGSL type of its elements, if it may lie in several parts (parts.h); NULL: never
    const char *written; // the same in passes that write it; NULL: element
} WeirBufferInfo;

// A buffer may hold several shares, one after the other: copies of the particles, lists of some of them.
typedef struct WeirBufferSize {
    uint64_t bytes;  // of one share
    uint32_t shares; // 0 as 1
    uint32_t slack;  // bytes behind the last share that shaders may load, but not use
} WeirBufferSize;

// Cells of one workgroup of the scan: vectors of 4 cells for each thread.
enum { WEIR_SCAN_VECTORS = 2, WEIR_SCAN_BLOCK = WEIR_WORKGROUP_SIZE * WEIR_SCAN_VECTORS * 4 };

typedef struct WeirBuffers {
    WeirGpu *gpu;
    const WeirBufferInfo *info;
    uint32_t count;
    WeirBufferSize size[WEIR_MAX_BUFFERS];
    // How many buffers of the device hold it: one, or, where the device's bindings are too small for all shares together,
    // one for each (parts.h).
    uint32_t parts[WEIR_MAX_BUFFERS];
    WGPUBuffer handle[WEIR_MAX_BUFFERS][WEIR_MAX_PARTS];
} WeirBuffers;

// Entries of the arrays per cell: whole blocks of the scan, and at least one more than `cells`, because cell_start
// ends with the particle count.
uint64_t weir_padded_cells(uint64_t cells);
// Bytes that a storage buffer may have, and be bound with.
uint64_t weir_buffers_most_bytes(const WeirGpu *gpu);
// Takes `sizes`, by name, and finds the parts. WEIR_ERROR_MEMORY with a message if the device's limits do not allow them.
WeirStatus weir_buffers_plan(WeirBuffers *buffers, const WeirBufferSize *sizes,
                             const WeirConstants *constants, WeirMessage *message);
// Makes all of them, zeroed; faults of the device go to `report`.
void weir_buffers_create(WeirBuffers *buffers, WeirReport *report);
void weir_buffers_destroy(WeirBuffers *buffers);
// Bytes of all shares, and of one part.
uint64_t weir_buffers_bytes(const WeirBuffers *buffers, uint32_t name);
uint64_t weir_buffers_part_bytes(const WeirBuffers *buffers, uint32_t name);
// Writes to the begin of the first share.
void weir_buffers_write(WeirBuffers *buffers, uint32_t name, const void *data, size_t size);
