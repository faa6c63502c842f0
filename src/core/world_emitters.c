// Emitters and drains, ready for the solvers.
#include "core/exact_math.h"
#include "core/scene_shape.h"
#include "core/world_build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Slots are chosen for this long, s, where no capacity is given and the emitter never stops.
static const double plausible_time = 60.0;
enum { MOST_SLOTS = 20000000 };

static void direction_of(const WeirEmitterPiece *piece, double direction[3])
{
    const double *d = piece->direction;
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int axis = 0; axis < 3; ++axis) direction[axis] = d[axis] / length;
}

static uint32_t sites_across(const WeirEmitterPiece *piece, double spacing)
{
    return (uint32_t)fmax(1.0, floor(piece->size / spacing + 0.5));
}

// Adds the points of one nozzle: a row across it, in 3D a square lattice inside its circle.
static void add_points(const WeirBuild *build, const WeirEmitterPiece *piece, WeirPoints *points)
{
    double direction[3], u[3] = {0.0}, v[3] = {0.0};
    direction_of(piece, direction);
    if (build->dimension == 3) {
        weir_basis(direction, u, v);
    } else {
        u[0] = -direction[1];
        u[1] = direction[0];
    }
    long sites = sites_across(piece, build->spacing), rows = build->dimension == 3 ? sites : 1;
    double half = 0.5 * (double)sites * build->spacing;
    for (long row = 0; row < rows; ++row) {
        for (long column = 0; column < sites; ++column) {
            double x = ((double)column + 0.5) * build->spacing - half, point[3];
            double y = build->dimension == 3 ? ((double)row + 0.5) * build->spacing - half : 0.0;
            if (x * x + y * y > half * half) continue;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = piece->center[axis] + x * u[axis] + y * v[axis];
            weir_points_add(points, point);
        }
    }
}

static double speed_of(const WeirBuild *build, const WeirEmitterPiece *piece, uint32_t point_count)
{
    if (piece->speed > 0.0) return piece->speed;
    double area = point_count * build->spacing * (build->dimension == 3 ? build->spacing : 1.0);
    return piece->flow_rate / area;
}

// ---- Inlets ----

// Where an emitter that always runs makes its layers: upstream of its nozzle.
typedef struct WeirInlet {
    double center[3], direction[3];
    double half; // of its width, and a little more, m
} WeirInlet;

static double inlet_reach(const WeirBuild *build)
{
    return (double)build->parameters.support_radius + build->spacing;
}

static void add_inlet(WeirBuild *build, const WeirEmitterPiece *piece)
{
    WeirInlet *inlet = &build->inlets[build->inlet_count];
    direction_of(piece, inlet->direction);
    inlet->half = (0.5 * sites_across(piece, build->spacing) + 0.3) * build->spacing;
    double around = inlet->half + inlet_reach(build);
    for (uint32_t axis = 0; axis < build->dimension; ++axis) {
        inlet->center[axis] = piece->center[axis];
        double low = piece->center[axis] - around, high = piece->center[axis] + around;
        bool first = build->inlet_count == 0;
        build->inlet_min[axis] = first ? low : fmin(build->inlet_min[axis], low);
        build->inlet_max[axis] = first ? high : fmax(build->inlet_max[axis], high);
    }
    ++build->inlet_count;
}

bool weir_build_inlets(WeirBuild *build)
{
    const WeirScene *scene = build->scene;
    build->inlets = calloc(scene->emitter_count + 1, sizeof *build->inlets);
    if (!build->inlets) return false;
    for (uint32_t n = 0; n < scene->emitter_count; ++n) {
        const WeirEmitterPiece *piece = &scene->emitter[n];
        if (piece->start > 0.0 || piece->stop > 0.0) continue; // closed at times: the wall must hold
        add_inlet(build, piece);
    }
    return true;
}

bool weir_is_in_inlet(const WeirBuild *build, const double *point)
{
    for (uint32_t axis = 0; axis < build->dimension; ++axis)
        if (point[axis] < build->inlet_min[axis] || point[axis] > build->inlet_max[axis]) return false;
    for (uint32_t n = 0; n < build->inlet_count; ++n) {
        const WeirInlet *inlet = &build->inlets[n];
        double along = 0.0, square = 0.0;
        for (uint32_t axis = 0; axis < build->dimension; ++axis) {
            double d = point[axis] - inlet->center[axis];
            along += d * inlet->direction[axis];
            square += d * d;
        }
        if (along < 0.25 * build->spacing && along > -inlet_reach(build) &&
            square - along * along < inlet->half * inlet->half)
            return true;
    }
    return false;
}

// ---- Checks ----

// Is there room for fluid at this point?
static WeirStatus check_room(WeirBuild *build, uint32_t n, const double *point)
{
    WeirScene *scene = build->scene;
    for (uint32_t axis = 0; axis < build->dimension; ++axis) {
        double slack = 1e-6 * build->spacing;
        if (point[axis] >= scene->domain_min[axis] - slack && point[axis] <= scene->domain_max[axis] + slack)
            continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "emitters[%u]: blows out of the domain at %c = %g; the domain allows %g to %g", n,
                         "xyz"[axis], point[axis], scene -> domain_min[axis], scene -> domain_max[axis]);
    }
    for (uint32_t w = 0; w < scene->wall_count; ++w) {
        double distance = weir_surface_distance(&build->walls[w], point);
        double gap = scene->wall[w].inside ? -distance : distance;
        if (gap > 0.3 * build->spacing) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "emitters[%u]: blows into walls[%u] near (%g, %g, %g); move or turn it", n, w,
                         point[0], point[1], build->dimension == 3 ? point[2] : 0.0);
    }
    for (uint32_t b = 0; b < scene->body_count; ++b) {
        if (weir_surface_distance(&build->bodies[b], point) > 0.3 * build->spacing) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "emitters[%u]: blows into bodies[%u] near (%g, %g, %g); move or turn it", n, b,
                         point[0], point[1], build->dimension == 3 ? point[2] : 0.0);
    }
    return WEIR_OK;
}

