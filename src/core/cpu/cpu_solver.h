// What both CPU solvers say of themselves.
#pragma once

#include "core/cpu/pool.h"
#include "core/solver.h"

// Wall clock in seconds; 0 where the target has none (WebAssembly: the page measures there).
double weir_seconds(void);

// WeirSolverInterface.wait: step() returns when it is done.
WeirStatus weir_cpu_wait(WeirSolver *base);

// WeirSolverInterface.pass_times from the last seconds of each of `passes` passes.
uint32_t weir_cpu_pass_times(const char *const *names, const double *seconds, uint32_t passes,
                             WeirPassTime *times, uint32_t capacity);

// Fills the solver's threads and device, such as "CPU, 2 threads, AVX2".
void weir_cpu_describe(WeirSolver *base, const WeirPool *pool, const char *simd);
