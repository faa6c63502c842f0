// The domain's own sides as walls of particles, outside the domain.
//
// One lattice: inside the domain one site per spacing along each axis, stretched to fit a whole number;
// outside it layers at half-spacing offsets. What lies beyond a closed side is wall. Beyond two sides, in the
// corner, it is wall if one of them is closed: walls meet in the corner, and an open side's neighbours go
// straight on.
#include "core/lattice_axis.h"
#include "core/world_build.h"

typedef struct Axis {
    WeirAxis sites;
    long before, after; // layers outside
    bool closed[2];
} Axis;

static Axis make_axis(const WeirScene *scene, uint32_t axis, double spacing, uint32_t layers)
{
    Axis made = {.sites = weir_axis_make(scene->domain_min[axis], scene->domain_max[axis], spacing)};
    made.before = made.after = scene->periodic[axis] ? 0 : (long)layers;
    for (int side = 0; side < 2; ++side)
        made.closed[side] = !scene->periodic[axis] && !scene->open[axis][side];
    return made;
}

// Is a site beyond a closed side of this axis?
static bool is_wall(const Axis *axis, long k)
{
    return (k < 0 && axis->closed[0]) || (k >= axis->sites.sites && axis->closed[1]);
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
        inner *= (double)axis.sites.sites;
        outer *= (double)(axis.sites.sites + axis.before + axis.after);
    }
    return outer - inner;
}

static void add_row(uint32_t dimension, WeirPoints *points, const Axis axes[3], long layer, long row,
                    bool all)
{
    long inside = axes[0].sites.sites, end = inside + axes[0].after;
    for (long column = -axes[0].before; column < end; ++column) {
        if (!all && column == 0) column = inside; // the inside holds no wall
        if (column >= end) return;
        if (!all && !is_wall(&axes[0], column)) continue;
        double point[3] = {weir_axis_site(&axes[0].sites, column), weir_axis_site(&axes[1].sites, row), 0.0};
        if (dimension == 3) point[2] = weir_axis_site(&axes[2].sites, layer);
        weir_points_add(points, point);
    }
}

void weir_build_sides(WeirBuild *build, WeirPoints *points)
{
    if (!weir_has_sides(build->scene)) return;
    Axis axes[3] = {{.sites.sites = 1}, {.sites.sites = 1}, {.sites.sites = 1}};
    for (uint32_t axis = 0; axis < build->dimension; ++axis)
        axes[axis] = make_axis(build->scene, axis, build->spacing, build->layers);
    long layers = axes[2].sites.sites + axes[2].after, rows = axes[1].sites.sites + axes[1].after;
    for (long layer = -axes[2].before; layer < layers; ++layer) {
        for (long row = -axes[1].before; row < rows; ++row)
            add_row(build->dimension, points, axes, layer, row,
                    is_wall(&axes[2], layer) || is_wall(&axes[1], row));
    }
}
