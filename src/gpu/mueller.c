// The method `mueller` on the GPU: the same passes in the same order as src/core/cpu/mueller.c,
// which judges it.
//
// Steps are batched: one compute pass holds as many as a submit may take, with no work for the queue in
// between. Between steps cell_count and the heads of cell_link are zero (density empties them).
#include "gpu/mueller.h"
#include "core/sim.h"
#include "gpu/platform.h"
#include "gpu/solvers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Pairs that a submit may visit: about 50 ms on an integrated GPU, after which a watchdog or a browser's
// frame would suffer, and steps of one submit, after which more would no longer hide anything.
static const double pairs_per_submit = 3e8;
enum { MAX_STEPS_PER_SUBMIT = 64 };

// Where passes are recorded: into one compute pass, or, if measured, each into one of its own.
typedef struct Recorder {
    WeirMueller *solver;
    WGPUCommandEncoder encoder;
    WGPUComputePassEncoder pass; // NULL: measured
} Recorder;

static void record(const Recorder *recorder, WeirPass pass)
{
    WeirMueller *solver = recorder->solver;
    if (recorder->pass) {
        weir_pass_dispatch(&solver->passes, pass, recorder->pass);
        return;
    }
    WGPUComputePassEncoder own = weir_profile_begin_pass(solver->profile, pass, recorder->encoder);
    weir_pass_dispatch(&solver->passes, pass, own);
    weir_profile_end_pass(solver->profile, own);
}

// ---- The step ----

static void evaluate(const Recorder *recorder)
{
    if (recorder->solver->parameters.search == WEIR_SEARCH_ALL_PAIRS) {
        record(recorder, WEIR_PASS_DENSITY_ALL_PAIRS);
        record(recorder, WEIR_PASS_FORCES_ALL_PAIRS);
    } else {
        record(recorder, WEIR_PASS_COUNT);
        record(recorder, WEIR_PASS_SCAN_REDUCE);
        record(recorder, WEIR_PASS_SCAN_WRITE);
        record(recorder, WEIR_PASS_SCATTER);
        record(recorder, WEIR_PASS_DENSITY);
        record(recorder, WEIR_PASS_FORCES);
    }
    ++recorder->solver->device_step; // forces counts it
}

static void take_step(const Recorder *recorder)
{
    evaluate(recorder);
    record(recorder, WEIR_PASS_INTEGRATE);
    ++recorder->solver->steps;
}

WGPUCommandEncoder weir_mueller_commands(WeirMueller *solver, const char *label)
{
    return wgpuDeviceCreateCommandEncoder(solver->gpu->device,
                                          &(WGPUCommandEncoderDescriptor){.label = weir_gpu_text(label)});
}

static Recorder begin_recording(WeirMueller *solver, WGPUCommandEncoder encoder)
{
    WGPUComputePassDescriptor descriptor = {.label = weir_gpu_text("step")};
    return (Recorder){solver, encoder, wgpuCommandEncoderBeginComputePass(encoder, &descriptor)};
}

static void end_recording(const Recorder *recorder)
{
    wgpuComputePassEncoderEnd(recorder->pass);
    wgpuComputePassEncoderRelease(recorder->pass);
}

static uint32_t steps_per_submit(const WeirMueller *solver)
{
    const WeirParameters *parameters = &solver->parameters;
    double count = solver->constants.particle_count;
    double ratio = parameters->support_radius / parameters->particle_spacing;
    // Candidates are about three times the neighbours pi (h / spacing)^2.
    double candidates =
        parameters->search == WEIR_SEARCH_ALL_PAIRS ? count : fmin(count, 3.0 * 3.14 * ratio * ratio);
    double pairs = pairs_per_submit * (solver->gpu->software ? 0.01 : 1.0);
    double steps = pairs / (2.0 * count * candidates);
    return steps < 1.0 ? 1 : steps > MAX_STEPS_PER_SUBMIT ? MAX_STEPS_PER_SUBMIT : (uint32_t)steps;
}

