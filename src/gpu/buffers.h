// The buffers of `mueller` on the GPU. A buffer has one name and one binding number in C and in every WGSL
// file (BINDING_<name>), listed once:
//
//   WEIR_BUFFER(name, bytes per particle, bytes per cell)
//
// One step, and who writes what:
//
//   position velocity id --count--> cell_count cell_link --scan--> cell_start --scatter--> sorted_*
//        ^                                                                                    |
//        +--integrate-- acceleration <--forces-- flow <--density-----------------------------+
#pragma once

#include "gpu/report.h"

#include <assert.h>

#define WEIR_BUFFERS                                                                                         \
    WEIR_BUFFER(position, 8, 0)                                                                              \
    WEIR_BUFFER(velocity, 8, 0)                                                                              \
    WEIR_BUFFER(id, 4, 0)                                                                                    \
    WEIR_BUFFER(cell_count, 0, 4)                                                                            \
    WEIR_BUFFER(cell_link, 4, 4)                                                                             \
    WEIR_BUFFER(block_sum, 0, 0)                                                                             \
    WEIR_BUFFER(cell_start, 0, 4)                                                                            \
    WEIR_BUFFER(sorted_position, 8, 0)                                                                       \
    WEIR_BUFFER(sorted_velocity, 8, 0)                                                                       \
    WEIR_BUFFER(sorted_id, 4, 0)                                                                             \
    WEIR_BUFFER(flow, 16, 0)                                                                                 \
    WEIR_BUFFER(acceleration, 8, 0)                                                                          \
    WEIR_BUFFER(health, 0, 0)

typedef enum WeirBufferName {
    WEIR_BUFFER_parameters, // the two uniforms
    WEIR_BUFFER_constants,
#define WEIR_BUFFER(name, per_particle, per_cell) WEIR_BUFFER_##name,
    WEIR_BUFFERS
#undef WEIR_BUFFER
        WEIR_BUFFER_TOTAL
} WeirBufferName;

// Cells of one workgroup of the scan: vectors of 4 cells for each thread.
enum { WEIR_SCAN_VECTORS = 2, WEIR_SCAN_BLOCK = WEIR_WORKGROUP_SIZE * WEIR_SCAN_VECTORS * 4 };

// What integrate leaves, as `struct Health` in shaders/common/uniforms.wgsl.
typedef struct WeirDeviceHealth {
    uint32_t bad_particles;
    uint32_t first_bad_step; // UINT32_MAX: none
    uint32_t step;           // low 32 bits of the step that forces ran last
    uint32_t padding;
} WeirDeviceHealth;
static_assert(sizeof(WeirDeviceHealth) == 16, "a size that copies and bindings take");

typedef struct WeirBuffers {
    WeirGpu *gpu;
    WGPUBuffer handle[WEIR_BUFFER_TOTAL];
    uint64_t size[WEIR_BUFFER_TOTAL];
    uint32_t scan_blocks;
} WeirBuffers;

const char *weir_buffer_name(WeirBufferName name);
// Makes all of them, zeroed. WEIR_ERROR_MEMORY with a message if the device's limits do not allow the sizes;
// faults of the device itself go to `report`.
WeirStatus weir_buffers_create(WeirBuffers *buffers, WeirGpu *gpu, const WeirConstants *constants,
                               WeirReport *report, WeirMessage *message);
void weir_buffers_destroy(WeirBuffers *buffers);
void weir_buffers_write(WeirBuffers *buffers, WeirBufferName name, const void *data, size_t size);
