// Walls and bodies in the step: what their particles see of the fluid, the forces on them, contact.
#include "core/cpu/runs.h"
#include "core/cpu/wcsph.h"

#include <string.h>

static const WeirSolid *solid_of(const WeirWcsph *solver, uint32_t group)
{
    return &solver->world.solids[group - WEIR_GROUP_SOLID];
}

static bool is_moving(const WeirSolid *solid)
{
    return solid->kind != WEIR_SOLID_FIXED;
}

static const float *local_of(const WeirWcsph *solver, uint32_t id)
{
    return solver->local + 3 * (size_t)(id - solver->constants.first_solid);
}

// ---- Velocities and places ----

typedef struct Velocities {
    WeirWcsph *solver;
    const WeirWcsphParticles *particles;
    float surface; // 1 with the surface's own velocity, 0 without
    float *const *velocity;
} Velocities;

static void velocities_chunk(void *context, uint32_t begin, uint32_t end)
{
    const Velocities *target = context;
    const WeirWcsph *solver = target->solver;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t group = target->particles->group[i];
        if (!weir_group_is_solid(group)) continue;
        const WeirSolid *solid = solid_of(solver, group);
        double place[3];
        float v[3] = {0.0f, 0.0f, 0.0f};
        if (is_moving(solid))
            weir_solid_point(&solver->solids[group - WEIR_GROUP_SOLID],
                             local_of(solver, target->particles->id[i]), place, v);
        for (int axis = 0; axis < 3; ++axis)
            target->velocity[axis][i] = v[axis] + target->surface * solid->surface_velocity[axis];
    }
}

void weir_wcsph_solid_velocities(WeirWcsph *solver, const WeirWcsphParticles *particles, bool surface,
                                 float *const velocity[3])
{
    if (solver->world.solid_count == 0) return;
    Velocities target = {solver, particles, surface ? 1.0f : 0.0f, velocity};
    weir_pool_run(solver->pool, solver->constants.particle_count, WEIR_WCSPH_CHUNK, velocities_chunk,
                  &target);
}

typedef struct Places {
    WeirWcsph *solver;
    WeirWcsphParticles *particles;
} Places;

static void places_chunk(void *context, uint32_t begin, uint32_t end)
{
    const Places *target = context;
    const WeirWcsph *solver = target->solver;
    const WeirConstants *constants = &solver->constants;
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t group = target->particles->group[i];
        if (!weir_group_is_solid(group) || !is_moving(solid_of(solver, group))) continue;
        double place[3];
        float v[3];
        weir_solid_point(&solver->solids[group - WEIR_GROUP_SOLID],
                         local_of(solver, target->particles->id[i]), place, v);
        for (uint32_t axis = 0; axis < constants->dimension; ++axis)
            target->particles->x[axis][i] = weir_coordinate_of(constants, place[axis], axis);
    }
}

void weir_wcsph_place_solids(WeirWcsph *solver, WeirWcsphParticles *particles)
{
    Places target = {solver, particles};
    weir_pool_run(solver->pool, solver->constants.particle_count, WEIR_WCSPH_CHUNK, places_chunk, &target);
}

// ---- walls ----

static void cross(const float a[3], const float b[3], float result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

static void arm_of(const WeirSolidState *state, const double place[3], float arm[3])
{
    for (int axis = 0; axis < 3; ++axis)
        arm[axis] = (float)(place[axis] - (double)state->position[axis] - (double)state->rest[axis]);
}

// Acceleration of the solid at sorted particle i: a + alpha x r + w x (w x r).
static void acceleration_at(const WeirWcsph *solver, uint32_t i, uint32_t group, float a[3])
{
    const WeirSolidState *state = &solver->solids[group - WEIR_GROUP_SOLID];
    double place[3];
    float v[3], arm[3], swing[3], spin[3], pull[3];
    memset(a, 0, 3 * sizeof *a);
    if (!is_moving(solid_of(solver, group))) return;
    weir_solid_point(state, local_of(solver, solver->sorted.id[i]), place, v);
    arm_of(state, place, arm);
    cross(state->angular_acceleration, arm, swing);
    cross(state->angular_velocity, arm, spin);
    cross(state->angular_velocity, spin, pull);
    float sway = weir_solid_sway(solid_of(solver, group), state);
    for (int axis = 0; axis < 3; ++axis)
        a[axis] = sway * (state->acceleration[axis] + swing[axis]) + pull[axis];
}

// Friction over that of laminar flow, of fluid that moves by `slip` m/s along a wall: docs/wcsph.md.
static float turbulence(const WeirConstants *constants, float slip)
{
    float root = sqrtf(slip * constants->inverse_turbulent_slip);
    return fmaxf(root * sqrtf(root), 1.0f);
}

// Of solid particle i: from the fluid's velocity to the one that `forces` takes for friction.
static void mirror(const WeirWcsphData *data, uint32_t i)
{
    float slip[3], slip2 = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        slip[axis] = data->seen_velocity[axis][i] - data->velocity[axis][i];
        slip2 += slip[axis] * slip[axis];
    }
    float times = 1.0f - 2.0f * turbulence(data->constants, sqrtf(slip2));
    for (int axis = 0; axis < 3; ++axis)
        data->seen_velocity[axis][i] = data->velocity[axis][i] + times * slip[axis];
}