// The device counts steps itself; only a read or a new state puts it out of step with the host.
static void align_step(WeirMueller *solver)
{
    uint32_t step = (uint32_t)solver->steps;
    if (solver->device_step == step) return;
    wgpuQueueWriteBuffer(solver->gpu->queue, solver->buffers.handle[WEIR_BUFFER_health],
                         offsetof(WeirDeviceHealth, step), &step, sizeof step);
    solver->device_step = step;
}

static void submit_steps(WeirMueller *solver, uint32_t steps, bool measured)
{
    align_step(solver);
    WGPUCommandEncoder encoder = weir_mueller_commands(solver, "step");
    if (measured) {
        weir_profile_start(solver->profile);
        take_step(&(Recorder){solver, encoder, NULL});
        weir_profile_resolve(solver->profile, encoder);
        --steps;
    }
    if (steps > 0) {
        Recorder recorder = begin_recording(solver, encoder);
        for (uint32_t n = 0; n < steps; ++n) take_step(&recorder);
        end_recording(&recorder);
    }
    weir_gpu_submit(solver->gpu, encoder, "step");
    if (measured) weir_profile_submitted(solver->profile);
    ++solver->work;
}

static WeirStatus step(WeirSolver *base, uint32_t steps, double until)
{
    (void)until; // steps of one length: the caller counts them
    WeirMueller *solver = (WeirMueller *)base;
    uint32_t most = steps_per_submit(solver);
    weir_profile_poll(solver->profile);
    bool measured = weir_profile_ready(solver->profile);
    while (steps > 0) {
        WeirStatus status = weir_mueller_check(solver);
        if (status != WEIR_OK) return status;
        uint32_t batch = steps < most ? steps : most;
        submit_steps(solver, batch, measured);
        steps -= batch;
        measured = false;
    }
    return weir_mueller_check(solver);
}

void weir_mueller_evaluate(WeirMueller *solver, WGPUCommandEncoder encoder)
{
    Recorder recorder = begin_recording(solver, encoder);
    evaluate(&recorder);
    end_recording(&recorder);
    // The renderer draws the state with the colours of flow: both must have the same order.
    static const WeirBufferName pairs[][2] = {
        {WEIR_BUFFER_sorted_position, WEIR_BUFFER_position},
        {WEIR_BUFFER_sorted_velocity, WEIR_BUFFER_velocity},
        {WEIR_BUFFER_sorted_id, WEIR_BUFFER_id},
    };
    for (size_t n = 0; n < sizeof pairs / sizeof *pairs; ++n) {
        wgpuCommandEncoderCopyBufferToBuffer(encoder, solver->buffers.handle[pairs[n][0]], 0,
                                             solver->buffers.handle[pairs[n][1]], 0,
                                             solver->buffers.size[pairs[n][0]]);
    }
}

// ---- The rest of the solver's contract ----

WeirStatus weir_mueller_check(WeirMueller *solver)
{
    WeirStatus status = weir_report_check(solver->report, &solver->base.message);
    return status == WEIR_OK ? weir_gpu_check(solver->gpu, &solver->base.message) : status;
}

static void destroy(WeirSolver *base)
{
    WeirMueller *solver = (WeirMueller *)base;
    weir_readback_destroy(solver->state_copy);
    weir_readback_destroy(solver->health_copy);
    weir_profile_destroy(solver->profile);
    weir_passes_destroy(&solver->passes);
    if (solver->buffers.gpu) weir_buffers_destroy(&solver->buffers);
    weir_report_destroy(solver->report);
    free(solver->host);
    free(solver);
}

