// Pass diagnose: sums over free fluid, one per workgroup of a share of the particles, and their way to the host.
#pragma once

#include "gpu/solver.h"

#include <assert.h>

// `struct FluidSums` in shaders/common/sums.wgsl.
typedef struct WeirGpuSums {
    float place[3], density_error;
    float velocity[3], speed2;
    float speed2_max, density_error_max;
    float particles, lost; // whole numbers: a workgroup has no more than 2^24 particles
} WeirGpuSums;
static_assert(sizeof(WeirGpuSums) == 48, "the layout of the shaders' struct");

// Workgroups of the pass: enough for a large device, few enough for the copy to be small.
uint32_t weir_sums_groups(uint32_t particle_count);
// Of buffer fluid_sums.
uint64_t weir_sums_bytes(uint32_t particle_count);
// For sums and health; NULL if memory runs out.
WeirReadback *weir_sums_readback(const WeirGpuSolver *solver);
// Queues the copy of both, from buffer `sums`.
void weir_sums_copy(WeirGpuSolver *solver, WGPUCommandEncoder encoder, uint32_t sums);
// Adds up what came, always in the same order. Step and time are left to the caller; returns the health.
const void *weir_sums_take(const WeirGpuSolver *solver, WeirDiagnosticSums *sums);
