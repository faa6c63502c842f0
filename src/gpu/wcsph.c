// The method `wcsph` on the GPU: the same passes as src/core/cpu/wcsph.c, which judges it, fused where nothing stands
// between them (docs/wcsph.md, gpu/wcsph.h).
//
// Steps are batched: one compute pass holds as many as a submit may take. The device chooses the time steps by itself;
// steps that are left when `until` is reached, or after a blow-up, find control.running at 0 and do nothing. Between
// steps cell_count and the heads of cell_link are zero (scan_write and forces empty them).
#include "gpu/wcsph.h"
#include "gpu/parallelism.h"
#include "gpu/platform.h"
#include "gpu/solvers.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

// Workgroups that fill a large device; passes that often have nothing to do start no more of them. From so many on it costs
// less that the device starts none then: measured on an H100, 10 us of a dispatch become 4.
enum { MOST_SORTING = 8192, LEAST_INDIRECT = 1024 };

// So that all of a simulation in 3D with about 37 neighbours takes 16 GiB.
static const uint64_t usual_list_bytes = (uint64_t)8 << 30;

// ---- The step ----

// A pass of a sort.
static void record_sorting(const WeirRecorder *recorder, uint32_t pass, uint32_t size, bool indirect)
{
    if (indirect)
        weir_record_indirect(recorder, pass, WEIR_WCSPH_step_end, 16 * (uint64_t)size);
    else
        weir_record(recorder, pass);
}

// Passes of a sort, and of lists, do nothing where the device finds that order or lists still last. `indirect`: it has left the
// sizes of the dispatches.
static void record_sort(const WeirWcsphGpu *solver, const WeirRecorder *recorder, bool indirect)
{
    if (solver->traits.emitter_count > 0) {
        record_sorting(recorder, WEIR_WCSPH_VACANCIES, WEIR_SORT_PARTICLES, indirect);
        record_sorting(recorder, WEIR_WCSPH_EMIT, WEIR_SORT_ONE, indirect);
    }
    record_sorting(recorder, WEIR_WCSPH_COUNT, WEIR_SORT_PARTICLES, indirect);
    record_sorting(recorder, WEIR_WCSPH_SCAN_REDUCE, WEIR_SORT_BLOCKS, indirect);
    record_sorting(recorder, WEIR_WCSPH_SCAN_WRITE, WEIR_SORT_BLOCKS, indirect);
    record_sorting(recorder, WEIR_WCSPH_SCATTER, WEIR_SORT_PARTICLES, indirect);
}

static void record_lists(const WeirRecorder *recorder, bool indirect)
{
    record_sorting(recorder, WEIR_WCSPH_NEIGHBORS, WEIR_SORT_LISTS, indirect);
}

// The first step's length and the first half of its move; later steps find theirs done where the one before finished.
static void record_begin(WeirWcsphGpu *solver, const WeirRecorder *recorder)
{
    weir_record(recorder, WEIR_WCSPH_BEGIN);
    weir_record(recorder, WEIR_WCSPH_DRIFT);
    solver->turn = 0;
}

// With the clock, which walls does on the way.
static void record_walls(const WeirWcsphGpu *solver, const WeirRecorder *recorder)
{
    if (solver->traits.solid_count > 0)
        weir_record(recorder, WEIR_WCSPH_WALLS);
    else if (!solver->traits.one_pass)
        weir_record(recorder, WEIR_WCSPH_TIME_STEP);
}

// Whether what the device does every `interval` steps may be due.
static bool may_be_due(const WeirWcsphGpu *solver, uint32_t interval)
{
    return !solver->certain || solver->counted % interval == 0;
}

// `measured`: with all passes.
static void record_step(WeirWcsphGpu *solver, const WeirRecorder *recorder, bool measured)
{
    const WeirWcsphTraits *traits = &solver->traits;
    if (measured || may_be_due(solver, traits->sort_interval))
        record_sort(solver, recorder, solver->indirect);
    if (measured || may_be_due(solver, traits->list_interval)) record_lists(recorder, solver->indirect);
    if (!traits->one_pass) record_walls(solver, recorder);
    weir_record_turn(recorder, WEIR_WCSPH_FORCES, solver->turn);
    solver->turn = (solver->turn + 1) % 3;
    if (traits->free_solids) weir_record(recorder, WEIR_WCSPH_SOLID_FORCES);
    if (traits->moving_solids) {
        weir_record(recorder, WEIR_WCSPH_SOLIDS);
        weir_record(recorder, WEIR_WCSPH_FINISH);
    }
    ++solver->counted;
}

