// What a world is for the device: walls, bodies, emitters, drains, and the particles at the start.
#include "core/grid.h"
#include "core/solids.h"
#include "gpu/wcsph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A copy from malloc; NULL for none, with *good cleared if memory runs out.
static void *copy_array(const void *from, size_t count, size_t size, bool *good)
{
    if (count == 0) return NULL;
    void *copy = malloc(count * size);
    if (copy) memcpy(copy, from, count * size);
    if (!copy) *good = false;
    return copy;
}

static void note_traits(WeirWcsphGpu *solver)
{
    const WeirWorld *world = &solver->world;
    WeirWcsphTraits *traits = &solver->traits;
    *traits = (WeirWcsphTraits){.dimension = solver->common.constants.dimension,
                                .solid_count = world->solid_count,
                                .emitter_count = world->emitter_count,
                                .drain_count = world->drain_count,
                                .drain_group_count = world->drain_group_count};
    for (uint32_t n = 0; n < world->solid_count; ++n) {
        const WeirSolid *solid = &world->solids[n];
        traits->moving_solids = traits->moving_solids || solid->kind != WEIR_SOLID_FIXED;
        traits->free_solids = traits->free_solids || solid->kind == WEIR_SOLID_FREE;
        traits->slip_solids = traits->slip_solids || !solid->no_slip;
        const float *v = solid->surface_velocity;
        float speed = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        traits->fastest_surface = fmaxf(traits->fastest_surface, speed);
    }
    traits->can_empty = world->drain_count > 0 || solver->common.constants.open_sides != 0;
}

// Blocks of solid n behind those that there are.
static void add_blocks(WeirWcsphGpu *solver, uint32_t n)
{
    const WeirSolid *solid = &solver->world.solids[n];
    for (uint32_t first = 0; first < solid->count; first += WEIR_SOLID_BLOCK) {
        uint32_t rest = solid->count - first, count = rest < WEIR_SOLID_BLOCK ? rest : WEIR_SOLID_BLOCK;
        uint32_t *block = solver->blocks[solver->traits.block_count++];
        block[0] = n;
        block[1] = solid->first + first;
        block[2] = solid->first + first + count;
        block[3] = 0;
    }
}

static bool make_blocks(WeirWcsphGpu *solver)
{
    const WeirWorld *world = &solver->world;
    size_t most = 1;
    for (uint32_t n = 0; n < world->solid_count; ++n) most += world->solids[n].count / WEIR_SOLID_BLOCK + 1;
    solver->blocks = malloc(most * sizeof *solver->blocks);
    if (!solver->blocks) return false;
    for (uint32_t n = 0; n < world->solid_count; ++n)
        if (world->solids[n].kind == WEIR_SOLID_FREE) add_blocks(solver, n);
    solver->traits.free_block_count = solver->traits.block_count;
    for (uint32_t n = 0; n < world->solid_count; ++n)
        if (world->solids[n].kind != WEIR_SOLID_FREE) add_blocks(solver, n);
    return true;
}

bool weir_gpu_wcsph_copy_world(WeirWcsphGpu *solver, const WeirSolverSetup *setup)
{
    const WeirWorld *world = setup->world;
    WeirWorld *copy = &solver->world;
    bool good = true;
    *copy = *world;
    copy->particles = (WeirParticles){0};
    size_t coordinates = (size_t)world->point_count * setup->constants.dimension;
    copy->solids = copy_array(world->solids, world->solid_count, sizeof *world->solids, &good);
    copy->motion = copy_array(world->motion, world->motion_count, sizeof *world->motion, &good);
    copy->emitters = copy_array(world->emitters, world->emitter_count, sizeof *world->emitters, &good);
    copy->points = copy_array(world->points, coordinates, sizeof *world->points, &good);
    copy->drains = copy_array(world->drains, world->drain_count, sizeof *world->drains, &good);
    good = good && weir_world_group_drains(copy);
    size_t solid_particles = setup->constants.particle_count - setup->constants.first_solid;
    solver->local_place = calloc(4 * solid_particles + 4, sizeof *solver->local_place);
    if (!good || !solver->local_place) return false;
    note_traits(solver);
    return make_blocks(solver);
}

void weir_gpu_wcsph_free_world(WeirWcsphGpu *solver)
{
    weir_world_free(&solver->world);
    free(solver->blocks);
    free(solver->local_place);
}

