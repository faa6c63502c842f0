#include "gpu/solver.h"
#include "gpu/parallelism.h"
#include "gpu/platform.h"
#include "gpu/sums.h"

// Time of a submit, pairs that it may visit while no step was measured, and steps of one, after which more would no
// longer hide anything.
static const double milliseconds_per_submit = 40.0, pairs_per_submit = 3e8;
enum { MAX_STEPS_PER_SUBMIT = 64 };

// ---- Making ----

static WeirStatus make_copies(WeirGpuSolver *solver, uint32_t pieces, const uint64_t *sizes,
                              WeirMessage *message)
{
    unsigned long long count = solver->constants.particle_count, most = solver->gpu->limits.maxBufferSize;
    for (uint32_t n = 0; n < pieces; ++n) {
        if (sizes[n] <= most) continue;
        return weir_fail(
            message, WEIR_ERROR_MEMORY,
            "reading %llu particles needs a GPU buffer of %llu MiB, but %s allows %llu MiB; raise "
            "parameters.particle_spacing",
            count, (unsigned long long)(sizes[n] >> 20), solver->gpu->name, most >> 20);
    }
    weir_report_begin(solver->report);
    solver->health_copy = weir_readback_create(solver->gpu, "health readback", 1, &solver->health_size);
    solver->state_copy.readback = weir_readback_create(solver->gpu, "state readback", pieces, sizes);
    solver->sums_copy.readback = weir_sums_readback(solver);
    weir_report_end(solver->report, "buffer for reading the state");
    if (!solver->health_copy || !solver->state_copy.readback || !solver->sums_copy.readback)
        return weir_fail(message, WEIR_ERROR_MEMORY, "no host memory for %llu particles", count);
    return WEIR_OK;
}

WeirStatus weir_gpu_solver_make(WeirGpuSolver *solver, const WeirMethodInfo *method,
                                const WeirBufferSize *sizes, uint32_t scan_blocks, uint32_t pieces,
                                const uint64_t *piece_sizes, WeirMessage *message)
{
    WeirGpu *gpu = solver->gpu;
    solver->report = weir_report_create(gpu);
    if (!solver->report) return weir_fail(message, WEIR_ERROR_MEMORY, "no memory for a simulation");
    solver->buffers = (WeirBuffers){.gpu = gpu, .info = method->buffers, .count = method->buffer_count};
    solver->passes = (WeirPasses){.gpu = gpu,
                                  .method = method,
                                  .buffers = &solver->buffers,
                                  .share_threads = WEIR_WORKGROUP_SIZE,
                                  .in_background = weir_platform_compiles_in_background()};
    WeirStatus status = weir_buffers_plan(&solver->buffers, sizes, &solver->constants, message);
    if (status == WEIR_OK) status = weir_passes_check(&solver->passes, message);
    if (status != WEIR_OK) return status;
    weir_buffers_create(&solver->buffers, solver->report);
    for (uint32_t name = 0; name < method->buffer_count; ++name)
        solver->base.memory += weir_buffers_bytes(&solver->buffers, name);
    status = make_copies(solver, pieces, piece_sizes, message);
    if (status != WEIR_OK) return status;
    uint32_t particles = solver->constants.particle_count;
    solver->passes.groups[WEIR_ITEMS_PARTICLES] = weir_workgroups(particles);
    solver->passes.groups[WEIR_ITEMS_CELL_BLOCKS] = scan_blocks;
    solver->passes.groups[WEIR_ITEMS_ONE] = 1;
    solver->passes.groups[WEIR_ITEMS_SUMS] = weir_sums_groups(particles);
    solver->profile = weir_profile_create(gpu, solver->report);
    return WEIR_OK;
}

void weir_gpu_solver_destroy(WeirGpuSolver *solver)
{
    weir_readback_destroy(solver->state_copy.readback);
    weir_readback_destroy(solver->sums_copy.readback);
    weir_readback_destroy(solver->gather_copy.readback);
    weir_readback_destroy(solver->health_copy);
    weir_profile_destroy(solver->profile);
    weir_passes_destroy(&solver->passes);
    weir_buffers_destroy(&solver->buffers);
    weir_report_destroy(solver->report);
}

static bool pipelines_are_under_way(const WeirGpuSolver *solver)
{
    return solver->passes.in_background && weir_report_pending(solver->report);
}

WeirStatus weir_gpu_solver_begin(WeirGpuSolver *solver)
{
    solver->starting = !solver->running && pipelines_are_under_way(solver);
    if (solver->starting) return WEIR_OK;
    solver->running = true;
    weir_passes_keep(&solver->passes);
    return solver->start(solver);
}

static void take_change(WeirGpuSolver *solver)
{
    solver->base.changing = false;
    weir_passes_use_prepared(&solver->passes);
    if (solver->running) weir_passes_keep(&solver->passes);
    solver->parameters = solver->wanted_parameters;
    solver->constants = solver->wanted_constants;
    // The two uniforms come first in every method's list.
    weir_buffers_write(&solver->buffers, 0, &solver->parameters, sizeof solver->parameters);
    weir_buffers_write(&solver->buffers, 1, &solver->constants, sizeof solver->constants);
    if (solver->take_change) solver->take_change(solver);
}

