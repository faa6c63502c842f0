#include "core/solids.h"
#include "core/exact_math.h"
#include "core/grid.h"

#include <float.h>
#include <math.h>
#include <string.h>

// ---- Small vectors ----

static void cross(const float a[3], const float b[3], float result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

// v turned by the unit quaternion q: v + 2 w (u x v) + 2 u x (u x v), u the vector part.
static void rotate(const float q[4], const float v[3], float result[3])
{
    float once[3], twice[3];
    cross(q, v, once);
    cross(q, once, twice);
    for (int axis = 0; axis < 3; ++axis) result[axis] = v[axis] + 2.0f * (q[3] * once[axis] + twice[axis]);
}

// Unit quaternion of a rotation given as angle times axis.
static void rotation_quaternion(const float rotation[3], float q[4])
{
    double angle2 = 0.0, sine, cosine;
    for (int axis = 0; axis < 3; ++axis) angle2 += (double)rotation[axis] * rotation[axis];
    double angle = sqrt(angle2);
    weir_sine_cosine(0.5 * angle, &sine, &cosine);
    double scale = angle > 1e-12 ? sine / angle : 0.5;
    for (int axis = 0; axis < 3; ++axis) q[axis] = (float)(scale * rotation[axis]);
    q[3] = (float)cosine;
}

// q after a turn with angular velocity w (world frame) over dt: q + dt/2 (w, 0) q, normalised.
static void turn(float q[4], const float w[3], float dt)
{
    float part[3], half = 0.5f * dt;
    cross(w, q, part);
    float scalar = -half * (w[0] * q[0] + w[1] * q[1] + w[2] * q[2]);
    for (int axis = 0; axis < 3; ++axis) part[axis] = half * (part[axis] + q[3] * w[axis]);
    for (int axis = 0; axis < 3; ++axis) q[axis] += part[axis];
    q[3] += scalar;
    float scale = 1.0f / sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; ++k) q[k] *= scale;
}

// ---- Prescribed motion ----

// A motion at one time in double precision: a mean velocity is the small difference of two such.
typedef struct Motion {
    double time;
    double displacement[3], rotation[3], displacement_rate[3], rotation_rate[3];
} Motion;

