#include "core/scene_shape.h"
#include "core/exact_math.h"

#include <float.h>
#include <math.h>
#include <string.h>

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Unit axis and length of a cylinder.
static double cylinder_axis(const WeirShape *shape, double axis[3])
{
    for (int k = 0; k < 3; ++k) axis[k] = shape->to[k] - shape->from[k];
    double length = sqrt(dot3(axis, axis));
    for (int k = 0; k < 3; ++k) axis[k] /= length > 0.0 ? length : 1.0;
    return length;
}

// ---- Bounds ----

static void include(const double *point, uint32_t dimension, double low[3], double high[3])
{
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        low[axis] = fmin(low[axis], point[axis]);
        high[axis] = fmax(high[axis], point[axis]);
    }
}

static void cylinder_bounds(const WeirShape *shape, double low[3], double high[3])
{
    double axis[3];
    cylinder_axis(shape, axis);
    for (int k = 0; k < 3; ++k) {
        double reach = shape->radius * sqrt(fmax(0.0, 1.0 - axis[k] * axis[k]));
        low[k] = fmin(shape->from[k], shape->to[k]) - reach;
        high[k] = fmax(shape->from[k], shape->to[k]) + reach;
    }
}

void weir_shape_bounds(const WeirShape *shape, uint32_t dimension, double low[3], double high[3])
{
    for (uint32_t axis = 0; axis < 3; ++axis) {
        bool is_ball = shape->kind == WEIR_SHAPE_BALL;
        low[axis] = is_ball ? shape->center[axis] - shape->radius : shape->min[axis];
        high[axis] = is_ball ? shape->center[axis] + shape->radius : shape->max[axis];
    }
    if (shape->kind == WEIR_SHAPE_CYLINDER) cylinder_bounds(shape, low, high);
    if (shape->kind != WEIR_SHAPE_POLYGON && shape->kind != WEIR_SHAPE_MESH) return;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        low[axis] = DBL_MAX;
        high[axis] = -DBL_MAX;
    }
    for (uint32_t n = 0; shape->kind == WEIR_SHAPE_POLYGON && n < shape->point_count; ++n)
        include(&shape->points[2 * (size_t)n], dimension, low, high);
    for (uint32_t n = 0; shape->kind == WEIR_SHAPE_MESH && n < shape->mesh.vertex_count; ++n) {
        double corner[3];
        weir_mesh_corner(&shape->mesh, n, corner);
        include(corner, dimension, low, high);
    }
}

// ---- Checks ----

const char *weir_shape_missing(const WeirShape *shape)
{
    switch (shape->kind) {
    case WEIR_SHAPE_NONE:
        return "box or ball";
    case WEIR_SHAPE_BOX:
        return !shape->has_max ? "box.max" : !shape->has_min ? "box.min" : NULL;
    case WEIR_SHAPE_BALL:
        return !shape->has_radius ? "ball.radius" : !shape->has_center ? "ball.center" : NULL;
    case WEIR_SHAPE_CYLINDER:
        return !shape->has_from     ? "cylinder.from"
               : !shape->has_to     ? "cylinder.to"
               : !shape->has_radius ? "cylinder.radius"
                                    : NULL;
    case WEIR_SHAPE_POLYGON:
        return NULL;
    case WEIR_SHAPE_MESH:
        return shape->mesh.vertex_count == 0     ? "mesh.vertices"
               : shape->mesh.triangle_count == 0 ? "mesh.triangles"
                                                 : NULL;
    }
    return NULL;
}

