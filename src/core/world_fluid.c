// A scene's fluid on its lattice, and its state at the start.
#include "core/exact_math.h"
#include "core/scene_shape.h"
#include "core/solid_job.h"

#include <math.h>
#include <string.h>

// Sites of one piece's bounding box. Box: in the middle of squares (cubes) of one spacing; for wcsph stretched to fit a
// whole number of them, so that the fluid is as far from the walls at both ends. Ball: the same around its centre.
typedef struct Lattice {
    double origin[3]; // first site
    double pitch[3];
    uint64_t sites[3];
} Lattice;

static Lattice fluid_lattice(const WeirScene *scene, const WeirFluid *fluid)
{
    double spacing = scene->parameters.particle_spacing;
    uint32_t dimension = scene->dimension;
    Lattice lattice = {.sites = {1, 1, 1}};
    double low[3], high[3];
    weir_shape_bounds(&fluid->shape, dimension, low, high);
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        bool is_ball = fluid->shape.kind == WEIR_SHAPE_BALL;
        double size = is_ball ? 2.0 * fluid->shape.radius : high[axis] - low[axis];
        double sites = floor(size / spacing + 0.5);
        lattice.sites[axis] = sites >= 1.0 ? (uint64_t)fmin(sites, 1e9) : 0;
        bool fits = fabs(size - sites * spacing) < 1e-6 * spacing;
        bool stretched = scene->method == WEIR_METHOD_WCSPH && !is_ball && !fits && sites >= 1.0;
        lattice.pitch[axis] = stretched ? size / sites : spacing;
        // A ball's lattice is centred; a box's starts half a spacing from its lowest corner.
        double margin = is_ball ? 0.5 * (size - (sites - 1.0) * spacing) : 0.5 * lattice.pitch[axis];
        lattice.origin[axis] = low[axis] + margin;
    }
    return lattice;
}

static bool is_inside(const WeirSurface *surface, const double *point)
{
    const WeirShape *shape = surface->shape;
    if (shape->kind != WEIR_SHAPE_BALL) return weir_surface_distance(surface, point) < 0.0;
    double distance2 = 0.0;
    for (uint32_t axis = 0; axis < surface->dimension; ++axis) {
        double d = point[axis] - shape->center[axis];
        distance2 += d * d;
    }
    return distance2 <= shape->radius * shape->radius;
}

double weir_fluid_sites(const WeirScene *scene)
{
    double total = 0.0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        Lattice lattice = fluid_lattice(scene, &scene->fluid[n]);
        double share = scene->fluid[n].shape.kind != WEIR_SHAPE_BALL ? 1.0
                       : scene->dimension == 3                       ? 0.52
                                                                     : 0.78;
        total += share * (double)lattice.sites[0] * (double)lattice.sites[1] * (double)lattice.sites[2];
    }
    return total;
}

// A disc of `wcsph` in concentric rings: its edge is round and its mass is right; a square lattice cut by a circle
// has steps, which start waves.
static void fill_disc(WeirBuild *build, const WeirSurface *surface)
{
    WeirSolidJob job = {.surface = surface, .layers = UINT32_MAX, .spacing = build->spacing};
    weir_near_start(&job.near, build->dimension, build->spacing);
    weir_job_ball(&job);
    build->fluid.failed |= job.near.points.failed;
    for (uint64_t i = 0; i < job.near.points.count; ++i)
        weir_points_add(&build->fluid, &job.near.points.data[2 * i]);
    weir_near_end(&job.near);
}

static void fill_lattice(WeirBuild *build, const WeirFluid *fluid, const WeirSurface *surface)
{
    Lattice lattice = fluid_lattice(build->scene, fluid);
    uint64_t k[3];
    for (k[2] = 0; k[2] < lattice.sites[2]; ++k[2]) {
        for (k[1] = 0; k[1] < lattice.sites[1]; ++k[1]) {
            for (k[0] = 0; k[0] < lattice.sites[0]; ++k[0]) {
                double point[3] = {0.0};
                for (uint32_t axis = 0; axis < build->dimension; ++axis)
                    point[axis] = lattice.origin[axis] + (double)k[axis] * lattice.pitch[axis];
                // Rounding must not cost a box its outermost sites.
                if (fluid->shape.kind == WEIR_SHAPE_BOX || is_inside(surface, point))
                    weir_points_add(&build->fluid, point);
            }
        }
    }
}

