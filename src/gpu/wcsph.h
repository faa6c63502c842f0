// The method `wcsph` on the GPU. One step, and who writes what (each arrow a pass of docs/wcsph.md):
//
//   state --count, scan--> cell_start --scatter--> working copy --neighbors--> neighbor_list
//     ^                                                  |
//     |                                  walls (with time_step), forces (with kick)
//     |                                                  |
//     +-- finish (with the next step's drift) -----------+
//
// In 2D where no solid moves forces is all of it, time_step too. Of fluid finish is a part of forces; where solids move, that of their particles is a pass of its own after solid_forces and solids.
//
// `coordinate` and `motion` hold three copies of the particles: the state between calls, and two working copies, one
// read and one written in turn by the steps of a batch. Particles keep their slots until the device finds that lists and
// cells might not last (common/clock.wgsl, judge_order): then finish leaves the particles in the state, from where
// they are sorted. A batch starts with begin and drift; its last step ends in the state, without the next one's drift.
#pragma once

#include "core/scene.h"
#include "gpu/solver.h"

#include <assert.h>
#include <stddef.h>

// WEIR_BUFFER(name): storage buffers. WEIR_PARTS(name, element, written): those that may lie in several parts (buffers.h).
// WEIR_SIZES(name): sizes of dispatches. Bytes of each: weir_gpu_wcsph_sizes().
#define WEIR_WCSPH_BUFFERS                                                                                   \
    WEIR_PARTS(coordinate, "vec4i", NULL)                                                                    \
    WEIR_PARTS(motion, "vec4f", NULL)                                                                        \
    WEIR_BUFFER(id)                                                                                          \
    WEIR_BUFFER(cell_count)                                                                                  \
    WEIR_BUFFER(cell_link)                                                                                   \
    WEIR_BUFFER(block_sum)                                                                                   \
    WEIR_BUFFER(cell_start)                                                                                  \
    WEIR_PARTS(neighbor_list, "vec2u", "vec4u")                                                              \
    WEIR_BUFFER(sorted_id)                                                                                   \
    WEIR_PARTS(kicked, "vec4f", NULL)                                                                        \
    WEIR_BUFFER(solid_state)                                                                                 \
    WEIR_BUFFER(solid_particle)                                                                              \
    WEIR_BUFFER(blocks)                                                                                      \
    WEIR_BUFFER(solid_sum)                                                                                   \
    WEIR_BUFFER(motion_rows)                                                                                 \
    WEIR_BUFFER(vacancy)                                                                                     \
    WEIR_BUFFER(nozzle)                                                                                      \
    WEIR_BUFFER(schedule)                                                                                    \
    WEIR_BUFFER(fluid_sums)                                                                                  \
    WEIR_BUFFER(looks)                                                                                       \
    WEIR_BUFFER(gathered)                                                                                    \
    WEIR_BUFFER(found)                                                                                       \
    WEIR_SIZES(step_end)                                                                                     \
    WEIR_BUFFER(control)

typedef enum WeirWcsphBuffer {
    WEIR_WCSPH_parameters, // the uniforms
    WEIR_WCSPH_constants,
    WEIR_WCSPH_solid_table,
    WEIR_WCSPH_emitters,
    WEIR_WCSPH_drains,
#define WEIR_PARTS(name, element, written) WEIR_WCSPH_##name,
#define WEIR_SIZES(name)                   WEIR_WCSPH_##name,
#define WEIR_BUFFER(name)                  WEIR_WCSPH_##name,
    WEIR_WCSPH_BUFFERS
#undef WEIR_BUFFER
#undef WEIR_SIZES
#undef WEIR_PARTS
        WEIR_WCSPH_BUFFER_TOTAL
} WeirWcsphBuffer;

typedef enum WeirWcsphGpuPass {
    WEIR_WCSPH_BEGIN,
    WEIR_WCSPH_DRIFT,
    WEIR_WCSPH_VACANCIES,
    WEIR_WCSPH_EMIT,
    WEIR_WCSPH_COUNT,
    WEIR_WCSPH_SCAN_REDUCE,
    WEIR_WCSPH_SCAN_WRITE,
    WEIR_WCSPH_SCATTER,
    WEIR_WCSPH_NEIGHBORS,
    WEIR_WCSPH_WALLS,
    WEIR_WCSPH_FORCES,
    WEIR_WCSPH_SOLID_FORCES,
    WEIR_WCSPH_SOLIDS,
    WEIR_WCSPH_TIME_STEP,
    WEIR_WCSPH_FINISH,
    WEIR_WCSPH_BEGIN_READ,
    WEIR_WCSPH_LOAD,
    WEIR_WCSPH_STORE,
    WEIR_WCSPH_FORCES_READ, // forces for read() and at the start: accelerations, on all solids
    WEIR_WCSPH_SOLID_FORCES_READ,
    WEIR_WCSPH_FIRST_STEP,
    WEIR_WCSPH_HEALTH,
    WEIR_WCSPH_DIAGNOSE,
    WEIR_WCSPH_GATHER,
    WEIR_WCSPH_PASS_TOTAL
} WeirWcsphGpuPass;

