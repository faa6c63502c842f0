// The shapes of walls and bodies as triangles.
#pragma once

#include "core/scene.h"

// Two vec4f of `corners` in shaders/render/space/solid.wgsl.
typedef struct WeirCorner {
    float place[3]; // from the solid's reference point at the start, m
    uint32_t solid;
    float normal[3];
    float tone; // of its colour: round shapes have two, which show how they turn
} WeirCorner;

// Three corners each, either way round.
typedef struct WeirTriangles {
    WeirCorner *corners; // from malloc
    uint32_t count, capacity;
    bool failed; // no memory, or more than a device's buffer holds
} WeirTriangles;

// Wall or body `n` of a scene, walls first; NULL if it is hidden (weir_scene_look()).
const WeirSolidPiece *weir_shown_piece(const WeirScene *scene, uint32_t n);
// Those of all walls and bodies of a scene in 3D that are drawn (weir_scene_look()). What of a fixed box lies outside
// the domain is cut off.
void weir_triangles_of(WeirTriangles *triangles, const WeirScene *scene);
void weir_triangles_free(WeirTriangles *triangles);
