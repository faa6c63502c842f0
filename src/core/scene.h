// A scene's fields, as the solvers' side of the core sees them. Built through weir.h only (scene.c,
// scene_path.c).
#pragma once

#include "core/parameters.h"

enum { WEIR_MAX_FLUIDS = 64, WEIR_TITLE_LENGTH = 120 };

typedef enum WeirShape { WEIR_SHAPE_NONE, WEIR_SHAPE_BOX, WEIR_SHAPE_BALL } WeirShape;

// One piece of fluid; which of its keys were set is kept so that a missing one can be named.
typedef struct WeirFluid {
    WeirShape shape;
    bool has_min, has_max, has_center, has_radius;
    double min[3], max[3];
    double center[3], radius;
    double velocity[3];
} WeirFluid;

struct WeirScene {
    char title[WEIR_TITLE_LENGTH];
    uint32_t dimension;
    WeirParameters parameters;
    double domain_min[3], domain_max[3];
    WeirFluid fluid[WEIR_MAX_FLUIDS];
    uint32_t fluid_count;
    WeirMessage error, warning;
};

// Most particles that a scene may make: ids and cell starts are 32-bit, and a state must fit the host.
enum { WEIR_MAX_PARTICLES = 1 << 28 };

// The scene's particles on their lattice, in order of fluid, row, column: the id is the index. Arrays of 2
// floats per particle, from malloc. Positions are computed in double and rounded once, so every target gets
// equal bits.
typedef struct WeirParticles {
    uint32_t count;
    float *position, *velocity;
} WeirParticles;
WeirStatus weir_scene_make_particles(WeirScene *scene, WeirParticles *particles);
void weir_particles_free(WeirParticles *particles);
// Refreshes the scene's warning: a time step above the stable one.
void weir_scene_advise(WeirScene *scene);
