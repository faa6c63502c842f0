#include "core/cpu/cpu_solver.h"

#include <stdio.h>
#include <time.h>

double weir_seconds(void)
{
#if defined(__wasm__)
    return 0.0;
#else
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
#endif
}

WeirStatus weir_cpu_wait(WeirSolver *base)
{
    (void)base;
    return WEIR_OK;
}

uint32_t weir_cpu_pass_times(const char *const *names, const double *seconds, uint32_t passes,
                             WeirPassTime *times, uint32_t capacity)
{
    if (weir_seconds() == 0.0) return 0; // no clock on this target
    for (uint32_t n = 0; n < passes && n < capacity; ++n)
        times[n] = (WeirPassTime){names[n], 1000.0 * seconds[n]};
    return passes;
}

void weir_cpu_describe(WeirSolver *base, const WeirPool *pool, const char *simd)
{
    base->threads = weir_pool_threads(pool);
    snprintf(base->device, sizeof base->device, "CPU, %u thread%s, %s", base->threads,
             base->threads == 1 ? "" : "s", simd);
}