void weir_gpu_wcsph_evaluate(WeirWcsphGpu *solver, WGPUCommandEncoder encoder, WeirEvaluation how)
{
    WeirRecorder recorder = weir_recorder_begin(&solver->common, encoder);
    if (how == WEIR_EVALUATE_RESTORED) weir_record(&recorder, WEIR_WCSPH_STORE);
    weir_record(&recorder, WEIR_WCSPH_BEGIN_READ);
    if (how == WEIR_EVALUATE_NEW) {
        record_sort(solver, &recorder, false);
        record_lists(&recorder, false);
    } else {
        weir_record(&recorder, WEIR_WCSPH_LOAD);
    }
    record_walls(solver, &recorder);
    if (how == WEIR_EVALUATE_NEW) weir_record(&recorder, WEIR_WCSPH_STORE); // with what solids see
    weir_record(&recorder, WEIR_WCSPH_FORCES_READ);
    if (solver->traits.solid_count > 0) weir_record(&recorder, WEIR_WCSPH_SOLID_FORCES_READ);
    weir_recorder_end(&recorder);
}

static uint32_t steps_per_submit(const WeirGpuSolver *solver)
{
    const WeirParameters *parameters = &solver->parameters;
    double count = solver->constants.particle_count;
    double ratio = parameters->support_radius / parameters->particle_spacing;
    double neighbors = solver->constants.dimension == 3 ? 4.19 * ratio * ratio * ratio : 3.14 * ratio * ratio;
    return weir_steps_per_submit(solver, count * fmin(count, 3.0 * neighbors));
}

// Up to `steps` steps in one submit, the first of them measured if wished. `first`, `last`: of the batch that the caller
// asked for.
static void submit_steps(WeirWcsphGpu *solver, uint32_t steps, bool first, bool last, bool measured)
{
    WeirGpuSolver *common = &solver->common;
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "step");
    WeirRecorder recorder;
    if (first) {
        recorder = weir_recorder_begin(common, encoder);
        record_begin(solver, &recorder);
        weir_recorder_end(&recorder);
    }
    if (measured) {
        recorder = weir_recorder_measure(common, encoder);
        record_step(solver, &recorder, true);
        weir_recorder_end(&recorder);
        --steps;
    }
    recorder = weir_recorder_batch(common, encoder, steps, measured && steps > 0);
    for (uint32_t n = 0; n < steps; ++n) record_step(solver, &recorder, false);
    if (last) weir_record(&recorder, WEIR_WCSPH_HEALTH);
    weir_recorder_end(&recorder);
    weir_gpu_solver_submit_steps(common, encoder, measured);
}

// Seconds as the device counts them.
static void write_ticks(double seconds, uint32_t ticks[2])
{
    double count = rint(seconds * 4398046511104.0); // 2^42
    uint64_t whole = !(count > 0.0) ? 0 : count < 9.2e18 ? (uint64_t)count : (uint64_t)1 << 63;
    ticks[0] = (uint32_t)whole;
    ticks[1] = (uint32_t)(whole >> 32);
}

static WeirStatus step(WeirSolver *base, uint32_t steps, double until)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)base;
    WeirGpuSolver *common = &solver->common;
    WeirStatus status = weir_gpu_solver_ready(common);
    if (status != WEIR_OK || steps == 0) return status;
    WeirWcsphControl request = {.steps_asked = steps};
    write_ticks(until, request.until);
    wgpuQueueWriteBuffer(common->gpu->queue, common->buffers.handle[WEIR_WCSPH_control][0], 0, &request,
                         offsetof(WeirWcsphControl, restored));
    weir_profile_poll(common->profile);
    bool measured = weir_profile_ready(common->profile);
    uint32_t most = steps_per_submit(common);
    solver->certain = solver->certain && isinf(until); // the device may stop sooner
    for (uint32_t done = 0; done < steps && status == WEIR_OK;) {
        uint32_t batch = steps - done < most ? steps - done : most;
        submit_steps(solver, batch, done == 0, done + batch == steps, measured && done == 0);
        done += batch;
        status = weir_gpu_solver_ready(common);
    }
    return status;
}

// ---- The rest of the solver's contract ----