// Cubic Hermite between (f0, d0) and (f1, d1) at the share s of an interval `length`, and its rate.
static void hermite(double s, double length, const float f0[3], const float d0[3], const float f1[3],
                    const float d1[3], double value[3], double rate[3])
{
    double s2 = s * s, s3 = s2 * s;
    for (int axis = 0; axis < 3; ++axis) {
        double a = f0[axis], b = length * d0[axis], c = f1[axis], d = length * d1[axis];
        value[axis] =
            (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * b + (3 * s2 - 2 * s3) * c + (s3 - s2) * d;
        rate[axis] = ((6 * s2 - 6 * s) * (a - c) + (3 * s2 - 4 * s + 1) * b + (3 * s2 - 2 * s) * d) / length;
    }
}

static Motion motion_at(const WeirMotionRow *rows, uint32_t count, bool repeats, double time)
{
    double first = rows[0].time, last = rows[count - 1].time;
    if (repeats && last > first && time > last) time = first + fmod(time - first, last - first);
    bool before = time<first, after = time> last;
    Motion now = {.time = time};
    if (before || after || count == 1) { // outside its table a motion stands still
        const WeirMotionRow *row = &rows[before ? 0 : count - 1];
        for (int axis = 0; axis < 3; ++axis) {
            now.displacement[axis] = row->displacement[axis];
            now.rotation[axis] = row->rotation[axis];
        }
        return now;
    }
    uint32_t low = 0, high = count - 1; // rows[low].time <= time < rows[high].time
    while (high - low > 1) {
        uint32_t middle = (low + high) / 2;
        if ((double)rows[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    const WeirMotionRow *a = &rows[low], *b = &rows[high];
    double length = (double)b->time - a->time, s = (time - a->time) / length;
    hermite(s, length, a->displacement, a->displacement_rate, b->displacement, b->displacement_rate,
            now.displacement, now.displacement_rate);
    hermite(s, length, a->rotation, a->rotation_rate, b->rotation, b->rotation_rate, now.rotation,
            now.rotation_rate);
    return now;
}

void weir_motion_at(const WeirMotionRow *rows, uint32_t count, bool repeats, double time, WeirMotionRow *now)
{
    Motion exact = motion_at(rows, count, repeats, time);
    now->time = (float)exact.time;
    for (int axis = 0; axis < 3; ++axis) {
        now->displacement[axis] = (float)exact.displacement[axis];
        now->displacement_rate[axis] = (float)exact.displacement_rate[axis];
        now->rotation[axis] = (float)exact.rotation[axis];
        now->rotation_rate[axis] = (float)exact.rotation_rate[axis];
    }
}

static const WeirMotionRow *rows_of(const WeirWorld *world, const WeirSolid *solid)
{
    return world->motion + solid->motion_first;
}

static void motion_of(const WeirWorld *world, const WeirSolid *solid, double time, WeirMotionRow *now)
{
    weir_motion_at(rows_of(world, solid), solid->motion_count, solid->motion_repeats, time, now);
}

// 900 m from the origin float32 knows 0.06 mm, and a step is less. So the position moves by whole units, twice what float32 tells
// apart there, and the rest waits. (Kahan's sum is shorter, but some drivers of the GPU take (a + b) - a for b.)
static void move_by(WeirSolidState *state, int axis, float way)
{
    union {
        float number;
        uint32_t bits;
    } unit = {state->position[axis]};
    unit.bits &= 0x7f800000u;
    unit.bits = (unit.bits > 0x20000000u ? unit.bits : 0x20000000u) - (22u << 23);
    float sum = state->rest[axis] + way, whole = rintf(sum / unit.number) * unit.number;
    state->position[axis] += whole;
    state->rest[axis] = sum - whole;
}

static void place_driven(const WeirWorld *world, const WeirSolid *solid, double time, WeirSolidState *state)
{
    WeirMotionRow now;
    motion_of(world, solid, time, &now);
    for (int axis = 0; axis < 3; ++axis) {
        state->position[axis] = solid->position[axis];
        state->rest[axis] = 0.0f;
        move_by(state, axis, now.displacement[axis]);
    }
    rotation_quaternion(now.rotation, state->orientation);
}

static bool is_driven(const WeirSolid *solid)
{
    return solid->kind == WEIR_SOLID_DRIVEN && solid->motion_count > 0;
}

void weir_solids_start(const WeirWorld *world, WeirSolidState *states)
{
    for (uint32_t n = 0; n < world->solid_count; ++n) {
        const WeirSolid *solid = &world->solids[n];
        states[n] = (WeirSolidState){.orientation = {0.0f, 0.0f, 0.0f, 1.0f}};
        memcpy(states[n].position, solid->position, sizeof states[n].position);
        memcpy(states[n].velocity, solid->velocity, sizeof states[n].velocity);
        memcpy(states[n].angular_velocity, solid->angular_velocity, sizeof states[n].angular_velocity);
        if (!is_driven(solid)) continue;
        WeirMotionRow now;
        motion_of(world, solid, 0.0, &now);
        place_driven(world, solid, 0.0, &states[n]);
        memcpy(states[n].velocity, now.displacement_rate, sizeof now.displacement_rate);
        memcpy(states[n].angular_velocity, now.rotation_rate, sizeof now.rotation_rate);
    }
}

// ---- Rigid bodies ----

// I^-1 v in world coordinates: R I0^-1 R^T v.
static void apply_inverse_inertia(const WeirSolid *solid, const WeirSolidState *state, const float v[3],
                                  float result[3])
{
    const float back[4] = {-state->orientation[0], -state->orientation[1], -state->orientation[2],
                           state->orientation[3]};
    float local[3], turned[3];
    rotate(back, v, local);
    for (int row = 0; row < 3; ++row) {
        const float *m = solid->inverse_inertia[row];
        turned[row] = m[0] * local[0] + m[1] * local[1] + m[2] * local[2];
    }
    rotate(state->orientation, turned, result);
}

// I0 from its inverse (adjugate over determinant); zero where the body cannot turn.
static void inertia(const WeirSolid *solid, float matrix[3][3])
{
    float rows[3][3];
    for (int k = 0; k < 3; ++k)
        cross(solid->inverse_inertia[(k + 1) % 3], solid->inverse_inertia[(k + 2) % 3], rows[k]);
    const float *first = solid->inverse_inertia[0];
    float determinant = first[0] * rows[0][0] + first[1] * rows[0][1] + first[2] * rows[0][2];
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) matrix[a][b] = determinant != 0.0f ? rows[b][a] / determinant : 0.0f;
    }
}

// w x (I w), world coordinates; 0 in 2D, where w is an axis of inertia.
static void gyroscopic(const WeirSolid *solid, const WeirSolidState *state, float torque[3])
{
    const float back[4] = {-state->orientation[0], -state->orientation[1], -state->orientation[2],
                           state->orientation[3]};
    float matrix[3][3], local[3], momentum[3], world[3];
    inertia(solid, matrix);
    rotate(back, state->angular_velocity, local);
    for (int row = 0; row < 3; ++row)
        momentum[row] = matrix[row][0] * local[0] + matrix[row][1] * local[1] + matrix[row][2] * local[2];
    rotate(state->orientation, momentum, world);
    cross(state->angular_velocity, world, torque);
}

// The length of a rod of that mass whose particles lie as far from its centre, root mean square; of other bodies 1.2 to 1.7 times
// the longest side. 0 where the body cannot turn.
static float length_of(const WeirSolid *solid, uint32_t dimension)
{
    if (dimension == 2) {
        float inverse = solid->inverse_inertia[2][2] * solid->mass;
        return inverse > 0.0f ? sqrtf(12.0f / inverse) : 0.0f;
    }
    float matrix[3][3];
    inertia(solid, matrix);
    return sqrtf(fmaxf(6.0f * (matrix[0][0] + matrix[1][1] + matrix[2][2]) / solid->mass, 0.0f));
}

float weir_solid_bulk(const WeirSolid *solid, uint32_t dimension, float particle_mass, float spacing)
{
    if (solid->kind != WEIR_SOLID_FREE) return FLT_MAX;
    uint64_t side = 1;
    while (side * side * (dimension == 3 ? side : 1) < solid->count) ++side;
    float face = (float)(dimension == 3 ? side * side : side);
    float most = solid->mass / (2.0f * particle_mass); // two pairs per particle across a face
    if (most < face) return most / face;
    float across = length_of(solid, dimension) / spacing;
    float longest = fminf(dimension == 3 ? across * across : across, (float)solid->count);
    return fmaxf(most / fmaxf(face, longest), 1.0f);
}

float weir_solid_barrier(const WeirSolid *solid, const WeirSolidState *state, float bulk)
{
    float dragged = state->force[3];
    return fminf(1.0f, dragged > solid->mass ? bulk * (dragged / solid->mass) : bulk);
}

float weir_solid_sway(const WeirSolid *solid, const WeirSolidState *state)
{
    static const float calm = 6.0f; // times what is dragged
    float dragged = state->force[3];
    return dragged > 0.0f ? fminf(1.0f, fmaxf(solid->mass, dragged) / (calm * dragged)) : 1.0f;
}

static void kick_free(const WeirSolid *solid, const float gravity[4], float dt, WeirSolidState *state)
{
    float torque[3], spin[3], alpha[3];
    gyroscopic(solid, state, spin);
    for (int axis = 0; axis < 3; ++axis) torque[axis] = state->torque[axis] - spin[axis];
    apply_inverse_inertia(solid, state, torque, alpha);
    float slow = solid->mass < state->force[3] ? solid->mass / state->force[3] : 1.0f;
    for (int axis = 0; axis < 3; ++axis) {
        float a = solid->mass > 0.0f ? state->force[axis] / solid->mass + gravity[axis] : 0.0f;
        state->acceleration[axis] = slow * a * solid->freedom[axis];
        state->angular_acceleration[axis] = slow * alpha[axis] * solid->angular_freedom[axis];
        state->velocity[axis] += dt * state->acceleration[axis];
        state->angular_velocity[axis] += dt * state->angular_acceleration[axis];
    }
}

// Mean velocities over the step, so that the second half's drift ends where the motion is.
static void kick_driven(const WeirWorld *world, const WeirSolid *solid, double time, float dt,
                        WeirSolidState *state)
{
    const WeirMotionRow *rows = rows_of(world, solid);
    Motion begin = motion_at(rows, solid->motion_count, solid->motion_repeats, time);
    Motion end = motion_at(rows, solid->motion_count, solid->motion_repeats, time + dt);
    // A table that starts anew jumps back: the rate is the table's own there.
    bool jumps = end.time < begin.time;
    for (int axis = 0; axis < 3; ++axis) {
        double way = end.displacement[axis] - begin.displacement[axis];
        double angle = end.rotation[axis] - begin.rotation[axis];
        float v = (float)(jumps ? end.displacement_rate[axis] : dt > 0.0f ? way / dt : 0.0);
        float w = (float)(jumps ? end.rotation_rate[axis] : dt > 0.0f ? angle / dt : 0.0);
        state->acceleration[axis] = dt > 0.0f ? (v - state->velocity[axis]) / dt : 0.0f;
        state->angular_acceleration[axis] = dt > 0.0f ? (w - state->angular_velocity[axis]) / dt : 0.0f;
        state->velocity[axis] = v;
        state->angular_velocity[axis] = w;
    }
}

void weir_solids_kick(const WeirWorld *world, const float gravity[4], double time, float dt,
                      WeirSolidState *states)
{
    for (uint32_t n = 0; n < world->solid_count; ++n) {
        const WeirSolid *solid = &world->solids[n];
        if (solid->kind == WEIR_SOLID_FREE) kick_free(solid, gravity, dt, &states[n]);
        if (is_driven(solid)) kick_driven(world, solid, time, dt, &states[n]);
    }
}

// Out of the domain by half of its longest side: there a body stays. It would fall for ever, faster each step, and all steps
// would be shorter for it, until no coordinate could tell where it is.
static bool has_left(const WeirConstants *constants, const WeirSolidState *state)
{
    float longest = 0.0f, outside = 0.0f;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        float low = constants->domain_min[axis], high = constants->domain_max[axis];
        longest = fmaxf(longest, high - low);
        if (weir_period(constants, axis) == 0)
            outside = fmaxf(outside, fmaxf(low - state->position[axis], state->position[axis] - high));
    }
    return outside > 0.5f * longest;
}

void weir_solids_drift(const WeirWorld *world, const WeirConstants *constants, double time, float dt,
                       WeirSolidState *states)
{
    for (uint32_t n = 0; n < world->solid_count; ++n) {
        const WeirSolid *solid = &world->solids[n];
        if (is_driven(solid)) place_driven(world, solid, time, &states[n]);
        if (solid->kind != WEIR_SOLID_FREE) continue;
        if (has_left(constants, &states[n])) {
            memset(states[n].velocity, 0, sizeof states[n].velocity);
            memset(states[n].angular_velocity, 0, sizeof states[n].angular_velocity);
            continue;
        }
        for (int axis = 0; axis < 3; ++axis) move_by(&states[n], axis, dt * states[n].velocity[axis]);
        turn(states[n].orientation, states[n].angular_velocity, dt);
    }
}

void weir_solid_point(const WeirSolidState *state, const float local[3], double position[3],
                      float velocity[3])
{
    float arm[3], swing[3];
    rotate(state->orientation, local, arm);
    cross(state->angular_velocity, arm, swing);
    for (int axis = 0; axis < 3; ++axis) {
        position[axis] = (double)state->position[axis] + (double)state->rest[axis] + (double)arm[axis];
        velocity[axis] = state->velocity[axis] + swing[axis];
    }
}
