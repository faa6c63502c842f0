// The method `mueller` on the CPU: the reference that judges the GPU, and the fallback where there is none.
//
// One step is  count -> scan -> scatter -> density -> forces -> integrate, the same passes as in
// shaders/solve/.
//
//   state (any order) --count, scan, scatter--> sorted (by cell, then id) --density, forces--> acceleration
//        ^                                                                                          |
//        +------------------------------------- integrate ------------------------------------------+
//
// No pass reads what it writes, and every sum has one order, so the bits depend on neither threads
// nor compiler.
#include "core/cpu/arrays.h"
#include "core/cpu/cells.h"
#include "core/cpu/cpu_solver.h"
#include "core/cpu/pairs.h"
#include "core/cpu/pool.h"
#include "core/cpu/solvers.h"
#include "core/grid.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// Particles of one piece of work: small enough to balance threads, large enough to hide the hand-over.
enum { CHUNK = 512, CELL_CHUNK = 4096 };

enum { PASS_COUNT, PASS_SCAN, PASS_SCATTER, PASS_DENSITY, PASS_FORCES, PASS_INTEGRATE, PASS_TOTAL };
static const char *const pass_names[PASS_TOTAL] = {"count",   "scan",   "scatter",
                                                   "density", "forces", "integrate"};

typedef struct MuellerCpu {
    WeirSolver base;
    WeirParameters parameters;
    WeirConstants constants;
    WeirPool *pool;
    const WeirPairPasses *pairs;
    WeirParticleArrays state;  // what the last step left
    WeirParticleArrays sorted; // the same particles by cell
    WeirSumArrays sums;        // of the sorted particles
    WeirHostArrays host;       // copy by id, for read()
    WeirCells cells;
    uint64_t steps;
    bool evaluated; // sorted and sums belong to the state, so that a read costs no second evaluation
    atomic_uint bad_particles;
    uint64_t first_bad_step;
    double pass_seconds[PASS_TOTAL];
} MuellerCpu;

// ---- Passes ----

static void count_chunk(void *context, uint32_t begin, uint32_t end)
{
    MuellerCpu *solver = context;
    const WeirConstants *constants = &solver->constants;
    bool alone = weir_pool_threads(solver->pool) == 1;
    for (uint32_t i = begin; i < end; ++i) {
        solver->cells.cell[i] = weir_grid_cell_at(constants, solver->state.x[i], solver->state.y[i]);
    }
    weir_cells_count(&solver->cells, begin, end, alone);
}

// Particles per cell, and each one's rank in its cell: any order, scatter puts it right.
static void count(MuellerCpu *solver)
{
    weir_pool_run(solver->pool, solver->constants.particle_count, CHUNK, count_chunk, solver);
}

// Where each cell's particles begin.
static void scan(MuellerCpu *solver)
{
    weir_cells_scan(&solver->cells, solver->pool, solver->constants.cell_count);
}

static void gather_chunk(void *context, uint32_t begin, uint32_t end)
{
    MuellerCpu *solver = context;
    for (uint32_t cell = begin; cell < end; ++cell) {
        uint32_t first = solver->cells.cell_start[cell], last = solver->cells.cell_start[cell + 1];
        if (last - first > 1) weir_cells_order(&solver->cells, solver->state.id, first, last);
        for (uint32_t k = first; k < last; ++k) {
            weir_particle_copy(&solver->sorted, k, &solver->state, solver->cells.slot[k]);
        }
    }
}

// Moves the whole particle data to its cell, in order of id.
static void scatter(MuellerCpu *solver)
{
    weir_cells_place(&solver->cells, solver->pool, solver->constants.particle_count);
    weir_pool_run(solver->pool, solver->constants.cell_count, CELL_CHUNK, gather_chunk, solver);
}

