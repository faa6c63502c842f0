#include "core/probe.h"
#include "core/grid.h"
#include "core/smoothing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Below this sum of weights a point has no fluid around it (probe.h).
static const double least_weight = 0.1;
// Sum of V W at a free surface: half of the bulk's 1.
static const double surface_weight = 0.5;
// Points per support radius at which a height probe looks for the surface before it bisects.
static const double height_points = 16.0;

// Everything that a measurement reads, in double where it is computed with.
typedef struct Field {
    const WeirState *state;
    size_t count; // ids below may be fluid
    uint32_t dimension, kernel;
    double support, mass;
    double period[3]; // m, 0: not periodic
} Field;

static Field make_field(const WeirState *state, const WeirParameters *parameters,
                        const WeirConstants *constants)
{
    Field field = {
        .state = state,
        .count = constants->first_solid && constants->first_solid < state->count ? constants->first_solid
                                                                                 : state->count,
        .dimension = state->dimension,
        .kernel = parameters->kernel,
        .support = parameters->support_radius,
        .mass = constants->particle_mass,
    };
    for (uint32_t axis = 0; axis < state->dimension; ++axis) {
        if (weir_period(constants, axis))
            field.period[axis] = (double)constants->domain_max[axis] - constants->domain_min[axis];
    }
    return field;
}

static bool is_fluid(const WeirState *state, size_t i)
{
    if (!state->group) return true;
    uint32_t group = state->group[i];
    return !weir_group_is_solid(group) && group != WEIR_GROUP_EMPTY;
}

// Shortest difference along an axis.
static double difference(const Field *field, uint32_t axis, double a, double b)
{
    double d = a - b, period = field->period[axis];
    return period > 0.0 ? d - period * floor(d / period + 0.5) : d;
}

// Squared distance of particle `i` from `point`; anything from support^2 on means "too far".
static double distance2(const Field *field, size_t i, const double point[3])
{
    const float *x = &field->state->position[field->dimension * i];
    double sum = 0.0;
    for (uint32_t axis = 0; axis < field->dimension; ++axis) {
        double d = difference(field, axis, point[axis], x[axis]);
        sum += d * d;
        if (sum >= field->support * field->support) break;
    }
    return sum;
}

static double weight(const Field *field, size_t i, double r2)
{
    double volume = field->mass / (double)field->state->density[i];
    return volume * weir_smoothing_value(field->kernel, field->dimension, sqrt(r2), field->support);
}

// Shepard-normalised value at `point` of `components` numbers per particle.
static void interpolate(const Field *field, const double point[3], const float *quantity, uint32_t components,
                        double values[3])
{
    double sum = 0.0, support2 = field->support * field->support;
    for (uint32_t k = 0; k < components; ++k) values[k] = 0.0;
    for (size_t i = 0; i < field->count; ++i) {
        double r2 = distance2(field, i, point);
        if (!(r2 < support2) || !is_fluid(field->state, i)) continue;
        double w = weight(field, i, r2);
        sum += w;
        for (uint32_t k = 0; k < components; ++k) values[k] += w * (double)quantity[components * i + k];
    }
    for (uint32_t k = 0; k < components; ++k) values[k] = sum >= least_weight ? values[k] / sum : 0.0;
}

// ---- Height ----

// A particle near the probe's line: place along it, squared distance from it, and volume.
typedef struct Near {
    double along, across2, volume;
} Near;

static void make_up(const WeirParameters *parameters, uint32_t dimension, double up[3])
{
    double length2 = 0.0;
    for (uint32_t axis = 0; axis < dimension; ++axis)
        length2 += (double)parameters->gravity[axis] * (double)parameters->gravity[axis];
    for (uint32_t axis = 0; axis < 3; ++axis) {
        bool part = axis < dimension && length2 > 0.0;
        up[axis] = part ? -(double)parameters->gravity[axis] / sqrt(length2) : 0.0;
    }
    if (!(length2 > 0.0)) up[1] = 1.0;
}

