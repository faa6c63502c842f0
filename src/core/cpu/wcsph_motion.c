// What moves particles: drift, kick, finish, time_step of docs/wcsph.md. Mirrors shaders/wcsph/.
#include "core/cpu/wcsph.h"

#include <math.h>

// Positions move by whole quanta; what is not finite or absurd does not move.
static inline int32_t quanta(const WeirConstants *constants, float distance)
{
    float steps = rintf(distance * constants->inverse_quantum);
    return fabsf(steps) < 1e9f ? (int32_t)steps : 0;
}

static inline int32_t wrap(int32_t x, uint32_t period)
{
    if (period == 0) return x;
    int32_t p = (int32_t)period;
    if (x < 0) x += p;
    if (x >= p) x -= p;
    return x;
}

static void move(const WeirConstants *constants, WeirWcsphParticles *particles, uint32_t i,
                 const float way[3])
{
    const uint32_t periods[3] = {constants->period_x, constants->period_y, constants->period_z};
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        particles->x[axis][i] = wrap(particles->x[axis][i] + quanta(constants, way[axis]), periods[axis]);
}

// ---- drift ----

// Fluid beyond an open side, or beyond a wall by more than a support radius, is gone.
static bool is_outside(const WeirConstants *constants, const WeirWcsphParticles *particles, uint32_t i)
{
    const uint32_t periods[3] = {constants->period_x, constants->period_y, constants->period_z};
    float reach = constants->search_radius;
    for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
        if (periods[axis] > 0) continue;
        float place = constants->origin[axis] + (float)particles->x[axis][i] * constants->quantum;
        float low = constants->open_sides >> (2 * axis) & 1 ? 0.0f : reach;
        float high = constants->open_sides >> (2 * axis + 1) & 1 ? 0.0f : reach;
        if (place < constants->domain_min[axis] - low || place > constants->domain_max[axis] + high)
            return true;
    }
    return false;
}

static bool is_drained(const WeirWcsph *solver, uint32_t i)
{
    const WeirConstants *constants = &solver->constants;
    for (uint32_t n = 0; n < solver->world.drain_count; ++n) {
        const WeirDrain *drain = &solver->world.drains[n];
        bool inside = true;
        for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
            float place = constants->origin[axis] + (float)solver->state.x[axis][i] * constants->quantum;
            inside = inside && place >= drain->min[axis] && place <= drain->max[axis];
        }
        if (inside) return true;
    }
    return false;
}

// An inlet's particle becomes free where it has passed the nozzle.
static bool has_passed(const WeirWcsph *solver, uint32_t i)
{
    const WeirEmitter *emitter = &solver->world.emitters[solver->state.group[i] - WEIR_GROUP_INLET];
    float along = 0.0f;
    for (uint32_t axis = 0; axis < solver->constants.dimension; ++axis) {
        float place =
            solver->constants.origin[axis] + (float)solver->state.x[axis][i] * solver->constants.quantum;
        along += (place - emitter->center[axis]) * emitter->direction[axis];
    }
    return along >= 0.0f;
}

typedef struct Drift {
    WeirWcsph *solver;
    atomic_uint drained, lost;
} Drift;

static void drift_chunk(void *context, uint32_t begin, uint32_t end)
{
    Drift *drift = context;
    WeirWcsph *solver = drift->solver;
    WeirWcsphParticles *state = &solver->state;
    float half = 0.5f * solver->dt;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t group = state->group[i];
        if (!weir_group_is_fluid(group)) continue;
        float way[3];
        for (int axis = 0; axis < 3; ++axis) way[axis] = half * state->velocity[axis][i];
        move(&solver->constants, state, i, way);
        state->excess[i] += half * state->rate[i];
        if (group != WEIR_GROUP_FLUID) {
            if (has_passed(solver, i)) state->group[i] = WEIR_GROUP_FLUID;
            continue;
        }
        bool drained = solver->has_drains && is_drained(solver, i);
        if (!drained && !is_outside(&solver->constants, state, i)) continue;
        state->group[i] = WEIR_GROUP_EMPTY;
        atomic_fetch_add_explicit(drained ? &drift->drained : &drift->lost, 1, memory_order_relaxed);
    }
}

void weir_wcsph_drift(WeirWcsph *solver)
{
    Drift drift = {.solver = solver};
    weir_pool_run(solver->pool, solver->constants.particle_count, WEIR_WCSPH_CHUNK, drift_chunk, &drift);
    solver->clock.drained_particles += drift.drained;
    solver->clock.lost_particles += drift.lost;
    if (solver->has_moving_solids) {
        float half = 0.5f * solver->dt;
        weir_solids_drift(&solver->world, solver->clock.time + half, half, solver->solids);
        weir_wcsph_place_solids(solver, &solver->state);
    }
    if (solver->has_emitters) weir_wcsph_emit(solver);
}

// ---- kick ----

static void kick_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirWcsphData *data = &solver->data;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t group = solver->sorted.group[i];
        if (!weir_group_is_fluid(group)) continue;
        float dt = group == WEIR_GROUP_FLUID ? solver->dt : 0.0f; // an inlet's particles keep their velocity
        for (int axis = 0; axis < 3; ++axis)
            data->new_velocity[axis][i] = data->velocity[axis][i] + dt * data->acceleration[axis][i];
    }
}

void weir_wcsph_kick(WeirWcsph *solver)
{
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, kick_chunk, solver);
    // A surface that slides along itself displaces no fluid.
    weir_wcsph_solid_velocities(solver, false, solver->data.new_velocity);
}

