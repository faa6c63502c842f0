// Boxes on a lattice; balls and cylinders in concentric shells.
#include "core/exact_math.h"
#include "core/lattice_axis.h"
#include "core/solid_job.h"

#include <math.h>

void weir_job_add(WeirSolidJob *job, const double *point)
{
    for (uint32_t axis = 0; job->clipped && axis < job->surface->dimension; ++axis) {
        if (!(point[axis] > job->low[axis] && point[axis] < job->high[axis])) return;
    }
    weir_near_add(&job->near, point);
}

// ---- Boxes ----

static bool is_site(const WeirSolidJob *job, const WeirAxis *axis, long k)
{
    if (job->around) return k < 0 || k >= axis->sites;
    long depth = k < axis->sites - 1 - k ? k : axis->sites - 1 - k;
    return (uint64_t)depth < job->layers;
}

// Sites of a row that are solid by their column alone; `all`: the row lies in a layer of another axis.
static void add_row(WeirSolidJob *job, const WeirAxis axes[3], const long k[3], long begin, long end,
                    bool all)
{
    long inside = axes[0].sites, hollow = job->around ? 0 : (long)job->layers;
    long skip_to = job->around ? inside : inside - (long)job->layers;
    for (long column = begin; column < end; ++column) {
        if (!all && column == hollow && skip_to > column) column = skip_to;
        if (column >= end) return;
        double point[3];
        for (uint32_t axis = 0; axis < job->surface->dimension; ++axis)
            point[axis] = weir_axis_site(&axes[axis], axis == 0 ? column : k[axis]);
        weir_job_add(job, point);
    }
}

void weir_job_box(WeirSolidJob *job)
{
    WeirAxis axes[3] = {{.sites = 1}, {.sites = 1}, {.sites = 1}};
    long begin[3] = {0}, end[3] = {1, 1, 1}, k[3];
    uint32_t dimension = job->surface->dimension;
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        axes[axis] = weir_axis_make(job->surface->low[axis], job->surface->high[axis], job->spacing);
        begin[axis] = job->around ? -(long)job->layers : 0;
        end[axis] = axes[axis].sites + (job->around ? (long)job->layers : 0);
    }
    bool whole = job->layers == UINT32_MAX;
    for (k[2] = begin[2]; k[2] < end[2]; ++k[2]) {
        for (k[1] = begin[1]; k[1] < end[1]; ++k[1]) {
            bool all =
                whole || is_site(job, &axes[1], k[1]) || (dimension == 3 && is_site(job, &axes[2], k[2]));
            add_row(job, axes, k, begin[0], end[0], all);
        }
    }
}

// ---- Rings and discs ----

// A plane in space: origin and two directions. In 2D the plane itself.
typedef struct Plane {
    double origin[3], u[3], v[3];
} Plane;

static void add_ring(WeirSolidJob *job, const Plane *plane, double radius, long count)
{
    for (long n = 0; n < count; ++n) {
        double point[3], sine, cosine;
        weir_sine_cosine(2.0 * WEIR_PI * ((double)n + 0.5) / (double)count, &sine, &cosine);
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = plane->origin[axis] + radius * (cosine * plane->u[axis] + sine * plane->v[axis]);
        weir_job_add(job, point);
    }
}

static long ring_count(double radius, double spacing)
{
    return (long)floor(2.0 * WEIR_PI * radius / spacing + 0.5);
}

// Rings inside a circle, from its edge inwards: as many layers as wanted, or all, with what is left in the middle.
static void add_disc(WeirSolidJob *job, const Plane *plane, double radius, uint64_t layers)
{
    double spacing = job->spacing;
    uint64_t whole = (uint64_t)floor(radius / spacing + 1e-9);
    for (uint64_t k = 0; k < whole && k < layers; ++k) {
        double r = radius - ((double)k + 0.5) * spacing;
        add_ring(job, plane, r, ring_count(r, spacing));
    }
    if (whole >= layers) return;
    double rest = radius / spacing - (double)whole; // a disc smaller than one spacing
    long count = (long)floor(WEIR_PI * rest * rest + 0.5);
    if (whole == 0 && count == 0) count = 1;
    add_ring(job, plane, count > 1 ? (rest - 0.5) * spacing : 0.0, count);
}

