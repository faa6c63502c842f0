// Emitters: layers of particles born one support radius upstream of their nozzle, in slots that were empty.
#include "core/cpu/wcsph.h"
#include "core/grid.h"

#include <string.h>

static double travel_of(const WeirWcsph *solver, uint32_t n, double time)
{
    const WeirEmitter *emitter = &solver->world.emitters[n];
    return emitter->speed * (time - emitter->start);
}

// Particles that appear must be sorted in, so emitters share the steps in which they do: with a layer that is due come
// those that will be within half a spacing of flow, and a layer that finds no slots is put off by as much.
static double share_of(const WeirWcsph *solver)
{
    return 0.5 * (double)solver->parameters.particle_spacing;
}

// Whether emitter n's next layer is due within `ahead` metres of flow; there is one per spacing of flow.
static bool is_due(const WeirWcsph *solver, uint32_t n, double time, double ahead)
{
    const WeirEmitter *emitter = &solver->world.emitters[n];
    double due = solver->emitters[n].next_travel;
    return time <= emitter->stop && due <= travel_of(solver, n, emitter->stop) &&
           travel_of(solver, n, time) >= due - ahead;
}

// At a chance, whether a layer is due before the next one, if the steps until then are as long as this one may be.
static bool any_is_due(const WeirWcsph *solver, double time)
{
    if (solver->clock.steps % solver->emission_interval != 0) return false;
    double until_next = solver->emission_interval * (double)solver->free_dt;
    for (uint32_t n = 0; n < solver->world.emitter_count; ++n)
        if (is_due(solver, n, time, solver->world.emitters[n].speed * until_next)) return true;
    return false;
}

static bool takes_part(const WeirWcsph *solver, uint32_t n, double time)
{
    return is_due(solver, n, time, share_of(solver));
}

// Leaves the places of the `wanted` empty slots of the lowest ids in solver->vacancy, by id; returns how many there are.
static uint32_t find_slots(WeirWcsph *solver, uint32_t wanted)
{
    const WeirWcsphParticles *state = &solver->state;
    uint32_t *vacancy = solver->vacancy, slots = solver->constants.first_solid, found = 0;
    memset(vacancy, 0, slots * sizeof *vacancy);
    for (uint32_t i = 0; i < solver->constants.particle_count; ++i)
        if (state->group[i] == WEIR_GROUP_EMPTY) vacancy[state->id[i]] = i + 1;
    for (uint32_t id = 0; id < slots && found < wanted; ++id)
        if (vacancy[id] > 0) vacancy[found++] = vacancy[id] - 1;
    return found;
}

// A particle of the layer that has come `way` metres from the place of birth.
static void bear(WeirWcsph *solver, uint32_t n, uint32_t point, double way, uint32_t i)
{
    const WeirConstants *constants = &solver->constants;
    const WeirEmitter *emitter = &solver->world.emitters[n];
    const double *at = solver->world.points + (size_t)constants->dimension * (emitter->point_first + point);
    WeirWcsphParticles *state = &solver->state;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        double place = axis < constants->dimension
                           ? at[axis] + (way - (double)constants->search_radius) * emitter->direction[axis]
                           : constants->origin[axis];
        state->x[axis][i] = weir_coordinate_of(constants, place, axis);
        state->velocity[axis][i] =
            axis < constants->dimension ? emitter->speed * emitter->direction[axis] : 0.0f;
    }
    state->excess[i] = 0.0f;
    state->rate[i] = 0.0f;
    state->group[i] = WEIR_GROUP_INLET + n;
}

static void bear_layer(WeirWcsph *solver, uint32_t n, double time, const uint32_t *places)
{
    double spacing = solver->parameters.particle_spacing, travel = travel_of(solver, n, time);
    double *due = &solver->emitters[n].next_travel;
    double way = travel - *due < spacing ? travel - *due : 0.0; // 0: it is very late; below: early
    for (uint32_t k = 0; k < solver->world.emitters[n].point_count; ++k) bear(solver, n, k, way, places[k]);
    *due = travel - way + spacing;
}

// One look for empty slots serves all layers of a step, in order. A layer that finds too few waits, whole, and leaves them to the next.
void weir_wcsph_emit(WeirWcsph *solver)
{
    const WeirWorld *world = &solver->world;
    double time = solver->clock.time + 0.5 * solver->dt;
    uint32_t wanted = 0, taken = 0;
    if (!any_is_due(solver, time)) return;
    for (uint32_t n = 0; n < world->emitter_count; ++n)
        wanted += takes_part(solver, n, time) ? world->emitters[n].point_count : 0;
    uint32_t found = find_slots(solver, wanted);
    for (uint32_t n = 0; n < world->emitter_count; ++n) {
        uint32_t count = world->emitters[n].point_count;
        if (!takes_part(solver, n, time)) continue;
        if (count > found - taken) {
            solver->emitters[n].next_travel += share_of(solver);
            continue;
        }
        bear_layer(solver, n, time, solver->vacancy + taken);
        taken += count;
    }
}