// Twice the signed area of the triangle abc.
static double turn_of(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool edges_cross(const double *a, const double *b, const double *c, const double *d)
{
    double abc = turn_of(a, b, c), abd = turn_of(a, b, d), cda = turn_of(c, d, a), cdb = turn_of(c, d, b);
    return ((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0));
}

static WeirStatus check_polygon(WeirScene *scene, const WeirShape *shape, const char *piece)
{
    uint32_t count = shape->point_count;
    const double *points = shape->points;
    if (count < 3 || count > 100000) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.polygon: has %u corners; must have 3 to 100000",
                         piece, count);
    }
    for (uint32_t n = 0; n < count; ++n) {
        const double *a = &points[2 * (size_t)n], *b = &points[2 * (size_t)((n + 1) % count)];
        if (a[0] == b[0] && a[1] == b[1]) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "%s.polygon[%u]: (%g, %g) comes twice in a row; it is closed by itself", piece,
                             (n + 1) % count, a[0], a[1]);
        }
        for (uint32_t m = n + 2; m < count; ++m) {
            if (n == 0 && m == count - 1) continue; // neighbours
            const double *c = &points[2 * (size_t)m], *d = &points[2 * (size_t)((m + 1) % count)];
            if (!edges_cross(a, b, c, d)) continue;
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "%s.polygon: its edges cross: the one from (%g, %g) and the one from (%g, %g)",
                             piece, a[0], a[1], c[0], c[1]);
        }
    }
    WeirShapeMoments moments;
    weir_shape_moments(shape, 2, &moments);
    if (moments.volume > 0.0) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.polygon: has no area", piece);
}

WeirStatus weir_shape_check(WeirScene *scene, const WeirShape *shape, const char *piece)
{
    const char *missing = weir_shape_missing(shape);
    if (missing) return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s: %s is missing", piece, missing);
    if (shape->kind == WEIR_SHAPE_POLYGON) return check_polygon(scene, shape, piece);
    if (shape->kind == WEIR_SHAPE_MESH) return weir_mesh_check(scene, &shape->mesh, piece);
    double axis[3];
    if (shape->kind == WEIR_SHAPE_CYLINDER && !(cylinder_axis(shape, axis) > 0.0)) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.cylinder: from and to are the same point",
                         piece);
    }
    for (uint32_t k = 0; shape->kind == WEIR_SHAPE_BOX && k < scene->dimension; ++k) {
        if (shape->min[k] < shape->max[k]) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.box: min %c = %g must be below max %c = %g",
                         piece, "xyz"[k], shape -> min[k], "xyz"[k], shape -> max[k]);
    }
    return WEIR_OK;
}

// ---- Distance ----

bool weir_surface_start(WeirSurface *surface, const WeirShape *shape, uint32_t dimension)
{
    *surface = (WeirSurface){.shape = shape, .dimension = dimension};
    weir_shape_bounds(shape, dimension, surface->low, surface->high);
    if (shape->kind == WEIR_SHAPE_MESH) surface->tree = weir_mesh_tree_create(&shape->mesh);
    return shape->kind != WEIR_SHAPE_MESH || surface->tree;
}

void weir_surface_end(WeirSurface *surface)
{
    weir_mesh_tree_destroy(surface->tree);
    surface->tree = NULL;
}

// Distance from excesses over the flat or round limits of a convex shape: inside the largest, outside the norm.
static double from_excess(const double *excess, uint32_t count)
{
    double largest = -DBL_MAX, sum = 0.0;
    for (uint32_t k = 0; k < count; ++k) {
        largest = fmax(largest, excess[k]);
        sum += excess[k] > 0.0 ? excess[k] * excess[k] : 0.0;
    }
    return largest <= 0.0 ? largest : sqrt(sum);
}

static double box_distance(const WeirShape *shape, uint32_t dimension, const double *point)
{
    double excess[3];
    for (uint32_t k = 0; k < dimension; ++k)
        excess[k] = fmax(shape->min[k] - point[k], point[k] - shape->max[k]);
    return from_excess(excess, dimension);
}

static double cylinder_distance(const WeirShape *shape, const double *point)
{
    double axis[3], offset[3];
    double length = cylinder_axis(shape, axis);
    for (int k = 0; k < 3; ++k) offset[k] = point[k] - shape->from[k];
    double along = dot3(offset, axis), across2 = dot3(offset, offset) - along * along;
    const double excess[2] = {fmax(-along, along - length), sqrt(fmax(across2, 0.0)) - shape->radius};
    return from_excess(excess, 2);
}

