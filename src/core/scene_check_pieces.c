// The checks of walls, bodies, emitters, drains and probes that need no particles.
#include "core/scene_shape.h"
#include "core/world_build.h"

#include <stdio.h>
#include <string.h>

static bool is_zero(const double v[3])
{
    return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0;
}

static WeirStatus missing(WeirScene *scene, const char *piece, const char *key)
{
    return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s: %s is missing", piece, key);
}

WeirStatus weir_check_inside(WeirScene *scene, const WeirShape *shape, const char *piece)
{
    double low[3], high[3];
    weir_shape_bounds(shape, scene->dimension, low, high);
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        // Box ends like 0.1 * 3 may lie beyond the wall by rounding alone.
        double slack = 1e-9 * (scene->domain_max[axis] - scene->domain_min[axis]);
        if (low[axis] >= scene->domain_min[axis] - slack && high[axis] <= scene->domain_max[axis] + slack)
            continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%s: reaches from %c = %g to %g; the domain allows %g to %g", piece, "xyz"[axis],
                         low[axis], high[axis], scene -> domain_min[axis], scene -> domain_max[axis]);
    }
    return WEIR_OK;
}

// min below max on each axis of a box.
static WeirStatus check_box(WeirScene *scene, const char *piece, const double min[3], const double max[3])
{
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        if (min[axis] < max[axis]) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s: min %c = %g must be below max %c = %g", piece,
                         "xyz"[axis], min[axis], "xyz"[axis], max[axis]);
    }
    return WEIR_OK;
}

// ---- Motions ----

static WeirStatus check_rows(WeirScene *scene, const WeirMotion *motion, const char *piece)
{
    if (motion->row_count < 2) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.motion.rows: has %u row; must have at least 2",
                         piece, motion->row_count);
    }
    const WeirMotionRow *first = &motion->rows[0];
    for (int axis = 0; axis < 3; ++axis) {
        if (first->displacement[axis] == 0.0f && first->rotation[axis] == 0.0f) continue;
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "%s.motion.rows[0]: is moved already; places are relative to the start, where they are 0", piece);
    }
    for (uint32_t n = 0; n < motion->row_count; ++n) {
        double time = motion->rows[n].time, before = n > 0 ? motion->rows[n - 1].time : -1e-30;
        if (time > before) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%s.motion.rows[%u]: its time %g s must be above %g s, that of the row before",
                         piece, n, time, n > 0 ? before : 0.0);
    }
    return WEIR_OK;
}

static WeirStatus check_motion(WeirScene *scene, const WeirMotion *motion, const char *piece)
{
    bool moves = !is_zero(motion->velocity) || !is_zero(motion->angular_velocity);
    bool swings = !is_zero(motion->amplitude) || !is_zero(motion->angle);
    if (moves + swings + (motion->row_count > 0) > 1) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.motion: has %s and %s; must be one of them",
                         piece, moves ? "a velocity" : "an amplitude",
                         motion->row_count > 0 ? "rows" : "an amplitude");
    }
    if (swings && motion->period == 0.0) return missing(scene, piece, "motion.period");
    if (!swings && motion->period > 0.0) return missing(scene, piece, "motion.amplitude or angle");
    if (motion->row_count == 0) return WEIR_OK;
    return check_rows(scene, motion, piece);
}

// ---- Walls and bodies ----

static WeirStatus check_name(WeirScene *scene, const WeirSolidPiece *piece, const char *path)
{
    if (piece->name[0] == '\0') return WEIR_OK;
    uint32_t same = strcmp(piece->name, "domain") == 0 ? 2 : 0;
    for (uint32_t n = 0; n < scene->wall_count; ++n) same += strcmp(scene->wall[n].name, piece->name) == 0;
    for (uint32_t n = 0; n < scene->body_count; ++n) same += strcmp(scene->body[n].name, piece->name) == 0;
    if (same == 1) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%s.name: \"%s\" is taken; every name must be another one", path, piece->name);
}