// The first two spacings of the jet must be free.
static WeirStatus check_jet(WeirBuild *build, uint32_t n, const double *nozzle)
{
    double direction[3], point[3];
    direction_of(&build->scene->emitter[n], direction);
    for (int k = 0; k < 3; ++k) {
        for (uint32_t axis = 0; axis < build->dimension; ++axis)
            point[axis] = nozzle[axis] + k * build->spacing * direction[axis];
        WeirStatus status = check_room(build, n, point);
        if (status) return status;
    }
    return WEIR_OK;
}

// ---- Slots ----

// What the emitters ask for: as given, or chosen.
typedef struct Slots {
    double given, chosen;
    double inside; // on their way through the nozzles whose slots are chosen
} Slots;

// Sites of the whole domain, less the fluid there is.
static double free_sites(const WeirBuild *build)
{
    double sites = 1.0;
    for (uint32_t axis = 0; axis < build->dimension; ++axis)
        sites *= (build->scene->domain_max[axis] - build->scene->domain_min[axis]) / build->spacing;
    return fmax(sites - (double)build->fluid.count, 0.0);
}

static void add_slots(const WeirBuild *build, const WeirEmitterPiece *piece, const WeirEmitter *emitter,
                      Slots *slots)
{
    if (piece->capacity > 0) {
        slots->given += piece->capacity;
        return;
    }
    double open = piece->stop > 0.0 ? piece->stop - piece->start : plausible_time;
    double layers = ceil(emitter->speed * open / build->spacing) + 1.0;
    slots->chosen += layers * emitter->point_count;
    slots->inside += (build->layers + 1.0) * emitter->point_count;
}

// The domain cannot hold more than its sites, however many emitters there are.
static uint32_t slot_count(const WeirBuild *build, const Slots *slots)
{
    double chosen = fmin(slots->chosen, free_sites(build) + slots->inside);
    return (uint32_t)fmin(ceil(slots->given + chosen), MOST_SLOTS);
}

static WeirStatus make_emitter(WeirBuild *build, uint32_t n, WeirPoints *points, Slots *slots)
{
    const WeirEmitterPiece *piece = &build->scene->emitter[n];
    WeirEmitter *emitter = &build->world->emitters[n];
    double direction[3];
    direction_of(piece, direction);
    emitter->point_first = (uint32_t)points->count;
    add_points(build, piece, points);
    if (points->failed) return WEIR_OK;
    emitter->point_count = (uint32_t)points->count - emitter->point_first;
    emitter->speed = (float)speed_of(build, piece, emitter->point_count);
    emitter->start = (float)piece->start;
    emitter->stop = piece->stop > 0.0 ? (float)piece->stop : 1e30f;
    for (uint32_t axis = 0; axis < build->dimension; ++axis) {
        emitter->direction[axis] = (float)direction[axis];
        emitter->center[axis] = (float)piece->center[axis];
    }
    add_slots(build, piece, emitter, slots);
    for (uint64_t i = emitter->point_first; i < points->count; ++i) {
        WeirStatus status = check_jet(build, n, &points->data[i * build->dimension]);
        if (status) return status;
    }
    return WEIR_OK;
}

WeirStatus weir_build_emitters(WeirBuild *build)
{
    WeirScene *scene = build->scene;
    WeirWorld *world = build->world;
    WeirPoints points = {.dimension = build->dimension};
    Slots slots = {0};
    world->emitters = calloc(WEIR_MAX_EMITTERS, sizeof *world->emitters);
    world->drains = calloc(WEIR_MAX_DRAINS, sizeof *world->drains);
    if (!world->emitters || !world->drains)
        return weir_fail(&scene->error, WEIR_ERROR_MEMORY, "emitters: memory ran out");
    WeirStatus status = WEIR_OK;
    for (uint32_t n = 0; n < scene->emitter_count && !status; ++n)
        status = make_emitter(build, n, &points, &slots);
    world->points = points.data; // freed with the world
    world->point_count = (uint32_t)points.count;
    world->emitter_count = scene->emitter_count;
    if (status) return status;
    if (points.failed) return weir_fail(&scene->error, WEIR_ERROR_MEMORY, "emitters: memory ran out");
    build->empty = slot_count(build, &slots);
    for (uint32_t n = 0; n < scene->drain_count; ++n) {
        for (uint32_t axis = 0; axis < build->dimension; ++axis) {
            world->drains[n].min[axis] = (float)scene->drain[n].min[axis];
            world->drains[n].max[axis] = (float)scene->drain[n].max[axis];
        }
    }
    world->drain_count = scene->drain_count;
    return WEIR_OK;
}

uint32_t weir_world_emission_interval(const WeirWorld *world, const WeirParameters *parameters,
                                      const WeirConstants *constants)
{
    bool fixed = parameters->stepping == WEIR_STEPPING_FIXED;
    double sound = (double)constants->smoothing_length / (double)constants->sound_speed;
    double longest = fixed ? (double)parameters->time_step : (double)parameters->courant * sound,
           fastest = 0.0;
    for (uint32_t n = 0; n < world->emitter_count; ++n)
        fastest = fmax(fastest, (double)world->emitters[n].speed);
    uint32_t interval = WEIR_EMISSION_INTERVAL;
    while (interval > 1 && interval * fastest * longest > 0.5 * (double)parameters->particle_spacing)
        interval /= 2;
    return interval;
}
