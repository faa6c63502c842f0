// The CPU as a backend: one solver per method.
#include "core/cpu/solvers.h"

static WeirSolver *create_solver(const WeirBackend *backend, const WeirSolverSetup *setup, WeirStatus *status,
                                 WeirMessage *message)
{
    (void)backend;
    return setup->method == WEIR_METHOD_WCSPH ? weir_wcsph_cpu_create(setup, status, message)
                                              : weir_mueller_cpu_create(setup, status, message);
}

const WeirBackend *weir_cpu_backend(void)
{
    static const WeirBackend backend = {.name = "cpu", .create_solver = create_solver};
    return &backend;
}