static WeirStatus configure(WeirSolver *base, const WeirParameters *parameters,
                            const WeirConstants *constants)
{
    WeirMueller *solver = (WeirMueller *)base;
    WeirStatus status = weir_mueller_check(solver);
    if (status != WEIR_OK) return status;
    // The layout of cell_link and the sizes of the buffers depend on it; it follows from no live parameter.
    if (constants->cell_count != solver->constants.cell_count)
        return weir_fail(&base->message, WEIR_ERROR_INPUT,
                         "the neighbour grid would change from %u to %u cells: make a new simulation",
                         solver->constants.cell_count, constants->cell_count);
    status = weir_passes_prepare(&solver->passes, parameters, solver->report, &base->message);
    if (status != WEIR_OK) return status;
    solver->parameters = *parameters;
    solver->constants = *constants;
    weir_buffers_write(&solver->buffers, WEIR_BUFFER_parameters, parameters, sizeof *parameters);
    weir_buffers_write(&solver->buffers, WEIR_BUFFER_constants, constants, sizeof *constants);
    return WEIR_OK;
}

// Ids in order, and the positions rounded once.
static WeirStatus write_particles(WeirMueller *solver, const WeirParticles *particles)
{
    uint32_t count = solver->constants.particle_count;
    uint32_t *id = malloc(count * sizeof *id);
    float *position = malloc(2 * (size_t)count * sizeof *position);
    WeirStatus status = id && position ? WEIR_OK : WEIR_ERROR_MEMORY;
    if (status == WEIR_OK) {
        for (uint32_t i = 0; i < count; ++i) id[i] = i;
        for (size_t k = 0; k < 2 * (size_t)count; ++k) position[k] = (float)particles->position[k];
        weir_buffers_write(&solver->buffers, WEIR_BUFFER_id, id, count * sizeof *id);
        weir_buffers_write(&solver->buffers, WEIR_BUFFER_position, position,
                           2 * (size_t)count * sizeof *position);
    }
    free(id);
    free(position);
    return status == WEIR_OK ? status
                             : weir_fail(&solver->base.message, status, "no memory for %u particles", count);
}

static WeirStatus set_state(WeirSolver *base, const WeirParticles *particles)
{
    WeirMueller *solver = (WeirMueller *)base;
    WeirStatus status = weir_mueller_check(solver);
    if (status == WEIR_OK) status = write_particles(solver, particles);
    if (status != WEIR_OK) return status;
    size_t bytes = 2 * sizeof(float) * (size_t)solver->constants.particle_count;
    WeirDeviceHealth health = {.first_bad_step = UINT32_MAX};
    weir_buffers_write(&solver->buffers, WEIR_BUFFER_velocity, particles->velocity, bytes);
    weir_buffers_write(&solver->buffers, WEIR_BUFFER_health, &health, sizeof health);
    solver->steps = solver->device_step = 0;
    solver->health = (WeirHealth){0};
    solver->state_copy_stale = true;
    solver->state_work = ++solver->work;
    // Density and pressure of the new state, for whoever draws it before the first step.
    WGPUCommandEncoder encoder = weir_mueller_commands(solver, "set_state");
    weir_mueller_evaluate(solver, encoder);
    weir_gpu_submit(solver->gpu, encoder, "set_state");
    return weir_mueller_check(solver);
}

static WeirStatus poll(WeirSolver *base, WeirHealth *health)
{
    WeirMueller *solver = (WeirMueller *)base;
    weir_gpu_poll(solver->gpu);
    WeirStatus status = weir_mueller_check(solver);
    if (status == WEIR_OK) {
        weir_profile_poll(solver->profile);
        weir_mueller_poll_health(solver);
        status = weir_mueller_check(solver);
    }
    *health = solver->health;
    return status;
}

static WeirStatus wait_until_done(WeirSolver *base)
{
    WeirMueller *solver = (WeirMueller *)base;
    for (;;) {
        WeirHealth health;
        WeirStatus status = poll(base, &health);
        if (status != WEIR_OK) return status;
        if (solver->health_known_work == solver->work) return WEIR_OK;
        if (!weir_platform_wait(solver->gpu)) return WEIR_PENDING;
    }
}

