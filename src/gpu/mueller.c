// The method `mueller` on the GPU: the same passes in the same order as src/core/cpu/mueller.c,
// which judges it.
//
// Steps are batched: one compute pass holds as many as a submit may take, with no work for the queue in
// between. Between steps cell_count and the heads of cell_link are zero (scan_write and density empty them).
#include "gpu/mueller.h"
#include "gpu/solvers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- The step ----

static bool searches_all_pairs(const WeirMueller *solver)
{
    return solver->common.parameters.search == WEIR_SEARCH_ALL_PAIRS;
}

static void record_density(const WeirMueller *solver, const WeirRecorder *recorder)
{
    if (searches_all_pairs(solver)) {
        weir_record(recorder, WEIR_MUELLER_DENSITY_ALL_PAIRS);
        return;
    }
    weir_record(recorder, WEIR_MUELLER_COUNT);
    weir_record(recorder, WEIR_MUELLER_SCAN_REDUCE);
    weir_record(recorder, WEIR_MUELLER_SCAN_WRITE);
    weir_record(recorder, WEIR_MUELLER_SCATTER);
    weir_record(recorder, WEIR_MUELLER_DENSITY);
}

static void record_forces(WeirMueller *solver, const WeirRecorder *recorder)
{
    weir_record(recorder, searches_all_pairs(solver) ? WEIR_MUELLER_FORCES_ALL_PAIRS : WEIR_MUELLER_FORCES);
    ++solver->device_step; // forces counts it
}

static void take_step(WeirMueller *solver, const WeirRecorder *recorder)
{
    record_density(solver, recorder);
    record_forces(solver, recorder);
    weir_record(recorder, WEIR_MUELLER_INTEGRATE);
    ++solver->steps;
}

static uint32_t steps_per_submit(const WeirGpuSolver *solver)
{
    const WeirParameters *parameters = &solver->parameters;
    double count = solver->constants.particle_count;
    double ratio = parameters->support_radius / parameters->particle_spacing;
    // Candidates are about three times the neighbours pi (h / spacing)^2.
    double candidates =
        parameters->search == WEIR_SEARCH_ALL_PAIRS ? count : fmin(count, 3.0 * 3.14 * ratio * ratio);
    return weir_steps_per_submit(solver, 2.0 * count * candidates);
}

// The device counts steps itself; only a read or a new state puts it out of step with the host.
static void align_step(WeirMueller *solver)
{
    uint32_t step = (uint32_t)solver->steps;
    if (solver->device_step == step) return;
    wgpuQueueWriteBuffer(solver->common.gpu->queue, solver->common.buffers.handle[WEIR_MUELLER_health][0],
                         offsetof(WeirDeviceHealth, step), &step, sizeof step);
    solver->device_step = step;
}

static void submit_steps(WeirMueller *solver, uint32_t steps, bool measured)
{
    WeirGpuSolver *common = &solver->common;
    align_step(solver);
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "step");
    if (measured) {
        WeirRecorder recorder = weir_recorder_measure(common, encoder);
        take_step(solver, &recorder);
        weir_recorder_end(&recorder);
        --steps;
    }
    if (steps > 0) {
        WeirRecorder recorder = weir_recorder_batch(common, encoder, steps, measured);
        for (uint32_t n = 0; n < steps; ++n) take_step(solver, &recorder);
        weir_recorder_end(&recorder);
    }
    weir_gpu_solver_submit_steps(common, encoder, measured);
}

static WeirStatus step(WeirSolver *base, uint32_t steps, double until)
{
    (void)until; // steps of one length: the caller counts them
    WeirMueller *solver = (WeirMueller *)base;
    weir_profile_poll(solver->common.profile);
    uint32_t most = steps_per_submit(&solver->common);
    bool measured = weir_profile_ready(solver->common.profile);
    while (steps > 0) {
        WeirStatus status = weir_gpu_solver_ready(&solver->common);
        if (status != WEIR_OK) return status;
        uint32_t batch = steps < most ? steps : most;
        submit_steps(solver, batch, measured);
        steps -= batch;
        measured = false;
    }
    return weir_gpu_solver_ready(&solver->common);
}

