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
    uint32_t empty;                      // slots for emitters
    struct WeirInlet *inlets;            // of the emitters that always run
    uint32_t inlet_count;
    double inlet_min[3], inlet_max[3];  // a box around all of them
    WeirPoints solid;                   // of all solids, one after the other
    struct WeirSurface *walls, *bodies; // their shapes, ready
    WeirWorld *world;
} WeirBuild;

// Fills build->fluid and ->first with the sites of all pieces.
WeirStatus weir_build_fluid(WeirBuild *build);
// Drops fluid inside walls and bodies, or nearer than half a spacing to them.
WeirStatus weir_build_trim_fluid(WeirBuild *build);
// Velocity and density at the start of all fluid particles, in the world's arrays.
void weir_build_start(WeirBuild *build);
// Upper bound on the fluid's sites.
double weir_fluid_sites(const WeirScene *scene);
// A field of flow at a point, added to the velocity; returns its pressure.
double weir_flow_at(const WeirScene *scene, const WeirFluid *fluid, const double *point, double velocity[3]);

// The domain's own sides as wall particles, added to `points`.
void weir_build_sides(WeirBuild *build, WeirPoints *points);
// Number of particles of the domain's sides.
double weir_sides_count(const WeirScene *scene, double spacing, uint32_t layers);
bool weir_has_sides(const WeirScene *scene);

// The domain's sides, walls and bodies: fills build->solid and the world's solids.
WeirStatus weir_build_solids(WeirBuild *build);
// Upper bound on the particles of walls and bodies.
double weir_solids_count(const WeirScene *scene, double spacing, uint32_t layers);
// Tables of all prescribed motions, in the world.
WeirStatus weir_build_motions(WeirBuild *build);
// Largest speed of a wall or body as prescribed or at the start, m/s.
double weir_solid_speed(const WeirSolidPiece *piece, uint32_t dimension);
// Fills build->inlets; false if memory runs out.
bool weir_build_inlets(WeirBuild *build);
// Is this where an emitter that always runs makes its layers? No wall can be there.
bool weir_is_in_inlet(const WeirBuild *build, const double *point);
// Nozzles, drains and the slots for emitters.
WeirStatus weir_build_emitters(WeirBuild *build);

// Checks all that needs no particles.
WeirStatus weir_scene_check_values(WeirScene *scene);
// The same of walls, bodies, emitters, drains and probes.
WeirStatus weir_scene_check_pieces(WeirScene *scene);
// Does a shape reach out of the domain?
WeirStatus weir_check_inside(WeirScene *scene, const WeirShape *shape, const char *piece);
// Layers of wall particles that a support radius needs.
uint32_t weir_wall_layers(const WeirParameters *parameters);