// What is wanted by now may need other pipelines than those that have just come.
static WeirStatus pursue_change(WeirGpuSolver *solver)
{
    if (!solver->base.changing || (solver->running && pipelines_are_under_way(solver))) return WEIR_OK;
    char settings[WEIR_SETTINGS_LENGTH];
    uint32_t needed = solver->choose(solver, settings);
    WeirStatus status =
        weir_passes_prepare(&solver->passes, settings, needed, solver->report, &solver->base.message);
    if (status == WEIR_OK && !(solver->running && pipelines_are_under_way(solver))) take_change(solver);
    return status;
}

WeirStatus weir_gpu_solver_ready(WeirGpuSolver *solver)
{
    WeirStatus status = weir_report_check(solver->report, &solver->base.message);
    if (status == WEIR_OK) status = weir_gpu_check(solver->gpu, &solver->base.message);
    if (status == WEIR_OK && solver->starting) status = weir_gpu_solver_begin(solver);
    if (status == WEIR_OK) status = pursue_change(solver);
    return status == WEIR_OK && solver->starting ? WEIR_PENDING : status;
}

WeirStatus weir_gpu_solver_configure(WeirSolver *base, const WeirParameters *parameters,
                                     const WeirConstants *constants)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    WeirStatus status = weir_gpu_solver_ready(solver);
    if (status != WEIR_OK) return status;
    // The layout of cell_link and the sizes of the buffers depend on it; it follows from no live parameter.
    if (constants->cell_count != solver->constants.cell_count)
        return weir_fail(&base->message, WEIR_ERROR_INPUT,
                         "the neighbour grid would change from %u to %u cells: make a new simulation",
                         solver->constants.cell_count, constants->cell_count);
    solver->wanted_parameters = *parameters;
    solver->wanted_constants = *constants;
    base->changing = true;
    return pursue_change(solver);
}

// ---- Recording ----

WGPUCommandEncoder weir_gpu_solver_commands(WeirGpuSolver *solver, const char *label)
{
    return wgpuDeviceCreateCommandEncoder(solver->gpu->device,
                                          &(WGPUCommandEncoderDescriptor){.label = weir_gpu_text(label)});
}

WeirRecorder weir_recorder_begin(WeirGpuSolver *solver, WGPUCommandEncoder encoder)
{
    WGPUComputePassDescriptor descriptor = {.label = weir_gpu_text("step")};
    return (WeirRecorder){solver, encoder, wgpuCommandEncoderBeginComputePass(encoder, &descriptor)};
}

WeirRecorder weir_recorder_measure(WeirGpuSolver *solver, WGPUCommandEncoder encoder)
{
    weir_profile_start(solver->profile);
    return (WeirRecorder){solver, encoder, NULL};
}

WeirRecorder weir_recorder_batch(WeirGpuSolver *solver, WGPUCommandEncoder encoder, uint32_t steps,
                                 bool measured)
{
    if (!measured) return weir_recorder_begin(solver, encoder);
    return (WeirRecorder){solver, encoder, weir_profile_begin_batch(solver->profile, steps, encoder)};
}

// Where a pass goes, in a measured step one of its own; then it is to be ended.
static WGPUComputePassEncoder pass_encoder(const WeirRecorder *recorder, uint32_t pass)
{
    const WeirGpuSolver *solver = recorder->solver;
    if (recorder->pass) return recorder->pass;
    return weir_profile_begin_pass(solver->profile, solver->passes.method->passes[pass].name,
                                   recorder->encoder);
}

void weir_record(const WeirRecorder *recorder, uint32_t pass)
{
    WGPUComputePassEncoder encoder = pass_encoder(recorder, pass);
    weir_pass_dispatch(&recorder->solver->passes, pass, encoder);
    if (!recorder->pass) weir_profile_end_pass(recorder->solver->profile, encoder);
}

void weir_record_turn(const WeirRecorder *recorder, uint32_t pass, uint32_t turn)
{
    WGPUComputePassEncoder encoder = pass_encoder(recorder, pass);
    weir_pass_dispatch_turn(&recorder->solver->passes, pass, turn, encoder);
    if (!recorder->pass) weir_profile_end_pass(recorder->solver->profile, encoder);
}

void weir_record_indirect(const WeirRecorder *recorder, uint32_t pass, uint32_t sizes, uint64_t offset)
{
    WeirGpuSolver *solver = recorder->solver;
    WGPUComputePassEncoder encoder = pass_encoder(recorder, pass);
    weir_pass_dispatch_indirect(&solver->passes, pass, encoder, solver->buffers.handle[sizes][0], offset);
    if (!recorder->pass) weir_profile_end_pass(solver->profile, encoder);
}

void weir_recorder_end(const WeirRecorder *recorder)
{
    if (!recorder->pass) return; // each pass has ended its own
    wgpuComputePassEncoderEnd(recorder->pass);
    wgpuComputePassEncoderRelease(recorder->pass);
}

