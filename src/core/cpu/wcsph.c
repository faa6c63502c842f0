// The method `wcsph` on the CPU: the reference that judges the GPU. docs/wcsph.md has the step and its sources.
//
//   state --time_step, drift--> moved --count, scan, scatter--> sorted --walls, forces, solids--> rates
//     ^                                                                                            |
//     +--------------------------------------- kick, finish ---------------------------------------+
//
// Every sum has one order and every choice depends on values alone, so the bits depend on neither threads nor
// compiler.
#include "core/cpu/wcsph.h"
#include "core/cpu/cpu_solver.h"
#include "core/cpu/solvers.h"
#include "core/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_PER_SNAPSHOT = 64 };

static const char *const pass_names[WEIR_WCSPH_PASSES] = {
    [WEIR_WCSPH_DRIFT] = "drift",         [WEIR_WCSPH_COUNT] = "count", [WEIR_WCSPH_SCAN] = "scan",
    [WEIR_WCSPH_SCATTER] = "scatter",     [WEIR_WCSPH_WALLS] = "walls", [WEIR_WCSPH_FORCES] = "forces",
    [WEIR_WCSPH_SOLIDS] = "solids",       [WEIR_WCSPH_KICK] = "kick",   [WEIR_WCSPH_FINISH] = "finish",
    [WEIR_WCSPH_TIME_STEP] = "time_step",
};

// ---- Sorting; cell_count stands for the cell of the empty slots ----

static void count_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirConstants *constants = &solver->constants;
    const WeirWcsphParticles *state = &solver->state;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t column = weir_grid_cell(state->x[0][i], constants->column_shift, constants->cell_columns);
        uint32_t row = weir_grid_cell(state->x[1][i], constants->row_shift, constants->cell_rows);
        uint32_t layer = weir_grid_cell(state->x[2][i], constants->row_shift, constants->cell_layers);
        uint32_t cell = (layer * constants->cell_rows + row) * constants->cell_columns + column;
        solver->cells.cell[i] = state->group[i] == WEIR_GROUP_EMPTY ? constants->cell_count : cell;
    }
    weir_cells_count(&solver->cells, begin, end, weir_pool_threads(solver->pool) == 1);
}

static void count(WeirWcsph *solver)
{
    weir_pool_run(solver->pool, solver->constants.particle_count, WEIR_WCSPH_CHUNK, count_chunk, solver);
}

static void scan(WeirWcsph *solver)
{
    weir_cells_scan(&solver->cells, solver->pool, solver->constants.cell_count + 1);
    solver->active = solver->cells.cell_start[solver->constants.cell_count];
}

// p of an excess density, docs/wcsph.md.
static inline float equation_of_state(const WeirWcsph *solver, bool linear, float excess)
{
    const WeirParameters *parameters = &solver->parameters;
    float c2 = solver->constants.sound_speed * solver->constants.sound_speed, rest = parameters->rest_density;
    if (linear) return c2 * excess + parameters->background_pressure;
    float ratio = 1.0f + excess / rest, cube = ratio * ratio * ratio;
    return rest * c2 / 7.0f * (cube * cube * ratio - 1.0f) + parameters->background_pressure;
}

// Copies 32-bit values of any kind to sorted places [begin, end). The sorted arrays are others than the state's.
static inline void gather(void *restrict to, const void *restrict from, const uint32_t *restrict slot,
                          uint32_t begin, uint32_t end)
{
    uint32_t *restrict sorted = to;
    const uint32_t *restrict state = from;
    for (uint32_t k = begin; k < end; ++k) sorted[k] = state[slot[k]];
}

static void gather_particles(const WeirWcsph *solver, uint32_t begin, uint32_t end)
{
    const WeirWcsphParticles *to = &solver->sorted, *from = &solver->state;
    const uint32_t *slot = solver->cells.slot;
    for (uint32_t axis = 0; axis < solver->constants.dimension; ++axis) { // in 2D the third is 0
        gather(to->x[axis], from->x[axis], slot, begin, end);
        gather(to->velocity[axis], from->velocity[axis], slot, begin, end);
    }
    gather(to->excess, from->excess, slot, begin, end);
    gather(to->rate, from->rate, slot, begin, end);
    gather(to->id, from->id, slot, begin, end);
    gather(to->group, from->group, slot, begin, end);
}

