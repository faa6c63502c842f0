#include "core/mesh_tree.h"
#include "core/mesh_weld.h"
#include "core/scene_shape.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF_TRIANGLES = 4, MAX_DEPTH = 64 };

typedef struct Node {
    double low[3], high[3];
    uint32_t first, count; // leaf: triangles in `order`; inner: count 0, children first and first + 1
} Node;

typedef struct Triangle {
    double corner[3][3];
    double normal[3];         // of the face, unit
    double edge_normal[3][3]; // of the edges 01, 12, 20: sum of both faces' normals
    uint32_t welded[3];
} Triangle;

struct WeirMeshTree {
    uint32_t triangle_count, node_count;
    Triangle *triangles;
    double *corner_normals; // by welded corner, sums weighted by angle
    uint32_t *order;
    Node *nodes;
};

static void subtract(const double a[3], const double b[3], double result[3])
{
    for (int k = 0; k < 3; ++k) result[k] = a[k] - b[k];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

// Angle between two directions, good to 1e-4, which is enough for a weight: sqrt alone, no arc cosine.
static double angle_between(const double a[3], const double b[3])
{
    double cosine = dot(a, b) / sqrt(dot(a, a) * dot(b, b));
    double x = fabs(fmin(fmax(cosine, -1.0), 1.0));
    // Abramowitz and Stegun 4.4.45.
    double angle = sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - 0.0187293 * x)));
    return cosine < 0.0 ? 3.14159265358979 - angle : angle;
}

// ---- Construction ----

static void make_triangle(WeirMeshTree *tree, const WeirMesh *mesh, const WeirWeld *weld, uint32_t t)
{
    Triangle *triangle = &tree->triangles[t];
    for (int k = 0; k < 3; ++k) {
        uint32_t corner = mesh->triangles[3 * (size_t)t + (size_t)k];
        weir_mesh_corner(mesh, corner, triangle->corner[k]);
        triangle->welded[k] = weld->corner[corner];
    }
    double a[3], b[3];
    subtract(triangle->corner[1], triangle->corner[0], a);
    subtract(triangle->corner[2], triangle->corner[0], b);
    cross(a, b, triangle->normal);
    double length = sqrt(dot(triangle->normal, triangle->normal));
    for (int k = 0; k < 3; ++k) triangle->normal[k] /= length;
    for (int k = 0; k < 3; ++k) {
        subtract(triangle->corner[(k + 1) % 3], triangle->corner[k], a);
        subtract(triangle->corner[(k + 2) % 3], triangle->corner[k], b);
        double angle = angle_between(a, b);
        for (int axis = 0; axis < 3; ++axis)
            tree->corner_normals[3 * (size_t)triangle->welded[k] + (size_t)axis] +=
                angle * triangle->normal[axis];
    }
}

static void make_edge_normals(WeirMeshTree *tree, const WeirWeld *weld)
{
    for (uint32_t t = 0; t < tree->triangle_count; ++t) {
        for (int k = 0; k < 3; ++k) {
            uint32_t other = weld->neighbor[3 * (size_t)t + (size_t)k];
            for (int axis = 0; axis < 3; ++axis) {
                tree->triangles[t].edge_normal[k][axis] =
                    tree->triangles[t].normal[axis] + tree->triangles[other].normal[axis];
            }
        }
    }
}

static void bound(const WeirMeshTree *tree, Node *node)
{
    for (int axis = 0; axis < 3; ++axis) {
        node->low[axis] = DBL_MAX;
        node->high[axis] = -DBL_MAX;
        for (uint32_t n = 0; n < node->count; ++n) {
            const Triangle *triangle = &tree->triangles[tree->order[node->first + n]];
            for (int k = 0; k < 3; ++k) {
                node->low[axis] = fmin(node->low[axis], triangle->corner[k][axis]);
                node->high[axis] = fmax(node->high[axis], triangle->corner[k][axis]);
            }
        }
    }
}

static double middle_of(const WeirMeshTree *tree, uint32_t n, int axis)
{
    const Triangle *triangle = &tree->triangles[tree->order[n]];
    return triangle->corner[0][axis] + triangle->corner[1][axis] + triangle->corner[2][axis];
}

// Parts the node's triangles about the middle of their middles along its longest side.
static uint32_t part(WeirMeshTree *tree, const Node *node)
{
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (node->high[k] - node->low[k] > node->high[axis] - node->low[axis]) axis = k;
    }
    double sum = 0.0;
    for (uint32_t n = 0; n < node->count; ++n) sum += middle_of(tree, node->first + n, axis);
    double middle = sum / node->count;
    uint32_t split = node->first;
    for (uint32_t n = node->first; n < node->first + node->count; ++n) {
        if (middle_of(tree, n, axis) >= middle) continue;
        uint32_t kept = tree->order[n];
        tree->order[n] = tree->order[split];
        tree->order[split++] = kept;
    }
    // All in one place: any half will do.
    if (split == node->first || split == node->first + node->count) split = node->first + node->count / 2;
    return split;
}

static void divide(WeirMeshTree *tree, uint32_t index, int depth)
{
    Node *node = &tree->nodes[index];
    bound(tree, node);
    if (node->count <= LEAF_TRIANGLES || depth >= MAX_DEPTH - 2) return;
    uint32_t split = part(tree, node), children = tree->node_count;
    tree->node_count += 2;
    tree->nodes[children] = (Node){.first = node->first, .count = split - node->first};
    tree->nodes[children + 1] = (Node){.first = split, .count = node->first + node->count - split};
    node->first = children;
    node->count = 0;
    divide(tree, children, depth + 1);
    divide(tree, children + 1, depth + 1);
}