static uint32_t pass_times(const WeirSolver *base, WeirPassTime *times, uint32_t capacity)
{
    return weir_profile_times(((const WeirMueller *)base)->profile, times, capacity);
}

static const WeirSolverInterface mueller_interface = {
    .destroy = destroy,
    .configure = configure,
    .set_state = set_state,
    .step = step,
    .poll = poll,
    .wait = wait_until_done,
    .read = weir_mueller_read,
    .pass_times = pass_times,
};

static WeirStatus make_copies(WeirMueller *solver, WeirMessage *message)
{
    uint64_t count = solver->constants.particle_count;
    uint64_t bytes = WEIR_STATE_COPY_BYTES * count;
    if (bytes > solver->gpu->limits.maxBufferSize)
        return weir_fail(
            message, WEIR_ERROR_MEMORY,
            "reading %llu particles needs a GPU buffer of %llu MiB, but %s allows %llu MiB; raise "
            "parameters.particle_spacing",
            (unsigned long long)count, (unsigned long long)(bytes >> 20), solver->gpu->name,
            (unsigned long long)(solver->gpu->limits.maxBufferSize >> 20));
    weir_report_begin(solver->report);
    solver->health_copy = weir_readback_create(solver->gpu, "health readback", sizeof(WeirDeviceHealth));
    solver->state_copy = weir_readback_create(solver->gpu, "state readback", bytes);
    weir_report_end(solver->report, "buffer for reading the state");
    solver->host = malloc(count * WEIR_HOST_FLOATS * sizeof *solver->host);
    if (!solver->health_copy || !solver->state_copy || !solver->host)
        return weir_fail(message, WEIR_ERROR_MEMORY, "no host memory for %llu particles",
                         (unsigned long long)count);
    return WEIR_OK;
}

static WeirStatus make(WeirMueller *solver, const WeirSolverSetup *setup, WeirMessage *message)
{
    WeirGpu *gpu = solver->gpu;
    solver->report = weir_report_create(gpu);
    if (!solver->report) return weir_fail(message, WEIR_ERROR_MEMORY, "no memory for a simulation");
    WeirStatus status =
        weir_buffers_create(&solver->buffers, gpu, &setup->constants, solver->report, message);
    if (status != WEIR_OK) return status;
    solver->constants = setup->constants;
    status = make_copies(solver, message);
    if (status != WEIR_OK) return status;
    solver->passes = (WeirPasses){
        .gpu = gpu, .buffers = &solver->buffers, .particle_count = setup->constants.particle_count};
    solver->profile = weir_profile_create(gpu, solver->report);
    status = configure(&solver->base, &setup->parameters, &setup->constants);
    if (status == WEIR_OK) status = set_state(&solver->base, &setup->world->particles);
    if (status != WEIR_OK) *message = solver->base.message;
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
    solver->base.interface = &mueller_interface;
    solver->gpu = gpu;
    snprintf(solver->base.device, sizeof solver->base.device, "%s", gpu->name);
    *status = make(solver, setup, message);
    if (*status == WEIR_OK) return &solver->base;
    destroy(&solver->base);
    return NULL;
}

bool weir_gpu_particles(WeirSim *sim, WeirGpuParticles *particles)
{
    WeirSolver *base = weir_sim_solver(sim);
    if (!base || base->interface != &mueller_interface) return false;
    const WeirMueller *solver = (const WeirMueller *)base;
    *particles = (WeirGpuParticles){
        .gpu = solver->gpu,
        .method = WEIR_METHOD_MUELLER,
        .position = solver->buffers.handle[WEIR_BUFFER_position],
        .velocity = solver->buffers.handle[WEIR_BUFFER_velocity],
        .flow = solver->buffers.handle[WEIR_BUFFER_flow],
        .count = solver->constants.particle_count,
    };
    return true;
}
