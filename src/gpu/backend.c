// The GPU as a backend: one solver per method.
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