// Of a solid's particle.
static void prepare_solid(WeirWcsph *solver, uint32_t k, uint32_t n)
{
    WeirWcsphData *data = &solver->data;
    const WeirSolid *solid = &solver->world.solids[n];
    if (solver->walls_by_pair)
        for (int axis = 0; axis < 3; ++axis) data->seen_velocity[axis][k] = weir_wcsph_seen(solver, k)[axis];
    data->stick[k] = solid->no_slip ? 1.0f : 0.0f;
    data->barrier[k] = weir_solid_barrier(solid, &solver->solids[n], solver->bulk[n]);
    data->needs_force[k] = solver->forces_wanted || solid->kind == WEIR_SOLID_FREE ? 1.0f : 0.0f;
}

// What follows from a particle alone and the sums need; pass `walls` has the rest for solids.
static void prepare(WeirWcsph *solver, uint32_t begin, uint32_t end)
{
    WeirWcsphData *data = &solver->data;
    const float *excess = solver->sorted.excess;
    const uint32_t *group = solver->sorted.group;
    float rest_density = solver->parameters.rest_density;
    bool linear = solver->parameters.equation_of_state == WEIR_EQUATION_LINEAR;
    for (uint32_t k = begin; k < end; ++k) data->inverse_density[k] = 1.0f / (rest_density + excess[k]);
    for (uint32_t k = begin; k < end; ++k) data->pressure[k] = equation_of_state(solver, linear, excess[k]);
    for (uint32_t axis = 0; axis < solver->constants.dimension; ++axis)
        memcpy(data->seen_velocity[axis] + begin, solver->sorted.velocity[axis] + begin,
               (end - begin) * sizeof(float));
    for (uint32_t k = begin; k < end; ++k) data->is_fluid[k] = weir_group_is_fluid(group[k]) ? 1.0f : 0.0f;
    for (uint32_t k = begin; k < end; ++k) data->stick[k] = data->barrier[k] = 1.0f;
    for (uint32_t k = begin; k < end; ++k) data->needs_force[k] = 0.0f;
    if (solver->world.solid_count == 0) return;
    for (uint32_t k = begin; k < end; ++k)
        if (weir_group_is_solid(group[k])) prepare_solid(solver, k, group[k] - WEIR_GROUP_SOLID);
}

static void gather_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    WeirCells *cells = &solver->cells;
    for (uint32_t cell = begin; cell < end; ++cell) {
        uint32_t first = cells->cell_start[cell], last = cells->cell_start[cell + 1];
        if (last - first > 1) weir_cells_order(cells, solver->state.id, first, last);
    }
    gather_particles(solver, cells->cell_start[begin], cells->cell_start[end]);
    prepare(solver, cells->cell_start[begin], cells->cell_start[end]);
}

// Excess density for the weight of fluid one support deep and the pressure rho0 v^2 / 2 at which the fastest fluid stagnates.
static float due_excess(const WeirWcsph *solver, float flow_speed)
{
    const float *g = solver->parameters.gravity, c0 = solver->constants.sound_speed;
    float weight = solver->parameters.support_radius * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    return solver->parameters.rest_density * (weight + 0.5f * flow_speed * flow_speed) / (c0 * c0);
}

// Points the pair passes to the arrays of the sorted particles, which change places with the state's every step.
static void point_to_sorted(WeirWcsph *solver)
{
    WeirWcsphData *data = &solver->data;
    data->parameters = &solver->parameters;
    data->constants = &solver->constants;
    data->cell_start = solver->cells.cell_start;
    // One particle that flies faster than the method is valid for must not shake all the others.
    data->flow_speed = fminf(solver->clock.max_speed, 0.1f * solver->constants.sound_speed);
    data->due_excess = due_excess(solver, data->flow_speed);
    data->flow_speed = fminf(data->flow_speed, solver->constants.shifting_limit / solver->dt);
    for (int axis = 0; axis < 3; ++axis) {
        data->x[axis] = solver->sorted.x[axis];
        data->velocity[axis] = solver->sorted.velocity[axis];
    }
    data->excess = solver->sorted.excess;
    data->walls_by_pair = solver->walls_by_pair;
    data->rate = solver->sorted.rate;
    data->dt = solver->dt;
    data->second_half = 0.5f * solver->dt * solver->constants.inverse_quantum;
}

