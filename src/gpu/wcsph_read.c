// From the device to the host: the clock and the particles' health while steps run, sums over the fluid, and the whole state
// by id.
#include "core/grid.h"
#include "core/solids.h"
#include "gpu/sums.h"
#include "gpu/wcsph.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static double seconds_of(const uint32_t ticks[2])
{
    return ((double)ticks[1] * 4294967296.0 + (double)ticks[0]) / 4398046511104.0; // 2^32, 2^42
}

static float float_of(uint32_t bits)
{
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

// ---- Health ----

void weir_gpu_wcsph_take_health(WeirGpuSolver *common, const void *copy)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)common;
    if (!copy) return;
    uint32_t steps = solver->seen.clock.steps;
    memcpy(&solver->seen, copy, sizeof solver->seen);
    const WeirWcsphControl *seen = &solver->seen;
    const WeirWcsphMaxima *maxima = &seen->maxima[seen->clock.noting];
    if (common->health_known_work == common->work) {
        solver->counted = seen->clock.steps;
        solver->certain = true;
    }
    if (seen->clock.steps < steps) solver->steps_before += (uint64_t)UINT32_MAX + 1;
    const WeirConstants *constants = &common->constants;
    WeirHealth *health = &common->health;
    health->steps = solver->steps_before + seen->clock.steps;
    health->time = seconds_of(seen->clock.time);
    health->time_step = seen->clock.free_dt;
    health->max_speed = sqrtf(float_of(maxima->speed2_bits));
    health->max_density_error = float_of(maxima->excess_bits) / common->parameters.rest_density;
    health->drained_particles = seen->drained;
    health->lost_particles = seen->lost;
    health->fluid_particles = solver->fluid_at_start + seen->emitted - seen->drained - seen->lost;
    if (seen->bad_step == UINT32_MAX) return;
    health->bad_particles = seen->bad_particles;
    health->first_bad_step = solver->steps_before + seen->bad_step;
    health->first_bad_id = seen->bad_id;
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        health->first_bad_position[axis] =
            constants->origin[axis] + (float)seen->bad_place[axis] * constants->quantum;
}

// ---- State ----

// The pieces of the copy, by slot: the first of the working copies; of kicked its first one: acceleration, pressure.
static const struct Piece {
    WeirWcsphBuffer name;
    uint32_t per_particle; // bytes; 0: the whole buffer
    uint32_t copy;
    bool evaluated; // left out where motion alone is wanted
} pieces[WEIR_WCSPH_PIECES] = {
    {WEIR_WCSPH_coordinate, 16, 1, false}, {WEIR_WCSPH_motion, 16, 1, false},
    {WEIR_WCSPH_id, 4, 0, false},          {WEIR_WCSPH_kicked, 16, 0, true},
    {WEIR_WCSPH_solid_state, 0, 0, false}, {WEIR_WCSPH_solid_sum, 0, 0, true},
    {WEIR_WCSPH_control, 0, 0, false},
};

void weir_gpu_wcsph_piece_sizes(const WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL], uint32_t particle_count,
                                uint64_t piece_sizes[WEIR_WCSPH_PIECES])
{
    for (int n = 0; n < WEIR_WCSPH_PIECES; ++n) {
        uint64_t per_particle = pieces[n].per_particle;
        piece_sizes[n] = per_particle > 0 ? per_particle * particle_count : sizes[pieces[n].name].bytes;
    }
}

// After a blow-up: the working copy that the bad step began with is the last good state, and the solids' state before
// that step.
static void restore(WeirWcsphGpu *solver)
{
    static const uint32_t one = 1;
    WeirBuffers *buffers = &solver->common.buffers;
    if (solver->traits.solid_count > 0)
        weir_buffers_write(buffers, WEIR_WCSPH_solid_state, solver->host_solids,
                           solver->traits.solid_count * sizeof *solver->host_solids);
    wgpuQueueWriteBuffer(solver->common.gpu->queue, buffers->handle[WEIR_WCSPH_control][0],
                         offsetof(WeirWcsphControl, restored), &one, sizeof one);
    solver->restored = true;
}