static bool is_near_line(const Field *field, size_t i, const double point[3], const double up[3], Near *near)
{
    const float *x = &field->state->position[field->dimension * i];
    double d[3] = {0.0, 0.0, 0.0}, along = 0.0, across2 = 0.0, offset = 0.0;
    for (uint32_t axis = 0; axis < field->dimension; ++axis) {
        d[axis] = difference(field, axis, x[axis], point[axis]);
        along += d[axis] * up[axis];
        offset += point[axis] * up[axis];
    }
    for (uint32_t axis = 0; axis < field->dimension; ++axis) {
        double rest = d[axis] - along * up[axis];
        across2 += rest * rest;
    }
    if (!(across2 < field->support * field->support) || !is_fluid(field->state, i)) return false;
    *near = (Near){offset + along, across2, field->mass / (double)field->state->density[i]};
    return true;
}

static double line_weight(const Field *field, const Near *near, size_t count, double along)
{
    double sum = 0.0, support2 = field->support * field->support;
    for (size_t k = 0; k < count; ++k) {
        double d = along - near[k].along, r2 = d * d + near[k].across2;
        if (r2 >= support2) continue;
        sum +=
            near[k].volume * weir_smoothing_value(field->kernel, field->dimension, sqrt(r2), field->support);
    }
    return sum;
}

// From above the highest particle downwards to the first point with enough fluid, then bisection.
static double find_surface(const Field *field, const Near *near, size_t count)
{
    double top = -INFINITY, bottom = INFINITY, step = field->support / height_points;
    for (size_t k = 0; k < count; ++k) {
        top = fmax(top, near[k].along);
        bottom = fmin(bottom, near[k].along);
    }
    double above = top + field->support;
    for (double along = above - step; along >= bottom - step; above = along, along -= step) {
        if (line_weight(field, near, count, along) < surface_weight) continue;
        double below = along;
        for (int k = 0; k < 30; ++k) {
            double middle = 0.5 * (above + below);
            *(line_weight(field, near, count, middle) < surface_weight ? &above : &below) = middle;
        }
        return below;
    }
    return NAN;
}

static double height(const Field *field, const WeirParameters *parameters, const double point[3])
{
    double up[3];
    size_t count = 0, capacity = 0;
    Near *near = NULL, found;
    make_up(parameters, field->dimension, up);
    for (size_t i = 0; i < field->count; ++i) {
        if (!is_near_line(field, i, point, up, &found)) continue;
        if (count == capacity) {
            capacity = capacity ? 2 * capacity : 256;
            Near *grown = realloc(near, capacity * sizeof *near);
            if (!grown) {
                free(near);
                return NAN;
            }
            near = grown;
        }
        near[count++] = found;
    }
    double surface = count ? find_surface(field, near, count) : NAN;
    free(near);
    return surface;
}

// ---- Front and mass ----

// Of a dot product with `direction`.
static double front_at(double farthest, const double direction[3], uint32_t dimension, double spacing)
{
    double length2 = 0.0;
    for (uint32_t axis = 0; axis < dimension; ++axis) length2 += direction[axis] * direction[axis];
    return length2 > 0.0 && isfinite(farthest) ? farthest / sqrt(length2) + 0.5 * spacing : NAN;
}

static double front(const Field *field, const double direction[3], double spacing)
{
    double farthest = -INFINITY;
    for (size_t i = 0; i < field->count; ++i) {
        const float *x = &field->state->position[field->dimension * i];
        double along = 0.0;
        for (uint32_t axis = 0; axis < field->dimension; ++axis) along += x[axis] * direction[axis];
        if (along > farthest && is_fluid(field->state, i)) farthest = along;
    }
    return front_at(farthest, direction, field->dimension, spacing);
}

static double mass_inside(const Field *field, const double min[3], const double max[3])
{
    size_t inside = 0;
    for (size_t i = 0; i < field->count; ++i) {
        const float *x = &field->state->position[field->dimension * i];
        bool in = true;
        for (uint32_t axis = 0; axis < field->dimension; ++axis)
            in = in && x[axis] >= min[axis] && x[axis] <= max[axis];
        inside += in && is_fluid(field->state, i);
    }
    return field->mass * (double)inside;
}