static void fill_piece(WeirBuild *build, const WeirFluid *fluid)
{
    WeirSurface surface;
    if (!weir_surface_start(&surface, &fluid->shape, build->dimension)) {
        build->fluid.failed = true;
        return;
    }
    bool is_disc = fluid->shape.kind == WEIR_SHAPE_BALL && build->dimension == 2;
    if (is_disc && build->scene->method == WEIR_METHOD_WCSPH)
        fill_disc(build, &surface);
    else
        fill_lattice(build, fluid, &surface);
    weir_surface_end(&surface);
}

// Does a particle of one piece lie on a site of the piece `other`? Lattices may be shifted against each other,
// so half a spacing of distance to the other piece's outermost sites is asked for.
static bool overlaps(const WeirSurface *other, double spacing, const double *position)
{
    const WeirShape *shape = other->shape;
    if (shape->kind == WEIR_SHAPE_BOX) {
        double gap = 0.02 * spacing;
        for (uint32_t axis = 0; axis < other->dimension; ++axis) {
            double x = position[axis];
            if (!(x > shape->min[axis] + gap && x < shape->max[axis] - gap)) return false;
        }
        return true;
    }
    double gap = 0.49 * spacing;
    if (shape->kind != WEIR_SHAPE_BALL) return weir_surface_distance(other, position) < -gap;
    double distance2 = 0.0, r = shape->radius - gap;
    for (uint32_t axis = 0; axis < other->dimension; ++axis) {
        double d = position[axis] - shape->center[axis];
        distance2 += d * d;
    }
    return r > 0.0 && distance2 < r * r;
}

static WeirStatus check_pair(WeirBuild *build, uint32_t n, uint32_t other, const WeirSurface *surface)
{
    for (uint64_t i = build->first[n]; i < build->first[n + 1]; ++i) {
        const double *point = &build->fluid.data[i * build->dimension];
        if (!overlaps(surface, build->spacing, point)) continue;
        return weir_fail(&build->scene->error, WEIR_ERROR_INPUT,
                         "fluid[%u] overlaps fluid[%u] near (%g, %g); move one of them", n, other, point[0],
                         point[1]);
    }
    return WEIR_OK;
}

static WeirStatus check_overlap(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    WeirStatus status = WEIR_OK;
    for (uint32_t other = 0; other < scene->fluid_count && scene->fluid_count > 1 && !status; ++other) {
        WeirSurface surface;
        if (!weir_surface_start(&surface, &scene->fluid[other].shape, build->dimension)) {
            build->fluid.failed = true;
            return WEIR_OK;
        }
        for (uint32_t n = 0; n < scene->fluid_count && !status; ++n) {
            if (n != other) status = check_pair(build, n, other, &surface);
        }
        weir_surface_end(&surface);
    }
    return status;
}

WeirStatus weir_build_fluid(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        fill_piece(build, &scene->fluid[n]);
        build->first[n + 1] = build->fluid.count;
        if (build->fluid.failed || build->first[n + 1] > build->first[n]) continue;
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "fluid[%u]: holds no particle; it must be larger than parameters.particle_spacing = %g m", n,
            build->spacing);
    }
    return build->fluid.failed ? WEIR_OK : check_overlap(build);
}

// ---- State at the start ----

// Height of a point against gravity, times |g|; along periodic axes gravity drives a flow and presses nothing.
static double head(const WeirScene *scene, const double *point)
{
    double sum = 0.0;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        if (!scene->periodic[axis]) sum -= (double)scene->parameters.gravity[axis] * point[axis];
    }
    return sum;
}

// Gravity where it presses.
static double pressing_gravity(const WeirScene *scene, double gravity[3])
{
    double g2 = 0.0;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        gravity[axis] = scene->periodic[axis] ? 0.0 : scene->parameters.gravity[axis];
        g2 += gravity[axis] * gravity[axis];
    }
    return sqrt(g2);
}