static WeirStatus check_solid(WeirScene *scene, const WeirSolidPiece *piece, const char *path)
{
    if (piece->shape.kind == WEIR_SHAPE_NONE)
        return missing(scene, path,
                       scene->dimension == 3 ? "box, ball, cylinder or mesh" : "box, ball or polygon");
    WeirStatus status = weir_shape_check(scene, &piece->shape, path);
    if (!status) status = check_name(scene, piece, path);
    if (!status && piece->is_driven) status = check_motion(scene, &piece->motion, path);
    if (!status && piece->is_driven && !is_zero(piece->surface_velocity)) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%s: has a surface_velocity and a motion; must be one of them", path);
    }
    return status;
}

static WeirStatus check_body(WeirScene *scene, const WeirSolidPiece *piece, const char *path)
{
    WeirStatus status = check_solid(scene, piece, path);
    if (status) return status;
    if (piece->density == 0.0 && !piece->is_driven) return missing(scene, path, "density");
    return weir_check_inside(scene, &piece->shape, path);
}

// ---- Emitters, drains, probes ----

static WeirStatus check_emitter(WeirScene *scene, const WeirEmitterPiece *piece, const char *path)
{
    if (!piece->has_center) return missing(scene, path, "center");
    if (is_zero(piece->direction)) return missing(scene, path, "direction (any length but 0)");
    if (piece->size == 0.0) return missing(scene, path, "size");
    if (piece->speed == 0.0 && piece->flow_rate == 0.0) return missing(scene, path, "speed or flow_rate");
    if (piece->speed > 0.0 && piece->flow_rate > 0.0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s: has speed and flow_rate; must be one of them",
                         path);
    }
    if (piece->stop > 0.0 && piece->stop <= piece->start) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s: stop = %g s must be after start = %g s", path,
                         piece->stop, piece->start);
    }
    if (piece->size / scene->parameters.particle_spacing < 1e4) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%s.size: %g m is more than 10000 spacings; raise parameters.particle_spacing", path,
                     piece->size);
}

static WeirStatus check_drain(WeirScene *scene, const WeirDrainPiece *piece, const char *path)
{
    if (!piece->has_min) return missing(scene, path, "min");
    if (!piece->has_max) return missing(scene, path, "max");
    return check_box(scene, path, piece->min, piece->max);
}

static WeirStatus check_probe(WeirScene *scene, const WeirProbePiece *piece, const char *path)
{
    bool at_point = piece->kind <= WEIR_PROBE_HEIGHT;
    if (!piece->has_kind) return missing(scene, path, "kind");
    if (at_point && !piece->has_position) return missing(scene, path, "position");
    if (piece->kind == WEIR_PROBE_FRONT && is_zero(piece->direction))
        return missing(scene, path, "direction");
    if (piece->kind == WEIR_PROBE_FORCE) {
        if (piece->target[0] == '\0') return missing(scene, path, "target");
        if (weir_scene_solid_index(scene, piece->target) >= 0) return WEIR_OK;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.target: no wall or body is named \"%s\"", path,
                         piece->target);
    }
    if (piece->kind != WEIR_PROBE_MASS) return WEIR_OK;
    if (!piece->has_min) return missing(scene, path, "min");
    if (!piece->has_max) return missing(scene, path, "max");
    return check_box(scene, path, piece->min, piece->max);
}

WeirStatus weir_scene_check_pieces(WeirScene *scene)
{
    char path[32];
    WeirStatus status = WEIR_OK;
    for (uint32_t n = 0; n < scene->wall_count && !status; ++n) {
        snprintf(path, sizeof path, "walls[%u]", n);
        status = check_solid(scene, &scene->wall[n], path);
    }
    for (uint32_t n = 0; n < scene->body_count && !status; ++n) {
        snprintf(path, sizeof path, "bodies[%u]", n);
        status = check_body(scene, &scene->body[n], path);
    }
    for (uint32_t n = 0; n < scene->emitter_count && !status; ++n) {
        snprintf(path, sizeof path, "emitters[%u]", n);
        status = check_emitter(scene, &scene->emitter[n], path);
    }
    for (uint32_t n = 0; n < scene->drain_count && !status; ++n) {
        snprintf(path, sizeof path, "drains[%u]", n);
        status = check_drain(scene, &scene->drain[n], path);
    }
    for (uint32_t n = 0; n < scene->probe_count && !status; ++n) {
        snprintf(path, sizeof path, "probes[%u]", n);
        status = check_probe(scene, &scene->probe[n], path);
    }
    return status;
}
