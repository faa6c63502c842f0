// Memory of the CPU solver of `wcsph`: its arrays, the state at the start, snapshots, and copies by id.
#include "core/cpu/pairs.h"
#include "core/cpu/wcsph.h"
#include "core/grid.h"

#include <stdlib.h>
#include <string.h>

typedef struct WeirHostCopy {
    float *position, *velocity, *acceleration, *density, *pressure;
    uint32_t *group;
} WeirHostCopy;

// ---- Arrays ----

static bool make_particles(WeirWcsphParticles *particles, size_t size)
{
    int32_t *words = calloc(10 * size, sizeof *words);
    if (!words) return false;
    float *numbers = (float *)(void *)words;
    for (int axis = 0; axis < 3; ++axis) {
        particles->x[axis] = words + (size_t)axis * size;
        particles->velocity[axis] = numbers + (size_t)(3 + axis) * size;
    }
    particles->excess = numbers + 6 * size;
    particles->rate = numbers + 7 * size;
    particles->id = (uint32_t *)(void *)(words + 8 * size);
    particles->group = (uint32_t *)(void *)(words + 9 * size);
    return true;
}

// One block for the arrays of `data` that do not belong to the sorted particles.
static bool make_sums(WeirWcsph *solver, size_t size)
{
    enum { ARRAYS = 23 };
    float *next = solver->sums = calloc(ARRAYS * size, sizeof *next);
    if (!next) return false;
    WeirWcsphData *data = &solver->data;
    float **single[] = {&data->inverse_density, &data->pressure, &data->weight, &data->wetted};
    float **vector[] = {data->seen_velocity, data->new_velocity, data->acceleration, data->shift,
                        data->extrapolated};
    for (size_t n = 0; n < sizeof single / sizeof *single; ++n, next += size) *single[n] = next;
    for (size_t n = 0; n < sizeof vector / sizeof *vector; ++n) {
        for (int axis = 0; axis < 3; ++axis, next += size) vector[n][axis] = next;
    }
    data->is_fluid = next, next += size;
    data->stick = next, next += size;
    data->barrier = next, next += size;
    data->needs_force = next;
    return true;
}

// A copy from malloc of `count` elements; NULL for none, with *good cleared if memory runs out.
static void *copy_array(const void *from, size_t count, size_t size, bool *good)
{
    if (count == 0) return NULL;
    void *copy = malloc(count * size);
    if (copy) memcpy(copy, from, count * size);
    if (!copy) *good = false;
    return copy;
}

static bool copy_world(WeirWcsph *solver, const WeirWorld *world)
{
    bool good = true;
    WeirWorld *copy = &solver->world;
    *copy = *world;
    copy->particles = (WeirParticles){0};
    copy->solids = copy_array(world->solids, world->solid_count, sizeof *world->solids, &good);
    copy->motion = copy_array(world->motion, world->motion_count, sizeof *world->motion, &good);
    copy->emitters = copy_array(world->emitters, world->emitter_count, sizeof *world->emitters, &good);
    copy->points = copy_array(world->points, (size_t)world->point_count * world->particles.dimension,
                              sizeof(double), &good);
    copy->drains = copy_array(world->drains, world->drain_count, sizeof *world->drains, &good);
    good = good && weir_world_group_drains(copy);
    solver->has_emitters = world->emitter_count > 0;
    for (uint32_t n = 0; good && n < world->solid_count; ++n) {
        solver->has_moving_solids = solver->has_moving_solids || world->solids[n].kind != WEIR_SOLID_FIXED;
        solver->has_free_bodies = solver->has_free_bodies || world->solids[n].kind == WEIR_SOLID_FREE;
    }
    solver->walls_by_pair = solver->constants.dimension == 2 && !solver->has_moving_solids;
    return good;
}

static size_t padded(const WeirWcsph *solver)
{
    return (size_t)solver->constants.particle_count + WEIR_PAIRS_PADDING;
}