// Sizes of dispatches in step_end: of passes over particles, over blocks of cells, and of one workgroup; first as the
// device decides them for the next sort, then as they are if there is one.
enum { WEIR_SORT_PARTICLES, WEIR_SORT_BLOCKS, WEIR_SORT_ONE, WEIR_SORT_LISTS, WEIR_SORT_SIZES };

// What a world asks of the passes.
typedef struct WeirWcsphTraits {
    uint32_t dimension, solid_count, emitter_count, drain_count, drain_group_count;
    uint32_t block_count, free_block_count; // blocks of solid particles; those of free bodies come first
    bool moving_solids, free_solids, slip_solids, can_empty;
    uint32_t probe_count, most_gathered; // particles that probes may look at together
    float fastest_surface;               // largest surface_velocity of a solid, m/s
    // How neighbours are found (wcsph_neighbors.c).
    uint32_t list_interval;     // steps; lists may be made anew before those whose number it divides,
    uint32_t sort_interval;     // and particles sorted: a multiple of it;
    uint32_t emission_interval; // and emitters act: a multiple of that, weir_world_emission_interval()
    uint32_t list_life;         // chances that lists are made to last for, at the pace of the step before
    uint32_t lanes;             // threads that share a particle's neighbours: 1, 2, 4, 8
    uint32_t share_threads;     // of a workgroup of pass forces
    uint32_t list_parts;        // of 8 neighbours, per particle; 0: no lists
    uint32_t list_shares,
        list_blocks; // shares of the lists' buffer; of 128 particles' lists each holds so many
    uint32_t row_height, layer_height;        // of cells, quanta
    uint32_t least_allowance, most_allowance; // of the way after which lists are made anew, quanta;
    uint32_t most_stray;                      // twice that and the way since the sort
    bool one_pass;                            // forces is the whole step: in 2D where no solid moves
    bool marks_mixed;                         // lists of fluid alone are summed apart from others
} WeirWcsphTraits;

// Particles of one block of pass solid_forces.
enum { WEIR_SOLID_BLOCK = 1024 };
// Ids whose empty slots pass vacancies counts together.
enum { WEIR_VACANCY_BLOCK = 128 };

// `struct Clock`, `Maxima` and `Control` in shaders/common/state.wgsl. Times: low and high word of a count of 2^-42 s.
typedef struct WeirWcsphClock {
    uint32_t steps_left, running, stepping, steps;
    uint32_t time[2], began[2];
    float dt, next_dt, free_dt, max_speed;
    uint32_t side, last_side, sorting, listing, stale, worn;
    uint32_t travelled, next_allowance, noting;
    float left, flow_speed, due_excess, diffusion;
    uint32_t unused;
} WeirWcsphClock;

typedef struct WeirWcsphMaxima {
    uint32_t speed2_bits, acceleration2_bits, excess_bits;
    uint32_t finish2_bits, drift2_bits, bad;
    uint32_t unused[26];
} WeirWcsphMaxima;

typedef struct WeirWcsphControl {
    uint32_t until[2];
    uint32_t steps_asked, restored, starting, emitted;
    float solid_speed;
    uint32_t bad_id;
    int32_t bad_place[4];
    uint32_t next_due[2], sorted_at, listed_at, allowance, unused_here;
    WeirWcsphClock clock;
    uint32_t unused[20];
    WeirWcsphClock clocks[3];
    uint32_t unused_too[18];
    WeirWcsphMaxima maxima[3];
    uint32_t bad_particles, bad_step, bad_slot; // bad_step UINT32_MAX: none
    uint32_t drained, lost, unused_at_last[3];
} WeirWcsphControl;
static_assert(offsetof(WeirWcsphControl, clocks) == 256 && offsetof(WeirWcsphControl, maxima) == 640 &&
                  sizeof(WeirWcsphControl) == 1056,
              "the layout of the shaders' struct");

static_assert(sizeof(WeirSolid) == 176 && sizeof(WeirSolidState) == 144, "strides of the shaders' arrays");
static_assert(sizeof(WeirEmitter) == 64 && sizeof(WeirDrain) == 32, "strides of the shaders' arrays");
// What a uniform buffer may hold everywhere.
static_assert(WEIR_MAX_EMITTERS * sizeof(WeirEmitter) <= 65536 &&
                  (WEIR_MAX_DRAINS + WEIR_MAX_DRAINS / WEIR_DRAIN_GROUP) * sizeof(WeirDrain) <= 65536,
              "WebGPU's limit");
static_assert(sizeof(WeirMotionRow) == 64, "four vectors in the shaders");

// wcsph_neighbors.c
// How neighbours are found, from what else is known of the world and of the device.
void weir_gpu_wcsph_plan(WeirWcsphTraits *traits, const WeirParameters *parameters,
                         const WeirConstants *constants, const WeirGpu *gpu, uint64_t most_list_bytes);
