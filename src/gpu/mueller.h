// The method `mueller` on the GPU. One step, and who writes what:
//
//   position velocity id --count--> cell_count cell_link --scan--> cell_start --scatter--> sorted_*
//        ^                                                                                    |
//        +--integrate-- acceleration <--forces-- flow <--density-----------------------------+
#pragma once

#include "gpu/solver.h"

#include <assert.h>

// WEIR_BUFFER(name, bytes per particle, bytes per cell)
#define WEIR_MUELLER_BUFFERS                                                                                 \
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
    WEIR_BUFFER(fluid_sums, 0, 0)                                                                            \
    WEIR_BUFFER(health, 0, 0)

typedef enum WeirMuellerBuffer {
    WEIR_MUELLER_parameters, // the two uniforms
    WEIR_MUELLER_constants,
#define WEIR_BUFFER(name, per_particle, per_cell) WEIR_MUELLER_##name,
    WEIR_MUELLER_BUFFERS
#undef WEIR_BUFFER
        WEIR_MUELLER_BUFFER_TOTAL
} WeirMuellerBuffer;

typedef enum WeirMuellerPass {
    WEIR_MUELLER_COUNT,
    WEIR_MUELLER_SCAN_REDUCE,
    WEIR_MUELLER_SCAN_WRITE,
    WEIR_MUELLER_SCATTER,
    WEIR_MUELLER_DENSITY,
    WEIR_MUELLER_FORCES,
    WEIR_MUELLER_DENSITY_ALL_PAIRS,
    WEIR_MUELLER_FORCES_ALL_PAIRS,
    WEIR_MUELLER_INTEGRATE,
    WEIR_MUELLER_DIAGNOSE,
    WEIR_MUELLER_PASS_TOTAL
} WeirMuellerPass;

// mueller_passes.c
extern const WeirMethodInfo weir_mueller_method;
// Bytes of each buffer.
void weir_mueller_sizes(const WeirConstants *constants, WeirBufferSize sizes[WEIR_MUELLER_BUFFER_TOTAL]);
// Threads that share the neighbours of a particle: fewer particles do not fill a large device.
uint32_t weir_mueller_lanes(const WeirGpu *gpu, uint32_t particle_count);
// WGSL constants that follow from the parameters, and the passes that they need, by bit.
uint32_t weir_mueller_settings(const WeirGpu *gpu, const WeirParameters *parameters,
                               const WeirConstants *constants, char settings[WEIR_SETTINGS_LENGTH]);

// What integrate leaves, as `struct Health` in shaders/common/fluid.wgsl.
typedef struct WeirDeviceHealth {
    uint32_t bad_particles;
    uint32_t first_bad_step; // UINT32_MAX: none
    uint32_t step;           // low 32 bits of the step that forces ran last
    uint32_t padding;
} WeirDeviceHealth;
static_assert(sizeof(WeirDeviceHealth) == 16, "a size that copies and bindings take");

typedef struct WeirMueller {
    WeirGpuSolver common;
    uint64_t steps;           // queued since the last set_state()
    uint32_t device_step;     // what health.step will hold once the queue is done
    uint64_t state_copy_step; // steps taken when the copy of the state was queued
    uint64_t sums_copy_step;  // the same for that of the sums
    float *host;              // the arrays of WeirState, one after the other
} WeirMueller;

// mueller_read.c: what travels from the device to the host.
void weir_mueller_take_health(WeirGpuSolver *solver, const void *found);
enum { WEIR_MUELLER_PIECES = 4 };
// Bytes of the pieces of the state's copy.
void weir_mueller_piece_sizes(uint32_t particle_count, uint64_t sizes[WEIR_MUELLER_PIECES]);
void weir_mueller_copy_state(WeirGpuSolver *solver);
WeirStatus weir_mueller_take_state(WeirGpuSolver *solver, void *state);
void weir_mueller_copy_sums(WeirGpuSolver *solver);
WeirStatus weir_mueller_take_sums(WeirGpuSolver *solver, void *sums);
// Queues count to density, and forces if `accelerations` are wanted, on the current state, which then is in the sorted order,
// as flow is.
void weir_mueller_evaluate(WeirMueller *solver, WGPUCommandEncoder encoder, bool accelerations);
// Floats of the host's arrays per particle: position, velocity, acceleration, density, pressure.
enum { WEIR_HOST_FLOATS = 2 + 2 + 2 + 1 + 1 };