bool weir_wcsph_allocate(WeirWcsph *solver, const WeirSolverSetup *setup)
{
    solver->constants = setup->constants;
    uint32_t count = setup->constants.particle_count;
    size_t size = padded(solver), solid_particles = count - setup->constants.first_solid;
    solver->pool = weir_pool_create(setup->threads);
    if (!solver->pool || !weir_cells_make(&solver->cells, count) || !make_particles(&solver->state, size) ||
        !make_particles(&solver->sorted, size) || !make_particles(&solver->snapshot.particles, size) ||
        !make_sums(solver, size) || !copy_world(solver, setup->world)) {
        return false;
    }
    // At least one of each, so that none is NULL.
    uint32_t solids = solver->world.solid_count + 1, emitters = solver->world.emitter_count + 1;
    solver->solids = calloc(solids, sizeof *solver->solids);
    solver->snapshot.solids = calloc(solids, sizeof *solver->solids);
    solver->emitters = calloc(emitters, sizeof *solver->emitters);
    solver->vacancy =
        calloc(solver->has_emitters ? setup->constants.first_solid + 1 : 1, sizeof *solver->vacancy);
    solver->local = calloc(3 * solid_particles + 1, sizeof *solver->local);
    solver->bulk = calloc(solids, sizeof *solver->bulk);
    solver->seen = calloc(3 * solid_particles + 1, sizeof *solver->seen);
    solver->solid_force = calloc(solid_particles + 1, sizeof *solver->solid_force);
    return solver->solids && solver->snapshot.solids && solver->emitters && solver->vacancy &&
           solver->local && solver->bulk && solver->seen && solver->solid_force;
}

void weir_wcsph_free(WeirWcsph *solver)
{
    weir_pool_destroy(solver->pool);
    weir_cells_free(&solver->cells);
    free(solver->state.x[0]);
    free(solver->sorted.x[0]);
    free(solver->snapshot.particles.x[0]);
    free(solver->snapshot.solids);
    free(solver->sums);
    weir_world_free(&solver->world);
    free(solver->solids);
    free(solver->emitters);
    free(solver->vacancy);
    free(solver->local);
    free(solver->bulk);
    free(solver->seen);
    free(solver->solid_force);
    if (solver->host) {
        free(solver->host->position);
        free(solver->host->group);
    }
    free(solver->host);
}

// ---- The state at the start ----

static void set_particle(WeirWcsph *solver, const WeirParticles *particles, uint32_t i)
{
    const WeirConstants *constants = &solver->constants;
    uint32_t dimension = constants->dimension;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        size_t k = (size_t)dimension * i + axis;
        solver->state.x[axis][i] =
            axis < dimension ? weir_coordinate_of(constants, particles->position[k], axis) : 0;
        solver->state.velocity[axis][i] = axis < dimension ? particles->velocity[k] : 0.0f;
    }
    solver->state.excess[i] =
        particles->density ? particles->density[i] - solver->parameters.rest_density : 0.0f;
    solver->state.rate[i] = 0.0f;
    solver->state.id[i] = i;
    solver->state.group[i] = particles->group ? particles->group[i] : WEIR_GROUP_FLUID;
    if (!weir_group_is_solid(solver->state.group[i])) return;
    const WeirSolid *solid = &solver->world.solids[solver->state.group[i] - WEIR_GROUP_SOLID];
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        solver->local[3 * (size_t)(i - constants->first_solid) + axis] =
            (float)(particles->position[(size_t)dimension * i + axis] - solid->position[axis]);
    }
}

void weir_wcsph_set_particles(WeirWcsph *solver, const WeirParticles *particles)
{
    for (uint32_t i = 0; i < solver->constants.particle_count; ++i) set_particle(solver, particles, i);
    weir_solids_start(&solver->world, solver->solids);
    for (uint32_t n = 0; n < solver->world.solid_count; ++n)
        solver->bulk[n] =
            weir_solid_bulk(&solver->world.solids[n], solver->constants.dimension,
                            solver->constants.particle_mass, solver->parameters.particle_spacing);
    if (solver->has_moving_solids) weir_wcsph_place_solids(solver, &solver->state);
    memset(solver->emitters, 0, (solver->world.emitter_count + 1) * sizeof *solver->emitters);
    solver->clock = (WeirWcsphClock){0};
    solver->bad = (WeirHealth){0};
}

// ---- Snapshots ----