// Moves the whole particle data to its cell, in order of id.
static void scatter(WeirWcsph *solver)
{
    point_to_sorted(solver);
    weir_cells_place(&solver->cells, solver->pool, solver->constants.particle_count);
    uint32_t cells = solver->constants.cell_count + 1, chunk = cells / (4 * weir_pool_threads(solver->pool));
    if (chunk < WEIR_WCSPH_CELL_CHUNK) chunk = WEIR_WCSPH_CELL_CHUNK; // long copies are the fast ones
    weir_pool_run(solver->pool, cells, chunk, gather_chunk, solver);
    weir_wcsph_solid_velocities(solver, &solver->sorted, true, solver->sorted.velocity);
    // A surface that slides along itself displaces no fluid.
    weir_wcsph_solid_velocities(solver, &solver->sorted, false, solver->data.new_velocity);
}

// ---- Pair passes ----

static void forces_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    solver->passes->forces(&solver->data, begin, end);
}

static void forces(WeirWcsph *solver)
{
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, forces_chunk, solver);
}

// ---- Motion ----

static void drift(WeirWcsph *solver)
{
    solver->drained_in_step = solver->lost_in_step = 0;
    weir_pool_run(solver->pool, solver->constants.particle_count, WEIR_WCSPH_CHUNK, solver->motion->drift,
                  solver);
    solver->clock.drained_particles += solver->drained_in_step;
    solver->clock.lost_particles += solver->lost_in_step;
    if (solver->has_moving_solids) {
        float half = 0.5f * solver->dt;
        weir_solids_drift(&solver->world, &solver->constants, solver->clock.time + half, half,
                          solver->solids);
        weir_wcsph_place_solids(solver, &solver->state);
    }
    if (solver->has_emitters) weir_wcsph_emit(solver);
}

static void kick(WeirWcsph *solver)
{
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, solver->motion->kick, solver);
}

static void begin_maxima(WeirWcsph *solver)
{
    solver->speed_bits = solver->acceleration_bits = solver->density_bits = 0;
    solver->fluid_in_step = solver->bad_in_step = 0;
    solver->first_bad_id = UINT32_MAX;
}

// The largest values of the step that is over, or of a new state.
static void take_maxima(WeirWcsph *solver)
{
    WeirWcsphClock *clock = &solver->clock;
    clock->max_speed = weir_float_of(solver->speed_bits);
    clock->max_acceleration = weir_float_of(solver->acceleration_bits);
    clock->max_density_error = weir_float_of(solver->density_bits);
    clock->fluid_particles = solver->fluid_in_step;
    for (uint32_t n = 0; n < solver->world.solid_count; ++n) {
        if (solver->world.solids[n].kind != WEIR_SOLID_FREE) continue;
        const float *a = solver->solids[n].acceleration;
        clock->max_acceleration =
            fmaxf(clock->max_acceleration, sqrtf(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]));
    }
}

// The sorted particles become the state.
static void finish(WeirWcsph *solver)
{
    begin_maxima(solver);
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, solver->motion->finish, solver);
    if (solver->has_moving_solids) {
        float half = 0.5f * solver->dt;
        weir_solids_drift(&solver->world, &solver->constants, solver->clock.time + solver->dt, half,
                          solver->solids);
        weir_wcsph_place_solids(solver, &solver->sorted);
    }
    WeirWcsphParticles sorted = solver->sorted;
    solver->sorted = solver->state;
    solver->state = sorted;
    take_maxima(solver);
}

// Density error from which steps get shorter: three times what the method is valid for.
static const float violent_error = 0.1f;

static void time_step(WeirWcsph *solver)
{
    const WeirParameters *parameters = &solver->parameters;
    const WeirConstants *constants = &solver->constants;
    WeirWcsphClock *clock = &solver->clock;
    if (parameters->stepping == WEIR_STEPPING_FIXED) {
        clock->time_step = parameters->time_step;
        return;
    }
    float h = constants->smoothing_length, dt = h / (constants->sound_speed + clock->max_speed);
    if (clock->max_acceleration > 0.0f) dt = fminf(dt, sqrtf(h / clock->max_acceleration));
    dt *= parameters->courant;
    // A step that vanishes would find no blow-up.
    if (clock->max_density_error > violent_error)
        dt *= fmaxf(sqrtf(violent_error / clock->max_density_error), 0.1f);
    clock->time_step = fminf(dt, constants->viscous_step);
}

// ---- The step ----

static void timed(WeirWcsph *solver, WeirWcsphPass pass, void (*run)(WeirWcsph *))
{
    double begin = weir_seconds();
    run(solver);
    solver->pass_seconds[pass] = weir_seconds() - begin;
}

static void sort(WeirWcsph *solver)
{
    timed(solver, WEIR_WCSPH_COUNT, count);
    timed(solver, WEIR_WCSPH_SCAN, scan);
    timed(solver, WEIR_WCSPH_SCATTER, scatter);
}