WeirMeshTree *weir_mesh_tree_create(const WeirMesh *mesh)
{
    WeirWeld weld;
    WeirMeshTree *tree = calloc(1, sizeof *tree);
    if (!tree || !weir_weld_start(&weld, mesh)) {
        free(tree);
        return NULL;
    }
    tree->triangle_count = mesh->triangle_count;
    tree->triangles = calloc(mesh->triangle_count, sizeof *tree->triangles);
    tree->corner_normals = calloc(3 * (size_t)mesh->vertex_count, sizeof(double));
    tree->order = calloc(mesh->triangle_count, sizeof(uint32_t));
    tree->nodes = calloc(2 * (size_t)mesh->triangle_count, sizeof *tree->nodes);
    if (!tree->triangles || !tree->corner_normals || !tree->order || !tree->nodes) {
        weir_weld_end(&weld);
        weir_mesh_tree_destroy(tree);
        return NULL;
    }
    for (uint32_t t = 0; t < tree->triangle_count; ++t) {
        make_triangle(tree, mesh, &weld, t);
        tree->order[t] = t;
    }
    make_edge_normals(tree, &weld);
    weir_weld_end(&weld);
    tree->nodes[0] = (Node){.first = 0, .count = tree->triangle_count};
    tree->node_count = 1;
    divide(tree, 0, 0);
    return tree;
}

void weir_mesh_tree_destroy(WeirMeshTree *tree)
{
    if (!tree) return;
    free(tree->triangles);
    free(tree->corner_normals);
    free(tree->order);
    free(tree->nodes);
    free(tree);
}

// ---- Distance ----

typedef struct Closest {
    double distance2;
    double offset[3];     // point - closest point of the surface
    const double *normal; // of the closest feature
} Closest;

// Barycentric regions of a triangle, after C. Ericson, Real-Time Collision Detection, 5.1.5.
static const double *closest_feature(const WeirMeshTree *tree, const Triangle *triangle, const double p[3],
                                     double weights[3])
{
    double ab[3], ac[3], ap[3], bp[3], cp[3];
    subtract(triangle->corner[1], triangle->corner[0], ab);
    subtract(triangle->corner[2], triangle->corner[0], ac);
    subtract(p, triangle->corner[0], ap);
    subtract(p, triangle->corner[1], bp);
    subtract(p, triangle->corner[2], cp);
    double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
           d6 = dot(ac, cp);
    double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    int corner = -1, edge = -1;
    double share = 0.0;
    if (d1 <= 0 && d2 <= 0) {
        corner = 0;
    } else if (d3 >= 0 && d4 <= d3) {
        corner = 1;
    } else if (d6 >= 0 && d5 <= d6) {
        corner = 2;
    } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        edge = 0, share = d1 / (d1 - d3);
    } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        edge = 2, share = 1.0 - d2 / (d2 - d6);
    } else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        edge = 1, share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    } else {
        double sum = va + vb + vc;
        weights[0] = va / sum, weights[1] = vb / sum, weights[2] = vc / sum;
        return triangle->normal;
    }
    weights[0] = weights[1] = weights[2] = 0.0;
    if (corner >= 0) {
        weights[corner] = 1.0;
        return &tree->corner_normals[3 * (size_t)triangle->welded[corner]];
    }
    weights[edge] = 1.0 - share;
    weights[(edge + 1) % 3] = share;
    return triangle->edge_normal[edge];
}

static void visit_triangle(const WeirMeshTree *tree, const Triangle *triangle, const double p[3],
                           Closest *closest)
{
    double weights[3], offset[3];
    const double *normal = closest_feature(tree, triangle, p, weights);
    for (int axis = 0; axis < 3; ++axis) {
        offset[axis] =
            p[axis] - (weights[0] * triangle->corner[0][axis] + weights[1] * triangle->corner[1][axis] +
                       weights[2] * triangle->corner[2][axis]);
    }
    double distance2 = dot(offset, offset);
    if (!(distance2 < closest->distance2)) return;
    closest->distance2 = distance2;
    closest->normal = normal;
    memcpy(closest->offset, offset, sizeof offset);
}

static double box_distance2(const Node *node, const double p[3])
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double below = node->low[axis] - p[axis], above = p[axis] - node->high[axis];
        double d = below > above ? below : above;
        sum += d > 0.0 ? d * d : 0.0;
    }
    return sum;
}

double weir_mesh_tree_distance(const WeirMeshTree *tree, const double point[3], double slope[3])
{
    Closest closest = {.distance2 = DBL_MAX, .normal = tree->triangles[0].normal};
    struct {
        uint32_t node;
        double distance2;
    } stack[MAX_DEPTH + 2];
    int depth = 0;
    stack[depth].node = 0;
    stack[depth++].distance2 = 0.0;
    while (depth > 0) {
        --depth;
        if (stack[depth].distance2 >= closest.distance2) continue;
        const Node *node = &tree->nodes[stack[depth].node];
        for (uint32_t n = 0; n < node->count; ++n)
            visit_triangle(tree, &tree->triangles[tree->order[node->first + n]], point, &closest);
        if (node->count > 0) continue;
        double a = box_distance2(&tree->nodes[node->first], point);
        double b = box_distance2(&tree->nodes[node->first + 1], point);
        uint32_t near = a <= b ? node->first : node->first + 1, children = node->first;
        stack[depth].node = near == children ? children + 1 : children;
        stack[depth++].distance2 = fmax(a, b);
        stack[depth].node = near;
        stack[depth++].distance2 = fmin(a, b);
    }
    double distance = sqrt(closest.distance2), sign = dot(closest.offset, closest.normal) < 0.0 ? -1.0 : 1.0;
    for (int axis = 0; slope && axis < 3; ++axis)
        slope[axis] = distance > 0.0 ? sign * closest.offset[axis] / distance : 0.0;
    return sign * distance;
}