static WeirPairData pair_data(const MuellerCpu *solver)
{
    return (WeirPairData){
        .parameters = &solver->parameters,
        .constants = &solver->constants,
        .cell_start = solver->cells.cell_start,
        .x = solver->sorted.x,
        .y = solver->sorted.y,
        .vx = solver->sorted.vx,
        .vy = solver->sorted.vy,
        .density = solver->sums.density,
        .pressure = solver->sums.pressure,
        .pressure_term = solver->sums.pressure_term,
        .inverse_density = solver->sums.inverse_density,
        .ax = solver->sums.ax,
        .ay = solver->sums.ay,
    };
}

static void density_chunk(void *context, uint32_t begin, uint32_t end)
{
    MuellerCpu *solver = context;
    WeirPairData data = pair_data(solver);
    solver->pairs->density(&data, begin, end);
}

static void density(MuellerCpu *solver)
{
    weir_pool_run(solver->pool, solver->constants.particle_count, CHUNK, density_chunk, solver);
}

static void forces_chunk(void *context, uint32_t begin, uint32_t end)
{
    MuellerCpu *solver = context;
    WeirPairData data = pair_data(solver);
    solver->pairs->forces(&data, begin, end);
}

static void forces(MuellerCpu *solver)
{
    weir_pool_run(solver->pool, solver->constants.particle_count, CHUNK, forces_chunk, solver);
}

// Acceleration that the pointer tool adds to a particle: falls off linearly to zero at the tool's radius.
static void add_tool(const WeirConstants *constants, float x, float y, float vx, float vy, float *ax,
                     float *ay)
{
    float dx = x - constants->tool_position[0], dy = y - constants->tool_position[1];
    float distance = sqrtf(dx * dx + dy * dy);
    if (!(distance < constants->tool_radius)) return;
    float strength = constants->tool_strength * (1.0f - distance / constants->tool_radius);
    if (constants->tool_kind == WEIR_TOOL_STIR) {
        *ax += strength * (constants->tool_velocity[0] - vx);
        *ay += strength * (constants->tool_velocity[1] - vy);
        return;
    }
    if (constants->tool_kind == WEIR_TOOL_PULL) strength = -strength;
    float inverse = distance > 0.0f ? 1.0f / distance : 0.0f;
    *ax += strength * dx * inverse;
    *ay += strength * dy * inverse;
}

// A wall mirrors what went through it, scaled by the restitution. The clamp holds particles in at any speed.
static inline void reflect(float low, float high, float restitution, float *x, float *v)
{
    if (*x < low) {
        *x = low + restitution * (low - *x);
        if (*v < 0.0f) *v = -restitution * *v;
    }
    if (*x > high) {
        *x = high - restitution * (*x - high);
        if (*v > 0.0f) *v = -restitution * *v;
    }
    if (*x < low) *x = low;
}

static void integrate_chunk(void *context, uint32_t begin, uint32_t end)
{
    MuellerCpu *solver = context;
    const WeirConstants *constants = &solver->constants;
    const WeirParticleArrays *from = &solver->sorted;
    WeirParticleArrays *to = &solver->state;
    float dt = solver->parameters.time_step, restitution = solver->parameters.restitution;
    float limit = constants->speed_limit * constants->speed_limit;
    uint32_t bad = 0;
    for (uint32_t i = begin; i < end; ++i) {
        float x = from->x[i], y = from->y[i], vx = from->vx[i], vy = from->vy[i];
        float ax = solver->sums.ax[i], ay = solver->sums.ay[i];
        if (constants->tool_kind != WEIR_TOOL_NONE) add_tool(constants, x, y, vx, vy, &ax, &ay);
        vx += dt * ax;
        vy += dt * ay;
        float speed2 = vx * vx + vy * vy;
        if (!(speed2 <= limit)) ++bad; // NaN compares false
        if (!(speed2 <= 1e37f)) { // not finite: stays where it was, so that it never indexes outside the grid
            vx = vy = 0.0f;
        }
        x += dt * vx;
        y += dt * vy;
        reflect(constants->domain_min[0], constants->domain_max[0], restitution, &x, &vx);
        reflect(constants->domain_min[1], constants->domain_max[1], restitution, &y, &vy);
        to->x[i] = x;
        to->y[i] = y;
        to->vx[i] = vx;
        to->vy[i] = vy;
        to->id[i] = from->id[i];
    }
    if (bad) atomic_fetch_add_explicit(&solver->bad_particles, bad, memory_order_relaxed);
}

