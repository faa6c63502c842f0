// The GPU as a backend: one solver per method.
#include "core/sim.h"
#include "gpu/device.h"
#include "gpu/solvers.h"

WeirSolver *weir_gpu_create_solver(const WeirBackend *backend, const WeirSolverSetup *setup,
                                   WeirStatus *status, WeirMessage *message)
{
    WeirGpu *gpu = ((const WeirGpuBackend *)backend)->gpu;
    *status = weir_gpu_check(gpu, message);
    if (*status != WEIR_OK) return NULL;
    return setup->method == WEIR_METHOD_WCSPH ? weir_wcsph_gpu_create(gpu, setup, status, message)
                                              : weir_mueller_gpu_create(gpu, setup, status, message);
}

bool weir_gpu_particles(WeirSim *sim, WeirGpuParticles *particles)
{
    WeirSolver *solver = weir_sim_solver(sim);
    return solver &&
           (weir_mueller_gpu_particles(solver, particles) || weir_wcsph_gpu_particles(solver, particles));
}