// The head of a piece's lowest and highest point.
static void piece_heads(const WeirScene *scene, const WeirFluid *fluid, double *lowest, double *highest)
{
    double low[3], high[3], bottom[3], top[3], gravity[3], g = pressing_gravity(scene, gravity);
    weir_shape_bounds(&fluid->shape, scene->dimension, low, high);
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        top[axis] = gravity[axis] < 0.0 ? high[axis] : low[axis];
        bottom[axis] = gravity[axis] < 0.0 ? low[axis] : high[axis];
    }
    *lowest = head(scene, bottom);
    *highest = head(scene, top);
    if (fluid->shape.kind != WEIR_SHAPE_BALL) return;
    *lowest = head(scene, fluid->shape.center) - g * fluid->shape.radius;
    *highest = head(scene, fluid->shape.center) + g * fluid->shape.radius;
}

// Density under a pressure, by the equation of state without background pressure.
static double density_under(const WeirParameters *parameters, double pressure)
{
    double rest = parameters->rest_density, c = parameters->sound_speed;
    double x = pressure / (rest * c * c);
    if (parameters->equation_of_state == WEIR_EQUATION_LINEAR) return rest * (1.0 + x);
    return rest * weir_seventh_root(1.0 + 7.0 * x);
}

// Pressure of a ball's own weight where the central force acts.
static double central_pressure(const WeirScene *scene, const WeirFluid *fluid, const double *point)
{
    double force = scene->parameters.central_force, r2 = 0.0;
    if (fluid->shape.kind != WEIR_SHAPE_BALL || force == 0.0 || fluid->flow == WEIR_FLOW_STRETCH) return 0.0;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        double d = point[axis] - fluid->shape.center[axis];
        r2 += d * d;
    }
    double edge2 = fluid->shape.radius * fluid->shape.radius;
    return 0.5 * scene->parameters.rest_density * force * fmax(edge2 - r2, 0.0);
}

// A layer under the weight of the layers above it is thinner than its mass at rest density: by how much a point at `own` head
// comes down, the integral of 1 - rho0 / rho from the piece's bottom (Simpson's rule). Density and lattice agree from the start, and
// still water stays still; it stands lower than the piece by g H^2 / 2 c^2.
static double settlement(const WeirBuild *build, double lowest, double highest, double own)
{
    double rest = build->parameters.rest_density, rise = own - lowest;
    double sum = 0.0;
    for (int k = 0; k <= 2; ++k) {
        double above = fmax(highest - lowest - 0.5 * k * rise, 0.0);
        double thinner = 1.0 - rest / density_under(&build->parameters, rest * above);
        sum += (k == 1 ? 4.0 : 1.0) / 6.0 * thinner;
    }
    return fmax(rise, 0.0) * sum;
}

static void start_piece(WeirBuild *build, const WeirFluid *fluid, uint64_t first, uint64_t end)
{
    WeirParticles *particles = &build->world->particles;
    double lowest, highest, gravity[3], rest = build->parameters.rest_density;
    double g = pressing_gravity(build->scene, gravity);
    piece_heads(build->scene, fluid, &lowest, &highest);
    for (uint64_t i = first; i < end; ++i) {
        double *point = &particles->position[i * build->dimension];
        double own = head(build->scene, point), pressure = 0.0;
        if (particles->density && fluid->hydrostatic) {
            pressure = rest * fmax(highest - own, 0.0) + central_pressure(build->scene, fluid, point);
            bool rests = g > 0.0 && fluid->shape.kind != WEIR_SHAPE_BALL;
            double way = rests ? settlement(build, lowest, highest, own) / (g * g) : 0.0;
            for (uint32_t axis = 0; axis < build->dimension; ++axis) point[axis] += way * gravity[axis];
        }
        double velocity[3] = {fluid->velocity[0], fluid->velocity[1], fluid->velocity[2]};
        pressure += weir_flow_at(build->scene, fluid, point, velocity);
        for (uint32_t axis = 0; axis < build->dimension; ++axis)
            particles->velocity[i * build->dimension + axis] = (float)velocity[axis];
        if (particles->density) particles->density[i] = (float)density_under(&build->parameters, pressure);
    }
}

void weir_build_start(WeirBuild *build)
{
    for (uint32_t n = 0; n < build->scene->fluid_count; ++n)
        start_piece(build, &build->scene->fluid[n], build->first[n], build->first[n + 1]);
}