// Semi-implicit Euler: the new velocity moves the particle.
static void integrate(MuellerCpu *solver)
{
    weir_pool_run(solver->pool, solver->constants.particle_count, CHUNK, integrate_chunk, solver);
}

// ---- The step ----

static void timed(MuellerCpu *solver, int pass, void (*run)(MuellerCpu *))
{
    double begin = weir_seconds();
    run(solver);
    solver->pass_seconds[pass] = weir_seconds() - begin;
}

// The tutorial's neighbour search visits every pair, so its particles need no order.
static void keep_order(MuellerCpu *solver)
{
    for (uint32_t i = 0; i < solver->constants.particle_count; ++i) {
        weir_particle_copy(&solver->sorted, i, &solver->state, i);
    }
}

static void evaluate(MuellerCpu *solver)
{
    if (solver->evaluated) return;
    if (solver->parameters.search == WEIR_SEARCH_ALL_PAIRS) {
        timed(solver, PASS_SCATTER, keep_order);
    } else {
        timed(solver, PASS_COUNT, count);
        timed(solver, PASS_SCAN, scan);
        timed(solver, PASS_SCATTER, scatter);
    }
    timed(solver, PASS_DENSITY, density);
    timed(solver, PASS_FORCES, forces);
    solver->evaluated = true;
}

static WeirStatus step(WeirSolver *base, uint32_t steps, double until)
{
    (void)until; // steps of one length: the caller counts them
    MuellerCpu *solver = (MuellerCpu *)base;
    for (uint32_t n = 0; n < steps; ++n) {
        evaluate(solver);
        timed(solver, PASS_INTEGRATE, integrate);
        solver->evaluated = false;
        ++solver->steps;
        if (solver->first_bad_step == 0 && solver->bad_particles > 0) solver->first_bad_step = solver->steps;
    }
    return WEIR_OK;
}

// ---- The rest of the solver's contract ----

static void destroy(WeirSolver *base)
{
    MuellerCpu *solver = (MuellerCpu *)base;
    weir_pool_destroy(solver->pool);
    weir_particle_arrays_free(&solver->state);
    weir_particle_arrays_free(&solver->sorted);
    weir_sum_arrays_free(&solver->sums);
    weir_host_arrays_free(&solver->host);
    weir_cells_free(&solver->cells);
    free(solver);
}

static WeirStatus configure(WeirSolver *base, const WeirParameters *parameters,
                            const WeirConstants *constants)
{
    MuellerCpu *solver = (MuellerCpu *)base;
    if (!weir_cells_reserve(&solver->cells, constants->cell_count)) {
        return weir_fail(&base->message, WEIR_ERROR_MEMORY, "no memory for %u cells", constants->cell_count);
    }
    // Constants follow from the parameters, apart from the tool, which acts in `integrate` only.
    if (memcmp(&solver->parameters, parameters, sizeof *parameters) != 0) solver->evaluated = false;
    solver->parameters = *parameters;
    solver->constants = *constants;
    bool all = parameters->search == WEIR_SEARCH_ALL_PAIRS; // every other particle is a candidate
    solver->pairs =
        weir_pair_passes(all ? constants->particle_count : weir_lattice_neighbors(parameters, 2, 1.0));
    return WEIR_OK;
}

