// The shapes of walls and bodies as triangles, and as forms that a shader meets with rays.
#pragma once

#include "core/scene.h"

// Two vec4f of `corners` in shaders/render/space/solid.wgsl.
typedef struct WeirCorner {
    float place[3]; // from the solid's reference point at the start, m
    uint32_t solid;
    float normal[3];
    float tone; // of its colour: round shapes have two, which show how they turn
} WeirCorner;

enum { WEIR_FORM_CORNERS = 3 * 512 }; // of a mesh: rays try them all

// Form in shaders/render/space/forms.wgsl. Lengths are m, in the solid's own axes.
typedef struct WeirForm {
    float middle[3]; // from the solid's reference point
    float reach;     // no point of it is farther from there; 0: nothing is there
    float size[3];   // half of a box; of a cylinder radius and half length; a ball's radius
    uint32_t kind;   // WeirShapeKind
    float axis[3];   // of a cylinder, a unit vector
    uint32_t solid;
    float across[3];      // to the axis: where the first of its tones begins
    uint32_t first, last; // corners of a mesh in the list of triangles; none if it has too many for rays
    uint32_t unused[3];
} WeirForm;

// Three corners each, either way round; and one form per wall or body.
typedef struct WeirTriangles {
    WeirCorner *corners; // from malloc
    uint32_t count, capacity;
    bool failed; // no memory, or more than a device's buffer holds
    WeirForm forms[WEIR_MAX_WALLS + WEIR_MAX_BODIES];
    uint32_t form_count;
} WeirTriangles;

// Wall or body `n` of a scene, walls first; NULL if it is hidden (weir_scene_look()).
const WeirSolidPiece *weir_shown_piece(const WeirScene *scene, uint32_t n);
// Those of all walls and bodies of a scene in 3D that are drawn (weir_scene_look()). What of a fixed box lies outside
// the domain is cut off.
void weir_triangles_of(WeirTriangles *triangles, const WeirScene *scene);
void weir_triangles_free(WeirTriangles *triangles);
