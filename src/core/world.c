// From a scene to the world that a simulation starts with.
#include "core/scene_shape.h"
#include "core/world_build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void weir_points_add(WeirPoints *points, const double *point)
{
    if (points->failed) return;
    if (points->count == points->capacity) {
        uint64_t wanted = points->capacity ? points->capacity + points->capacity / 2 : 1024;
        double *grown = realloc(points->data, wanted * points->dimension * sizeof *grown);
        if (!grown) {
            points->failed = true;
            return;
        }
        points->data = grown;
        points->capacity = wanted;
    }
    memcpy(&points->data[points->count++ * points->dimension], point, points->dimension * sizeof *point);
}

void weir_points_free(WeirPoints *points)
{
    free(points->data);
    *points = (WeirPoints){0};
}

static WeirStatus no_memory(WeirScene *scene, double particles)
{
    return weir_fail(
        &scene->error, WEIR_ERROR_MEMORY,
        "%.4g particles need %.4g MB more than there is; raise parameters.particle_spacing (now %g m)",
        particles, particles * 24.0 / 1048576.0, scene->parameters.particle_spacing);
}

// Upper bound on all sites, before any is made: an absurd scene must fail at once.
static WeirStatus check_count(const WeirBuild *build)
{
    WeirScene *scene = build->scene;
    double fluid = weir_fluid_sites(scene), sides = 0.0;
    if (scene->method == WEIR_METHOD_WCSPH) sides = weir_sides_count(scene, build->spacing, build->layers);
    if (fluid + sides <= WEIR_MAX_PARTICLES) return WEIR_OK;
    bool walls = sides > fluid;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%s: about %.3g particles; allowed are %d. Raise parameters.particle_spacing (now %g m)",
                     walls ? "domain" : "fluid", walls ? sides : fluid, WEIR_MAX_PARTICLES, build->spacing);
}

static bool start_surfaces(WeirBuild *build)
{
    const WeirScene *scene = build->scene;
    build->walls = calloc(WEIR_MAX_WALLS, sizeof *build->walls);
    build->bodies = calloc(WEIR_MAX_BODIES, sizeof *build->bodies);
    bool ready = build->walls && build->bodies;
    for (uint32_t n = 0; ready && n < scene->wall_count; ++n)
        ready = weir_surface_start(&build->walls[n], &scene->wall[n].shape, build->dimension);
    for (uint32_t n = 0; ready && n < scene->body_count; ++n)
        ready = weir_surface_start(&build->bodies[n], &scene->body[n].shape, build->dimension);
    return ready;
}

static void end_build(WeirBuild *build)
{
    for (uint32_t n = 0; build->walls && n < build->scene->wall_count; ++n)
        weir_surface_end(&build->walls[n]);
    for (uint32_t n = 0; build->bodies && n < build->scene->body_count; ++n)
        weir_surface_end(&build->bodies[n]);
    free(build->walls);
    free(build->bodies);
    free(build->inlets);
}

static WeirStatus make_points(WeirBuild *build)
{
    WeirStatus status = weir_build_fluid(build);
    if (status || build->scene->method != WEIR_METHOD_WCSPH) return status;
    if (!start_surfaces(build) || !weir_build_inlets(build)) return no_memory(build->scene, 0.0);
    status = weir_build_solids(build);
    if (!status) status = weir_build_trim_fluid(build);
    if (!status) status = weir_build_emitters(build);
    if (!status) status = weir_build_motions(build);
    return status;
}

// The particles of fluid and solids side by side, with their groups.
static WeirStatus join(WeirBuild *build)
{
    WeirWorld *world = build->world;
    WeirParticles *particles = &world->particles;
    uint64_t slots = build->fluid.count + build->empty, count = slots + build->solid.count;
    size_t dimension = build->dimension;
    bool wcsph = build->scene->method == WEIR_METHOD_WCSPH;
    particles->dimension = build->dimension;
    particles->count = (uint32_t)count;
    particles->fluid_slots = (uint32_t)slots;
    particles->position = build->fluid.data;
    build->fluid.data = NULL;
    double *grown = realloc(particles->position, count * dimension * sizeof *grown);
    if (grown) particles->position = grown;
    particles->velocity = calloc(count * dimension, sizeof(float));
    if (wcsph) {
        particles->density = malloc(count * sizeof(float));
        particles->group = calloc(count, sizeof(uint32_t));
    }
    if (!grown || !particles->velocity || (wcsph && !(particles->density && particles->group)))
        return no_memory(build->scene, (double)count);
    for (uint64_t i = build->fluid.count; i < slots; ++i) {
        // An empty slot lies in the domain's corner, so that whoever draws or copies it needs no exception.
        for (size_t axis = 0; axis < dimension; ++axis)
            particles->position[i * dimension + axis] = build->scene->domain_min[axis];
        particles->group[i] = WEIR_GROUP_EMPTY;
    }
    if (build->solid.count > 0) {
        memcpy(&particles->position[slots * dimension], build->solid.data,
               build->solid.count * dimension * sizeof(double));
    }
    for (uint64_t i = build->fluid.count; i < count; ++i)
        particles->density[i] = build->parameters.rest_density;
    for (uint32_t s = 0; s < world->solid_count; ++s) {
        WeirSolid *solid = &world->solids[s];
        solid->first += (uint32_t)slots;
        for (uint32_t i = 0; i < solid->count; ++i) particles->group[solid->first + i] = WEIR_GROUP_SOLID + s;
    }
    weir_build_start(build);
    return WEIR_OK;
}

