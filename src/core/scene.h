// A scene's fields, as the solvers' side of the core sees them. Built through weir.h only (scene.c,
// scene_path.c).
#pragma once

#include "core/solver.h"

enum {
    WEIR_MAX_FLUIDS = 64,
    WEIR_MAX_WALLS = 64,
    WEIR_MAX_BODIES = 64,
    WEIR_MAX_EMITTERS = 1024, // a uniform buffer on the GPU holds so many
    WEIR_MAX_DRAINS = 1024,
    WEIR_MAX_PROBES = 32,
    WEIR_TITLE_LENGTH = 120,
    WEIR_NAME_LENGTH = 32,
};

typedef enum WeirShapeKind {
    WEIR_SHAPE_NONE,
    WEIR_SHAPE_BOX,      // min, max
    WEIR_SHAPE_BALL,     // center, radius; a disc in 2D
    WEIR_SHAPE_CYLINDER, // from, to (ends of its axis), radius; 3D only
    WEIR_SHAPE_POLYGON,  // points, closed by itself; 2D only
    WEIR_SHAPE_MESH,     // a closed triangle mesh; 3D only
} WeirShapeKind;

// A triangle mesh: corners x, y, z and three corner indices per triangle, counter-clockwise seen from outside.
typedef struct WeirMesh {
    double *vertices;
    uint32_t *triangles;
    uint32_t vertex_count, triangle_count;
    uint32_t vertex_capacity, triangle_capacity;
    double scale, translate[3]; // corner = scale * vertex + translate; scale 0: 1
} WeirMesh;

// A region of space; which of its keys were set is kept so that a missing one can be named.
typedef struct WeirShape {
    WeirShapeKind kind;
    bool has_min, has_max, has_center, has_radius, has_from, has_to;
    double min[3], max[3];
    double center[3], radius;
    double from[3], to[3];
    double *points; // polygon: x, y per corner; owned
    uint32_t point_count, point_capacity;
    WeirMesh mesh; // owned
} WeirShape;

// How the fluid moves at the start, beside its constant velocity; `flow_rate` is the number named.
typedef enum WeirFlow {
    WEIR_FLOW_NONE,
    WEIR_FLOW_TAYLOR_GREEN,    // vortices of one domain length, speed in m/s; with their pressure
    WEIR_FLOW_ROTATING_SQUARE, // angular velocity in rad/s about the piece's middle; with its pressure
    WEIR_FLOW_STRETCH,         // (-A x, A y) about the piece's middle, A in 1/s; with its pressure
    WEIR_FLOW_STANDING_WAVE,   // first mode of the domain's length at flat surface, amplitude in m
} WeirFlow;

typedef struct WeirFluid {
    WeirShape shape;
    double velocity[3];
    WeirFlow flow;
    double flow_rate;
    bool hydrostatic; // wcsph: starts under the pressure of its own weight; true by default
} WeirFluid;

// A prescribed motion: constant velocities, or oscillation amplitude * sin(2 pi t / period), or rows of a table.
typedef struct WeirMotion {
    double velocity[3], angular_velocity[3];
    double amplitude[3], angle[3], period; // m, rad, s
    bool has_pivot;
    double pivot[3];     // point that it turns about; the middle of the shape if not given
    WeirMotionRow *rows; // owned; as given: rates are made with the world
    uint32_t row_count, row_capacity;
    bool repeats;
} WeirMotion;

// A wall or a body.
typedef struct WeirSolidPiece {
    char name[WEIR_NAME_LENGTH]; // for probes and reports; "" if not given
    WeirShape shape;
    bool inside;  // walls: the fluid is inside the shape and the wall around it
    bool no_slip; // true by default
    double surface_velocity[3];
    bool is_driven; // it has a motion
    WeirMotion motion;
    // Bodies only:
    double density;                          // kg/m^3
    double velocity[3], angular_velocity[3]; // at the start
    bool fixed[3], fixed_rotation[3];        // directions in which it is held
} WeirSolidPiece;

// `center` of a nozzle that is `size` wide (2D) or a disc of that diameter (3D), blowing along `direction`.
typedef struct WeirEmitterPiece {
    bool has_center;
    double center[3], direction[3];
    double size;        // m
    double speed;       // m/s
    double flow_rate;   // m^3/s (m^2/s in 2D) instead of speed; 0: not given
    double start, stop; // s; stop 0: never
    uint32_t capacity;  // most particles that it may have in the domain at a time; 0: chosen from the domain
} WeirEmitterPiece;

typedef struct WeirDrainPiece {
    bool has_min, has_max;
    double min[3], max[3];
} WeirDrainPiece;

typedef enum WeirProbeKind {
    WEIR_PROBE_PRESSURE, // at `position`, Pa
    WEIR_PROBE_VELOCITY, // at `position`, m/s per axis
    WEIR_PROBE_HEIGHT,   // of the free surface above `position`, against gravity, m
    WEIR_PROBE_FORCE,    // of the fluid on the wall or body `target`, N per axis
    WEIR_PROBE_FRONT,    // farthest fluid along `direction`, m
    WEIR_PROBE_MASS,     // of the fluid in the box min, max, kg
} WeirProbeKind;

typedef struct WeirProbePiece {
    char name[WEIR_NAME_LENGTH];
    WeirProbeKind kind;
    bool has_kind, has_position, has_min, has_max;
    double position[3], direction[3];
    double min[3], max[3];
    char target[WEIR_NAME_LENGTH];
    double rate; // samples per simulated second; 100 by default
} WeirProbePiece;

struct WeirScene {
    char title[WEIR_TITLE_LENGTH];
    WeirMethod method;
    uint32_t dimension;
    WeirParameters parameters;
    uint64_t parameters_given; // bit k: parameter k was set
    double domain_min[3], domain_max[3];
    bool periodic[3];     // axes
    bool open[3][2];      // wcsph: sides (axis, low or high) without wall; what passes them is lost
    bool free_slip_sides; // wcsph: the domain's own walls let the fluid slide
    WeirFluid fluid[WEIR_MAX_FLUIDS];
    WeirSolidPiece wall[WEIR_MAX_WALLS];
    WeirSolidPiece body[WEIR_MAX_BODIES];
    WeirEmitterPiece emitter[WEIR_MAX_EMITTERS];
    WeirDrainPiece drain[WEIR_MAX_DRAINS];
    WeirProbePiece probe[WEIR_MAX_PROBES];
    uint32_t fluid_count, wall_count, body_count, emitter_count, drain_count, probe_count;
    WeirMessage error, warning;
};

// Most particles that a scene may make: ids and cell starts are 32-bit, and a state must fit the host.
enum { WEIR_MAX_PARTICLES = 1 << 28 };

// The parameters as a solver takes them: where 0 means "choose", the choice (support_radius, sound_speed).
WeirParameters weir_scene_resolved(const WeirScene *scene);
// Largest speed expected, m/s: of fluid, walls and emitters at the start, and 2 sqrt(g H) of the fall to the
// domain's lowest point, the speed of a dam break's front.
double weir_scene_expected_speed(const WeirScene *scene);
// Checks the scene and makes all that a simulation starts with; free it with weir_world_free().
WeirStatus weir_scene_make_world(WeirScene *scene, WeirWorld *world);
// Index into WeirWorld.solids of the wall or body of that name, or of "domain", the domain's own sides; -1 if there
// is none.
int weir_scene_solid_index(const WeirScene *scene, const char *name);
// Refreshes the scene's warning: a time step above the stable one.
void weir_scene_advise(WeirScene *scene);
