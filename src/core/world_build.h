// The parts of weir_scene_make_world(): lists of points that grow, and who fills them.
#pragma once

#include "core/scene.h"

// Points that are added one by one; `failed` if memory ran out: then nothing more is added.
typedef struct WeirPoints {
    double *data;
    uint64_t count, capacity;
    uint32_t dimension;
    bool failed;
} WeirPoints;

void weir_points_add(WeirPoints *points, const double *point);
void weir_points_free(WeirPoints *points);

// A world under construction.
typedef struct WeirBuild {
    WeirScene *scene;
    WeirParameters parameters; // resolved
    uint32_t dimension;
    double spacing;
    uint32_t layers;                     // of wall particles that the support needs
    WeirPoints fluid;                    // by piece
    uint64_t first[WEIR_MAX_FLUIDS + 1]; // of a piece's points; the last: their number
    WeirPoints solid;                    // of all solids, one after the other
    WeirWorld *world;
} WeirBuild;

// Fills build->fluid and ->first with the sites of all pieces.
WeirStatus weir_build_fluid(WeirBuild *build);
// Velocity and density at the start of all fluid particles, in the world's arrays.
void weir_build_start(WeirBuild *build);
// Upper bound on the fluid's sites.
double weir_fluid_sites(const WeirScene *scene);
// The domain's own sides as wall particles: adds solid 0 if any side is closed.
void weir_build_sides(WeirBuild *build);
// Number of particles of the domain's sides.
double weir_sides_count(const WeirScene *scene, double spacing, uint32_t layers);
bool weir_has_sides(const WeirScene *scene);
// Checks all that needs no particles.
WeirStatus weir_scene_check_values(WeirScene *scene);
// Layers of wall particles that a support radius needs.
uint32_t weir_wall_layers(const WeirParameters *parameters);
