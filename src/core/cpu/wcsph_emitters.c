// Emitters: layers of particles born one support radius upstream of their nozzle, in slots that were empty.
#include "core/cpu/wcsph.h"

#include <math.h>
#include <stdlib.h>

// An empty slot: where it is in the state's arrays, and its id.
typedef struct Slot {
    uint32_t id, place;
} Slot;

static int by_id(const void *a, const void *b)
{
    uint32_t x = ((const Slot *)a)->id, y = ((const Slot *)b)->id;
    return (x > y) - (x < y);
}

// The empty slots by id; NULL if there are none or memory runs out (the layer waits then).
static Slot *empty_slots(const WeirWcsph *solver, uint32_t *count)
{
    *count = 0;
    for (uint32_t i = 0; i < solver->constants.particle_count; ++i)
        *count += solver->state.group[i] == WEIR_GROUP_EMPTY;
    Slot *slots = *count > 0 ? malloc(*count * sizeof *slots) : NULL;
    if (!slots) return NULL;
    uint32_t next = 0;
    for (uint32_t i = 0; i < solver->constants.particle_count; ++i) {
        if (solver->state.group[i] == WEIR_GROUP_EMPTY) slots[next++] = (Slot){solver->state.id[i], i};
    }
    qsort(slots, *count, sizeof *slots, by_id);
    return slots;
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
        state->x[axis][i] = (int32_t)rint((place - constants->origin[axis]) / constants->quantum);
        state->velocity[axis][i] =
            axis < constants->dimension ? emitter->speed * emitter->direction[axis] : 0.0f;
    }
    state->excess[i] = 0.0f;
    state->rate[i] = 0.0f;
    state->group[i] = WEIR_GROUP_INLET + n;
}

// One layer per spacing of flow. A layer that finds too few empty slots waits, whole.
static void emit_from(WeirWcsph *solver, uint32_t n, double time)
{
    const WeirEmitter *emitter = &solver->world.emitters[n];
    double spacing = solver->parameters.particle_spacing, travel = emitter->speed * (time - emitter->start);
    double *due = &solver->emitters[n].next_travel;
    if (time < emitter->start || time > emitter->stop || travel < *due) return;
    uint32_t empty;
    Slot *slots = empty_slots(solver, &empty);
    if (slots && empty >= emitter->point_count) {
        double way = travel - *due < spacing ? travel - *due : 0.0; // 0: it waited
        for (uint32_t k = 0; k < emitter->point_count; ++k) bear(solver, n, k, way, slots[k].place);
        *due = travel - way + spacing;
    }
    free(slots);
}

void weir_wcsph_emit(WeirWcsph *solver)
{
    double time = solver->clock.time + 0.5 * solver->dt;
    for (uint32_t n = 0; n < solver->world.emitter_count; ++n) emit_from(solver, n, time);
}
