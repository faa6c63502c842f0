// Triangle meshes, and whatever else is known by its distance alone: points of a fine raster, moved onto the
// layers, taken one after the other unless one is too near already. Along the axes that gives the lattice itself.
#include "core/solid_job.h"

#include <math.h>
#include <string.h>

enum { PER_SPACING = 4, BLOCK = 16 }; // raster points per spacing, and per block's side

static bool is_useful(const WeirSolidJob *job, const double *low, double size)
{
    for (uint32_t axis = 0; job->clipped && axis < job->surface->dimension; ++axis) {
        if (low[axis] > job->high[axis] || low[axis] + size < job->low[axis]) return false;
    }
    return true;
}

static void scan_block(WeirSolidJob *job, WeirVisit *visit, const double *low)
{
    double step = job->spacing / PER_SPACING, point[3];
    int layers = job->surface->dimension == 3 ? BLOCK : 1;
    for (int z = 0; z < layers; ++z) {
        point[2] = low[2] + z * step;
        for (int y = 0; y < BLOCK; ++y) {
            point[1] = low[1] + y * step;
            for (int x = 0; x < BLOCK; ++x) {
                point[0] = low[0] + x * step;
                visit(job, point);
            }
        }
    }
}

// `size` is 2^n blocks.
static void scan_box(WeirSolidJob *job, WeirVisit *visit, const double *low, double size)
{
    uint32_t dimension = job->surface->dimension;
    double center[3] = {0.0}, reach = 0.5 * size * sqrt((double)dimension);
    for (uint32_t axis = 0; axis < dimension; ++axis) center[axis] = low[axis] + 0.5 * size;
    if (job->near.points.failed || !is_useful(job, low, size)) return;
    double depth = weir_job_depth(job, center);
    if (depth + reach < 0.0 || depth - reach > job->layers * job->spacing) return;
    if (size < 1.5 * BLOCK / PER_SPACING * job->spacing) {
        scan_block(job, visit, low);
        return;
    }
    for (uint32_t part = 0; part < 1u << dimension; ++part) {
        double corner[3] = {0.0};
        for (uint32_t axis = 0; axis < dimension; ++axis)
            corner[axis] = low[axis] + (part >> axis & 1 ? 0.5 * size : 0.0);
        scan_box(job, visit, corner, 0.5 * size);
    }
}

void weir_job_scan(WeirSolidJob *job, WeirVisit *visit)
{
    double low[3] = {0.0}, size = BLOCK / PER_SPACING * job->spacing, longest = 0.0;
    double margin = job->around ? job->layers * job->spacing : 0.0;
    for (uint32_t axis = 0; axis < job->surface->dimension; ++axis) {
        low[axis] = job->surface->low[axis] - margin;
        longest = fmax(longest, job->surface->high[axis] + margin - low[axis]);
    }
    while (size <= longest) size *= 2.0;
    scan_box(job, visit, low, size);
}

// ---- Layers ----

// Moves a point to the middle of its layer, along the way on which the depth grows.
static void settle(WeirSolidJob *job, const double *point)
{
    double depth = weir_job_depth(job, point), spacing = job->spacing;
    double layer = floor(depth / spacing);
    // A point of the raster lies within half its diagonal of the layer it belongs to.
    double wanted = (layer + 0.5) * spacing, step = wanted - depth;
    if (!(depth > 0.0) || layer >= job->layers || fabs(step) > 0.22 * spacing) return;
    double moved[3], probe[3], slope[3], length2 = 0.0, e = 1e-3 * spacing;
    memcpy(moved, point, job->surface->dimension * sizeof *moved);
    if (fabs(step) > 1e-9 * spacing) {
        for (uint32_t axis = 0; axis < job->surface->dimension; ++axis) {
            memcpy(probe, point, job->surface->dimension * sizeof *probe);
            probe[axis] += e;
            slope[axis] = weir_job_depth(job, probe) - depth;
            length2 += slope[axis] * slope[axis];
        }
        if (!(length2 > 0.25 * e * e)) return; // between two sides: no layer here
        for (uint32_t axis = 0; axis < job->surface->dimension; ++axis)
            moved[axis] += step * slope[axis] / sqrt(length2);
        if (fabs(weir_job_depth(job, moved) - wanted) > 0.02 * spacing) return;
    }
    if (!weir_near_within(&job->near, moved, 0.93 * spacing)) weir_job_add(job, moved);
}

void weir_job_mesh(WeirSolidJob *job)
{
    weir_job_scan(job, settle);
    weir_job_fill(job);
}

// ---- What is left ----

static void fill_at(WeirSolidJob *job, const double *point, double radius)
{
    if (weir_near_within(&job->near, point, radius)) return;
    double depth = weir_job_depth(job, point);
    if (depth >= 0.45 * job->spacing && depth <= job->layers * job->spacing) weir_job_add(job, point);
}

// In 3D a cubic lattice leaves 0.87 spacings, in 2D a square one 0.71.
static void fill_3d(WeirSolidJob *job, const double *point)
{
    fill_at(job, point, 0.9 * job->spacing);
}

static void fill_2d(WeirSolidJob *job, const double *point)
{
    fill_at(job, point, 0.75 * job->spacing);
}

void weir_job_fill(WeirSolidJob *job)
{
    weir_job_scan(job, job->surface->dimension == 3 ? fill_3d : fill_2d);
}
