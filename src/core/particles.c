// A scene's particles on their lattice, and the checks that need to see them all.
#include "core/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Particle counts along the axes of one piece of fluid's bounding box. Box: sites in the middle of squares of
// one spacing. Ball: the same squares around the centre.
typedef struct Lattice {
    double origin[2]; // first site
    uint64_t sites[2];
} Lattice;

static Lattice fluid_lattice(const WeirFluid *fluid, double spacing)
{
    Lattice lattice;
    for (int axis = 0; axis < 2; ++axis) {
        double low = fluid->shape.min[axis], size = fluid->shape.max[axis] - fluid->shape.min[axis];
        if (fluid->shape.kind == WEIR_SHAPE_BALL) {
            low = fluid->shape.center[axis] - fluid->shape.radius;
            size = 2.0 * fluid->shape.radius;
        }
        double sites = floor(size / spacing + 0.5);
        lattice.sites[axis] = sites >= 1.0 ? (uint64_t)fmin(sites, 1e9) : 0;
        // A ball's lattice is centred; a box's starts half a spacing from its lowest corner.
        double margin =
            fluid->shape.kind == WEIR_SHAPE_BALL ? 0.5 * (size - (sites - 1.0) * spacing) : 0.5 * spacing;
        lattice.origin[axis] = low + margin;
    }
    return lattice;
}

// Calls that want only the number pass particles without arrays.
static uint64_t fill_fluid(const WeirFluid *fluid, double spacing, uint64_t next, WeirParticles *particles)
{
    Lattice lattice = fluid_lattice(fluid, spacing);
    for (uint64_t row = 0; row < lattice.sites[1]; ++row) {
        for (uint64_t column = 0; column < lattice.sites[0]; ++column) {
            double x = lattice.origin[0] + (double)column * spacing;
            double y = lattice.origin[1] + (double)row * spacing;
            double dx = x - fluid->shape.center[0], dy = y - fluid->shape.center[1];
            if (fluid->shape.kind == WEIR_SHAPE_BALL &&
                dx * dx + dy * dy > fluid->shape.radius * fluid->shape.radius)
                continue;
            if (particles->position) {
                particles->position[2 * next] = x;
                particles->position[2 * next + 1] = y;
                particles->velocity[2 * next] = (float)fluid->velocity[0];
                particles->velocity[2 * next + 1] = (float)fluid->velocity[1];
            }
            ++next;
        }
    }
    return next;
}

static WeirStatus check_fluid(WeirScene *scene, uint32_t index)
{
    const WeirFluid *fluid = &scene->fluid[index];
    const char *missing = NULL;
    if (fluid->shape.kind == WEIR_SHAPE_NONE) missing = "box or ball";
    if (fluid->shape.kind == WEIR_SHAPE_BOX && !fluid->shape.has_max) missing = "box.max";
    if (fluid->shape.kind == WEIR_SHAPE_BOX && !fluid->shape.has_min) missing = "box.min";
    if (fluid->shape.kind == WEIR_SHAPE_BALL && !fluid->shape.has_radius) missing = "ball.radius";
    if (fluid->shape.kind == WEIR_SHAPE_BALL && !fluid->shape.has_center) missing = "ball.center";
    if (missing)
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "fluid[%u]: %s is missing", index, missing);
    for (int axis = 0; axis < 2; ++axis) {
        double low = fluid->shape.min[axis], high = fluid->shape.max[axis];
        char name = "xy"[axis];
        if (fluid->shape.kind == WEIR_SHAPE_BALL) {
            low = fluid->shape.center[axis] - fluid->shape.radius;
            high = fluid->shape.center[axis] + fluid->shape.radius;
        }
        if (low >= high) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "fluid[%u].box: min %c = %g must be below max %c = %g", index, name, low, name,
                             high);
        }
        // Box ends like 0.1 * 3 may lie beyond the wall by rounding alone.
        double slack = 1e-9 * (scene->domain_max[axis] - scene->domain_min[axis]);
        if (low < scene->domain_min[axis] - slack || high > scene->domain_max[axis] + slack) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "fluid[%u]: reaches from %c = %g to %g; the domain allows %g to %g", index, name,
                             low, high, scene->domain_min[axis], scene->domain_max[axis]);
        }
    }
    return WEIR_OK;
}

// Upper bound on all sites, before any is made: an absurd scene must fail at once.
static WeirStatus check_count(WeirScene *scene)
{
    double spacing = scene->parameters.particle_spacing, total = 0.0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        Lattice lattice = fluid_lattice(&scene->fluid[n], spacing);
        double share = scene->fluid[n].shape.kind == WEIR_SHAPE_BALL ? 0.78 : 1.0;
        total += share * (double)lattice.sites[0] * (double)lattice.sites[1];
    }
    if (total > WEIR_MAX_PARTICLES) {
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "fluid: about %.3g particles; allowed are %d. Raise parameters.particle_spacing (now %g m)",
            total, WEIR_MAX_PARTICLES, spacing);
    }
    return WEIR_OK;
}

