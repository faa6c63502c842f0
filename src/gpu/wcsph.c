// The method `wcsph` on the GPU.
#include "gpu/solvers.h"

WeirSolver *weir_wcsph_gpu_create(WeirGpu *gpu, const WeirSolverSetup *setup, WeirStatus *status,
                                  WeirMessage *message)
{
    (void)gpu, (void)setup;
    *status = weir_fail(message, WEIR_ERROR_INPUT, "method: wcsph does not run on the GPU yet; use the CPU");
    return NULL;
}