// ---- What stays ----

// Where an emitter's particles are born: one support radius upstream of their points of the nozzle.
static void write_nozzle(WeirWcsphGpu *solver, const WeirEmitter *emitter)
{
    enum { AT_ONCE = 64 };
    const WeirConstants *constants = &solver->common.constants;
    uint32_t dimension = constants->dimension;
    WGPUBuffer nozzle = solver->common.buffers.handle[WEIR_WCSPH_nozzle][0];
    int32_t places[AT_ONCE][4] = {{0}};
    for (uint32_t k = 0; k < emitter->point_count; ++k) {
        uint32_t point = emitter->point_first + k, ready = k % AT_ONCE + 1;
        for (uint32_t axis = 0; axis < dimension; ++axis) {
            double at = solver->world.points[(size_t)dimension * point + axis];
            double upstream = (double)constants->search_radius * (double)emitter->direction[axis];
            places[ready - 1][axis] = weir_coordinate_of(constants, at - upstream, axis);
        }
        if (ready < AT_ONCE && k + 1 < emitter->point_count) continue;
        wgpuQueueWriteBuffer(solver->common.gpu->queue, nozzle, 16 * (uint64_t)(point + 1 - ready), places,
                             ready * sizeof *places);
    }
}

static void write_flows(WeirWcsphGpu *solver)
{
    WeirBuffers *buffers = &solver->common.buffers;
    const WeirWorld *world = &solver->world;
    if (world->emitter_count > 0)
        weir_buffers_write(buffers, WEIR_WCSPH_emitters, world->emitters,
                           world->emitter_count * sizeof *world->emitters);
    for (uint32_t n = 0; n < world->emitter_count; ++n) write_nozzle(solver, &world->emitters[n]);
    if (world->drain_count == 0) return;
    size_t groups = world->drain_group_count * sizeof *world->drain_groups;
    weir_buffers_write(buffers, WEIR_WCSPH_drains, world->drain_groups, groups);
    wgpuQueueWriteBuffer(solver->common.gpu->queue, buffers->handle[WEIR_WCSPH_drains][0], groups,
                         world->drains, world->drain_count * sizeof *world->drains);
}

void weir_gpu_wcsph_write_world(WeirWcsphGpu *solver)
{
    WeirBuffers *buffers = &solver->common.buffers;
    const WeirWorld *world = &solver->world;
    write_flows(solver);
    if (world->motion_count > 0)
        weir_buffers_write(buffers, WEIR_WCSPH_motion_rows, world->motion,
                           world->motion_count * sizeof *world->motion);
    if (world->solid_count == 0) return;
    weir_buffers_write(buffers, WEIR_WCSPH_blocks, solver->blocks,
                       solver->traits.block_count * sizeof *solver->blocks);
}

// ---- What a new state changes ----

typedef struct State {
    int32_t (*coordinate)[4];
    float (*motion)[4];
    uint32_t *id;
} State;

static void set_local_place(WeirWcsphGpu *solver, const WeirParticles *particles, uint32_t i, uint32_t group)
{
    const WeirConstants *constants = &solver->common.constants;
    const WeirSolid *solid = &solver->world.solids[group - WEIR_GROUP_SOLID];
    float *local = solver->local_place + 4 * (size_t)(i - constants->first_solid);
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        local[axis] = (float)(particles->position[(size_t)constants->dimension * i + axis] -
                              (double)solid->position[axis]);
}

static void set_particle(WeirWcsphGpu *solver, const WeirParticles *particles, uint32_t i, const State *state)
{
    const WeirConstants *constants = &solver->common.constants;
    uint32_t dimension = constants->dimension;
    uint32_t group = particles->group ? particles->group[i] : WEIR_GROUP_FLUID;
    memset(state->coordinate[i], 0, sizeof state->coordinate[i]);
    memset(state->motion[i], 0, sizeof state->motion[i]);
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        size_t k = (size_t)dimension * i + axis;
        state->coordinate[i][axis] = weir_coordinate_of(constants, particles->position[k], axis);
        state->motion[i][axis] = particles->velocity[k];
    }
    state->coordinate[i][3] = (int32_t)group;
    state->motion[i][3] =
        particles->density ? particles->density[i] - solver->common.parameters.rest_density : 0.0f;
    state->id[i] = i;
    if (weir_group_is_solid(group))
        set_local_place(solver, particles, i, group);
    else if (group != WEIR_GROUP_EMPTY)
        ++solver->fluid_at_start;
}