static void copy_particles(const WeirWcsph *solver, WeirWcsphParticles *to, const WeirWcsphParticles *from)
{
    memcpy(to->x[0], from->x[0], 10 * padded(solver) * sizeof *to->x[0]);
}

void weir_wcsph_take_snapshot(WeirWcsph *solver)
{
    WeirWcsphSnapshot *snapshot = &solver->snapshot;
    copy_particles(solver, &snapshot->particles, &solver->state);
    memcpy(snapshot->solids, solver->solids, solver->world.solid_count * sizeof *snapshot->solids);
    snapshot->clock = solver->clock;
}

void weir_wcsph_restore_snapshot(WeirWcsph *solver)
{
    const WeirWcsphSnapshot *snapshot = &solver->snapshot;
    copy_particles(solver, &solver->state, &snapshot->particles);
    memcpy(solver->solids, snapshot->solids, solver->world.solid_count * sizeof *snapshot->solids);
    solver->clock = snapshot->clock;
}

// ---- Copies by id ----

static bool make_host(WeirWcsph *solver)
{
    size_t count = solver->constants.particle_count, vector = solver->constants.dimension * count;
    WeirHostCopy *host = calloc(1, sizeof *host);
    if (!host) return false;
    host->position = calloc(3 * vector + 2 * count, sizeof *host->position);
    host->group = calloc(count, sizeof *host->group);
    solver->host = host;
    if (!host->position || !host->group) return false;
    host->velocity = host->position + vector;
    host->acceleration = host->velocity + vector;
    host->density = host->acceleration + vector;
    host->pressure = host->density + count;
    return true;
}

typedef struct Copy {
    const WeirWcsph *solver;
    const WeirWcsphParticles *from;
} Copy;

static void copy_motion_chunk(void *context, uint32_t begin, uint32_t end)
{
    const Copy *copy = context;
    const WeirConstants *constants = &copy->solver->constants;
    const WeirWcsphParticles *from = copy->from;
    WeirHostCopy *host = copy->solver->host;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t id = from->id[i];
        bool empty = from->group[i] == WEIR_GROUP_EMPTY;
        for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
            size_t k = (size_t)constants->dimension * id + axis;
            double place = (double)constants->origin[axis] + from->x[axis][i] * (double)constants->quantum;
            host->position[k] = (float)place;
            host->velocity[k] = empty ? 0.0f : from->velocity[axis][i];
        }
        host->group[id] = from->group[i];
    }
}

static void copy_evaluated_chunk(void *context, uint32_t begin, uint32_t end)
{
    const Copy *copy = context;
    const WeirWcsph *solver = copy->solver;
    WeirHostCopy *host = solver->host;
    uint32_t dimension = solver->constants.dimension;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t id = copy->from->id[i];
        bool empty = copy->from->group[i] == WEIR_GROUP_EMPTY;
        for (uint32_t axis = 0; axis < dimension; ++axis)
            host->acceleration[(size_t)dimension * id + axis] =
                empty ? 0.0f : solver->data.acceleration[axis][i];
        host->density[id] = empty ? 0.0f : solver->parameters.rest_density + copy->from->excess[i];
        host->pressure[id] = empty ? 0.0f : solver->data.pressure[i];
    }
}

bool weir_wcsph_copy_state(WeirWcsph *solver, bool evaluated, WeirState *state)
{
    if (!solver->host && !make_host(solver)) return false;
    uint32_t count = solver->constants.particle_count;
    Copy copy = {solver, evaluated ? &solver->sorted : &solver->state};
    weir_pool_run(solver->pool, count, WEIR_WCSPH_CHUNK, copy_motion_chunk, &copy);
    if (evaluated) weir_pool_run(solver->pool, count, WEIR_WCSPH_CHUNK, copy_evaluated_chunk, &copy);
    const WeirHostCopy *host = solver->host;
    *state = (WeirState){
        .count = solver->constants.particle_count,
        .dimension = solver->constants.dimension,
        .step = solver->clock.steps,
        .position = host->position,
        .velocity = host->velocity,
        .acceleration = host->acceleration,
        .density = host->density,
        .pressure = host->pressure,
        .group = host->group,
        .solids = solver->solids,
        .time = solver->clock.time,
    };
    return true;
}