static void add_rings_around(WeirSolidJob *job, const Plane *plane, double radius, uint64_t layers)
{
    for (uint64_t k = 0; k < layers; ++k) {
        double r = radius + ((double)k + 0.5) * job->spacing;
        add_ring(job, plane, r, ring_count(r, job->spacing));
    }
}

// ---- Balls ----

// Points of a shell by a spiral with the golden angle: even, with about 0.87 of the mean distance as the least
// (A. Gonzalez, Math. Geosci. 42, 2010).
static void add_shell(WeirSolidJob *job, const double center[3], double radius)
{
    static const double golden = 0.38196601125010515; // of a turn
    double r = radius / job->spacing;
    long count = (long)floor(4.0 * WEIR_PI * (r * r + 1.0 / 12.0) + 0.5);
    for (long n = 0; n < count; ++n) {
        double z = 1.0 - (2.0 * (double)n + 1.0) / (double)count, across = radius * sqrt(1.0 - z * z);
        double turns = golden * (double)n, sine, cosine;
        weir_sine_cosine(2.0 * WEIR_PI * (turns - floor(turns)), &sine, &cosine);
        const double point[3] = {center[0] + across * cosine, center[1] + across * sine,
                                 center[2] + radius * z};
        weir_job_add(job, point);
    }
}

static void add_ball_inside(WeirSolidJob *job, const WeirShape *shape)
{
    uint64_t whole = (uint64_t)floor(shape->radius / job->spacing + 1e-9);
    for (uint64_t k = 0; k < whole && k < job->layers; ++k)
        add_shell(job, shape->center, shape->radius - ((double)k + 0.5) * job->spacing);
    if (whole >= job->layers) return;
    double rest = shape->radius / job->spacing - (double)whole;
    if (rest >= 0.9) {
        add_shell(job, shape->center, (rest - 0.5) * job->spacing);
    } else if (rest >= 0.5 || whole == 0) {
        weir_job_add(job, shape->center);
    }
}

void weir_job_ball(WeirSolidJob *job)
{
    const WeirShape *shape = job->surface->shape;
    if (job->surface->dimension == 2) {
        Plane plane = {.u = {1.0}, .v = {0.0, 1.0}};
        for (int axis = 0; axis < 2; ++axis) plane.origin[axis] = shape->center[axis];
        if (job->around)
            add_rings_around(job, &plane, shape->radius, job->layers);
        else
            add_disc(job, &plane, shape->radius, job->layers);
    } else if (job->around) {
        for (uint32_t k = 0; k < job->layers; ++k)
            add_shell(job, shape->center, shape->radius + ((double)k + 0.5) * job->spacing);
    } else {
        add_ball_inside(job, shape);
    }
}

// ---- Cylinders: slices across the axis ----

static void add_slice(WeirSolidJob *job, const Plane *plane, const WeirAxis *axis, long k)
{
    double radius = job->surface->shape->radius;
    if (job->around) {
        if (k < 0 || k >= axis->sites) add_disc(job, plane, radius, UINT64_MAX);
        add_rings_around(job, plane, radius, job->layers);
        return;
    }
    add_disc(job, plane, radius, is_site(job, axis, k) ? UINT64_MAX : job->layers);
}

void weir_job_cylinder(WeirSolidJob *job)
{
    const WeirShape *shape = job->surface->shape;
    double direction[3], length2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        direction[k] = shape->to[k] - shape->from[k];
        length2 += direction[k] * direction[k];
    }
    double length = sqrt(length2);
    for (int k = 0; k < 3; ++k) direction[k] /= length;
    Plane plane;
    weir_basis(direction, plane.u, plane.v);
    WeirAxis axis = weir_axis_make(0.0, length, job->spacing);
    long margin = job->around ? (long)job->layers : 0;
    for (long n = -margin; n < axis.sites + margin; ++n) {
        double along = weir_axis_site(&axis, n);
        for (int k = 0; k < 3; ++k) plane.origin[k] = shape->from[k] + along * direction[k];
        add_slice(job, &plane, &axis, n);
    }
}