static double polygon_distance(const WeirShape *shape, const double *point)
{
    double nearest2 = DBL_MAX;
    bool inside = false;
    const double *a = &shape->points[2 * (size_t)(shape->point_count - 1)];
    for (uint32_t n = 0; n < shape->point_count; ++n) {
        const double *b = &shape->points[2 * (size_t)n];
        double ex = b[0] - a[0], ey = b[1] - a[1], px = point[0] - a[0], py = point[1] - a[1];
        double share = fmin(fmax((px * ex + py * ey) / (ex * ex + ey * ey), 0.0), 1.0);
        double dx = px - share * ex, dy = py - share * ey;
        nearest2 = fmin(nearest2, dx * dx + dy * dy);
        // Crossings of the ray towards +x.
        if ((a[1] > point[1]) != (b[1] > point[1]) && px < (point[1] - a[1]) * ex / ey) inside = !inside;
        a = b;
    }
    return inside ? -sqrt(nearest2) : sqrt(nearest2);
}

double weir_surface_distance(const WeirSurface *surface, const double *point)
{
    const WeirShape *shape = surface->shape;
    if (shape->kind == WEIR_SHAPE_BOX) return box_distance(shape, surface->dimension, point);
    if (shape->kind == WEIR_SHAPE_CYLINDER) return cylinder_distance(shape, point);
    if (shape->kind == WEIR_SHAPE_POLYGON) return polygon_distance(shape, point);
    if (shape->kind == WEIR_SHAPE_MESH) return weir_mesh_tree_distance(surface->tree, point, NULL);
    double distance2 = 0.0;
    for (uint32_t k = 0; k < surface->dimension; ++k)
        distance2 += (point[k] - shape->center[k]) * (point[k] - shape->center[k]);
    return sqrt(distance2) - shape->radius;
}

// ---- Moments ----

static void set_inertia(WeirShapeMoments *moments, double x, double y, double z)
{
    moments->inertia[0][0] = x;
    moments->inertia[1][1] = y;
    moments->inertia[2][2] = z;
}

static void box_moments(const WeirShape *shape, uint32_t dimension, WeirShapeMoments *moments)
{
    double square[3] = {0.0, 0.0, 0.0};
    moments->volume = 1.0;
    for (uint32_t k = 0; k < dimension; ++k) {
        double size = shape->max[k] - shape->min[k];
        moments->volume *= size;
        moments->center[k] = 0.5 * (shape->min[k] + shape->max[k]);
        square[k] = size * size / 12.0;
    }
    double v = moments->volume;
    set_inertia(moments, v * (square[1] + square[2]), v * (square[0] + square[2]),
                v * (square[0] + square[1]));
}

static void ball_moments(const WeirShape *shape, uint32_t dimension, WeirShapeMoments *moments)
{
    double r2 = shape->radius * shape->radius;
    memcpy(moments->center, shape->center, sizeof moments->center);
    moments->volume = dimension == 3 ? 4.0 / 3.0 * WEIR_PI * r2 * shape->radius : WEIR_PI * r2;
    double about = moments->volume * r2 * (dimension == 3 ? 0.4 : 0.5);
    set_inertia(moments, about, about, about);
}

static void cylinder_moments(const WeirShape *shape, WeirShapeMoments *moments)
{
    double axis[3], length = cylinder_axis(shape, axis), r2 = shape->radius * shape->radius;
    moments->volume = WEIR_PI * r2 * length;
    double along = 0.5 * moments->volume * r2,
           across = moments->volume * (0.25 * r2 + length * length / 12.0);
    for (int i = 0; i < 3; ++i) {
        moments->center[i] = 0.5 * (shape->from[i] + shape->to[i]);
        for (int j = 0; j < 3; ++j)
            moments->inertia[i][j] = (along - across) * axis[i] * axis[j] + (i == j ? across : 0.0);
    }
}