static WeirStatus set_state(WeirSolver *base, const WeirParticles *particles)
{
    MuellerCpu *solver = (MuellerCpu *)base;
    for (uint32_t i = 0; i < solver->constants.particle_count; ++i) {
        solver->state.x[i] = (float)particles->position[2 * i];
        solver->state.y[i] = (float)particles->position[2 * i + 1];
        solver->state.vx[i] = particles->velocity[2 * i];
        solver->state.vy[i] = particles->velocity[2 * i + 1];
        solver->state.id[i] = i;
    }
    solver->evaluated = false;
    solver->steps = solver->first_bad_step = 0;
    solver->bad_particles = 0;
    return WEIR_OK;
}

static WeirStatus poll(WeirSolver *base, WeirHealth *health)
{
    const MuellerCpu *solver = (const MuellerCpu *)base;
    health->bad_particles = solver->bad_particles;
    health->first_bad_step = solver->first_bad_step;
    return WEIR_OK;
}

static void copy_by_id(void *context, uint32_t begin, uint32_t end)
{
    MuellerCpu *solver = context;
    const WeirHostArrays *host = &solver->host;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t id = solver->sorted.id[i];
        host->position[2 * id] = solver->sorted.x[i];
        host->position[2 * id + 1] = solver->sorted.y[i];
        host->velocity[2 * id] = solver->sorted.vx[i];
        host->velocity[2 * id + 1] = solver->sorted.vy[i];
        host->acceleration[2 * id] = solver->sums.ax[i];
        host->acceleration[2 * id + 1] = solver->sums.ay[i];
        host->density[id] = solver->sums.density[i];
        host->pressure[id] = solver->sums.pressure[i];
    }
}

static WeirStatus read_state(WeirSolver *base, WeirState *state)
{
    MuellerCpu *solver = (MuellerCpu *)base;
    uint32_t count = solver->constants.particle_count;
    if (!solver->host.position && !weir_host_arrays_make(&solver->host, count)) {
        return weir_fail(&base->message, WEIR_ERROR_MEMORY, "no memory to read %u particles", count);
    }
    evaluate(solver);
    weir_pool_run(solver->pool, count, CHUNK, copy_by_id, solver);
    *state = weir_host_state(&solver->host, count, solver->steps);
    return WEIR_OK;
}

static uint32_t pass_times(const WeirSolver *base, WeirPassTime *times, uint32_t capacity)
{
    const MuellerCpu *solver = (const MuellerCpu *)base;
    return weir_cpu_pass_times(pass_names, solver->pass_seconds, PASS_TOTAL, times, capacity);
}

static const WeirSolverInterface mueller_interface = {
    .destroy = destroy,
    .configure = configure,
    .set_state = set_state,
    .step = step,
    .poll = poll,
    .wait = weir_cpu_wait,
    .read = read_state,
    .pass_times = pass_times,
};

static bool allocate(MuellerCpu *solver, uint32_t count, uint32_t threads)
{
    solver->pool = weir_pool_create(threads);
    return solver->pool && weir_cells_make(&solver->cells, count) &&
           weir_particle_arrays_make(&solver->state, count) &&
           weir_particle_arrays_make(&solver->sorted, count) && weir_sum_arrays_make(&solver->sums, count);
}

WeirSolver *weir_mueller_cpu_create(const WeirSolverSetup *setup, WeirStatus *status, WeirMessage *message)
{
    MuellerCpu *solver = calloc(1, sizeof *solver);
    uint32_t count = setup->constants.particle_count;
    if (!solver || !allocate(solver, count, setup->threads) ||
        configure(&solver->base, &setup->parameters, &setup->constants) != WEIR_OK) {
        *status = weir_fail(message, WEIR_ERROR_MEMORY,
                            "no memory for %u particles; raise parameters.particle_spacing", count);
        if (solver) destroy(&solver->base);
        return NULL;
    }
    solver->base.interface = &mueller_interface;
    weir_cpu_describe(&solver->base, solver->pool, solver->pairs->simd);
    set_state(&solver->base, &setup->world->particles);
    *status = WEIR_OK;
    return &solver->base;
}