// The state as it is, where motion alone is wanted; otherwise a working copy, on which accelerations, pressures and forces
// on solids are evaluated.
void weir_gpu_wcsph_copy_state(WeirGpuSolver *common)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)common;
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "read");
    bool restores = solver->blown_up && !solver->restored;
    bool motion = common->copied_motion = common->wants_motion && !solver->blown_up;
    if (restores) restore(solver);
    if (!motion)
        weir_gpu_wcsph_evaluate(solver, encoder, restores ? WEIR_EVALUATE_RESTORED : WEIR_EVALUATE_STATE);
    for (uint32_t n = 0; n < WEIR_WCSPH_PIECES; ++n) {
        const WeirBuffers *buffers = &common->buffers;
        if (motion && pieces[n].evaluated) continue;
        uint32_t copy = motion ? 0 : pieces[n].copy;
        bool apart = buffers->parts[pieces[n].name] > 1;
        WGPUBuffer from = buffers->handle[pieces[n].name][apart ? copy : 0];
        uint64_t offset = apart ? 0 : copy * buffers->size[pieces[n].name].bytes;
        weir_readback_copy(common->state_copy.readback, encoder, n, from, offset);
    }
    weir_gpu_submit(common->gpu, encoder, "read");
}

// The copy's pieces.
typedef struct View {
    const int32_t *coordinate; // 4 per particle, like motion and kicked
    const float *motion;
    const uint32_t *id;
    const float *kicked; // acceleration, pressure
    const WeirSolidState *solids;
    const float *sums; // 16 per block
    const WeirWcsphControl *control;
} View;

static View view_of(const WeirGpuSolver *common)
{
    const void *at[WEIR_WCSPH_PIECES];
    for (uint32_t n = 0; n < WEIR_WCSPH_PIECES; ++n) {
        bool came = !(common->copied_motion && pieces[n].evaluated);
        at[n] = came ? weir_readback_data(common->state_copy.readback, n) : NULL;
    }
    return (View){at[0], at[1], at[2], at[3], at[4], at[5], at[6]};
}