static WeirStatus make_world(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    WeirStatus status = weir_scene_check_values(scene);
    if (status) return status;
    build->layers = weir_wall_layers(&build->parameters);
    status = check_count(build);
    if (status) return status;
    build->world->solids = calloc(1 + WEIR_MAX_WALLS + WEIR_MAX_BODIES, sizeof(WeirSolid));
    if (!build->world->solids) return no_memory(scene, 0.0);
    status = make_points(build);
    if (status) return status;
    double count = (double)build->fluid.count + (double)build->empty + (double)build->solid.count;
    if (build->fluid.failed || build->solid.failed) return no_memory(scene, count);
    if (count > WEIR_MAX_PARTICLES) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.4g particles, empty slots included; allowed are %d. Raise "
                         "parameters.particle_spacing, or lower emitters[0].capacity",
                         count, WEIR_MAX_PARTICLES);
    }
    return join(build);
}

WeirStatus weir_scene_make_world(WeirScene *scene, WeirWorld *world)
{
    *world = (WeirWorld){0};
    WeirBuild build = {
        .scene = scene,
        .parameters = weir_scene_resolved(scene),
        .dimension = scene->dimension,
        .spacing = scene->parameters.particle_spacing,
        .fluid.dimension = scene->dimension,
        .solid.dimension = scene->dimension,
        .world = world,
    };
    WeirStatus status = make_world(&build);
    end_build(&build);
    weir_points_free(&build.fluid);
    weir_points_free(&build.solid);
    if (status) {
        weir_world_free(world);
    } else {
        weir_scene_advise(scene);
    }
    return status;
}

// Along x, then y, then z.
static int by_place(const void *a, const void *b)
{
    const WeirDrain *x = a, *y = b;
    for (int axis = 0; axis < 3; ++axis)
        if (x->min[axis] != y->min[axis]) return x->min[axis] < y->min[axis] ? -1 : 1;
    return 0;
}

bool weir_world_group_drains(WeirWorld *world)
{
    uint32_t count = (world->drain_count + WEIR_DRAIN_GROUP - 1) / WEIR_DRAIN_GROUP;
    if (count == 0) return true;
    world->drain_groups = calloc(count, sizeof *world->drain_groups);
    if (!world->drain_groups) return false;
    world->drain_group_count = count;
    qsort(world->drains, world->drain_count, sizeof *world->drains, by_place);
    for (uint32_t n = 0; n < world->drain_count; ++n) {
        const WeirDrain *drain = &world->drains[n];
        WeirDrain *group = &world->drain_groups[n / WEIR_DRAIN_GROUP];
        if (n % WEIR_DRAIN_GROUP == 0) *group = *drain;
        for (int axis = 0; axis < 3; ++axis) {
            group->min[axis] = fminf(group->min[axis], drain->min[axis]);
            group->max[axis] = fmaxf(group->max[axis], drain->max[axis]);
        }
    }
    return true;
}

void weir_world_free(WeirWorld *world)
{
    free(world->particles.position);
    free(world->particles.velocity);
    free(world->particles.density);
    free(world->particles.group);
    free(world->solids);
    free(world->motion);
    free(world->emitters);
    free(world->points);
    free(world->drains);
    free(world->drain_groups);
    *world = (WeirWorld){0};
}

WeirStatus weir_scene_check(WeirScene *scene)
{
    WeirWorld world;
    WeirStatus status = weir_scene_make_world(scene, &world);
    weir_world_free(&world);
    return status;
}

uint32_t weir_scene_particle_count(WeirScene *scene)
{
    WeirWorld world;
    if (weir_scene_make_world(scene, &world)) return 0;
    uint32_t count = world.particles.count;
    weir_world_free(&world);
    return count;
}
