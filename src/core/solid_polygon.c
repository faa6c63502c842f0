// Polygons: each layer is the curve at one depth. It is walked along the edges, moved into the solid, and round the
// corners where the solid opens; what comes too near another edge is cut off. Particles are spread evenly along each
// smooth piece of what remains, so that straight edges along the axes give the lattice itself.
#include "core/solid_job.h"

#include <math.h>
#include <string.h>

// A smooth piece of a layer, as points walked so far.
typedef struct Walk {
    WeirSolidJob *job;
    double depth;
    WeirPoints piece;
    double length;
    double last[2]; // sample before this one
    bool last_lies; // it is on the layer
    bool has_last;
    double heading[2]; // of the edge or arc at hand
    double end_heading[2];
    uint64_t made;
} Walk;

static bool lies_on_layer(const Walk *walk, const double *point)
{
    return weir_job_depth(walk->job, point) >= walk->depth - 1e-6 * walk->job->spacing;
}

// Spreads particles over the piece and starts a new one.
static void end_piece(Walk *walk)
{
    double spacing = walk->job->spacing;
    uint64_t count = (uint64_t)floor(walk->length / spacing + 0.5);
    double walked = 0.0;
    uint64_t n = 0;
    for (uint64_t k = 1; k < walk->piece.count && n < count; ++k) {
        const double *a = &walk->piece.data[2 * (k - 1)], *b = a + 2;
        double length = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
        for (; n < count; ++n) {
            double at = ((double)n + 0.5) * walk->length / (double)count - walked;
            if (at > length) break;
            double share = length > 0.0 ? at / length : 0.0;
            const double point[2] = {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
            if (weir_near_within(&walk->job->near, point, 0.68 * spacing)) continue;
            weir_job_add(walk->job, point);
            ++walk->made;
        }
        walked += length;
    }
    walk->piece.count = 0;
    walk->length = 0.0;
}

static void extend(Walk *walk, const double *point)
{
    if (walk->piece.count > 0) {
        const double *last = &walk->piece.data[2 * (walk->piece.count - 1)];
        double x = point[0] - last[0], y = point[1] - last[1];
        walk->length += sqrt(x * x + y * y);
    }
    weir_points_add(&walk->piece, point);
    memcpy(walk->end_heading, walk->heading, sizeof walk->heading);
}

// Where the walk enters or leaves the layer, between two samples.
static void find_border(const Walk *walk, const double *on, const double *off, double border[2])
{
    double low = 0.0, high = 1.0;
    for (int n = 0; n < 40; ++n) {
        double middle = 0.5 * (low + high);
        for (int k = 0; k < 2; ++k) border[k] = on[k] + middle * (off[k] - on[k]);
        if (lies_on_layer(walk, border))
            low = middle;
        else
            high = middle;
    }
    for (int k = 0; k < 2; ++k) border[k] = on[k] + low * (off[k] - on[k]);
}

// The walk comes back to the layer: where it left it, as at a slight bend, the piece goes on.
static void enter(Walk *walk, const double *border)
{
    if (walk->piece.count > 0) {
        const double *end = &walk->piece.data[2 * (walk->piece.count - 1)];
        double x = border[0] - end[0], y = border[1] - end[1], near = 1e-2 * walk->job->spacing;
        double turn = walk->heading[0] * walk->end_heading[0] + walk->heading[1] * walk->end_heading[1];
        if (x * x + y * y > near * near || turn < 0.86) end_piece(walk);
    }
    extend(walk, border);
}

static void sample(Walk *walk, const double *point)
{
    bool lies = lies_on_layer(walk, point);
    double border[2];
    if (walk->has_last && lies != walk->last_lies) {
        find_border(walk, lies ? point : walk->last, lies ? walk->last : point, border);
        if (lies)
            enter(walk, border);
        else
            extend(walk, border);
    }
    if (lies) extend(walk, point);
    memcpy(walk->last, point, sizeof walk->last);
    walk->last_lies = lies;
    walk->has_last = true;
}

static void sample_edge(Walk *walk, const double *a, const double *b, const double *normal)
{
    double length = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
    long parts = (long)ceil(length / (walk->job->spacing / 16.0));
    for (long n = 0; n <= parts; ++n) {
        double share = (double)n / (double)parts, point[2];
        for (int k = 0; k < 2; ++k) point[k] = a[k] + share * (b[k] - a[k]) + walk->depth * normal[k];
        sample(walk, point);
    }
}

// Directions between two normals by halving, which needs no angles; `middle` decides where they are opposite.
static void sample_arc(Walk *walk, const double *corner, const double *from, const double *to,
                       const double *middle, int level)
{
    double half[2] = {from[0] + to[0], from[1] + to[1]};
    double length = sqrt(half[0] * half[0] + half[1] * half[1]);
    for (int k = 0; k < 2; ++k) half[k] = length > 1e-6 ? half[k] / length : middle[k];
    if (level > 0) sample_arc(walk, corner, from, half, middle, level - 1);
    double point[2];
    for (int k = 0; k < 2; ++k) point[k] = corner[k] + walk->depth * half[k];
    walk->heading[0] = to[0] - from[0];
    walk->heading[1] = to[1] - from[1];
    double step = sqrt(walk->heading[0] * walk->heading[0] + walk->heading[1] * walk->heading[1]);
    for (int k = 0; k < 2; ++k) walk->heading[k] = step > 0.0 ? walk->heading[k] / step : middle[k];
    sample(walk, point);
    if (level > 0) sample_arc(walk, corner, half, to, middle, level - 1);
}

static void direction_of(const double *a, const double *b, double direction[2])
{
    double x = b[0] - a[0], y = b[1] - a[1], length = sqrt(x * x + y * y);
    direction[0] = x / length;
    direction[1] = y / length;
}

// Corner between two edges: round where the solid opens, and the end of a piece where it is sharp.
static void sample_corner(Walk *walk, const double *corner, const double *before, const double *after,
                          double side)
{
    const double from[2] = {side * before[1], -side * before[0]}, to[2] = {side * after[1], -side * after[0]};
    double turn = before[0] * after[1] - before[1] * after[0];
    double straight = before[0] * after[0] + before[1] * after[1];
    bool is_sharp = straight < 0.86;
    if (is_sharp) end_piece(walk);
    if (side * turn <= 0.0) return; // the solid closes: edges cut each other
    sample_arc(walk, corner, from, to, before, 4);
    if (is_sharp) end_piece(walk);
}

static uint64_t walk_layer(WeirSolidJob *job, double depth)
{
    const WeirShape *shape = job->surface->shape;
    uint32_t count = shape->point_count;
    double area = 0.0, before[2], after[2];
    for (uint32_t n = 0; n < count; ++n) {
        const double *a = &shape->points[2 * (size_t)n], *b = &shape->points[2 * (size_t)((n + 1) % count)];
        area += (a[0] - shape->points[0]) * (b[1] - shape->points[1]) -
                (b[0] - shape->points[0]) * (a[1] - shape->points[1]);
    }
    // The right-hand side of a way round counter-clockwise is outside.
    double side = (area > 0.0) == job->around ? 1.0 : -1.0;
    Walk walk = {.job = job, .depth = depth, .piece.dimension = 2};
    direction_of(&shape->points[2 * (size_t)(count - 1)], shape->points, before);
    for (uint32_t n = 0; n < count; ++n) {
        const double *a = &shape->points[2 * (size_t)n], *b = &shape->points[2 * (size_t)((n + 1) % count)];
        direction_of(a, b, after);
        sample_corner(&walk, a, before, after, side);
        const double normal[2] = {side * after[1], -side * after[0]};
        memcpy(walk.heading, after, sizeof after);
        sample_edge(&walk, a, b, normal);
        memcpy(before, after, sizeof before);
    }
    end_piece(&walk);
    if (walk.piece.failed) job->near.points.failed = true;
    weir_points_free(&walk.piece);
    return walk.made;
}

void weir_job_polygon(WeirSolidJob *job)
{
    for (uint32_t k = 0; k < job->layers; ++k) {
        if (walk_layer(job, ((double)k + 0.5) * job->spacing) == 0 && job->layers == UINT32_MAX) break;
    }
    weir_job_fill(job);
}