void weir_gpu_wcsph_take_solids(WeirWcsphGpu *solver, const WeirSolidState *solids, const float *sums)
{
    const WeirWcsphTraits *traits = &solver->traits;
    memcpy(solver->host_solids, solids, traits->solid_count * sizeof *solver->host_solids);
    for (uint32_t n = 0; n < traits->solid_count; ++n) {
        double force[3] = {0.0, 0.0, 0.0}, torque[3] = {0.0, 0.0, 0.0};
        for (uint32_t b = 0; b < traits->block_count; ++b) {
            if (solver->blocks[b][0] != n) continue;
            for (int axis = 0; axis < 3; ++axis) {
                force[axis] += (double)sums[16 * b + axis];
                torque[axis] += (double)sums[16 * b + 4 + axis];
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            solver->host_solids[n].force[axis] = (float)force[axis];
            solver->host_solids[n].torque[axis] = (float)torque[axis];
        }
    }
}

// Own velocity of a solid's particle; the sorted one is mirrored for the fluid.
static void solid_velocity(const WeirWcsphGpu *solver, uint32_t group, uint32_t id, float velocity[3])
{
    const WeirSolid *solid = &solver->world.solids[group - WEIR_GROUP_SOLID];
    double place[3];
    float v[3] = {0.0f, 0.0f, 0.0f};
    if (solid->kind != WEIR_SOLID_FIXED)
        weir_solid_point(&solver->host_solids[group - WEIR_GROUP_SOLID],
                         solver->local_place + 4 * (size_t)(id - solver->common.constants.first_solid), place,
                         v);
    for (int axis = 0; axis < 3; ++axis) velocity[axis] = v[axis] + solid->surface_velocity[axis];
}

// Places leave a periodic domain a little before they are sorted anew.
static double wrapped(int32_t place, uint32_t period)
{
    if (period == 0) return place;
    return place < 0 ? (double)place + period : place >= (int32_t)period ? (double)place - period : place;
}

void weir_gpu_wcsph_position(const WeirConstants *constants, const int32_t *place, float *position)
{
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        position[axis] =
            (float)((double)constants->origin[axis] +
                    wrapped(place[axis], weir_period(constants, axis)) * (double)constants->quantum);
}

static WeirState order_motion(WeirWcsphGpu *solver, const View *view)
{
    const WeirConstants *constants = &solver->common.constants;
    uint32_t count = constants->particle_count, dimension = constants->dimension;
    float *position = solver->host, *velocity = position + (size_t)dimension * count;
    for (size_t i = 0; i < count; ++i) {
        uint32_t id = view->id[i], group = (uint32_t)view->coordinate[4 * i + 3];
        if (id >= count) continue; // only a broken device could do that
        bool empty = group == WEIR_GROUP_EMPTY, solid = weir_group_is_solid(group);
        float own[3];
        memcpy(own, view->motion + 4 * i, sizeof own);
        if (solid && group - WEIR_GROUP_SOLID < solver->traits.solid_count && id >= constants->first_solid)
            solid_velocity(solver, group, id, own);
        weir_gpu_wcsph_position(constants, view->coordinate + 4 * i, position + (size_t)dimension * id);
        for (uint32_t axis = 0; axis < dimension; ++axis)
            velocity[(size_t)dimension * id + axis] = empty ? 0.0f : own[axis];
        solver->host_group[id] = group;
    }
    return (WeirState){.count = count,
                       .dimension = dimension,
                       .position = position,
                       .velocity = velocity,
                       .group = solver->host_group};
}

static void order_evaluated(WeirWcsphGpu *solver, const View *view, WeirState *state)
{
    size_t count = state->count, dimension = state->dimension;
    float *acceleration = solver->host + 2 * dimension * count;
    float *density = acceleration + dimension * count, *pressure = density + count;
    for (size_t i = 0; i < count; ++i) {
        uint32_t id = view->id[i];
        if (id >= count) continue;
        bool empty = (uint32_t)view->coordinate[4 * i + 3] == WEIR_GROUP_EMPTY;
        for (size_t axis = 0; axis < dimension; ++axis)
            acceleration[dimension * id + axis] = empty ? 0.0f : view->kicked[4 * i + axis];
        density[id] = empty ? 0.0f : solver->common.parameters.rest_density + view->motion[4 * i + 3];
        pressure[id] = empty ? 0.0f : view->kicked[4 * i + 3];
    }
    state->acceleration = acceleration;
    state->density = density;
    state->pressure = pressure;
    state->solids = solver->host_solids;
}

void weir_gpu_wcsph_take_moment(const WeirWcsphGpu *solver, const WeirWcsphControl *control, WeirState *state)
{
    state->step = solver->steps_before + control->clock.steps;
    state->time = seconds_of(control->clock.time);
}

static WeirStatus take_motion(WeirWcsphGpu *solver, const View *view, WeirState *state)
{
    if (!solver->common.wants_motion) return WEIR_PENDING; // by now it is not enough
    if (view->control->bad_step != UINT32_MAX) return WEIR_ERROR_UNSTABLE;
    memcpy(solver->host_solids, view->solids, solver->traits.solid_count * sizeof *solver->host_solids);
    *state = order_motion(solver, view);
    weir_gpu_wcsph_take_moment(solver, view->control, state);
    return WEIR_OK;
}

WeirStatus weir_gpu_wcsph_take_state(WeirGpuSolver *common, void *found)
{
    WeirState *state = found;
    WeirWcsphGpu *solver = (WeirWcsphGpu *)common;
    View view = view_of(common);
    if (common->copied_motion) return take_motion(solver, &view, state);
    bool bad = view.control->bad_step != UINT32_MAX;
    if (bad && !solver->restored) {
        // Nothing was evaluated: copy again what was good.
        size_t count = solver->traits.solid_count;
        memcpy(solver->host_solids, view.solids + 2 * count, count * sizeof *solver->host_solids);
        solver->blown_up = true;
        return WEIR_PENDING;
    }
    weir_gpu_wcsph_take_solids(solver, view.solids, view.sums);
    *state = order_motion(solver, &view);
    order_evaluated(solver, &view, state);
    weir_gpu_wcsph_take_moment(solver, view.control, state);
    if (bad) {
        // The sorted particles are half a step before the end of the bad one.
        --state->step;
        state->time -= 0.5 * (double)view.control->clock.dt;
    }
    return WEIR_OK;
}

// ---- Sums ----

void weir_gpu_wcsph_copy_sums(WeirGpuSolver *common)
{
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "diagnose");
    WeirRecorder recorder = weir_recorder_begin(common, encoder);
    weir_record(&recorder, WEIR_WCSPH_DIAGNOSE);
    weir_recorder_end(&recorder);
    weir_sums_copy(common, encoder, WEIR_WCSPH_fluid_sums);
    weir_gpu_submit(common->gpu, encoder, "diagnose");
}

WeirStatus weir_gpu_wcsph_take_sums(WeirGpuSolver *common, void *found)
{
    const WeirWcsphGpu *solver = (const WeirWcsphGpu *)common;
    WeirDiagnosticSums *sums = found;
    const WeirWcsphControl *control = weir_sums_take(common, sums);
    if (control->bad_step != UINT32_MAX) return WEIR_ERROR_UNSTABLE;
    sums->step = solver->steps_before + control->clock.steps;
    sums->time = seconds_of(control->clock.time);
    return WEIR_OK;
}
