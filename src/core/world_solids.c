// The domain's sides, walls and bodies as particles, and what the solvers need to know of each.
#include "core/solid_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int weir_scene_solid_index(const WeirScene *scene, const char *name)
{
    int sides = weir_has_sides(scene) ? 1 : 0;
    if (*name == '\0') return -1;
    if (strcmp(name, "domain") == 0) return sides - 1;
    for (uint32_t n = 0; n < scene->wall_count; ++n) {
        if (strcmp(scene->wall[n].name, name) == 0) return sides + (int)n;
    }
    for (uint32_t n = 0; n < scene->body_count; ++n) {
        if (strcmp(scene->body[n].name, name) == 0) return sides + (int)(scene->wall_count + n);
    }
    return -1;
}

// ---- Particles of one piece ----

static double piece_count(const WeirSolidPiece *piece, uint32_t dimension, double spacing, double layers)
{
    double low[3], high[3], outer = 1.0, inner = 1.0;
    weir_shape_bounds(&piece->shape, dimension, low, high);
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        double sites = (high[axis] - low[axis]) / spacing, margin = piece->inside ? 2.0 * layers : 0.0;
        outer *= sites + margin + 1.0;
        inner *= fmax(sites - (piece->inside ? 0.0 : 2.0 * layers), 0.0);
    }
    return outer - inner;
}

double weir_solids_count(const WeirScene *scene, double spacing, uint32_t layers)
{
    double count = 0.0;
    for (uint32_t n = 0; n < scene->wall_count; ++n)
        count += piece_count(&scene->wall[n], scene->dimension, spacing, layers);
    for (uint32_t n = 0; n < scene->body_count; ++n)
        count += piece_count(&scene->body[n], scene->dimension, spacing, 1e9);
    return count;
}

static void run_job(WeirSolidJob *job)
{
    switch (job->surface->shape->kind) {
    case WEIR_SHAPE_BOX:
        weir_job_box(job);
        break;
    case WEIR_SHAPE_BALL:
        weir_job_ball(job);
        break;
    case WEIR_SHAPE_CYLINDER:
        weir_job_cylinder(job);
        break;
    case WEIR_SHAPE_POLYGON:
        weir_job_polygon(job);
        break;
    default:
        weir_job_mesh(job);
    }
}

static WeirSolidJob start_job(const WeirBuild *build, const WeirSurface *surface, const WeirSolidPiece *piece,
                              bool is_body)
{
    const WeirScene *scene = build->scene;
    WeirSolidJob job = {.surface = surface, .around = piece->inside, .spacing = build->spacing};
    job.layers = is_body ? UINT32_MAX : build->layers;
    job.clipped = !piece->is_driven && !is_body;
    for (uint32_t axis = 0; axis < build->dimension; ++axis) {
        // Rounding keeps a particle that lies right on a periodic side, once.
        double margin = scene->periodic[axis] ? -1e-9 : (build->layers + 0.01) * build->spacing;
        job.low[axis] = scene->domain_min[axis] - margin;
        job.high[axis] = scene->domain_max[axis] + margin;
    }
    weir_near_start(&job.near, build->dimension, build->spacing);
    return job;
}

// Depth of a point in wall `n`.
static double wall_depth(const WeirBuild *build, uint32_t n, const double *point)
{
    double distance = weir_surface_distance(&build->walls[n], point);
    return build->scene->wall[n].inside ? distance : -distance;
}

// Do fixed walls before `end` cover this point, or does an emitter need it?
static bool is_covered(const WeirBuild *build, const WeirNear *taken, uint32_t end, const double *point)
{
    if (weir_is_in_inlet(build, point)) return true;
    if (weir_near_within(taken, point, 0.5 * build->spacing * (1.0 - 1e-6))) return true;
    for (uint32_t n = 0; n < end; ++n) {
        if (!build->scene->wall[n].is_driven && wall_depth(build, n, point) > 1e-6 * build->spacing)
            return true;
    }
    return false;
}

// ---- The solids' properties ----

