// From the device to the host: the particles' health while steps run, and the whole state by id.
#include "gpu/mueller.h"
#include "gpu/platform.h"

#include <string.h>

// ---- Health ----

// The device counts steps in 32 bits: the 64-bit step that is not ahead of the steps taken.
static uint64_t widen_step(const WeirMueller *solver, uint32_t low)
{
    uint64_t step = (solver->steps & ~(uint64_t)UINT32_MAX) | low;
    return step > solver->steps ? step - ((uint64_t)UINT32_MAX + 1) : step;
}

static void take_health(WeirMueller *solver)
{
    const WeirDeviceHealth *found = weir_readback_data(solver->health_copy);
    solver->health_known_work = solver->health_work;
    if (found && solver->health_work >= solver->state_work && found->first_bad_step != UINT32_MAX) {
        // The count may have wrapped around to 0 in a long blow-up.
        solver->health.bad_particles = found->bad_particles ? found->bad_particles : UINT32_MAX;
        solver->health.first_bad_step = widen_step(solver, found->first_bad_step);
    }
    weir_readback_finish(solver->health_copy);
}

void weir_mueller_poll_health(WeirMueller *solver)
{
    if (weir_readback_state(solver->health_copy) == WEIR_READBACK_READY) take_health(solver);
    bool idle = weir_readback_state(solver->health_copy) == WEIR_READBACK_IDLE;
    if (!idle || solver->health_known_work == solver->work) return;
    WGPUCommandEncoder encoder = weir_mueller_commands(solver, "health");
    weir_readback_copy(solver->health_copy, encoder, solver->buffers.handle[WEIR_BUFFER_health], 0,
                       sizeof(WeirDeviceHealth));
    weir_gpu_submit(solver->gpu, encoder, "health");
    weir_readback_start(solver->health_copy);
    solver->health_work = solver->work;
}

// ---- State ----

// The pieces of the copy, one after the other: position, flow, acceleration, id, all in the sorted order.
static void start_copy(WeirMueller *solver)
{
    static const WeirBufferName names[] = {WEIR_BUFFER_sorted_position, WEIR_BUFFER_flow,
                                           WEIR_BUFFER_acceleration, WEIR_BUFFER_sorted_id};
    WGPUCommandEncoder encoder = weir_mueller_commands(solver, "read");
    weir_mueller_evaluate(solver, encoder);
    uint64_t offset = 0;
    for (size_t n = 0; n < sizeof names / sizeof *names; ++n) {
        uint64_t size = solver->buffers.size[names[n]];
        weir_readback_copy(solver->state_copy, encoder, solver->buffers.handle[names[n]], offset, size);
        offset += size;
    }
    weir_gpu_submit(solver->gpu, encoder, "read");
    weir_readback_start(solver->state_copy);
    solver->state_copy_step = solver->steps;
    solver->state_copy_stale = false;
}

static WeirState order_by_id(const WeirMueller *solver, const void *copy)
{
    uint32_t count = solver->constants.particle_count;
    const float *from_position = copy;
    const float *from_flow = from_position + 2 * (size_t)count;
    const float *from_acceleration = from_flow + 4 * (size_t)count;
    const uint32_t *from_id = (const uint32_t *)(from_acceleration + 2 * (size_t)count);
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
    return (WeirState){
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
}

WeirStatus weir_mueller_read(WeirSolver *base, WeirState *state)
{
    WeirMueller *solver = (WeirMueller *)base;
    for (;;) {
        weir_gpu_poll(solver->gpu);
        WeirStatus status = weir_mueller_check(solver);
        if (status != WEIR_OK) return status;
        switch (weir_readback_state(solver->state_copy)) {
        case WEIR_READBACK_IDLE:
            start_copy(solver);
            break;
        case WEIR_READBACK_PENDING:
            if (!weir_platform_wait(solver->gpu)) return WEIR_PENDING;
            break;
        case WEIR_READBACK_READY: {
            const void *copy = weir_readback_data(solver->state_copy);
            if (copy && !solver->state_copy_stale) *state = order_by_id(solver, copy);
            weir_readback_finish(solver->state_copy);
            if (!copy) return weir_fail(&base->message, WEIR_ERROR_DEVICE, "read: the GPU's copy failed");
            if (!solver->state_copy_stale) return WEIR_OK;
        }
        }
    }
}
