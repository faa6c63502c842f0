// A state of the CPU solver on the device, laid out as the GPU solver of wcsph lays out its own.
#pragma once

#include "core/sim.h"
#include "gpu/gpu.h"

// False if the device or memory fails. Release with weir_upload_release().
bool weir_upload_arrays(WeirGpu *gpu, int32_t (*coordinate)[4], float (*motion)[4], uint32_t count,
                        WeirGpuParticles *particles);
// False if the device or memory fails, or the simulation cannot be read.
bool weir_upload(WeirGpu *gpu, WeirSim *cpu, WeirGpuParticles *particles);
// Adds the solids' states to particles that have been uploaded.
bool weir_upload_solids(WeirGpuParticles *particles, const WeirSolidState *states, uint32_t count);
void weir_upload_release(WeirGpuParticles *particles);
