#include "core/mesh_weld.h"
#include "core/mesh_tree.h"
#include "core/scene_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint64_t mix(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 29;
}

static uint64_t hash_vertex(const double *vertex)
{
    uint64_t hash = 0x51ed270b, words[3];
    double clean[3];
    for (int k = 0; k < 3; ++k) clean[k] = vertex[k] + 0.0; // -0 is 0
    memcpy(words, clean, sizeof words);
    for (int k = 0; k < 3; ++k) hash = mix(hash, words[k]);
    return hash;
}

// Power of two above twice the count.
static size_t table_size(size_t count)
{
    size_t size = 16;
    while (size < 2 * count) size *= 2;
    return size;
}

static bool weld_corners(WeirWeld *weld, const WeirMesh *mesh)
{
    size_t size = table_size(mesh->vertex_count);
    uint32_t *table = calloc(size, sizeof *table); // vertex + 1
    if (!table) return false;
    for (uint32_t v = 0; v < mesh->vertex_count; ++v) {
        const double *vertex = &mesh->vertices[3 * (size_t)v];
        size_t slot = hash_vertex(vertex) & (size - 1);
        while (table[slot]) {
            const double *other = &mesh->vertices[3 * (size_t)(table[slot] - 1)];
            if (other[0] == vertex[0] && other[1] == vertex[1] && other[2] == vertex[2]) break;
            slot = (slot + 1) & (size - 1);
        }
        if (!table[slot]) table[slot] = v + 1;
        weld->corner[v] = table[slot] - 1;
    }
    free(table);
    return true;
}

static void edge_ends(const WeirWeld *weld, const WeirMesh *mesh, size_t edge, uint32_t *from, uint32_t *to)
{
    const uint32_t *triangle = &mesh->triangles[edge / 3 * 3];
    *from = weld->corner[triangle[edge % 3]];
    *to = weld->corner[triangle[(edge % 3 + 1) % 3]];
}

// The slot of the edge from -> to: where it is, or where it would be put.
static size_t edge_slot(const WeirWeld *weld, const WeirMesh *mesh, const uint32_t *table, size_t size,
                        uint32_t from, uint32_t to)
{
    size_t slot = mix(mix(0x2545f491, from), to) & (size - 1);
    for (; table[slot]; slot = (slot + 1) & (size - 1)) {
        uint32_t a, b;
        edge_ends(weld, mesh, table[slot] - 1, &a, &b);
        if (a == from && b == to) break;
    }
    return slot;
}

static bool join_edges(WeirWeld *weld, const WeirMesh *mesh)
{
    size_t edges = 3 * (size_t)mesh->triangle_count, size = table_size(edges);
    uint32_t *table = calloc(size, sizeof *table); // edge + 1
    if (!table) return false;
    for (size_t edge = 0; edge < edges; ++edge) {
        uint32_t from, to;
        edge_ends(weld, mesh, edge, &from, &to);
        size_t slot = edge_slot(weld, mesh, table, size, from, to);
        if (table[slot] && weld->turned_triangle == UINT32_MAX) {
            weld->turned_triangle = (uint32_t)(edge / 3);
            weld->turned_edge = edge % 3;
        }
        if (!table[slot]) table[slot] = (uint32_t)edge + 1;
    }
    for (size_t edge = 0; edge < edges; ++edge) {
        uint32_t from, to;
        edge_ends(weld, mesh, edge, &from, &to);
        size_t slot = edge_slot(weld, mesh, table, size, to, from);
        weld->neighbor[edge] = table[slot] ? (table[slot] - 1) / 3 : (uint32_t)(edge / 3);
        if (!table[slot] && weld->open_triangle == UINT32_MAX) {
            weld->open_triangle = (uint32_t)(edge / 3);
            weld->open_edge = edge % 3;
        }
    }
    free(table);
    return true;
}

bool weir_weld_start(WeirWeld *weld, const WeirMesh *mesh)
{
    *weld = (WeirWeld){.open_triangle = UINT32_MAX, .turned_triangle = UINT32_MAX};
    weld->corner = malloc(mesh->vertex_count * sizeof *weld->corner);
    weld->neighbor = malloc(3 * (size_t)mesh->triangle_count * sizeof *weld->neighbor);
    if (weld->corner && weld->neighbor && weld_corners(weld, mesh) && join_edges(weld, mesh)) return true;
    weir_weld_end(weld);
    return false;
}