static WeirStatus check_values(WeirScene *scene)
{
    for (int axis = 0; axis < 2; ++axis) {
        double size = scene->domain_max[axis] - scene->domain_min[axis];
        if (!(size > 0.0)) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT, "domain: min %c = %g must be below max %c = %g",
                             "xy"[axis], scene -> domain_min[axis], "xy"[axis], scene -> domain_max[axis]);
        }
    }
    double ratio = (double)scene->parameters.support_radius / scene->parameters.particle_spacing;
    if (!(ratio >= 1.1 && ratio <= 40.0)) {
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "parameters.support_radius: %g m is %.3g times the particle_spacing of %g m; allowed is "
            "1.1 to 40 times",
            scene->parameters.support_radius, ratio, scene->parameters.particle_spacing);
    }
    if (scene->fluid_count == 0) {
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "fluid: the scene has none; add a piece with box {min, max} or ball {center, radius}");
    }
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        WeirStatus status = check_fluid(scene, n);
        if (status) return status;
    }
    return check_count(scene);
}

// Does particle `i` of one piece lie on a site of piece `other`? Lattices may be shifted against each other,
// so half a spacing of distance to the other piece's outermost sites is asked for.
static bool overlaps(const WeirFluid *other, double spacing, const double *position)
{
    double x = position[0], y = position[1], gap = 0.49 * spacing;
    if (other->shape.kind == WEIR_SHAPE_BALL) {
        double dx = x - other->shape.center[0], dy = y - other->shape.center[1],
               r = other->shape.radius - gap;
        return r > 0.0 && dx * dx + dy * dy < r * r;
    }
    return x > other->shape.min[0] + 0.02 * spacing && x < other->shape.max[0] - 0.02 * spacing &&
           y > other->shape.min[1] + 0.02 * spacing && y < other->shape.max[1] - 0.02 * spacing;
}

static WeirStatus check_overlap(WeirScene *scene, const WeirParticles *particles, const uint64_t first[])
{
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        for (uint32_t other = 0; other < scene->fluid_count; ++other) {
            if (other == n) continue;
            for (uint64_t i = first[n]; i < first[n + 1]; ++i) {
                if (!overlaps(&scene->fluid[other], scene->parameters.particle_spacing,
                              &particles->position[2 * i])) {
                    continue;
                }
                return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                                 "fluid[%u] overlaps fluid[%u] near (%g, %g); move one of them", n, other,
                                 (double)particles->position[2 * i], (double)particles->position[2 * i + 1]);
            }
        }
    }
    return WEIR_OK;
}

static void free_particles(WeirParticles *particles)
{
    free(particles->position);
    free(particles->velocity);
    free(particles->density);
    free(particles->group);
    *particles = (WeirParticles){0};
}

static WeirStatus allocate(WeirScene *scene, WeirParticles *particles, uint64_t count)
{
    particles->count = (uint32_t)count;
    particles->dimension = 2;
    particles->fluid_slots = (uint32_t)count;
    particles->position = malloc(count * 2 * sizeof(double));
    particles->velocity = malloc(count * 2 * sizeof(float));
    if (particles->position && particles->velocity) return WEIR_OK;
    free_particles(particles);
    return weir_fail(
        &scene->error, WEIR_ERROR_MEMORY,
        "%llu particles need %llu MB more than there is; raise parameters.particle_spacing (now %g m)",
        (unsigned long long)count, (unsigned long long)(count * 24 >> 20),
        scene->parameters.particle_spacing);
}

static WeirStatus make_particles(WeirScene *scene, WeirParticles *particles)
{
    double spacing = scene->parameters.particle_spacing;
    uint64_t first[WEIR_MAX_FLUIDS + 1] = {0};
    *particles = (WeirParticles){0};
    WeirStatus status = check_values(scene);
    if (status) return status;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        first[n + 1] = fill_fluid(&scene->fluid[n], spacing, first[n], particles);
        if (first[n + 1] > first[n]) continue;
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "fluid[%u]: holds no particle; it must be larger than parameters.particle_spacing = %g m", n,
            spacing);
    }
    status = allocate(scene, particles, first[scene->fluid_count]);
    if (status) return status;
    for (uint32_t n = 0; n < scene->fluid_count; ++n)
        fill_fluid(&scene->fluid[n], spacing, first[n], particles);
    status = check_overlap(scene, particles, first);
    if (status) free_particles(particles);
    if (!status) weir_scene_advise(scene);
    return status;
}

WeirStatus weir_scene_make_world(WeirScene *scene, WeirWorld *world)
{
    *world = (WeirWorld){0};
    return make_particles(scene, &world->particles);
}

void weir_world_free(WeirWorld *world)
{
    free_particles(&world->particles);
    free(world->solids);
    free(world->motion);
    free(world->emitters);
    free(world->points);
    free(world->drains);
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