static void invert_inertia(double inertia[3][3], double density, uint32_t dimension, float inverse[3][4])
{
    if (dimension == 2) {
        inverse[2][2] = (float)(1.0 / (density * inertia[2][2]));
        return;
    }
    double determinant = 0.0;
    for (int i = 0; i < 3; ++i) {
        determinant += inertia[0][i] * (inertia[1][(i + 1) % 3] * inertia[2][(i + 2) % 3] -
                                        inertia[1][(i + 2) % 3] * inertia[2][(i + 1) % 3]);
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) { // cofactors, transposed
            int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            double cofactor = inertia[a][c] * inertia[b][d] - inertia[a][d] * inertia[b][c];
            inverse[i][j] = (float)(cofactor / (determinant * density));
        }
    }
}

static void copy_vector(float to[4], const double from[3], uint32_t count)
{
    for (uint32_t axis = 0; axis < count; ++axis) to[axis] = (float)from[axis];
}

static WeirSolid describe(const WeirBuild *build, const WeirSolidPiece *piece, bool is_body)
{
    WeirShapeMoments moments;
    weir_shape_moments(&piece->shape, build->dimension, &moments);
    WeirSolid solid = {.no_slip = piece->no_slip};
    solid.kind = piece->is_driven ? WEIR_SOLID_DRIVEN : is_body ? WEIR_SOLID_FREE : WEIR_SOLID_FIXED;
    double reference[3];
    weir_piece_reference(piece, build->dimension, reference);
    copy_vector(solid.position, reference, build->dimension);
    copy_vector(solid.surface_velocity, piece->surface_velocity, build->dimension);
    if (!is_body) return solid;
    solid.mass = (float)(piece->density * moments.volume);
    if (piece->is_driven) return solid;
    copy_vector(solid.velocity, piece->velocity, build->dimension);
    copy_vector(solid.angular_velocity, piece->angular_velocity, 3);
    invert_inertia(moments.inertia, piece->density, build->dimension, solid.inverse_inertia);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        bool turns = build->dimension == 3 || axis == 2;
        solid.freedom[axis] = axis < build->dimension && !piece->fixed[axis] ? 1.0f : 0.0f;
        solid.angular_freedom[axis] = turns && !piece->fixed_rotation[axis] ? 1.0f : 0.0f;
    }
    return solid;
}

// ---- Bodies in the way of others ----

static WeirStatus too_close(WeirBuild *build, uint32_t body, const char *other, uint32_t index,
                            const double *point)
{
    return weir_fail(&build->scene->error, WEIR_ERROR_INPUT,
                     "bodies[%u] reaches into %s[%u] near (%g, %g, %g); move one of them", body, other, index,
                     point[0], point[1], build->dimension == 3 ? point[2] : 0.0);
}

static WeirStatus check_body(WeirBuild *build, uint32_t body, const WeirPoints *points)
{
    WeirScene *scene = build->scene;
    double slack = 0.25 * build->spacing;
    for (uint64_t i = 0; i < points->count; ++i) {
        const double *point = &points->data[i * points->dimension];
        for (uint32_t n = 0; n < scene->wall_count; ++n) {
            if (!scene->body[body].is_driven && wall_depth(build, n, point) > slack)
                return too_close(build, body, "walls", n, point);
        }
        for (uint32_t n = 0; n < scene->body_count; ++n) {
            if (n != body && -weir_surface_distance(&build->bodies[n], point) > slack)
                return too_close(build, body, "bodies", n, point);
        }
    }
    return WEIR_OK;
}

// ---- All of them ----

static void append(WeirBuild *build, const WeirPoints *points, WeirSolid solid)
{
    WeirWorld *world = build->world;
    solid.first = (uint32_t)build->solid.count;
    for (uint64_t i = 0; i < points->count; ++i)
        weir_points_add(&build->solid, &points->data[i * points->dimension]);
    solid.count = (uint32_t)(build->solid.count - solid.first);
    if (points->failed) build->solid.failed = true;
    world->solids[world->solid_count++] = solid;
}

// Particles of wall `n`; those of fixed walls before it win.
static void make_wall(WeirBuild *build, uint32_t n, WeirNear *taken, WeirPoints *points)
{
    const WeirSolidPiece *piece = &build->scene->wall[n];
    WeirSolidJob job = start_job(build, &build->walls[n], piece, false);
    run_job(&job);
    points->failed |= job.near.points.failed;
    for (uint64_t i = 0; i < job.near.points.count; ++i) {
        const double *point = &job.near.points.data[i * build->dimension];
        if (piece->is_driven || !is_covered(build, taken, n, point)) weir_points_add(points, point);
    }
    weir_near_end(&job.near);
    for (uint64_t i = 0; !piece->is_driven && i < points->count; ++i)
        weir_near_add(taken, &points->data[i * build->dimension]);
    points->failed |= taken->points.failed;
}

