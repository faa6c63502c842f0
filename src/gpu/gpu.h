// What solvers, renderer and tests know of a device (device.c) beyond the public API.
#pragma once

#include "core/solver.h"
#include "weir/weir_gpu.h"
#include <webgpu/webgpu.h>

// Handles of a ready device; owned by the WeirGpu.
WGPUDevice weir_gpu_wgpu_device(WeirGpu *gpu);
WGPUQueue weir_gpu_wgpu_queue(WeirGpu *gpu);
WGPUInstance weir_gpu_wgpu_instance(WeirGpu *gpu);

// The buffers of a simulation on the GPU, for drawing. One element per particle, all in the same (sorted)
// order, which changes every step.
typedef struct WeirGpuParticles {
    WeirGpu *gpu;
    WeirMethod method;
    // mueller; NULL otherwise
    WGPUBuffer position; // array<vec2f>, m, newest
    WGPUBuffer velocity; // array<vec2f>, m/s, newest
    WGPUBuffer flow;     // array<vec4f>: velocity, density, pressure as the last step's passes used them
    // wcsph; NULL otherwise. Walls and bodies are particles too; draw by group.
    WGPUBuffer coordinate; // array<vec4i>: x, y, z in quanta from constants.origin (2D: z = 0), group
    WGPUBuffer
        motion; // array<vec4f>: velocity, m/s; density less rest density, kg/m^3 (of solids from the fluid near by)
    WGPUBuffer solids; // array<WeirSolidState>, newest; solid_count of them, NULL if there are none
    uint32_t count;    // particles, with empty slots (WEIR_GROUP_EMPTY, anywhere in the arrays)
    uint32_t solid_count;
} WeirGpuParticles;
// False if the simulation does not run on a GPU.
bool weir_gpu_particles(WeirSim *sim, WeirGpuParticles *particles);