static void destroy(WeirSolver *base)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)base;
    weir_gpu_solver_destroy(&solver->common);
    weir_gpu_wcsph_free_world(solver);
    weir_gpu_wcsph_free_probes(solver);
    free(solver->host);
    free(solver->host_group);
    free(solver->host_solids);
    free(solver);
}

// Of what is wanted.
static WeirWcsphTraits wanted_traits(const WeirWcsphGpu *solver)
{
    const WeirGpuSolver *common = &solver->common;
    WeirWcsphTraits traits = solver->traits;
    traits.emission_interval =
        weir_world_emission_interval(&solver->world, &common->wanted_parameters, &common->wanted_constants);
    if (traits.emitter_count > 0 && traits.sort_interval > traits.emission_interval)
        traits.sort_interval = traits.emission_interval;
    if (traits.list_interval > traits.sort_interval) traits.list_interval = traits.sort_interval;
    return traits;
}

static uint32_t choose(const WeirGpuSolver *common, char settings[WEIR_SETTINGS_LENGTH])
{
    WeirWcsphTraits traits = wanted_traits((const WeirWcsphGpu *)common);
    return weir_gpu_wcsph_settings(&common->wanted_parameters, &common->wanted_constants, &traits, settings);
}

static void set_groups(WeirWcsphGpu *solver)
{
    const WeirWcsphTraits *traits = &solver->traits;
    const WeirConstants *constants = &solver->common.constants;
    uint32_t *groups = solver->common.passes.groups;
    uint32_t solid_particles = constants->particle_count - constants->first_solid;
    groups[WEIR_ITEMS_SHARES] =
        weir_workgroups_of(traits->share_threads, traits->lanes * constants->particle_count);
    groups[WEIR_ITEMS_STEP] = groups[WEIR_ITEMS_SHARES];
    if (traits->one_pass && constants->friction_factor > 0.0f)
        groups[WEIR_ITEMS_STEP] += weir_workgroups_of(traits->share_threads, traits->lanes * solid_particles);
    groups[WEIR_ITEMS_SOLID_SHARES] = weir_workgroups(traits->lanes * solid_particles) + 1; // the clock's
    groups[WEIR_ITEMS_SOLIDS] = weir_workgroups(solid_particles);
    groups[WEIR_ITEMS_BLOCKS] = traits->block_count;
    groups[WEIR_ITEMS_FREE_BLOCKS] = traits->free_block_count;
}

static void take_change(WeirGpuSolver *common)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)common;
    solver->traits = wanted_traits(solver);
    set_groups(solver);
    WeirConstants cells = weir_gpu_wcsph_cells(&solver->traits, &common->constants);
    weir_buffers_write(&common->buffers, WEIR_WCSPH_constants, &cells, sizeof cells);
    weir_gpu_wcsph_write_looks(solver);
}

// When the emitters' layers are due, and when the first of them is.
static void write_schedule(WeirWcsphGpu *solver, uint32_t next_due[2])
{
    WGPUBuffer schedule = solver->common.buffers.handle[WEIR_WCSPH_schedule][0];
    next_due[0] = next_due[1] = UINT32_MAX; // never
    for (uint32_t n = 0; n < solver->traits.emitter_count; ++n) {
        uint32_t due[4];
        write_ticks(solver->world.emitters[n].start, due);
        write_ticks(solver->world.emitters[n].stop, due + 2);
        wgpuQueueWriteBuffer(solver->common.gpu->queue, schedule, 16 * (uint64_t)n, due, sizeof due);
        if (due[1] > next_due[1] || (due[1] == next_due[1] && due[0] >= next_due[0])) continue;
        next_due[0] = due[0];
        next_due[1] = due[1];
    }
}

static void write_control(WeirWcsphGpu *solver)
{
    WeirWcsphControl control = {.bad_step = UINT32_MAX, .bad_slot = UINT32_MAX, .starting = 1};
    control.clock.sorting = control.clock.listing = 1;
    control.clock.next_allowance = solver->traits.least_allowance;
    write_schedule(solver, control.next_due);
    weir_buffers_write(&solver->common.buffers, WEIR_WCSPH_control, &control, sizeof control);
    solver->seen = control;
    solver->counted = 0;
    solver->certain = true;
}

