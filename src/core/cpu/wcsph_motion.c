// What moves particles: drift, kick, finish of docs/wcsph.md, each for particles [begin, end). Mirrors shaders/wcsph/.
//
// WEIR_LANES particles at a time, which share no sums; what happens to few (drains, nozzles) one by one. The build compiles this
// file once per instruction set; all variants give the same bits.
#include "core/cpu/simd.h"
#include "core/cpu/wcsph.h"
#include "core/grid.h"

#include <math.h>

// Name of the variant that this compilation makes.
#ifndef WEIR_WCSPH_MOTION
#define WEIR_WCSPH_MOTION weir_wcsph_motion_base
#endif
extern const WeirWcsphMotion WEIR_WCSPH_MOTION;

// Where distances lead, in quanta: by whole ones; what is not finite or absurd does not move.
static inline WeirMask moved(const WeirConstants *constants, WeirMask x, WeirLanes distance, uint32_t period)
{
    WeirLanes steps = weir_lanes_round(distance * constants->inverse_quantum);
    WeirMask sane = (WeirMask)(weir_lanes_abs(steps) < 1e9f), p = x - x + (int32_t)period;
    x += __builtin_convertvector((WeirLanes)((WeirMask)steps & sane), WeirMask);
    if (period == 0) return x;
    x += (x < 0) & p;
    return x - ((x >= p) & p);
}

static inline WeirMask free_lanes(const uint32_t *group, uint32_t i, uint32_t end)
{
    WeirMask g = weir_mask_load((const int32_t *)group + i);
    return (g == WEIR_GROUP_FLUID) & weir_mask_first(end - i);
}

// Free fluid and what emitters still push.
static inline WeirMask fluid_lanes(const uint32_t *group, uint32_t i, uint32_t end)
{
    WeirMask g = weir_mask_load((const int32_t *)group + i);
    WeirMask inlet = (g >= WEIR_GROUP_INLET) & (g != WEIR_GROUP_EMPTY);
    return ((g == WEIR_GROUP_FLUID) | inlet) & weir_mask_first(end - i);
}

static inline WeirMask select_places(WeirMask mask, WeirMask a, WeirMask b)
{
    return (mask & a) | (~mask & b);
}

// ---- drift ----

// Fluid beyond an open side, or beyond a wall by more than a support radius, is gone.
static inline WeirMask is_outside(const WeirConstants *constants, const WeirMask x[3])
{
    WeirMask outside = {0};
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        outside |= (x[axis] < constants->inside_low[axis]) | (x[axis] > constants->inside_high[axis]);
    return outside;
}

static inline WeirMask in_box(const WeirDrain *box, const WeirLanes place[3], uint32_t dimension)
{
    WeirMask inside = ~(WeirMask){0};
    for (uint32_t axis = 0; axis < dimension; ++axis)
        inside &= (WeirMask)(place[axis] >= box->min[axis]) & (WeirMask)(place[axis] <= box->max[axis]);
    return inside;
}