// Solids that a motion or a reset puts elsewhere than the world has their particles.
static void place_solids(const WeirWcsphGpu *solver, const WeirSolidState *states, const State *state)
{
    const WeirConstants *constants = &solver->common.constants;
    for (uint32_t i = constants->first_solid; i < constants->particle_count; ++i) {
        uint32_t n = (uint32_t)state->coordinate[i][3] - WEIR_GROUP_SOLID;
        if (solver->world.solids[n].kind == WEIR_SOLID_FIXED) continue;
        double place[3];
        float velocity[3];
        weir_solid_point(&states[n], solver->local_place + 4 * (size_t)(i - constants->first_solid), place,
                         velocity);
        for (uint32_t axis = 0; axis < constants->dimension; ++axis)
            state->coordinate[i][axis] = weir_coordinate_of(constants, place[axis], axis);
    }
}

// How far from its reference point a solid's particles are, m.
static float radius_of(const WeirWcsphGpu *solver, const WeirSolid *solid)
{
    float most = 0.0f;
    for (uint32_t id = solid->first; id < solid->first + solid->count; ++id) {
        const float *arm = solver->local_place + 4 * (size_t)(id - solver->common.constants.first_solid);
        most = fmaxf(most, arm[0] * arm[0] + arm[1] * arm[1] + arm[2] * arm[2]);
    }
    return sqrtf(most);
}

// The device's table has each solid's radius in position[3], and weir_solid_bulk() in freedom[3].
static bool write_solid_table(WeirWcsphGpu *solver)
{
    const WeirConstants *constants = &solver->common.constants;
    uint32_t count = solver->world.solid_count;
    WeirSolid *table = malloc(count * sizeof *table);
    if (!table) return false;
    for (uint32_t n = 0; n < count; ++n) {
        table[n] = solver->world.solids[n];
        table[n].position[3] = radius_of(solver, &table[n]);
        table[n].freedom[3] = weir_solid_bulk(&table[n], constants->dimension, constants->particle_mass,
                                              solver->common.parameters.particle_spacing);
    }
    weir_buffers_write(&solver->common.buffers, WEIR_WCSPH_solid_table, table, count * sizeof *table);
    free(table);
    return true;
}

static bool start_solids(WeirWcsphGpu *solver, const State *state)
{
    uint32_t count = solver->world.solid_count;
    if (count == 0) return true;
    WeirSolidState *states = calloc(3 * (size_t)count, sizeof *states);
    if (!states) return false;
    weir_solids_start(&solver->world, states);
    memcpy(states + count, states, count * sizeof *states);
    memcpy(states + 2 * (size_t)count, states, count * sizeof *states);
    place_solids(solver, states, state);
    weir_buffers_write(&solver->common.buffers, WEIR_WCSPH_solid_state, states,
                       3 * (size_t)count * sizeof *states);
    free(states);
    return write_solid_table(solver);
}

bool weir_gpu_wcsph_write_state(WeirWcsphGpu *solver, const WeirParticles *particles)
{
    WeirBuffers *buffers = &solver->common.buffers;
    const WeirConstants *constants = &solver->common.constants;
    size_t count = constants->particle_count;
    State state = {malloc(count * sizeof *state.coordinate), malloc(count * sizeof *state.motion),
                   malloc(count * sizeof *state.id)};
    bool good = state.coordinate && state.motion && state.id;
    solver->fluid_at_start = 0;
    for (uint32_t i = 0; good && i < count; ++i) set_particle(solver, particles, i, &state);
    good = good && start_solids(solver, &state);
    if (good) {
        weir_buffers_write(buffers, WEIR_WCSPH_coordinate, state.coordinate,
                           count * sizeof *state.coordinate);
        weir_buffers_write(buffers, WEIR_WCSPH_motion, state.motion, count * sizeof *state.motion);
        weir_buffers_write(buffers, WEIR_WCSPH_id, state.id, count * sizeof *state.id);
        size_t solid_particles = count - constants->first_solid;
        if (solid_particles > 0)
            weir_buffers_write(buffers, WEIR_WCSPH_solid_particle, solver->local_place, 16 * solid_particles);
    }
    free(state.coordinate);
    free(state.motion);
    free(state.id);
    return good;
}
