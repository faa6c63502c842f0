// Shapes: where they are, what is inside, how far the surface is, how heavy they are.
#pragma once

#include "core/mesh_tree.h"
#include "core/scene.h"

// Lowest and highest corner of what encloses the shape.
void weir_shape_bounds(const WeirShape *shape, uint32_t dimension, double low[3], double high[3]);
// What the shape lacks, "box.max"; NULL if it is complete.
const char *weir_shape_missing(const WeirShape *shape);
// Checks the shape of the piece named `piece`: complete, not turned, a simple polygon, a closed mesh.
WeirStatus weir_shape_check(WeirScene *scene, const WeirShape *shape, const char *piece);

// A shape ready for many questions.
typedef struct WeirSurface {
    const WeirShape *shape;
    uint32_t dimension;
    WeirMeshTree *tree;     // of a mesh
    double low[3], high[3]; // bounds
} WeirSurface;

// false if memory ran out.
bool weir_surface_start(WeirSurface *surface, const WeirShape *shape, uint32_t dimension);
void weir_surface_end(WeirSurface *surface);
// Distance to the surface, negative inside the shape.
double weir_surface_distance(const WeirSurface *surface, const double *point);

// Of a shape of density 1: area (2D) or volume, centre, and inertia about the centre (2D: [2][2] alone).
typedef struct WeirShapeMoments {
    double volume, center[3], inertia[3][3];
} WeirShapeMoments;

void weir_shape_moments(const WeirShape *shape, uint32_t dimension, WeirShapeMoments *moments);

// The point of a wall or body whose place the solver keeps: its middle, a body's centre of mass; or what its motion turns
// about.
void weir_piece_reference(const WeirSolidPiece *piece, uint32_t dimension, double point[3]);

// Corner `index` of a mesh after scale and translate.
static inline void weir_mesh_corner(const WeirMesh *mesh, uint32_t index, double corner[3])
{
    double scale = mesh->scale > 0.0 ? mesh->scale : 1.0;
    for (int axis = 0; axis < 3; ++axis)
        corner[axis] = scale * mesh->vertices[3 * (size_t)index + (size_t)axis] + mesh->translate[axis];
}
