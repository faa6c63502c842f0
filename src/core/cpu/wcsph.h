// The CPU solver of `wcsph`: what its files share. wcsph.c has the step, wcsph_motion.c what moves particles,
// wcsph_solids.c walls and bodies, wcsph_pairs.c the sums over neighbours, wcsph_state.c memory and reading.
#pragma once

#include "core/cpu/cells.h"
#include "core/cpu/wcsph_pairs.h"
#include "core/solids.h"
#include "core/solver.h"

// Particles of one piece of work: small enough to balance threads, large enough to hide the hand-over.
enum { WEIR_WCSPH_CHUNK = 512, WEIR_WCSPH_CELL_CHUNK = 4096 };

// On a particle of a solid.
typedef struct WeirWcsphSolidForce {
    float fluid[3], contact[3]; // N, by the fluid and by other solids
    float wetted,
        pressed; // kg of fluid around it, and that contact would move (docs/wcsph.md, "Light bodies", "Contact of solids")
} WeirWcsphSolidForce;

// Between steps all of a particle; vectors have three arrays also in 2D.
typedef struct WeirWcsphParticles {
    int32_t *x[3];      // quanta
    float *velocity[3]; // m/s
    float *
        excess; // density less the rest density, kg/m^3: float32 holds its small changes, which make the pressure
    float *rate; // drho/dt
    uint32_t *id, *group;
} WeirWcsphParticles;

typedef struct WeirWcsphEmitterState {
    double next_travel; // m that the flow has come since `start` when the next layer is due
} WeirWcsphEmitterState;

// Where the simulation stands; small enough to be copied with a snapshot.
typedef struct WeirWcsphClock {
    uint64_t steps;
    double time;            // s
    float time_step;        // s, of the next step
    float max_speed;        // m/s, of the fluid
    float max_acceleration; // m/s^2, of fluid and free bodies
    float max_density_error;
    uint32_t fluid_particles, drained_particles, lost_particles;
} WeirWcsphClock;

// The state of some steps ago, for reading after a blow-up.
typedef struct WeirWcsphSnapshot {
    WeirWcsphParticles particles;
    WeirSolidState *solids;
    WeirWcsphClock clock;
} WeirWcsphSnapshot;

typedef enum WeirWcsphPass {
    WEIR_WCSPH_DRIFT,
    WEIR_WCSPH_COUNT,
    WEIR_WCSPH_SCAN,
    WEIR_WCSPH_SCATTER,
    WEIR_WCSPH_WALLS,
    WEIR_WCSPH_FORCES,
    WEIR_WCSPH_SOLIDS,
    WEIR_WCSPH_KICK,
    WEIR_WCSPH_FINISH,
    WEIR_WCSPH_TIME_STEP,
    WEIR_WCSPH_PASSES
} WeirWcsphPass;

// wcsph_motion.c, once per instruction set. Each handles particles [begin, end) and writes nothing else; `context`: the solver.
typedef struct WeirWcsphMotion {
    void (*drift)(void *context, uint32_t begin, uint32_t end);  // of the state
    void (*kick)(void *context, uint32_t begin, uint32_t end);   // of the sorted particles
    void (*finish)(void *context, uint32_t begin, uint32_t end); // of the sorted particles
} WeirWcsphMotion;