// Sums over triangles from the first corner, where numbers are small.
static void polygon_moments(const WeirShape *shape, WeirShapeMoments *moments)
{
    const double *origin = shape->points;
    double area = 0.0, x = 0.0, y = 0.0, second = 0.0;
    for (uint32_t n = 1; n + 1 < shape->point_count; ++n) {
        const double *b = &shape->points[2 * (size_t)n], *c = b + 2;
        double bx = b[0] - origin[0], by = b[1] - origin[1], cx = c[0] - origin[0], cy = c[1] - origin[1];
        double twice = bx * cy - by * cx;
        area += 0.5 * twice;
        x += twice * (bx + cx) / 6.0;
        y += twice * (by + cy) / 6.0;
        second += twice * (bx * bx + bx * cx + cx * cx + by * by + by * cy + cy * cy) / 12.0;
    }
    double sign = area < 0.0 ? -1.0 : 1.0;
    moments->volume = sign * area;
    if (area == 0.0) return;
    x /= area;
    y /= area;
    moments->center[0] = origin[0] + x;
    moments->center[1] = origin[1] + y;
    moments->inertia[2][2] = sign * second - moments->volume * (x * x + y * y);
}

// Sums over tetrahedra from the first corner: integrals of 1, x_i and x_i x_j.
static void mesh_moments(const WeirMesh *mesh, WeirShapeMoments *moments)
{
    double origin[3], first[3] = {0.0}, second[3][3] = {{0.0}}, volume = 0.0;
    weir_mesh_corner(mesh, mesh->triangles[0], origin);
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        double p[3][3], sum[3];
        for (int k = 0; k < 3; ++k) {
            weir_mesh_corner(mesh, mesh->triangles[3 * (size_t)t + (size_t)k], p[k]);
            for (int i = 0; i < 3; ++i) p[k][i] -= origin[i];
        }
        double six = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
                     p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
                     p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
        volume += six / 6.0;
        for (int i = 0; i < 3; ++i) {
            sum[i] = p[0][i] + p[1][i] + p[2][i];
            first[i] += six * sum[i] / 24.0;
        }
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                double products = p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j];
                second[i][j] += six * (products + sum[i] * sum[j]) / 120.0;
            }
        }
    }
    moments->volume = volume;
    for (int i = 0; i < 3; ++i) first[i] /= volume;
    double trace = 0.0;
    for (int i = 0; i < 3; ++i) {
        moments->center[i] = origin[i] + first[i];
        trace += second[i][i] - volume * first[i] * first[i];
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            double central = second[i][j] - volume * first[i] * first[j];
            moments->inertia[i][j] = (i == j ? trace : 0.0) - central;
        }
    }
}

void weir_shape_moments(const WeirShape *shape, uint32_t dimension, WeirShapeMoments *moments)
{
    *moments = (WeirShapeMoments){0};
    if (shape->kind == WEIR_SHAPE_BOX) box_moments(shape, dimension, moments);
    if (shape->kind == WEIR_SHAPE_BALL) ball_moments(shape, dimension, moments);
    if (shape->kind == WEIR_SHAPE_CYLINDER) cylinder_moments(shape, moments);
    if (shape->kind == WEIR_SHAPE_POLYGON) polygon_moments(shape, moments);
    if (shape->kind == WEIR_SHAPE_MESH) mesh_moments(&shape->mesh, moments);
}

void weir_piece_reference(const WeirSolidPiece *piece, uint32_t dimension, double point[3])
{
    WeirShapeMoments moments;
    weir_shape_moments(&piece->shape, dimension, &moments);
    bool pivots = piece->is_driven && piece->motion.has_pivot;
    memcpy(point, pivots ? piece->motion.pivot : moments.center, sizeof moments.center);
}
