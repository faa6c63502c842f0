// The domain's own sides as walls of particles, outside the domain.
//
// One lattice: inside the domain one site per spacing along each axis, stretched to fit a whole number;
// outside it layers at half-spacing offsets. What lies beyond a closed side is wall. Beyond two sides, in the
// corner, it is wall if one of them is closed: walls meet in the corner, and an open side's neighbours go
// straight on.
#include "core/world_build.h"

#include <math.h>

typedef struct Axis {
    double min, pitch, spacing, max;
    long sites, before, after; // sites inside; layers outside
    bool closed[2];
} Axis;

static Axis make_axis(const WeirScene *scene, uint32_t axis, double spacing, uint32_t layers)
{
    Axis made = {.min = scene->domain_min[axis], .max = scene->domain_max[axis], .spacing = spacing};
    double size = made.max - made.min, sites = fmax(1.0, floor(size / spacing + 0.5));
    made.sites = (long)fmin(sites, 1e9);
    made.pitch = size / (double)made.sites;
    made.before = made.after = scene->periodic[axis] ? 0 : (long)layers;
    for (int side = 0; side < 2; ++side)
        made.closed[side] = !scene->periodic[axis] && !scene->open[axis][side];
    return made;
}

static double site(const Axis *axis, long k)
{
    if (k < 0) return axis->min + ((double)k + 0.5) * axis->spacing;
    if (k >= axis->sites) return axis->max + ((double)(k - axis->sites) + 0.5) * axis->spacing;
    return axis->min + ((double)k + 0.5) * axis->pitch;
}

// Is a site beyond a closed side of this axis?
static bool is_wall(const Axis *axis, long k)
{
    return (k < 0 && axis->closed[0]) || (k >= axis->sites && axis->closed[1]);
}

bool weir_has_sides(const WeirScene *scene)
{
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        if (!scene->periodic[axis] && !(scene->open[axis][0] && scene->open[axis][1])) return true;
    }
    return false;
}

double weir_sides_count(const WeirScene *scene, double spacing, uint32_t layers)
{
    double inner = 1.0, outer = 1.0;
    for (uint32_t n = 0; n < scene->dimension; ++n) {
        Axis axis = make_axis(scene, n, spacing, layers);
        inner *= (double)axis.sites;
        outer *= (double)(axis.sites + axis.before + axis.after);
    }
    return outer - inner;
}

static void add_row(WeirBuild *build, const Axis axes[3], long layer, long row, bool all)
{
    for (long column = -axes[0].before; column < axes[0].sites + axes[0].after; ++column) {
        if (!all && column == 0) column = axes[0].sites; // the inside holds no wall
        if (column >= axes[0].sites + axes[0].after) return;
        if (!all && !is_wall(&axes[0], column)) continue;
        double point[3] = {site(&axes[0], column), site(&axes[1], row), 0.0};
        if (build->dimension == 3) point[2] = site(&axes[2], layer);
        weir_points_add(&build->solid, point);
    }
}

void weir_build_sides(WeirBuild *build)
{
    if (!weir_has_sides(build->scene)) return;
    Axis axes[3] = {{.sites = 1}, {.sites = 1}, {.sites = 1}};
    for (uint32_t axis = 0; axis < build->dimension; ++axis)
        axes[axis] = make_axis(build->scene, axis, build->spacing, build->layers);
    for (long layer = -axes[2].before; layer < axes[2].sites + axes[2].after; ++layer) {
        for (long row = -axes[1].before; row < axes[1].sites + axes[1].after; ++row)
            add_row(build, axes, layer, row, is_wall(&axes[2], layer) || is_wall(&axes[1], row));
    }
    WeirWorld *world = build->world;
    world->solids[world->solid_count++] = (WeirSolid){
        .kind = WEIR_SOLID_FIXED,
        .no_slip = !build->scene->free_slip_sides,
        .count = (uint32_t)build->solid.count,
    };
}