// Of buffer neighbor_list.
WeirBufferSize weir_gpu_wcsph_list_size(const WeirWcsphTraits *traits);
// The constants with the cells of this plan.
WeirConstants weir_gpu_wcsph_cells(const WeirWcsphTraits *traits, const WeirConstants *constants);

// wcsph_passes.c
// By dimension: 2, 3.
const WeirMethodInfo *weir_gpu_wcsph_method(uint32_t dimension);
// Bytes of each buffer.
void weir_gpu_wcsph_sizes(const WeirConstants *constants, const WeirWorld *world,
                          const WeirWcsphTraits *traits, WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL]);
// WGSL constants, and the passes needed, by bit.
uint32_t weir_gpu_wcsph_settings(const WeirParameters *parameters, const WeirConstants *constants,
                                 const WeirWcsphTraits *traits, char settings[WEIR_SETTINGS_LENGTH]);

typedef struct WeirWcsphGpu {
    WeirGpuSolver common;
    WeirWorld world; // without particles
    WeirWcsphTraits traits;
    uint32_t fluid_at_start; // particles
    uint32_t turn;           // 0 to 2: of the next step (pass forces)
    uint32_t counted;        // steps that the device will have taken, if they are certain: it may stop before
    bool indirect;           // the device decides how many workgroups a sort's dispatches have
    bool certain;            // as many as it was asked to
    uint64_t steps_before;   // steps that the device counted in 32 bits before it wrapped around
    bool blown_up;           // a copy said so, and host_solids are those before the bad step
    bool restored;           // then: the last good state is the state
    WeirWcsphControl seen;   // the last copy
    uint32_t (*blocks)[4];   // solid, first id, last id + 1
    float *local_place;      // 4 per solid particle (`struct SolidParticle`), the last one unused
    float *host;             // the arrays of WeirState, one after the other
    uint32_t *host_group;
    WeirSolidState *host_solids;
    struct WeirWcsphProbes *probes; // NULL: none
} WeirWcsphGpu;

// wcsph_world.c: what the world is for the device.
bool weir_gpu_wcsph_copy_world(WeirWcsphGpu *solver, const WeirSolverSetup *setup);
void weir_gpu_wcsph_free_world(WeirWcsphGpu *solver);
// Fills all buffers of solids and emitters, which no new state changes.
void weir_gpu_wcsph_write_world(WeirWcsphGpu *solver);
// Fills those that a new state does. False if memory runs out.
bool weir_gpu_wcsph_write_state(WeirWcsphGpu *solver, const WeirParticles *particles);

// wcsph.c
typedef enum WeirEvaluation {
    WEIR_EVALUATE_NEW, // a state from the host, not sorted yet
    WEIR_EVALUATE_STATE,
    WEIR_EVALUATE_RESTORED // first the working copy before a blow-up becomes the state
} WeirEvaluation;
// Queues walls and forces on a state.
void weir_gpu_wcsph_evaluate(WeirWcsphGpu *solver, WGPUCommandEncoder encoder, WeirEvaluation how);

// wcsph_read.c
enum { WEIR_WCSPH_PIECES = 7 };
// Bytes of the pieces of a state's copy.
void weir_gpu_wcsph_piece_sizes(const WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL], uint32_t particle_count,
                                uint64_t piece_sizes[WEIR_WCSPH_PIECES]);
void weir_gpu_wcsph_take_health(WeirGpuSolver *solver, const void *found);
void weir_gpu_wcsph_copy_state(WeirGpuSolver *solver);
WeirStatus weir_gpu_wcsph_take_state(WeirGpuSolver *solver, void *state);
// Solids and forces on them, as a copy of both buffers has them.
void weir_gpu_wcsph_take_solids(WeirWcsphGpu *solver, const WeirSolidState *solids, const float *sums);
// Of a particle at `place` quanta, m: as many numbers as dimensions.
void weir_gpu_wcsph_position(const WeirConstants *constants, const int32_t *place, float *position);
// Step and time of a state.
void weir_gpu_wcsph_take_moment(const WeirWcsphGpu *solver, const WeirWcsphControl *control,
                                WeirState *state);
void weir_gpu_wcsph_copy_sums(WeirGpuSolver *solver);
WeirStatus weir_gpu_wcsph_take_sums(WeirGpuSolver *solver, void *sums);

// wcsph_probe.c: what the probes look at.
bool weir_gpu_wcsph_copy_probes(WeirWcsphGpu *solver, const WeirSolverSetup *setup);
void weir_gpu_wcsph_free_probes(WeirWcsphGpu *solver);
// Bytes of their buffers.
void weir_gpu_wcsph_probe_sizes(const WeirWcsphTraits *traits, WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL]);
// False if memory runs out.
bool weir_gpu_wcsph_make_gather_copy(WeirWcsphGpu *solver);
// After a change of the parameters.
void weir_gpu_wcsph_write_looks(WeirWcsphGpu *solver);
void weir_gpu_wcsph_copy_gathered(WeirGpuSolver *solver);
WeirStatus weir_gpu_wcsph_take_gathered(WeirGpuSolver *solver, void *gathered);