static void evaluate(WeirWcsph *solver)
{
    sort(solver);
    timed(solver, WEIR_WCSPH_WALLS, weir_wcsph_walls);
    timed(solver, WEIR_WCSPH_FORCES, forces);
}

// `forces` needs of walls but the velocity for friction, and takes that of the step before: so a GPU needs one pass for both.
// docs/wcsph.md, "Walls".
static void evaluate_by_pair(WeirWcsph *solver)
{
    sort(solver);
    timed(solver, WEIR_WCSPH_FORCES, forces);
    solver->pass_seconds[WEIR_WCSPH_WALLS] = 0.0;
    if (solver->constants.friction_factor == 0.0f) return;
    solver->keeps_seen = true;
    timed(solver, WEIR_WCSPH_WALLS, weir_wcsph_walls);
    solver->keeps_seen = false;
}

static void take_step(WeirWcsph *solver)
{
    timed(solver, WEIR_WCSPH_TIME_STEP, time_step); // the next one's
    timed(solver, WEIR_WCSPH_DRIFT, drift);
    if (solver->walls_by_pair)
        evaluate_by_pair(solver);
    else
        evaluate(solver);
    timed(solver, WEIR_WCSPH_SOLIDS, weir_wcsph_solids);
    timed(solver, WEIR_WCSPH_KICK, kick);
    timed(solver, WEIR_WCSPH_FINISH, finish);
}

// The first two time steps follow from the accelerations and speeds at the start.
static void choose_first_step(WeirWcsph *solver)
{
    solver->keeps_seen = solver->walls_by_pair;
    evaluate(solver);
    solver->keeps_seen = false;
    begin_maxima(solver);
    for (uint32_t i = 0; i < solver->active; ++i) {
        if (!weir_group_is_fluid(solver->sorted.group[i])) continue;
        float speed2 = 0.0f, acceleration2 = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            float v = solver->sorted.velocity[axis][i], a = solver->data.acceleration[axis][i];
            speed2 += v * v;
            acceleration2 += a * a;
        }
        weir_atomic_max(&solver->speed_bits, sqrtf(speed2));
        weir_atomic_max(&solver->acceleration_bits, sqrtf(acceleration2));
        weir_atomic_max(&solver->density_bits,
                        fabsf(solver->sorted.excess[i]) / solver->parameters.rest_density);
        ++solver->fluid_in_step;
    }
    take_maxima(solver);
    time_step(solver);
}

// Length of the next step; the last two before `until` share what is left, so that none is tiny. 0: it is reached.
static float next_step(const WeirWcsph *solver, double until)
{
    double left = until - solver->clock.time, dt = solver->free_dt;
    if (isinf(until)) return (float)dt;
    if (left <= 1e-9 * fmax(until, 1e-3)) return 0.0f;
    if (dt >= left) return (float)left;
    return (float)(dt > 0.5 * left ? 0.5 * left : dt);
}

static void find_first_bad(WeirWcsph *solver)
{
    WeirHealth *bad = &solver->bad;
    bad->bad_particles += solver->bad_in_step;
    if (bad->first_bad_step > 0) return;
    bad->first_bad_step = solver->clock.steps;
    bad->first_bad_id = solver->first_bad_id;
    for (uint32_t i = 0; i < solver->active; ++i) {
        if (solver->state.id[i] != bad->first_bad_id) continue;
        for (uint32_t axis = 0; axis < solver->constants.dimension; ++axis) {
            bad->first_bad_position[axis] =
                solver->constants.origin[axis] + (float)solver->state.x[axis][i] * solver->constants.quantum;
        }
    }
    weir_wcsph_restore_snapshot(solver);
}

static WeirStatus step(WeirSolver *base, uint32_t steps, double until)
{
    WeirWcsph *solver = (WeirWcsph *)base;
    for (uint32_t n = 0; n < steps && solver->bad.bad_particles == 0; ++n) {
        solver->free_dt = solver->clock.time_step;
        solver->dt = next_step(solver, until);
        if (solver->dt <= 0.0f) break;
        take_step(solver);
        ++solver->clock.steps;
        // A step that was shortened to end there ends there exactly.
        double time = solver->clock.time + solver->dt;
        bool ends = isfinite(until) && fabs(until - time) <= 1e-6 * solver->dt;
        solver->clock.time = ends ? until : time;
        if (solver->bad_in_step > 0)
            find_first_bad(solver);
        else if (solver->clock.steps % STEPS_PER_SNAPSHOT == 0)
            weir_wcsph_take_snapshot(solver);
    }
    return WEIR_OK;
}

