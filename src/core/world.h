// What a scene becomes when a simulation starts: particles, solids, emitters and drains, on the host, in
// double precision where it matters. The solvers copy it; the structs that shaders read have their layout.
#pragma once

#include "core/parameters.h"

// What a particle is. Solids are walls and bodies alike: WEIR_GROUP_SOLID + index.
enum {
    WEIR_GROUP_FLUID = 0,
    WEIR_GROUP_SOLID = 1,
    WEIR_GROUP_INLET = 0x40000000, // + index of the emitter: fluid that still moves at the emitter's velocity
    WEIR_GROUP_EMPTY = 0x7FFFFFFF, // a slot without particle, for an emitter to use
};

static inline bool weir_group_is_solid(uint32_t group)
{
    return group >= WEIR_GROUP_SOLID && group < WEIR_GROUP_INLET;
}

// Arrays from malloc, by id: first the fluid in order of piece, layer, row, column; then the empty slots;
// then each solid's particles. Positions are rounded by the solvers, once, so every target gets equal bits.
typedef struct WeirParticles {
    uint32_t dimension;   // 2 or 3
    uint32_t count;       // all
    uint32_t fluid_slots; // ids below are fluid or empty, ids from here on belong to solids
    double *position;     // dimension per particle, m
    float *velocity;      // dimension per particle, m/s
    float *density;       // kg/m^3 at the start; NULL (mueller): it follows from the positions
    uint32_t *group;      // WEIR_GROUP_...; NULL (mueller): all fluid
} WeirParticles;

typedef enum WeirSolidKind {
    WEIR_SOLID_FIXED,  // never moves (its surface may: surface_velocity)
    WEIR_SOLID_DRIVEN, // follows its rows of the motion table
    WEIR_SOLID_FREE,   // moved by fluid, gravity and contact
} WeirSolidKind;

// What of a wall or body stays as it is. The layout of WGSL `struct Solid` (shaders/wcsph/solids.wgsl).
typedef struct WeirSolid {
    uint32_t kind;           // WeirSolidKind
    uint32_t no_slip;        // 1: the fluid sticks to it (viscosity acts), 0: it slides
    uint32_t first, count;   // ids of its particles
    uint32_t motion_first;   // rows of the motion table, by time
    uint32_t motion_count;   // 0: none
    uint32_t motion_repeats; // 1: starts anew after its last row
    float mass;              // kg (per metre of depth in 2D)
    alignas(16) float surface_velocity
        [4];                     // of a fixed wall's surface, as of a conveyor belt or a cavity's lid, m/s
    float freedom[4];            // 1 or 0 per axis: may a free body move along x, y, z
    float angular_freedom[4];    // may it turn about x, y, z (2D: z only)
    float inverse_inertia[3][4]; // of a free body about its centre of mass at the start, 1/(kg m^2)
    float position[4];           // reference point at the start: a body's centre of mass, m
    float velocity[4];           // at the start, m/s
    float angular_velocity[4];   // at the start, rad/s
} WeirSolid;

// What changes. The layout of WGSL `struct SolidState`. Vectors in world coordinates.
typedef struct WeirSolidState {
    alignas(16) float position[4]; // of the reference point, m
    float orientation[4];          // unit quaternion x, y, z, w; the start is 0, 0, 0, 1
    float velocity[4];             // of the reference point, m/s
    float angular_velocity[4];     // rad/s
    float acceleration[4];         // of the reference point, m/s^2: enters the wall pressure
    float angular_acceleration[4]; // rad/s^2
    float force[4];  // of the fluid on the solid, last step, N (per metre of depth in 2D); [3]: of a free
                     // body, mass of the fluid that it drags along, kg
    float torque[4]; // of the fluid about the reference point, N m
    float rest[4];   // what float32 leaves out of the position, m
} WeirSolidState;

// One row of a prescribed motion, relative to the start. Between rows: cubic Hermite interpolation.
typedef struct WeirMotionRow {
    float time;                 // s, rising
    float displacement[3];      // m
    float rotation[3];          // angle times axis, rad
    float displacement_rate[3]; // m/s
    float rotation_rate[3];     // rad/s
    float unused[3];            // pads to 64 bytes
} WeirMotionRow;

// A flat nozzle. Layers of particles at its points move along `direction`; each layer is born one support radius
// upstream and becomes free fluid on crossing the nozzle.
typedef struct WeirEmitter {
    uint32_t point_first, point_count; // of WeirWorld.points
    float speed;                       // m/s
    float start, stop;                 // s
    float unused[3];
    alignas(16) float direction[4]; // unit
    float center[4];                // m
} WeirEmitter;

// Fluid that enters the box leaves the simulation; its slots become empty.
typedef struct WeirDrain {
    alignas(16) float min[4], max[4]; // m
} WeirDrain;

typedef struct WeirWorld {
    WeirParticles particles;
    WeirSolid *solids;
    WeirMotionRow *motion;
    WeirEmitter *emitters;
    double *points; // of all emitters' nozzles, dimension per point, m
    WeirDrain *drains;
    WeirDrain *drain_groups; // boxes around WEIR_DRAIN_GROUP drains each; weir_world_group_drains()
    uint32_t solid_count, motion_count, emitter_count, point_count, drain_count, drain_group_count;
} WeirWorld;

// Drains of a group: what lies in none of the groups' boxes is in no drain.
enum { WEIR_DRAIN_GROUP = 32 };
// Puts drains that are near each other side by side, and makes the boxes of their groups, for the solvers. False if
// memory runs out.
bool weir_world_group_drains(WeirWorld *world);

// Layers are born before steps whose number this divides: 4, or 2 or 1 where the fastest emitter's flow would come farther
// than half a spacing in so many steps. The GPU need not offer to sort in the others.
enum { WEIR_EMISSION_INTERVAL = 4 };
uint32_t weir_world_emission_interval(const WeirWorld *world, const WeirParameters *parameters,
                                      const WeirConstants *constants);

void weir_world_free(WeirWorld *world);
