#include "gpu/sums.h"

#include <math.h>

enum { MOST_GROUPS = 256 };
enum { SUMS, HEALTH, PIECES }; // of the copy

uint32_t weir_sums_groups(uint32_t particle_count)
{
    uint32_t groups = weir_workgroups(particle_count);
    return groups < MOST_GROUPS ? groups : MOST_GROUPS;
}

uint64_t weir_sums_bytes(uint32_t particle_count)
{
    return weir_sums_groups(particle_count) * sizeof(WeirGpuSums);
}

WeirReadback *weir_sums_readback(const WeirGpuSolver *solver)
{
    const uint64_t sizes[PIECES] = {weir_sums_bytes(solver->constants.particle_count), solver->health_size};
    return weir_readback_create(solver->gpu, "sums readback", PIECES, sizes);
}

void weir_sums_copy(WeirGpuSolver *solver, WGPUCommandEncoder encoder, uint32_t sums)
{
    WeirReadback *readback = solver->sums_copy.readback;
    weir_readback_copy(readback, encoder, SUMS, solver->buffers.handle[sums][0], 0);
    weir_readback_copy(readback, encoder, HEALTH, solver->buffers.handle[solver->health_buffer][0], 0);
}

const void *weir_sums_take(const WeirGpuSolver *solver, WeirDiagnosticSums *sums)
{
    const WeirGpuSums *parts = weir_readback_data(solver->sums_copy.readback, SUMS);
    *sums = (WeirDiagnosticSums){0};
    for (uint32_t n = 0; n < weir_sums_groups(solver->constants.particle_count); ++n) {
        const WeirGpuSums *part = &parts[n];
        for (int axis = 0; axis < 3; ++axis) {
            sums->place[axis] += (double)part->place[axis];
            sums->velocity[axis] += (double)part->velocity[axis];
        }
        sums->speed2 += (double)part->speed2;
        sums->density_error += (double)part->density_error;
        sums->speed2_max = fmax(sums->speed2_max, (double)part->speed2_max);
        sums->density_error_max = fmax(sums->density_error_max, (double)part->density_error_max);
        sums->particles += (uint64_t)part->particles;
        sums->lost += (uint64_t)part->lost;
    }
    return weir_readback_data(solver->sums_copy.readback, HEALTH);
}