void weir_gpu_solver_submit_steps(WeirGpuSolver *solver, WGPUCommandEncoder encoder, bool measured)
{
    if (measured) weir_profile_resolve(solver->profile, encoder);
    weir_gpu_submit(solver->gpu, encoder, "step");
    if (measured) weir_profile_submitted(solver->profile);
    ++solver->work;
}

uint32_t weir_steps_per_submit(const WeirGpuSolver *solver, double pairs)
{
    double measured = weir_profile_step(solver->profile);
    double device = solver->gpu->software ? 0.01 : weir_parallelism_ratio(solver->gpu);
    double steps = measured > 0.0 ? milliseconds_per_submit / measured : device * pairs_per_submit / pairs;
    return steps < 1.0 ? 1 : steps > MAX_STEPS_PER_SUBMIT ? MAX_STEPS_PER_SUBMIT : (uint32_t)steps;
}

// ---- Health ----

static void poll_health(WeirGpuSolver *solver)
{
    if (weir_readback_state(solver->health_copy) == WEIR_READBACK_READY) {
        const void *found = weir_readback_data(solver->health_copy, 0);
        solver->health_known_work = solver->health_work;
        if (solver->health_work >= solver->state_work) solver->take_health(solver, found);
        weir_readback_finish(solver->health_copy);
    }
    bool idle = weir_readback_state(solver->health_copy) == WEIR_READBACK_IDLE;
    if (!idle || solver->health_known_work == solver->work) return;
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(solver, "health");
    weir_readback_copy(solver->health_copy, encoder, 0, solver->buffers.handle[solver->health_buffer][0], 0);
    weir_gpu_submit(solver->gpu, encoder, "health");
    weir_readback_start(solver->health_copy);
    solver->health_work = solver->work;
}

WeirStatus weir_gpu_solver_poll(WeirSolver *base, WeirHealth *health)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    weir_gpu_poll(solver->gpu);
    WeirStatus status = weir_gpu_solver_ready(solver);
    if (status == WEIR_OK) {
        weir_profile_poll(solver->profile);
        poll_health(solver);
        status = weir_gpu_solver_ready(solver);
    }
    *health = solver->health;
    return status;
}

WeirStatus weir_gpu_solver_wait(WeirSolver *base)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    for (;;) {
        WeirHealth health;
        WeirStatus status = weir_gpu_solver_poll(base, &health);
        if (status != WEIR_OK) return status;
        if (solver->health_known_work == solver->work) return WEIR_OK;
        if (!weir_platform_wait(solver->gpu)) return WEIR_PENDING;
    }
}

// ---- State ----

void weir_gpu_solver_replaced(WeirGpuSolver *solver)
{
    solver->state_copy.stale = solver->sums_copy.stale = solver->gather_copy.stale = true;
    solver->state_work = ++solver->work;
}

// What `copy` gives, as soon as it is there.
static WeirStatus fetch(WeirGpuSolver *solver, WeirGpuCopy *copy, const char *what, void *found)
{
    for (;;) {
        weir_gpu_poll(solver->gpu);
        WeirStatus status = weir_gpu_solver_ready(solver);
        if (status != WEIR_OK) return status;
        switch (weir_readback_state(copy->readback)) {
        case WEIR_READBACK_IDLE:
            copy->stale = false;
            copy->queue(solver);
            weir_readback_start(copy->readback);
            break;
        case WEIR_READBACK_PENDING:
            if (!weir_platform_wait(solver->gpu)) return WEIR_PENDING;
            break;
        case WEIR_READBACK_READY: {
            bool came = weir_readback_data(copy->readback, 0) != NULL, stale = copy->stale;
            if (came && !stale) status = copy->take(solver, found);
            weir_readback_finish(copy->readback);
            if (!came)
                return weir_fail(&solver->base.message, WEIR_ERROR_DEVICE, "%s: the GPU's copy failed", what);
            if (!stale && status != WEIR_PENDING) return status;
        }
        }
    }
}

WeirStatus weir_gpu_solver_read(WeirSolver *base, WeirState *state)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    solver->wants_motion = false;
    return fetch(solver, &solver->state_copy, "read", state);
}

WeirStatus weir_gpu_solver_read_motion(WeirSolver *base, WeirState *state)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    solver->wants_motion = true;
    return fetch(solver, &solver->state_copy, "read_motion", state);
}

WeirStatus weir_gpu_solver_diagnose(WeirSolver *base, WeirDiagnosticSums *sums)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    return fetch(solver, &solver->sums_copy, "diagnose", sums);
}

WeirStatus weir_gpu_solver_gather(WeirSolver *base, WeirGathered *gathered)
{
    WeirGpuSolver *solver = (WeirGpuSolver *)base;
    return fetch(solver, &solver->gather_copy, "gather", gathered);
}

uint32_t weir_gpu_solver_pass_times(const WeirSolver *base, WeirPassTime *times, uint32_t capacity)
{
    return weir_profile_times(((const WeirGpuSolver *)base)->profile, times, capacity);
}

double weir_gpu_solver_step_time(const WeirSolver *base)
{
    return weir_profile_step(((const WeirGpuSolver *)base)->profile);
}
