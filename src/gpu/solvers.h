// The GPU's solvers, one per method.
#pragma once

#include "gpu/gpu.h"

// `create_solver` of a WeirGpuBackend.
WeirSolver *weir_gpu_create_solver(const WeirBackend *backend, const WeirSolverSetup *setup,
                                   WeirStatus *status, WeirMessage *message);
// On failure NULL, with *status and message set. The device is ready.
WeirSolver *weir_mueller_gpu_create(WeirGpu *gpu, const WeirSolverSetup *setup, WeirStatus *status,
                                    WeirMessage *message);
WeirSolver *weir_wcsph_gpu_create(WeirGpu *gpu, const WeirSolverSetup *setup, WeirStatus *status,
                                  WeirMessage *message);
// For weir_gpu_particles(): false if `solver` is another one.
bool weir_mueller_gpu_particles(const WeirSolver *solver, WeirGpuParticles *particles);
bool weir_wcsph_gpu_particles(const WeirSolver *solver, WeirGpuParticles *particles);