typedef struct WeirWcsph {
    WeirSolver base;
    WeirParameters parameters;
    WeirConstants constants;
    WeirPool *pool;
    const WeirWcsphPasses *passes;
    const WeirWcsphMotion *motion;
    WeirCells cells;
    WeirWcsphParticles state;  // what the last step left
    WeirWcsphParticles sorted; // the same by cell, empty slots last
    uint32_t active;           // sorted particles that are not empty
    float *sums;               // one block for all arrays of `data` that are not of `sorted`
    WeirWcsphData data;        // of the sorted particles
    WeirWorld world;           // without particles
    WeirSolidState *solids;
    WeirWcsphEmitterState *emitters;
    uint32_t *vacancy; // by id of the fluid, if there are emitters: for weir_wcsph_emit()
    float *local;      // 3 per solid particle: where it is from its solid's reference point at the start, m
    float *bulk;       // by solid: weir_solid_bulk()
    float *
        seen; // 3 per solid particle, with walls_by_pair: the velocity that fluid sees, of the step before, m/s
    WeirWcsphSolidForce *solid_force; // by solid particle
    bool forces_wanted;               // a read asks for the forces on fixed and driven solids too
    bool has_emitters, has_moving_solids, has_free_bodies;
    bool walls_by_pair;         // in 2D where no solid moves: WeirWcsphData
    bool keeps_seen;            // walls leaves what fluid sees for the next step: not in a read
    uint32_t emission_interval; // weir_world_emission_interval()
    float dt, free_dt;          // of the step that is being taken; the same, if nothing had shortened it
    WeirWcsphClock clock;
    WeirWcsphSnapshot snapshot;
    WeirHealth bad;          // the bad_particles, first_bad_ fields alone
    atomic_uint bad_in_step; // of the step that is being taken
    atomic_uint first_bad_id;
    atomic_uint speed_bits, acceleration_bits,
        density_bits; // largest values of the step: floats >= 0, compared as bits
    atomic_uint fluid_in_step, drained_in_step, lost_in_step;
    struct WeirHostCopy *host;
    double pass_seconds[WEIR_WCSPH_PASSES];
} WeirWcsph;

// Takes the maximum of values that are not negative: their bits have their order.
static inline void weir_atomic_max(atomic_uint *bits, float value)
{
    union {
        float number;
        uint32_t bits;
    } word = {value};
    uint32_t old = atomic_load_explicit(bits, memory_order_relaxed);
    while (old < word.bits && !atomic_compare_exchange_weak_explicit(
                                  bits, &old, word.bits, memory_order_relaxed, memory_order_relaxed)) {
    }
}

static inline float weir_float_of(uint32_t bits)
{
    union {
        uint32_t bits;
        float number;
    } word = {bits};
    return word.number;
}

// Group FLUID or INLET: particles that are fluid for all others.
static inline bool weir_group_is_fluid(uint32_t group)
{
    return group == WEIR_GROUP_FLUID || (group >= WEIR_GROUP_INLET && group != WEIR_GROUP_EMPTY);
}

// Of a solid's sorted particle i: what stands for it in `seen`.
static inline float *weir_wcsph_seen(const WeirWcsph *solver, uint32_t i)
{
    return solver->seen + 3 * (size_t)(solver->sorted.id[i] - solver->constants.first_solid);
}

// ---- dispatch.c ----
// The fastest motion that this processor runs, for particles with about so many neighbours.
const WeirWcsphMotion *weir_wcsph_motion(uint32_t dimension, double neighbors);

// ---- wcsph_solids.c ----
// Velocity of every solid's particles among `particles`, `surface`: with the surface's own.
void weir_wcsph_solid_velocities(WeirWcsph *solver, const WeirWcsphParticles *particles, bool surface,
                                 float *const velocity[3]);
void weir_wcsph_walls(WeirWcsph *solver);
void weir_wcsph_solids(WeirWcsph *solver);
// Places the particles of moving solids.
void weir_wcsph_place_solids(WeirWcsph *solver, WeirWcsphParticles *particles);
// Sums the forces on each solid.
void weir_wcsph_sum_solid_forces(WeirWcsph *solver);

// ---- wcsph_emitters.c ----
void weir_wcsph_emit(WeirWcsph *solver);

// ---- wcsph_state.c ----
bool weir_wcsph_allocate(WeirWcsph *solver, const WeirSolverSetup *setup);
void weir_wcsph_free(WeirWcsph *solver);
void weir_wcsph_set_particles(WeirWcsph *solver, const WeirParticles *particles);
void weir_wcsph_take_snapshot(WeirWcsph *solver);
void weir_wcsph_restore_snapshot(WeirWcsph *solver);
// Copies by id; false if memory runs out. `evaluated`: the sorted particles and what the passes found, else what moves of
// the state.
bool weir_wcsph_copy_state(WeirWcsph *solver, bool evaluated, WeirState *state);
