// The shapes of walls and bodies in 2D, as flat_solids.wgsl measures distances from them.
#pragma once

#include "core/scene.h"

enum {
    WEIR_FLAT_EDGES = 2048
}; // of all polygons; what every device's uniform buffer holds. flat_solids.wgsl: edges

// Three vec4f of `shapes` in shaders/render/flat_solids.wgsl. Lengths are m, from the solid's reference point at the start.
typedef struct WeirFlatShape {
    float low[2], high[2];
    uint32_t kind; // WeirShapeKind
    uint32_t solid;
    uint32_t first_edge, edge_count; // of a polygon
    float band;                      // width of the wall around the shape; 0: the shape itself is solid
    uint32_t moves;
    float unused[2];
} WeirFlatShape;

typedef struct WeirFlatShapes {
    WeirFlatShape shapes[WEIR_MAX_WALLS + WEIR_MAX_BODIES];
    uint32_t count, edge_count;
    float edges[WEIR_FLAT_EDGES][4]; // both ends
    bool failed;                     // more edges than that
} WeirFlatShapes;

// Those of all walls and bodies of a scene in 2D that are drawn (weir_scene_look()).
void weir_flat_shapes_of(WeirFlatShapes *flat, const WeirScene *scene);
