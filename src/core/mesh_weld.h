// Corners of a mesh that lie in one place become one, and triangles learn who is on the other side of each edge.
#pragma once

#include "core/scene.h"

typedef struct WeirWeld {
    uint32_t *corner; // per vertex: the first vertex in its place
    uint32_t
        *neighbor; // per triangle and edge (01, 12, 20): the triangle with the same edge the other way round
    // What stands in the way of a closed surface; UINT32_MAX: nothing. Triangle, and its edge.
    uint32_t open_triangle, open_edge;     // an edge without another side
    uint32_t turned_triangle, turned_edge; // an edge that two triangles run the same way
} WeirWeld;

// false if memory ran out. Indices must be in range.
bool weir_weld_start(WeirWeld *weld, const WeirMesh *mesh);
void weir_weld_end(WeirWeld *weld);