static void walls_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirWcsphData *data = &solver->data;
    const WeirParameters *parameters = &solver->parameters;
    float stiffness = solver->constants.sound_speed * solver->constants.sound_speed;
    solver->passes->walls(data, begin, end);
    for (uint32_t i = begin; i < end; ++i) {
        uint32_t group = solver->sorted.group[i];
        if (!weir_group_is_solid(group)) continue;
        float pressure = 0.0f;
        if (data->weight[i] > 0.0f) {
            float a[3];
            acceleration_at(solver, i, group, a);
            pressure = data->pressure[i];
            for (int axis = 0; axis < 3; ++axis)
                pressure += (parameters->gravity[axis] - a[axis]) * data->extrapolated[axis][i];
            if (pressure < 0.0f) pressure = 0.0f;
            mirror(data, i);
        } else {
            for (int axis = 0; axis < 3; ++axis) data->seen_velocity[axis][i] = data->velocity[axis][i];
        }
        data->pressure[i] = pressure;
        data->excess[i] = (pressure - parameters->background_pressure) / stiffness;
        data->inverse_density[i] = 1.0f / (parameters->rest_density + data->excess[i]);
        if (!solver->keeps_seen) continue;
        for (int axis = 0; axis < 3; ++axis) weir_wcsph_seen(solver, i)[axis] = data->seen_velocity[axis][i];
    }
}

void weir_wcsph_walls(WeirWcsph *solver)
{
    if (solver->world.solid_count == 0) return;
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, walls_chunk, solver);
}

// ---- Forces on solids ----

static float bulk_of(const WeirWcsph *solver, uint32_t i)
{
    return solver->bulk[solver->sorted.group[i] - WEIR_GROUP_SOLID];
}

// Penalty contact of sorted particle i, of a free body, with the particles of other solids closer than one spacing:
// stiff as the fluid, half damped, less so if either is light. Returns the mass of fluid that so many pairs would move.
static float contact_at(const WeirWcsph *solver, uint32_t i, float force[3])
{
    const WeirConstants *constants = &solver->constants;
    const WeirWcsphData *data = &solver->data;
    float spacing = solver->parameters.particle_spacing, mass = constants->particle_mass;
    float c0 = constants->sound_speed, stiffness = 0.25f * mass * c0 * c0 / (spacing * spacing);
    float damping = 0.5f * mass * c0 / spacing;
    WeirLaneGroup group;
    weir_take_lanes(constants, data->cell_start, data->x, i, i + 1, &group);
    weir_find_runs(constants, data->cell_start, &group);
    memset(force, 0, 3 * sizeof *force);
    float pressed = 0.0f;
    for (uint32_t n = 0; n < group.run_count; ++n) {
        for (uint32_t j = group.run[n].begin; j < group.run[n].end; ++j) {
            if (!weir_group_is_solid(solver->sorted.group[j]) ||
                solver->sorted.group[j] == solver->sorted.group[i])
                continue;
            float x[3], r2 = 0.0f, approach = 0.0f;
            for (int axis = 0; axis < 3; ++axis) {
                x[axis] = (float)(data->x[axis][i] - group.run[n].shift[axis] - data->x[axis][j]) *
                          constants->quantum;
                r2 += x[axis] * x[axis];
                approach += (data->velocity[axis][i] - data->velocity[axis][j]) * x[axis];
            }
            if (r2 >= spacing * spacing || r2 == 0.0f) continue;
            float bulk = fminf(bulk_of(solver, i), bulk_of(solver, j));
            pressed += bulk * mass;
            float r = sqrtf(r2), push = stiffness * (spacing - r) - damping * approach / r;
            if (push <= 0.0f) continue;
            for (int axis = 0; axis < 3; ++axis) force[axis] += bulk * push * x[axis] / r;
        }
    }
    return pressed;
}