// Which particles are in a drain? Most are in no group's box.
static inline WeirMask is_drained(const WeirWcsph *solver, const WeirMask x[3])
{
    const WeirWorld *world = &solver->world;
    const WeirConstants *constants = &solver->constants;
    WeirMask drained = {0};
    WeirLanes place[3];
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        place[axis] =
            constants->origin[axis] + __builtin_convertvector(x[axis], WeirLanes) * constants->quantum;
    for (uint32_t group = 0; group < world->drain_group_count; ++group) {
        if (!weir_mask_any(in_box(&world->drain_groups[group], place, constants->dimension))) continue;
        uint32_t first = group * WEIR_DRAIN_GROUP, end = first + WEIR_DRAIN_GROUP;
        for (uint32_t n = first; n < end && n < world->drain_count; ++n)
            drained |= in_box(&world->drains[n], place, constants->dimension);
    }
    return drained;
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

// What leaves the fluid or enters it: few particles, one by one.
static void leave_or_enter(WeirWcsph *solver, uint32_t i, bool drained, bool outside)
{
    uint32_t *group = &solver->state.group[i];
    if (*group != WEIR_GROUP_FLUID) {
        if (has_passed(solver, i)) *group = WEIR_GROUP_FLUID;
        return;
    }
    if (!drained && !outside) return;
    *group = WEIR_GROUP_EMPTY;
    atomic_fetch_add_explicit(drained ? &solver->drained_in_step : &solver->lost_in_step, 1,
                              memory_order_relaxed);
}

static void drift(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    WeirWcsphParticles *state = &solver->state;
    const WeirConstants *constants = &solver->constants;
    float half = 0.5f * solver->dt;
    for (uint32_t i = begin; i < end; i += WEIR_LANES) {
        WeirMask fluid = fluid_lanes(state->group, i, end), x[3];
        for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
            WeirMask from = weir_mask_load(state->x[axis] + i);
            WeirLanes way = half * weir_lanes_load(state->velocity[axis] + i);
            x[axis] = moved(constants, from, way, weir_period(constants, axis));
            weir_mask_store(state->x[axis] + i, select_places(fluid, x[axis], from));
        }
        WeirLanes excess = weir_lanes_load(state->excess + i);
        WeirLanes later = excess + half * weir_lanes_load(state->rate + i);
        weir_lanes_store(state->excess + i, weir_lanes_select(fluid, later, excess));
        WeirMask outside = is_outside(constants, x) & fluid;
        WeirMask drained = is_drained(solver, x) & fluid;
        WeirMask special = outside | drained | (fluid & ~free_lanes(state->group, i, end));
        if (!weir_mask_any(special)) continue;
        for (uint32_t lane = 0; lane < WEIR_LANES; ++lane) {
            if (special[lane]) leave_or_enter(solver, i + lane, drained[lane], outside[lane]);
        }
    }
}

// ---- kick ----

// An inlet's particles keep their velocity.
static void kick(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirWcsphData *data = &solver->data;
    for (uint32_t i = begin; i < end; i += WEIR_LANES) {
        WeirMask free = free_lanes(solver->sorted.group, i, end);
        WeirLanes dt = (WeirLanes)((WeirMask)weir_lanes_fill(solver->dt) & free);
        for (int axis = 0; axis < 3; ++axis) {
            WeirLanes v = weir_lanes_load(data->velocity[axis] + i);
            weir_lanes_store(data->new_velocity[axis] + i,
                             v + dt * weir_lanes_load(data->acceleration[axis] + i));
        }
    }
}

// ---- finish ----

typedef struct Maxima {
    WeirLanes speed2, acceleration2, density_error;
    WeirMask fluid; // minus their number
    uint32_t bad, first_bad_id;
} Maxima;

static float largest(WeirLanes lanes)
{
    float result = 0.0f;
    for (int lane = 0; lane < WEIR_LANES; ++lane) result = lanes[lane] > result ? lanes[lane] : result;
    return result;
}

static void note(WeirWcsph *solver, const Maxima *maxima)
{
    uint32_t fluid = 0;
    for (int lane = 0; lane < WEIR_LANES; ++lane) fluid -= (uint32_t)maxima->fluid[lane];
    weir_atomic_max(&solver->speed_bits, sqrtf(largest(maxima->speed2)));
    weir_atomic_max(&solver->acceleration_bits, sqrtf(largest(maxima->acceleration2)));
    weir_atomic_max(&solver->density_bits, largest(maxima->density_error));
    atomic_fetch_add_explicit(&solver->fluid_in_step, fluid, memory_order_relaxed);
    if (maxima->bad == 0) return;
    atomic_fetch_add_explicit(&solver->bad_in_step, maxima->bad, memory_order_relaxed);
    uint32_t old = atomic_load_explicit(&solver->first_bad_id, memory_order_relaxed);
    while (old > maxima->first_bad_id &&
           !atomic_compare_exchange_weak_explicit(&solver->first_bad_id, &old, maxima->first_bad_id,
                                                  memory_order_relaxed, memory_order_relaxed)) {
    }
}

// The larger of a maximum and a value of the lanes in `mask`; NaN is passed over.
static inline WeirLanes larger(WeirLanes maximum, WeirLanes value, WeirMask mask)
{
    return weir_lanes_max((WeirLanes)((WeirMask)value & mask), maximum);
}