static WeirStatus write_state(WeirWcsphGpu *solver, const WeirParticles *particles)
{
    WeirGpuSolver *common = &solver->common;
    if (!weir_gpu_wcsph_write_state(solver, particles))
        return weir_fail(&common->base.message, WEIR_ERROR_MEMORY, "no memory for %u particles",
                         common->constants.particle_count);
    write_control(solver);
    solver->steps_before = 0;
    solver->blown_up = solver->restored = false;
    common->health = (WeirHealth){.has_clock = true, .fluid_particles = solver->fluid_at_start};
    weir_gpu_solver_replaced(common);
    return WEIR_OK;
}

// Accelerations and speeds give the first step's length.
static WeirStatus start(WeirGpuSolver *common)
{
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "set_state");
    weir_gpu_wcsph_evaluate((WeirWcsphGpu *)common, encoder, WEIR_EVALUATE_NEW);
    WeirRecorder recorder = weir_recorder_begin(common, encoder);
    weir_record(&recorder, WEIR_WCSPH_FIRST_STEP);
    weir_recorder_end(&recorder);
    weir_gpu_submit(common->gpu, encoder, "set_state");
    return weir_gpu_solver_ready(common);
}

static WeirStatus set_state(WeirSolver *base, const WeirParticles *particles)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)base;
    WeirStatus status = weir_gpu_solver_ready(&solver->common);
    if (status == WEIR_OK) status = write_state(solver, particles);
    return status == WEIR_OK ? weir_gpu_solver_begin(&solver->common) : status;
}

static const WeirSolverInterface wcsph_interface = {
    .destroy = destroy,
    .configure = weir_gpu_solver_configure,
    .set_state = set_state,
    .step = step,
    .poll = weir_gpu_solver_poll,
    .wait = weir_gpu_solver_wait,
    .read = weir_gpu_solver_read,
    .read_motion = weir_gpu_solver_read_motion,
    .diagnose = weir_gpu_solver_diagnose,
    .gather = weir_gpu_solver_gather,
    .pass_times = weir_gpu_solver_pass_times,
    .step_time = weir_gpu_solver_step_time,
};

static bool make_host(WeirWcsphGpu *solver)
{
    size_t count = solver->common.constants.particle_count, dimension = solver->common.constants.dimension;
    solver->host = calloc((3 * dimension + 2) * count, sizeof *solver->host);
    solver->host_group = calloc(count, sizeof *solver->host_group);
    solver->host_solids = calloc(solver->traits.solid_count + 1, sizeof *solver->host_solids);
    return solver->host && solver->host_group && solver->host_solids;
}

static void set_sort_groups(WeirWcsphGpu *solver, uint32_t scan_blocks)
{
    WeirGpuSolver *common = &solver->common;
    uint32_t groups = common->passes.groups[WEIR_ITEMS_PARTICLES];
    if (groups > MOST_SORTING) groups = MOST_SORTING;
    common->passes.groups[WEIR_ITEMS_SORTING] = groups;
    uint32_t sizes[2 * WEIR_SORT_SIZES][4] = {{0}}, *sorting[WEIR_SORT_SIZES];
    for (int k = 0; k < WEIR_SORT_SIZES; ++k) {
        sorting[k] = sizes[WEIR_SORT_SIZES + k];
        sorting[k][2] = 1;
    }
    weir_pass_groups(common->gpu, groups, sorting[WEIR_SORT_PARTICLES]);
    weir_pass_groups(common->gpu, scan_blocks, sorting[WEIR_SORT_BLOCKS]);
    weir_pass_groups(common->gpu, 1, sorting[WEIR_SORT_ONE]);
    weir_pass_groups(common->gpu, groups, sorting[WEIR_SORT_LISTS]);
    weir_buffers_write(&common->buffers, WEIR_WCSPH_step_end, sizes, sizeof sizes);
    solver->indirect = groups >= weir_parallelism_ratio(common->gpu) * LEAST_INDIRECT &&
                       weir_platform_dispatches_indirectly();
}