void weir_weld_end(WeirWeld *weld)
{
    free(weld->corner);
    free(weld->neighbor);
    weld->corner = weld->neighbor = NULL;
}

// ---- Checks ----

static WeirStatus check_indices(WeirScene *scene, const WeirMesh *mesh, const char *piece)
{
    if (mesh->triangle_count < 4 || mesh->vertex_count < 4) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%s.mesh: %u vertices and %u triangles; a closed mesh has at least 4 of each", piece,
                         mesh->vertex_count, mesh->triangle_count);
    }
    for (size_t k = 0; k < 3 * (size_t)mesh->triangle_count; ++k) {
        if (mesh->triangles[k] < mesh->vertex_count) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%s.mesh.triangles[%zu]: corner %u does not exist; there are %u vertices", piece,
                         k / 3, mesh->triangles[k], mesh->vertex_count);
    }
    return WEIR_OK;
}

// Twice the area vector of a triangle.
static void area_of(const WeirMesh *mesh, uint32_t t, double corner[3][3], double area[3])
{
    for (int k = 0; k < 3; ++k) weir_mesh_corner(mesh, mesh->triangles[3 * (size_t)t + (size_t)k], corner[k]);
    double a[3], b[3];
    for (int axis = 0; axis < 3; ++axis) {
        a[axis] = corner[1][axis] - corner[0][axis];
        b[axis] = corner[2][axis] - corner[0][axis];
    }
    for (int k = 0; k < 3; ++k) area[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static WeirStatus check_areas(WeirScene *scene, const WeirMesh *mesh, const char *piece)
{
    double volume = 0.0, corner[3][3], area[3], origin[3];
    weir_mesh_corner(mesh, mesh->triangles[0], origin);
    for (uint32_t t = 0; t < mesh->triangle_count; ++t) {
        area_of(mesh, t, corner, area);
        double longest2 = 0.0;
        for (int k = 0; k < 3; ++k) {
            double length2 = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                double d = corner[(k + 1) % 3][axis] - corner[k][axis];
                length2 += d * d;
            }
            longest2 = fmax(longest2, length2);
        }
        double size = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
        if (!(size > 1e-9 * longest2)) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "%s.mesh.triangles[%u]: has no area, near (%g, %g, %g); remove it", piece, t,
                             corner[0][0], corner[0][1], corner[0][2]);
        }
        for (int axis = 0; axis < 3; ++axis) volume += (corner[0][axis] - origin[axis]) * area[axis] / 6.0;
    }
    if (volume > 0.0) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%s.mesh: its normals point inwards (volume %g m^3); turn all triangles round", piece,
                     volume);
}

WeirStatus weir_mesh_check(WeirScene *scene, const WeirMesh *mesh, const char *piece)
{
    WeirWeld weld;
    WeirStatus status = check_indices(scene, mesh, piece);
    if (status) return status;
    if (!weir_weld_start(&weld, mesh))
        return weir_fail(&scene->error, WEIR_ERROR_MEMORY, "%s.mesh: memory ran out", piece);
    weir_weld_end(&weld);
    bool turned = weld.turned_triangle != UINT32_MAX;
    uint32_t t = turned ? weld.turned_triangle : weld.open_triangle;
    uint32_t edge = turned ? weld.turned_edge : weld.open_edge;
    double from[3], to[3];
    // A flat triangle makes edges that look open: it is named first.
    status = check_areas(scene, mesh, piece);
    if (t == UINT32_MAX || (status && strstr(scene->error.text, "no area"))) return status;
    weir_mesh_corner(mesh, mesh->triangles[3 * (size_t)t + edge], from);
    weir_mesh_corner(mesh, mesh->triangles[3 * (size_t)t + (edge + 1) % 3], to);
    return weir_fail(
        &scene->error, WEIR_ERROR_INPUT,
        "%s.mesh: %s at the edge (%g, %g, %g) to (%g, %g, %g) of triangle %u; must be closed, with "
        "all normals outwards",
        piece, turned ? "two triangles have opposite normals, or more than two meet," : "has a hole", from[0],
        from[1], from[2], to[0], to[1], to[2], t);
}