static inline WeirLanes square(const float *const v[3], uint32_t i)
{
    WeirLanes x = weir_lanes_load(v[0] + i), y = weir_lanes_load(v[1] + i), z = weir_lanes_load(v[2] + i);
    return x * x + y * y + z * z;
}

static void note_bad(Maxima *maxima, const uint32_t *id, WeirMask bad)
{
    if (!weir_mask_any(bad)) return;
    for (uint32_t lane = 0; lane < WEIR_LANES; ++lane) {
        if (!bad[lane]) continue;
        ++maxima->bad;
        if (id[lane] < maxima->first_bad_id) maxima->first_bad_id = id[lane];
    }
}

// The seal of the domain's own walls: no free fluid stays deeper in them than half a spacing, where their first layer lies.
static inline void seal(const WeirConstants *constants, uint32_t axis, WeirMask free, WeirMask *x,
                        WeirLanes *v)
{
    const WeirLanes zero = {0};
    const WeirMask low = (WeirMask){0} + constants->seal_low[axis],
                   high = (WeirMask){0} + constants->seal_high[axis];
    WeirMask below = (*x < low) & free, above = (*x > high) & free;
    *x = select_places(below, low, select_places(above, high, *x));
    *v = weir_lanes_select(below, weir_lanes_max(*v, zero), *v);
    *v = weir_lanes_select(above, weir_lanes_min(*v, zero), *v);
}

// Share of the rest density below which fluid is not stretched, but torn: its tension would pull without bound.
static const float least_density = 0.8f;

static void finish(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirWcsphData *data = &solver->data;
    const WeirConstants *constants = &solver->constants;
    WeirWcsphParticles *to = &solver->sorted;
    const float limit = constants->speed_limit * constants->speed_limit;
    float dt = solver->dt, half = 0.5f * dt, rest_density = solver->parameters.rest_density;
    const WeirLanes least = weir_lanes_fill((least_density - 1.0f) * rest_density);
    Maxima maxima = {.first_bad_id = UINT32_MAX};
    for (uint32_t i = begin; i < end; i += WEIR_LANES) {
        WeirMask fluid = fluid_lanes(to->group, i, end), free = free_lanes(to->group, i, end);
        WeirLanes speed2 = square((const float *const *)data->new_velocity, i);
        WeirLanes rate = weir_lanes_load(data->rate + i), excess = weir_lanes_load(to->excess + i);
        WeirMask good =
            (WeirMask)(speed2 <= limit) & (WeirMask)(weir_lanes_abs(rate) < INFINITY); // NaN: false
        note_bad(&maxima, to->id + i, fluid & ~good);
        for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
            WeirLanes v = weir_lanes_load(data->new_velocity[axis] + i);
            WeirLanes shift = dt * weir_lanes_load(data->shift[axis] + i);
            WeirMask from = weir_mask_load(to->x[axis] + i);
            WeirMask x = moved(constants, from, half * v + (WeirLanes)((WeirMask)shift & free),
                               weir_period(constants, axis));
            seal(constants, axis, free, &x, &v);
            weir_mask_store(to->x[axis] + i, select_places(fluid, x, from));
            weir_lanes_store(to->velocity[axis] + i,
                             weir_lanes_select(fluid, v, weir_lanes_load(to->velocity[axis] + i)));
        }
        WeirLanes later = weir_lanes_max(excess + half * rate, least);
        excess = weir_lanes_select(fluid, later, excess);
        weir_lanes_store(to->excess + i, excess);
        maxima.fluid += fluid;
        maxima.speed2 = larger(maxima.speed2, speed2, fluid);
        maxima.density_error = larger(maxima.density_error, weir_lanes_abs(excess) / rest_density, fluid);
        maxima.acceleration2 =
            larger(maxima.acceleration2, square((const float *const *)data->acceleration, i), free);
    }
    note(solver, &maxima);
}

const WeirWcsphMotion WEIR_WCSPH_MOTION = {drift, kick, finish};
