// The method `wcsph` on the CPU.
#include "core/cpu/solvers.h"

WeirSolver *weir_wcsph_cpu_create(const WeirSolverSetup *setup, WeirStatus *status, WeirMessage *message)
{
    (void)setup;
    *status = weir_fail(message, WEIR_ERROR_INPUT, "method: wcsph is not done yet");
    return NULL;
}