// ---- The rest of the solver's contract ----

static void destroy(WeirSolver *base)
{
    weir_wcsph_free((WeirWcsph *)base);
    free(base);
}

static WeirStatus configure(WeirSolver *base, const WeirParameters *parameters,
                            const WeirConstants *constants)
{
    WeirWcsph *solver = (WeirWcsph *)base;
    if (!weir_cells_reserve(&solver->cells, constants->cell_count + 1))
        return weir_fail(&base->message, WEIR_ERROR_MEMORY, "no memory for %u cells", constants->cell_count);
    solver->parameters = *parameters;
    solver->constants = *constants;
    solver->emission_interval = weir_world_emission_interval(&solver->world, parameters, constants);
    return WEIR_OK;
}

static WeirStatus set_state(WeirSolver *base, const WeirParticles *particles)
{
    WeirWcsph *solver = (WeirWcsph *)base;
    weir_wcsph_set_particles(solver, particles);
    choose_first_step(solver);
    weir_wcsph_take_snapshot(solver);
    return WEIR_OK;
}

static WeirStatus poll(WeirSolver *base, WeirHealth *health)
{
    const WeirWcsph *solver = (const WeirWcsph *)base;
    const WeirWcsphClock *clock = &solver->clock;
    *health = solver->bad;
    health->has_clock = true;
    health->steps = clock->steps;
    health->time = clock->time;
    health->time_step = clock->time_step;
    health->max_speed = clock->max_speed;
    health->max_density_error = clock->max_density_error;
    health->fluid_particles = clock->fluid_particles;
    health->drained_particles = clock->drained_particles;
    health->lost_particles = clock->lost_particles;
    return WEIR_OK;
}

static WeirStatus copied(WeirWcsph *solver, bool good)
{
    if (good) return WEIR_OK;
    return weir_fail(&solver->base.message, WEIR_ERROR_MEMORY, "no memory to read %u particles",
                     solver->constants.particle_count);
}

static WeirStatus read_state(WeirSolver *base, WeirState *state)
{
    WeirWcsph *solver = (WeirWcsph *)base;
    solver->forces_wanted = true;
    evaluate(solver);
    weir_wcsph_sum_solid_forces(solver);
    solver->forces_wanted = false;
    return copied(solver, weir_wcsph_copy_state(solver, true, state));
}

static WeirStatus read_motion(WeirSolver *base, WeirState *state)
{
    WeirWcsph *solver = (WeirWcsph *)base;
    weir_wcsph_solid_velocities(solver, &solver->state, true, solver->state.velocity);
    return copied(solver, weir_wcsph_copy_state(solver, false, state));
}

static uint32_t pass_times(const WeirSolver *base, WeirPassTime *times, uint32_t capacity)
{
    const WeirWcsph *solver = (const WeirWcsph *)base;
    return weir_cpu_pass_times(pass_names, solver->pass_seconds, WEIR_WCSPH_PASSES, times, capacity);
}

static const WeirSolverInterface wcsph_interface = {
    .destroy = destroy,
    .configure = configure,
    .set_state = set_state,
    .step = step,
    .poll = poll,
    .wait = weir_cpu_wait,
    .read = read_state,
    .read_motion = read_motion,
    .pass_times = pass_times,
};

WeirSolver *weir_wcsph_cpu_create(const WeirSolverSetup *setup, WeirStatus *status, WeirMessage *message)
{
    WeirWcsph *solver = calloc(1, sizeof *solver);
    if (!solver || !weir_wcsph_allocate(solver, setup) ||
        configure(&solver->base, &setup->parameters, &setup->constants) != WEIR_OK) {
        *status = weir_fail(message, WEIR_ERROR_MEMORY,
                            "no memory for %u particles; raise parameters.particle_spacing",
                            setup->constants.particle_count);
        if (solver) destroy(&solver->base);
        return NULL;
    }
    solver->base.interface = &wcsph_interface;
    uint32_t dimension = setup->constants.dimension;
    double neighbors = weir_lattice_neighbors(&setup->parameters, dimension, 1.0);
    solver->passes = weir_wcsph_passes(dimension, neighbors);
    solver->motion = weir_wcsph_motion(dimension, neighbors);
    weir_cpu_describe(&solver->base, solver->pool, solver->passes->simd);
    set_state(&solver->base, &setup->world->particles);
    *status = WEIR_OK;
    return &solver->base;
}