void weir_mueller_evaluate(WeirMueller *solver, WGPUCommandEncoder encoder, bool accelerations)
{
    WeirRecorder recorder = weir_recorder_begin(&solver->common, encoder);
    record_density(solver, &recorder);
    if (accelerations) record_forces(solver, &recorder);
    weir_recorder_end(&recorder);
    // The renderer draws the state with the colours of flow: both must have the same order.
    static const WeirMuellerBuffer pairs[][2] = {
        {WEIR_MUELLER_sorted_position, WEIR_MUELLER_position},
        {WEIR_MUELLER_sorted_velocity, WEIR_MUELLER_velocity},
        {WEIR_MUELLER_sorted_id, WEIR_MUELLER_id},
    };
    const WeirBuffers *buffers = &solver->common.buffers;
    for (size_t n = 0; n < sizeof pairs / sizeof *pairs; ++n) {
        wgpuCommandEncoderCopyBufferToBuffer(encoder, buffers->handle[pairs[n][0]][0], 0,
                                             buffers->handle[pairs[n][1]][0], 0,
                                             buffers->size[pairs[n][0]].bytes);
    }
}

// ---- The rest of the solver's contract ----

static void destroy(WeirSolver *base)
{
    WeirMueller *solver = (WeirMueller *)base;
    weir_gpu_solver_destroy(&solver->common);
    free(solver->host);
    free(solver);
}

static uint32_t choose(const WeirGpuSolver *solver, char settings[WEIR_SETTINGS_LENGTH])
{
    return weir_mueller_settings(solver->gpu, &solver->wanted_parameters, &solver->wanted_constants,
                                 settings);
}

// Ids in order, and the positions rounded once.
static WeirStatus write_particles(WeirGpuSolver *solver, const WeirParticles *particles)
{
    uint32_t count = solver->constants.particle_count;
    uint32_t *id = malloc(count * sizeof *id);
    float *position = malloc(2 * (size_t)count * sizeof *position);
    WeirStatus status = id && position ? WEIR_OK : WEIR_ERROR_MEMORY;
    if (status == WEIR_OK) {
        for (uint32_t i = 0; i < count; ++i) id[i] = i;
        for (size_t k = 0; k < 2 * (size_t)count; ++k) position[k] = (float)particles->position[k];
        weir_buffers_write(&solver->buffers, WEIR_MUELLER_id, id, count * sizeof *id);
        weir_buffers_write(&solver->buffers, WEIR_MUELLER_position, position,
                           2 * (size_t)count * sizeof *position);
    }
    free(id);
    free(position);
    return status == WEIR_OK ? status
                             : weir_fail(&solver->base.message, status, "no memory for %u particles", count);
}

static WeirStatus write_state(WeirMueller *solver, const WeirParticles *particles)
{
    WeirGpuSolver *common = &solver->common;
    WeirStatus status = write_particles(common, particles);
    if (status != WEIR_OK) return status;
    size_t bytes = 2 * sizeof(float) * (size_t)common->constants.particle_count;
    WeirDeviceHealth health = {.first_bad_step = UINT32_MAX};
    weir_buffers_write(&common->buffers, WEIR_MUELLER_velocity, particles->velocity, bytes);
    weir_buffers_write(&common->buffers, WEIR_MUELLER_health, &health, sizeof health);
    solver->steps = solver->device_step = 0;
    common->health = (WeirHealth){0};
    weir_gpu_solver_replaced(common);
    return WEIR_OK;
}

// Density and pressure of the new state, for whoever draws it before the first step.
static WeirStatus start(WeirGpuSolver *common)
{
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "set_state");
    weir_mueller_evaluate((WeirMueller *)common, encoder, true);
    weir_gpu_submit(common->gpu, encoder, "set_state");
    return weir_gpu_solver_ready(common);
}

static WeirStatus set_state(WeirSolver *base, const WeirParticles *particles)
{
    WeirMueller *solver = (WeirMueller *)base;
    WeirStatus status = weir_gpu_solver_ready(&solver->common);
    if (status == WEIR_OK) status = write_state(solver, particles);
    return status == WEIR_OK ? weir_gpu_solver_begin(&solver->common) : status;
}