static WeirWcsphSolidForce *force_on(const WeirWcsph *solver, uint32_t id)
{
    return &solver->solid_force[id - solver->constants.first_solid];
}

static void particle_forces_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirWcsph *solver = context;
    const WeirWcsphData *data = &solver->data;
    for (uint32_t i = begin; i < end; ++i) {
        if (data->needs_force[i] == 0.0f) continue;
        float mass = solver->constants.particle_mass;
        WeirWcsphSolidForce *force = force_on(solver, solver->sorted.id[i]);
        for (int axis = 0; axis < 3; ++axis) force->fluid[axis] = mass * data->acceleration[axis][i];
        force->wetted = mass * data->wetted[i];
        if (solid_of(solver, solver->sorted.group[i])->kind == WEIR_SOLID_FREE)
            force->pressed = contact_at(solver, i, force->contact);
    }
}

static float wetted_mass(const WeirWcsph *solver, const WeirSolid *solid)
{
    double sum = 0.0;
    for (uint32_t k = 0; k < solid->count; ++k) sum += force_on(solver, solid->first + k)->wetted;
    return (float)sum;
}

static float pressed_mass(const WeirWcsph *solver, const WeirSolid *solid)
{
    double sum = 0.0;
    for (uint32_t k = 0; k < solid->count; ++k) sum += force_on(solver, solid->first + k)->pressed;
    return (float)sum;
}

// Sums the particles' forces, of contact or of the fluid, in order of id, in double precision.
static void sum_forces(const WeirWcsph *solver, uint32_t n, bool of_contact, float force[3], float torque[3])
{
    const WeirSolid *solid = &solver->world.solids[n];
    double total[3] = {0.0, 0.0, 0.0}, moment[3] = {0.0, 0.0, 0.0};
    for (uint32_t k = 0; k < solid->count; ++k) {
        uint32_t id = solid->first + k;
        const float *f = of_contact ? force_on(solver, id)->contact : force_on(solver, id)->fluid;
        double place[3];
        float v[3], arm[3], turn[3];
        weir_solid_point(&solver->solids[n], local_of(solver, id), place, v);
        arm_of(&solver->solids[n], place, arm);
        cross(arm, f, turn);
        for (int axis = 0; axis < 3; ++axis) {
            total[axis] += f[axis];
            moment[axis] += turn[axis];
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        force[axis] = (float)total[axis];
        torque[axis] = (float)moment[axis];
    }
}

void weir_wcsph_sum_solid_forces(WeirWcsph *solver)
{
    weir_pool_run(solver->pool, solver->active, WEIR_WCSPH_CHUNK, particle_forces_chunk, solver);
    for (uint32_t n = 0; n < solver->world.solid_count; ++n) {
        if (solver->world.solids[n].kind == WEIR_SOLID_FREE || solver->forces_wanted)
            sum_forces(solver, n, false, solver->solids[n].force, solver->solids[n].torque);
    }
}

void weir_wcsph_solids(WeirWcsph *solver)
{
    if (!solver->has_moving_solids) return;
    if (solver->has_free_bodies) weir_wcsph_sum_solid_forces(solver);
    uint32_t count = solver->world.solid_count;
    // Contact moves the body, but the force that is told is the fluid's.
    for (uint32_t n = 0; n < count; ++n) {
        WeirSolidState *state = &solver->solids[n];
        if (solver->world.solids[n].kind != WEIR_SOLID_FREE) continue;
        const WeirSolid *solid = &solver->world.solids[n];
        float force[3], torque[3], pressed = pressed_mass(solver, solid);
        float share = pressed > solid->mass ? solid->mass / pressed : 1.0f;
        sum_forces(solver, n, true, force, torque);
        for (int axis = 0; axis < 3; ++axis) {
            state->force[axis] += share * force[axis];
            state->torque[axis] += share * torque[axis];
        }
        state->force[3] = wetted_mass(solver, solid);
    }
    weir_solids_kick(&solver->world, solver->parameters.gravity, solver->clock.time, solver->dt,
                     solver->solids);
    for (uint32_t n = 0; n < count; ++n) {
        if (solver->world.solids[n].kind == WEIR_SOLID_FREE)
            sum_forces(solver, n, false, solver->solids[n].force, solver->solids[n].torque);
    }
}