static void make_sides(WeirBuild *build, const WeirNear *taken)
{
    if (!weir_has_sides(build->scene)) return;
    WeirPoints all = {.dimension = build->dimension}, kept = {.dimension = build->dimension};
    weir_build_sides(build, &all);
    for (uint64_t i = 0; i < all.count; ++i) {
        const double *point = &all.data[i * build->dimension];
        if (!is_covered(build, taken, build->scene->wall_count, point)) weir_points_add(&kept, point);
    }
    kept.failed |= all.failed;
    append(build, &kept, (WeirSolid){.kind = WEIR_SOLID_FIXED, .no_slip = !build->scene->free_slip_sides});
    weir_points_free(&all);
    weir_points_free(&kept);
}

static WeirStatus no_particle(WeirBuild *build, const char *list, uint32_t n)
{
    return weir_fail(
        &build->scene->error, WEIR_ERROR_INPUT,
        "%s[%u]: has no particle: it lies outside the domain or inside other walls, or is thinner than "
        "parameters.particle_spacing = %g m",
        list, n, build->spacing);
}

static WeirStatus make_walls(WeirBuild *build, WeirPoints *points, WeirNear *taken)
{
    WeirScene *scene = build->scene;
    for (uint32_t n = 0; n < scene->wall_count; ++n) {
        points[n].dimension = build->dimension;
        make_wall(build, n, taken, &points[n]);
        if (!points[n].failed && points[n].count == 0) return no_particle(build, "walls", n);
    }
    make_sides(build, taken);
    for (uint32_t n = 0; n < scene->wall_count; ++n)
        append(build, &points[n], describe(build, &scene->wall[n], false));
    return WEIR_OK;
}

static WeirStatus make_bodies(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    for (uint32_t n = 0; n < scene->body_count; ++n) {
        WeirSolidJob job = start_job(build, &build->bodies[n], &scene->body[n], true);
        run_job(&job);
        WeirStatus status = check_body(build, n, &job.near.points);
        if (!status && !job.near.points.failed && job.near.points.count == 0)
            status = no_particle(build, "bodies", n);
        append(build, &job.near.points, describe(build, &scene->body[n], true));
        weir_near_end(&job.near);
        if (status) return status;
    }
    return WEIR_OK;
}

WeirStatus weir_build_solids(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    WeirPoints points[WEIR_MAX_WALLS] = {{0}};
    WeirNear taken;
    weir_near_start(&taken, build->dimension, build->spacing);
    WeirStatus status = make_walls(build, points, &taken);
    if (!status) status = make_bodies(build);
    for (uint32_t n = 0; n < scene->wall_count; ++n) weir_points_free(&points[n]);
    weir_near_end(&taken);
    return status;
}

// ---- Fluid in their way ----

static bool is_free(const WeirBuild *build, const double *point)
{
    const WeirScene *scene = build->scene;
    double gap = 0.49 * build->spacing; // a lattice along a wall lies half a spacing away, but for rounding
    for (uint32_t n = 0; n < scene->wall_count; ++n) {
        if (wall_depth(build, n, point) > -gap) return false;
    }
    for (uint32_t n = 0; n < scene->body_count; ++n) {
        if (weir_surface_distance(&build->bodies[n], point) < gap) return false;
    }
    return true;
}

WeirStatus weir_build_trim_fluid(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    if (scene->wall_count + scene->body_count == 0) return WEIR_OK;
    uint64_t kept = 0, begin = 0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        uint64_t end = build->first[n + 1];
        build->first[n] = kept;
        for (uint64_t i = begin; i < end; ++i) {
            const double *point = &build->fluid.data[i * build->dimension];
            if (!is_free(build, point)) continue;
            memmove(&build->fluid.data[kept++ * build->dimension], point, build->dimension * sizeof *point);
        }
        begin = end;
        if (kept > build->first[n]) continue;
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "fluid[%u]: lies inside walls or bodies, or too close to them: nothing is left of it", n);
    }
    build->first[scene->fluid_count] = build->fluid.count = kept;
    return WEIR_OK;
}
