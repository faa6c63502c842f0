// Signed distance to a closed triangle mesh: a tree of boxes over its triangles, and normals of faces, edges and
// corners weighted by angle, which tell inside from outside at every closest point (J. A. Baerentzen, H. Aanaes,
// IEEE Trans. Vis. Comput. Graph. 11, 2005).
#pragma once

#include "core/scene.h"

typedef struct WeirMeshTree WeirMeshTree;

// NULL if memory ran out. The mesh must have passed weir_mesh_check().
WeirMeshTree *weir_mesh_tree_create(const WeirMesh *mesh);
void weir_mesh_tree_destroy(WeirMeshTree *tree); // NULL is allowed
// Negative inside. `slope`, if not NULL, gets the unit direction in which it grows (0 on the surface itself).
double weir_mesh_tree_distance(const WeirMeshTree *tree, const double point[3], double slope[3]);

// Indices in range, no flat triangles, closed, normals all outward; `piece` names it in messages.
WeirStatus weir_mesh_check(WeirScene *scene, const WeirMesh *mesh, const char *piece);
