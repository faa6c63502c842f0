// Triangle meshes: points of a fine raster, moved onto the layers, taken one after the other unless one is too near already. Along the axes that gives the lattice itself.
#include "core/solid_job.h"

#include <math.h>

// Raster points per spacing, finer where they are cheap; spacings per side of a block.
static int raster_of(const WeirSolidJob *job)
{
    return job->surface->dimension == 3 ? 4 : 8;
}
static const double block = 4.0;

static bool is_useful(const WeirSolidJob *job, const double *low, double size)
{
    for (uint32_t axis = 0; job->clipped && axis < job->surface->dimension; ++axis) {
        if (low[axis] > job->high[axis] || low[axis] + size < job->low[axis]) return false;
    }
    return true;
}

static void scan_block(WeirSolidJob *job, WeirVisit *visit, const double *low)
{
    int raster = raster_of(job), points = (int)block * raster;
    double step = job->spacing / raster, point[3];
    int layers = job->surface->dimension == 3 ? points : 1;
    for (int z = 0; z < layers; ++z) {
        point[2] = low[2] + z * step;
        for (int y = 0; y < points; ++y) {
            point[1] = low[1] + y * step;
            for (int x = 0; x < points; ++x) {
                point[0] = low[0] + x * step;
                visit(job, point);
            }
        }
    }
}

// `size` is 2^n blocks.
static void scan_box(WeirSolidJob *job, WeirVisit *visit, double deepest, const double *low, double size)
{
    uint32_t dimension = job->surface->dimension;
    double center[3] = {0.0}, reach = 0.5 * size * sqrt((double)dimension);
    for (uint32_t axis = 0; axis < dimension; ++axis) center[axis] = low[axis] + 0.5 * size;
    if (job->near.points.failed || !is_useful(job, low, size)) return;
    double depth = weir_job_depth(job, center);
    if (depth + reach < 0.0 || depth - reach > deepest) return;
    if (size < 1.5 * block * job->spacing) {
        scan_block(job, visit, low);
        return;
    }
    for (uint32_t part = 0; part < 1u << dimension; ++part) {
        double corner[3] = {0.0};
        for (uint32_t axis = 0; axis < dimension; ++axis)
            corner[axis] = low[axis] + (part >> axis & 1 ? 0.5 * size : 0.0);
        scan_box(job, visit, deepest, corner, 0.5 * size);
    }
}

void weir_job_scan(WeirSolidJob *job, WeirVisit *visit, double deepest)
{
    double low[3] = {0.0}, size = block * job->spacing, longest = 0.0;
    double margin = job->around ? job->layers * job->spacing : 0.0;
    for (uint32_t axis = 0; axis < job->surface->dimension; ++axis) {
        low[axis] = job->surface->low[axis] - margin;
        longest = fmax(longest, job->surface->high[axis] + margin - low[axis]);
    }
    while (size <= longest) size *= 2.0;
    scan_box(job, visit, deepest, low, size);
}

// ---- Layers ----

// Moves a point to the middle of its layer, along the way on which the depth grows; it stays there if no particle is
// nearer than `apart`.
static void settle_apart(WeirSolidJob *job, const double *point, double apart)
{
    // A point of the raster lies within half its diagonal of the layer it belongs to.
    double spacing = job->spacing, longest = 0.22 * spacing, moved[3], slope[3];
    if (weir_near_within(&job->near, point, apart - longest)) return; // it would be too near wherever it goes
    double depth = weir_mesh_tree_distance(job->surface->tree, point, slope), sign = job->around ? 1.0 : -1.0;
    depth *= sign;
    double layer = floor(depth / spacing), wanted = (layer + 0.5) * spacing, step = wanted - depth;
    if (!(depth > 0.0) || layer >= job->layers || fabs(step) > longest) return;
    for (int axis = 0; axis < 3; ++axis) moved[axis] = point[axis] + step * sign * slope[axis];
    if (weir_near_within(&job->near, moved, apart)) return;
    // Between two sides there is no layer: the way leads elsewhere.
    if (fabs(weir_job_depth(job, moved) - wanted) > 0.02 * spacing) return;
    weir_job_add(job, moved);
}

// Measured on spheres, this distance gives the right number of particles; along the axes it gives the lattice.
static void settle(WeirSolidJob *job, const double *point)
{
    settle_apart(job, point, 0.905 * job->spacing);
}

static void settle_holes(WeirSolidJob *job, const double *point)
{
    settle_apart(job, point, 0.77 * job->spacing);
}

// Layers as far as they can matter: inside a body, deeper, the raster itself is as good.
void weir_job_mesh(WeirSolidJob *job)
{
    enum { DEEPEST = 6 };
    uint32_t layers = job->layers < DEEPEST ? job->layers : DEEPEST;
    weir_job_scan(job, settle, layers * job->spacing);
    weir_job_scan(job, settle_holes, layers * job->spacing);
    weir_job_fill(job);
}

// ---- What is left ----

static void fill_at(WeirSolidJob *job, const double *point, double radius)
{
    if (weir_near_within(&job->near, point, radius)) return;
    double depth = weir_job_depth(job, point);
    if (depth >= 0.45 * job->spacing && depth <= job->layers * job->spacing) weir_job_add(job, point);
}

// In 3D a cubic lattice leaves 0.866 spacings, in 2D a square one 0.707.
static void fill_3d(WeirSolidJob *job, const double *point)
{
    fill_at(job, point, 0.87 * job->spacing);
}

static void fill_2d(WeirSolidJob *job, const double *point)
{
    fill_at(job, point, 0.73 * job->spacing);
}

void weir_job_fill(WeirSolidJob *job)
{
    weir_job_scan(job, job->surface->dimension == 3 ? fill_3d : fill_2d, job->layers * job->spacing);
}