static const WeirSolverInterface mueller_interface = {
    .destroy = destroy,
    .configure = weir_gpu_solver_configure,
    .set_state = set_state,
    .step = step,
    .poll = weir_gpu_solver_poll,
    .wait = weir_gpu_solver_wait,
    .read = weir_gpu_solver_read,
    .diagnose = weir_gpu_solver_diagnose,
    .pass_times = weir_gpu_solver_pass_times,
    .step_time = weir_gpu_solver_step_time,
};

static WeirStatus make(WeirMueller *solver, const WeirSolverSetup *setup, WeirMessage *message)
{
    WeirGpuSolver *common = &solver->common;
    WeirBufferSize sizes[WEIR_MUELLER_BUFFER_TOTAL] = {{0}};
    uint64_t pieces[WEIR_MUELLER_PIECES], count = setup->constants.particle_count;
    weir_mueller_sizes(&setup->constants, sizes);
    weir_mueller_piece_sizes((uint32_t)count, pieces);
    common->constants = setup->constants;
    uint32_t scan_blocks = (uint32_t)(sizes[WEIR_MUELLER_block_sum].bytes / 4);
    WeirStatus status = weir_gpu_solver_make(common, &weir_mueller_method, sizes, scan_blocks,
                                             WEIR_MUELLER_PIECES, pieces, message);
    if (status != WEIR_OK) return status;
    solver->host = malloc(count * WEIR_HOST_FLOATS * sizeof *solver->host);
    if (!solver->host)
        return weir_fail(message, WEIR_ERROR_MEMORY, "no host memory for %llu particles",
                         (unsigned long long)count);
    uint32_t threads = (uint32_t)count * weir_mueller_lanes(common->gpu, (uint32_t)count);
    common->passes.groups[WEIR_ITEMS_SHARES] = weir_workgroups(threads);
    status = weir_gpu_solver_configure(&common->base, &setup->parameters, &setup->constants);
    if (status == WEIR_OK) status = set_state(&common->base, &setup->world->particles);
    if (status != WEIR_OK) *message = common->base.message;
    return status;
}

WeirSolver *weir_mueller_gpu_create(WeirGpu *gpu, const WeirSolverSetup *setup, WeirStatus *status,
                                    WeirMessage *message)
{
    WeirMueller *solver = calloc(1, sizeof *solver);
    if (!solver) {
        *status = weir_fail(message, WEIR_ERROR_MEMORY, "no memory for a simulation");
        return NULL;
    }
    WeirGpuSolver *common = &solver->common;
    common->base.interface = &mueller_interface;
    common->gpu = gpu;
    common->start = start;
    common->choose = choose;
    common->health_buffer = WEIR_MUELLER_health;
    common->health_size = sizeof(WeirDeviceHealth);
    common->take_health = weir_mueller_take_health;
    common->state_copy = (WeirGpuCopy){.queue = weir_mueller_copy_state, .take = weir_mueller_take_state};
    common->sums_copy = (WeirGpuCopy){.queue = weir_mueller_copy_sums, .take = weir_mueller_take_sums};
    snprintf(common->base.device, sizeof common->base.device, "%s", gpu->name);
    *status = make(solver, setup, message);
    if (*status == WEIR_OK) return &common->base;
    destroy(&common->base);
    return NULL;
}

bool weir_mueller_gpu_particles(const WeirSolver *base, WeirGpuParticles *particles)
{
    if (base->interface != &mueller_interface) return false;
    const WeirGpuSolver *solver = (const WeirGpuSolver *)base;
    *particles = (WeirGpuParticles){
        .gpu = solver->gpu,
        .method = WEIR_METHOD_MUELLER,
        .position = solver->buffers.handle[WEIR_MUELLER_position][0],
        .velocity = solver->buffers.handle[WEIR_MUELLER_velocity][0],
        .flow = solver->buffers.handle[WEIR_MUELLER_flow][0],
        .count = solver->constants.particle_count,
    };
    return true;
}
