// From the device to the host: the particles' health while steps run, sums over them, and the whole state by id.
#include "gpu/mueller.h"
#include "gpu/sums.h"

#include <string.h>

// The device counts steps in 32 bits: the 64-bit step that is not ahead of the steps taken.
static uint64_t widen_step(const WeirMueller *solver, uint32_t low)
{
    uint64_t step = (solver->steps & ~(uint64_t)UINT32_MAX) | low;
    return step > solver->steps ? step - ((uint64_t)UINT32_MAX + 1) : step;
}

void weir_mueller_take_health(WeirGpuSolver *common, const void *copy)
{
    const WeirDeviceHealth *found = copy;
    if (!found || found->first_bad_step == UINT32_MAX) return;
    // The count may have wrapped around to 0 in a long blow-up.
    common->health.bad_particles = found->bad_particles ? found->bad_particles : UINT32_MAX;
    common->health.first_bad_step = widen_step((WeirMueller *)common, found->first_bad_step);
}

// The pieces of the copy, all in the sorted order.
static const struct Piece {
    WeirMuellerBuffer name;
    uint32_t per_particle; // bytes
} pieces[WEIR_MUELLER_PIECES] = {{WEIR_MUELLER_sorted_position, 8},
                                 {WEIR_MUELLER_flow, 16},
                                 {WEIR_MUELLER_acceleration, 8},
                                 {WEIR_MUELLER_sorted_id, 4}};

void weir_mueller_piece_sizes(uint32_t particle_count, uint64_t sizes[WEIR_MUELLER_PIECES])
{
    for (int n = 0; n < WEIR_MUELLER_PIECES; ++n)
        sizes[n] = (uint64_t)pieces[n].per_particle * particle_count;
}

void weir_mueller_copy_state(WeirGpuSolver *common)
{
    WeirMueller *solver = (WeirMueller *)common;
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "read");
    weir_mueller_evaluate(solver, encoder, true);
    for (uint32_t n = 0; n < WEIR_MUELLER_PIECES; ++n)
        weir_readback_copy(common->state_copy.readback, encoder, n, common->buffers.handle[pieces[n].name][0],
                           0);
    weir_gpu_submit(common->gpu, encoder, "read");
    solver->state_copy_step = solver->steps;
}

WeirStatus weir_mueller_take_state(WeirGpuSolver *common, void *found)
{
    WeirState *state = found;
    const WeirMueller *solver = (const WeirMueller *)common;
    uint32_t count = common->constants.particle_count;
    const float *from_position = weir_readback_data(common->state_copy.readback, 0);
    const float *from_flow = weir_readback_data(common->state_copy.readback, 1);
    const float *from_acceleration = weir_readback_data(common->state_copy.readback, 2);
    const uint32_t *from_id = weir_readback_data(common->state_copy.readback, 3);
    float *position = solver->host, *velocity = position + 2 * (size_t)count;
    float *acceleration = velocity + 2 * (size_t)count, *density = acceleration + 2 * (size_t)count;
    float *pressure = density + count;
    for (size_t i = 0; i < count; ++i) {
        size_t id = from_id[i];
        if (id >= count) continue; // only a broken device could do that
        memcpy(position + 2 * id, from_position + 2 * i, 2 * sizeof(float));
        memcpy(velocity + 2 * id, from_flow + 4 * i, 2 * sizeof(float));
        memcpy(acceleration + 2 * id, from_acceleration + 2 * i, 2 * sizeof(float));
        density[id] = from_flow[4 * i + 2];
        pressure[id] = from_flow[4 * i + 3];
    }
    *state = (WeirState){
        .count = count,
        .dimension = 2,
        .step = solver->state_copy_step,
        .position = position,
        .velocity = velocity,
        .acceleration = acceleration,
        .density = density,
        .pressure = pressure,
        .time = -1.0,
    };
    return WEIR_OK;
}

void weir_mueller_copy_sums(WeirGpuSolver *common)
{
    WeirMueller *solver = (WeirMueller *)common;
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "diagnose");
    weir_mueller_evaluate(solver, encoder, false);
    WeirRecorder recorder = weir_recorder_begin(common, encoder);
    weir_record(&recorder, WEIR_MUELLER_DIAGNOSE);
    weir_recorder_end(&recorder);
    weir_sums_copy(common, encoder, WEIR_MUELLER_fluid_sums);
    weir_gpu_submit(common->gpu, encoder, "diagnose");
    solver->sums_copy_step = solver->steps;
}

WeirStatus weir_mueller_take_sums(WeirGpuSolver *common, void *found)
{
    WeirDiagnosticSums *sums = found;
    weir_sums_take(common, sums);
    sums->step = ((const WeirMueller *)common)->sums_copy_step;
    sums->time = -1.0;
    return WEIR_OK;
}