// ---- finish ----

typedef struct Maxima {
    float speed2, acceleration2, density_error;
    uint32_t fluid, bad, first_bad_id;
} Maxima;

static void note(WeirWcsph *solver, const Maxima *maxima)
{
    weir_atomic_max(&solver->speed_bits, sqrtf(maxima->speed2));
    weir_atomic_max(&solver->acceleration_bits, sqrtf(maxima->acceleration2));
    weir_atomic_max(&solver->density_bits, maxima->density_error);
    atomic_fetch_add_explicit(&solver->fluid_in_step, maxima->fluid, memory_order_relaxed);
    if (maxima->bad == 0) return;
    atomic_fetch_add_explicit(&solver->bad_in_step, maxima->bad, memory_order_relaxed);
    uint32_t old = atomic_load_explicit(&solver->first_bad_id, memory_order_relaxed);
    while (old > maxima->first_bad_id &&
           !atomic_compare_exchange_weak_explicit(&solver->first_bad_id, &old, maxima->first_bad_id,
                                                  memory_order_relaxed, memory_order_relaxed)) {
    }
}

static float square(const float *const v[3], uint32_t i)
{
    return v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i];
}

// The seal of the domain's own walls: no fluid gets deeper into them than one spacing.
static void seal(const WeirWcsph *solver, WeirWcsphParticles *particles, uint32_t i)
{
    const WeirConstants *constants = &solver->constants;
    const uint32_t periods[3] = {constants->period_x, constants->period_y, constants->period_z};
    for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
        float depth = solver->parameters.particle_spacing;
        float low =
            (constants->domain_min[axis] - depth - constants->origin[axis]) * constants->inverse_quantum;
        float high =
            (constants->domain_max[axis] + depth - constants->origin[axis]) * constants->inverse_quantum;
        int32_t *x = &particles->x[axis][i];
        float *v = &particles->velocity[axis][i];
        if (periods[axis] > 0) continue;
        if ((float)*x < low && !(constants->open_sides >> (2 * axis) & 1)) {
            *x = (int32_t)low;
            *v = fmaxf(*v, 0.0f);
        }
        if ((float)*x > high && !(constants->open_sides >> (2 * axis + 1) & 1)) {
            *x = (int32_t)high;
            *v = fminf(*v, 0.0f);
        }
    }
}

static void finish_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirWcsphData *data = &solver->data;
    WeirWcsphParticles *to = &solver->sorted;
    const float limit = solver->constants.speed_limit * solver->constants.speed_limit;
    float dt = solver->dt, half = 0.5f * dt, rest_density = solver->parameters.rest_density;
    Maxima maxima = {.first_bad_id = UINT32_MAX};
    for (uint32_t i = begin; i < end; ++i) {
        if (!weir_group_is_fluid(to->group[i])) continue;
        bool free = to->group[i] == WEIR_GROUP_FLUID;
        float speed2 = square((const float *const *)data->new_velocity, i), way[3];
        if (!(speed2 <= limit) || !isfinite(data->rate[i])) { // NaN compares false
            ++maxima.bad;
            if (to->id[i] < maxima.first_bad_id) maxima.first_bad_id = to->id[i];
        }
        for (int axis = 0; axis < 3; ++axis) {
            to->velocity[axis][i] = data->new_velocity[axis][i];
            way[axis] = half * to->velocity[axis][i] + (free ? dt * data->shift[axis][i] : 0.0f);
        }
        to->excess[i] += half * data->rate[i];
        move(&solver->constants, to, i, way);
        if (free) seal(solver, to, i);
        ++maxima.fluid;
        maxima.speed2 = fmaxf(maxima.speed2, speed2);
        maxima.density_error = fmaxf(maxima.density_error, fabsf(to->excess[i]) / rest_density);
        if (free)
            maxima.acceleration2 =
                fmaxf(maxima.acceleration2, square((const float *const *)data->acceleration, i));
    }
    note(solver, &maxima);
}

void weir_wcsph_begin_maxima(WeirWcsph *solver)
{
    solver->speed_bits = solver->acceleration_bits = solver->density_bits = 0;
    solver->fluid_in_step = solver->bad_in_step = 0;
    solver->first_bad_id = UINT32_MAX;
}

// The sorted particles become the state.
void weir_wcsph_finish(WeirWcsph *solver)
{
    weir_wcsph_begin_maxima(solver);
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, finish_chunk, solver);
    if (solver->has_moving_solids) {
        float half = 0.5f * solver->dt;
        weir_solids_drift(&solver->world, solver->clock.time + solver->dt, half, solver->solids);
        weir_wcsph_place_solids(solver, &solver->sorted);
    }
    WeirWcsphParticles sorted = solver->sorted;
    solver->sorted = solver->state;
    solver->state = sorted;
}

// ---- time_step ----

void weir_wcsph_time_step(WeirWcsph *solver)
{
    const WeirParameters *parameters = &solver->parameters;
    const WeirConstants *constants = &solver->constants;
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
    if (parameters->stepping == WEIR_STEPPING_FIXED) {
        clock->time_step = parameters->time_step;
        return;
    }
    float h = constants->smoothing_length, dt = h / (constants->sound_speed + clock->max_speed);
    if (clock->max_acceleration > 0.0f) dt = fminf(dt, sqrtf(h / clock->max_acceleration));
    dt *= parameters->courant;
    if (parameters->viscosity > 0.0f)
        dt = fminf(dt, 0.125f * h * h * parameters->rest_density / parameters->viscosity);
    clock->time_step = dt;
}