double weir_probe_value(const WeirProbePiece *probe, double found, const WeirParameters *parameters,
                        const WeirConstants *constants)
{
    if (probe->kind == WEIR_PROBE_MASS) return constants->particle_mass * found;
    return front_at(found, probe->direction, constants->dimension, parameters->particle_spacing);
}

// ---- What it looks at ----

WeirLook weir_probe_look(const WeirProbePiece *probe, const WeirParameters *parameters,
                         const WeirConstants *constants)
{
    static const WeirLookKind kinds[] = {
        [WEIR_PROBE_PRESSURE] = WEIR_LOOK_POINT, [WEIR_PROBE_VELOCITY] = WEIR_LOOK_POINT,
        [WEIR_PROBE_HEIGHT] = WEIR_LOOK_LINE,    [WEIR_PROBE_FORCE] = WEIR_LOOK_FORCE,
        [WEIR_PROBE_FRONT] = WEIR_LOOK_FARTHEST, [WEIR_PROBE_MASS] = WEIR_LOOK_BOX,
    };
    WeirLook look = {.kind = kinds[probe->kind]};
    double up[3];
    make_up(parameters, constants->dimension, up);
    bool box = look.kind == WEIR_LOOK_BOX;
    const double *from = box ? probe->min : probe->position, *to = box ? probe->max : probe->direction;
    if (look.kind == WEIR_LOOK_LINE) to = up;
    for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
        look.point[axis] = (float)from[axis];
        look.direction[axis] = (float)to[axis];
    }
    return look;
}

uint32_t weir_probe_reach(const WeirProbePiece *probes, uint32_t count, const WeirParameters *parameters,
                          const WeirConstants *constants)
{
    // In spacings: a particle has a volume of 1.
    double spacing = parameters->particle_spacing, support = parameters->support_radius / spacing;
    double length2 = 0.0, sum = 0.0;
    bool flat = constants->dimension == 2;
    for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
        double side = ((double)constants->domain_max[axis] - constants->domain_min[axis]) / spacing;
        length2 += side * side;
    }
    double ball = flat ? 3.15 * support * support : 4.19 * support * support * support;
    double line = (sqrt(length2) + 2.0 * support) * (flat ? 2.0 * support : 3.15 * support * support);
    for (uint32_t k = 0; k < count; ++k) {
        // Twice as many around a point as at rest; a line that is full of fluid from end to end is rare.
        bool point = probes[k].kind == WEIR_PROBE_PRESSURE || probes[k].kind == WEIR_PROBE_VELOCITY;
        sum += point ? 2.0 * ball + 16.0 : probes[k].kind == WEIR_PROBE_HEIGHT ? line + 16.0 : 0.0;
    }
    return (uint32_t)fmin(sum, constants->first_solid ? constants->first_solid : constants->particle_count);
}

// ---- The probe ----

uint32_t weir_probe_components(const WeirProbePiece *probe, uint32_t dimension)
{
    bool vector = probe->kind == WEIR_PROBE_VELOCITY || probe->kind == WEIR_PROBE_FORCE;
    return vector ? dimension : 1;
}

void weir_probe_measure(const WeirProbePiece *probe, uint32_t solid, const WeirState *state,
                        const WeirParameters *parameters, const WeirConstants *constants, double values[3])
{
    Field field = make_field(state, parameters, constants);
    switch (probe->kind) {
    case WEIR_PROBE_PRESSURE:
        interpolate(&field, probe->position, state->pressure, 1, values);
        break;
    case WEIR_PROBE_VELOCITY:
        interpolate(&field, probe->position, state->velocity, field.dimension, values);
        break;
    case WEIR_PROBE_HEIGHT:
        values[0] = height(&field, parameters, probe->position);
        break;
    case WEIR_PROBE_FORCE:
        for (uint32_t axis = 0; axis < field.dimension; ++axis)
            values[axis] = state->solids ? (double)state->solids[solid].force[axis] : (double)NAN;
        break;
    case WEIR_PROBE_FRONT:
        values[0] = front(&field, probe->direction, parameters->particle_spacing);
        break;
    case WEIR_PROBE_MASS:
        values[0] = mass_inside(&field, probe->min, probe->max);
        break;
    }
}
