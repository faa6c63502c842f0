// The buffers of a solver on the GPU. A buffer has one name and one binding number in C and in every WGSL file
// (BINDING_<name>), listed once per method.
#pragma once

#include "gpu/report.h"

enum { WEIR_MAX_BUFFERS = 32 };

typedef struct WeirBufferInfo {
    const char *name, *label;
    bool uniform; // bound to every pass as a uniform buffer, otherwise a storage buffer
} WeirBufferInfo;

// Cells of one workgroup of the scan: vectors of 4 cells for each thread.
enum { WEIR_SCAN_VECTORS = 2, WEIR_SCAN_BLOCK = WEIR_WORKGROUP_SIZE * WEIR_SCAN_VECTORS * 4 };

typedef struct WeirBuffers {
    WeirGpu *gpu;
    const WeirBufferInfo *info;
    uint32_t count;
    WGPUBuffer handle[WEIR_MAX_BUFFERS];
    uint64_t size[WEIR_MAX_BUFFERS];
} WeirBuffers;

// Entries of the arrays per cell: whole blocks of the scan, and at least one more than `cells`, because cell_start
// ends with the particle count.
uint64_t weir_padded_cells(uint64_t cells);
// Makes all of them in the sizes that `buffers` says, zeroed. WEIR_ERROR_MEMORY with a message if the device's limits
// do not allow the sizes; faults of the device itself go to `report`.
WeirStatus weir_buffers_create(WeirBuffers *buffers, const WeirConstants *constants, WeirReport *report,
                               WeirMessage *message);
void weir_buffers_destroy(WeirBuffers *buffers);
void weir_buffers_write(WeirBuffers *buffers, uint32_t name, const void *data, size_t size);