static WeirStatus make(WeirWcsphGpu *solver, const WeirSolverSetup *setup, uint64_t most_list_bytes,
                       WeirMessage *message)
{
    WeirGpuSolver *common = &solver->common;
    common->constants = setup->constants;
    if (!weir_gpu_wcsph_copy_world(solver, setup) || !weir_gpu_wcsph_copy_probes(solver, setup) ||
        !make_host(solver))
        return weir_fail(message, WEIR_ERROR_MEMORY, "no host memory for %u particles",
                         setup->constants.particle_count);
    weir_gpu_wcsph_plan(&solver->traits, &setup->parameters, &setup->constants, common->gpu, most_list_bytes);
    WeirConstants cells = weir_gpu_wcsph_cells(&solver->traits, &setup->constants);
    WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL] = {{0}};
    weir_gpu_wcsph_sizes(&cells, &solver->world, &solver->traits, sizes);
    uint32_t scan_blocks = (uint32_t)(sizes[WEIR_WCSPH_block_sum].bytes / 4);
    uint64_t pieces[WEIR_WCSPH_PIECES];
    weir_gpu_wcsph_piece_sizes(sizes, setup->constants.particle_count, pieces);
    const WeirMethodInfo *method = weir_gpu_wcsph_method(setup->constants.dimension);
    WeirStatus status =
        weir_gpu_solver_make(common, method, sizes, scan_blocks, WEIR_WCSPH_PIECES, pieces, message);
    if (status != WEIR_OK) return status;
    if (!weir_gpu_wcsph_make_gather_copy(solver))
        return weir_fail(message, WEIR_ERROR_MEMORY, "no host memory for probes");
    common->passes.share_threads = solver->traits.share_threads;
    set_sort_groups(solver, scan_blocks);
    status = weir_gpu_solver_configure(&common->base, &setup->parameters, &setup->constants);
    if (status == WEIR_OK) weir_gpu_wcsph_write_world(solver);
    if (status == WEIR_OK) status = set_state(&common->base, &setup->world->particles);
    if (status != WEIR_OK) *message = common->base.message;
    return status;
}

static WeirSolver *create(WeirGpu *gpu, const WeirSolverSetup *setup, uint64_t most_list_bytes,
                          WeirStatus *status, WeirMessage *message)
{
    WeirWcsphGpu *solver = calloc(1, sizeof *solver);
    if (!solver) {
        *status = weir_fail(message, WEIR_ERROR_MEMORY, "no memory for a simulation");
        return NULL;
    }
    WeirGpuSolver *common = &solver->common;
    common->base.interface = &wcsph_interface;
    common->gpu = gpu;
    common->start = start;
    common->choose = choose;
    common->take_change = take_change;
    common->health_buffer = WEIR_WCSPH_control;
    common->health_size = sizeof(WeirWcsphControl);
    common->take_health = weir_gpu_wcsph_take_health;
    common->state_copy = (WeirGpuCopy){.queue = weir_gpu_wcsph_copy_state, .take = weir_gpu_wcsph_take_state};
    common->sums_copy = (WeirGpuCopy){.queue = weir_gpu_wcsph_copy_sums, .take = weir_gpu_wcsph_take_sums};
    common->gather_copy =
        (WeirGpuCopy){.queue = weir_gpu_wcsph_copy_gathered, .take = weir_gpu_wcsph_take_gathered};
    snprintf(common->base.device, sizeof common->base.device, "%s", gpu->name);
    *status = make(solver, setup, most_list_bytes, message);
    if (*status == WEIR_OK) return &common->base;
    destroy(&common->base);
    return NULL;
}

WeirSolver *weir_wcsph_gpu_create(WeirGpu *gpu, const WeirSolverSetup *setup, WeirStatus *status,
                                  WeirMessage *message)
{
    uint64_t most = gpu->options.list_memory;
    WeirSolver *solver = create(gpu, setup, most > 0 ? most : usual_list_bytes, status, message);
    if (!solver && *status == WEIR_ERROR_MEMORY) solver = create(gpu, setup, 0, status, message);
    return solver;
}

bool weir_wcsph_gpu_particles(const WeirSolver *base, WeirGpuParticles *particles)
{
    if (base->interface != &wcsph_interface) return false;
    const WeirWcsphGpu *solver = (const WeirWcsphGpu *)base;
    const WeirGpuSolver *common = &solver->common;
    *particles = (WeirGpuParticles){
        .gpu = common->gpu,
        .method = WEIR_METHOD_WCSPH,
        .coordinate = common->buffers.handle[WEIR_WCSPH_coordinate][0],
        .motion = common->buffers.handle[WEIR_WCSPH_motion][0],
        .solids = solver->traits.solid_count > 0 ? common->buffers.handle[WEIR_WCSPH_solid_state][0] : NULL,
        .count = common->constants.particle_count,
        .solid_count = solver->traits.solid_count,
    };
    return true;
}
