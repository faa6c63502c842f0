// Weir: a real-time smoothed particle hydrodynamics (SPH) fluid engine.
//
//   WeirScene *scene = weir_scene_create();                    // defaults, or load a scene file value by value
//   weir_scene_set_numbers(scene, "fluid[0].box.min", (double[]){-1, -1}, 2);
//   WeirSim *sim = weir_sim_create(scene, NULL);               // NULL: all cores of the CPU
//   weir_sim_step(sim, 100);
//   weir_sim_read(sim, WEIR_FIELD_POSITION, positions, 2 * count);
//
// Rules that hold everywhere:
// - Units are metres, kilograms, seconds; y points up. Arrays of particles are ordered by particle id.
// - Nothing here exits or aborts the program. A call that can fail returns a WeirStatus, and the object keeps
//   a message that names the field, the value and the allowed range.
// - There is no global state: any number of scenes and simulations live side by side. One object must not be
//   used by two threads at the same time.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define WEIR_VERSION "0.1.0"

// What a call has to say. Everything but WEIR_OK and WEIR_PENDING comes with a message.
typedef enum WeirStatus {
    WEIR_OK = 0,
    WEIR_PENDING = 1,        // not finished yet: call again later (GPU work in a browser never blocks)
    WEIR_ERROR_INPUT = 2,    // a value, key or state is not acceptable; nothing was changed
    WEIR_ERROR_MEMORY = 3,   // host or device memory ran out
    WEIR_ERROR_DEVICE = 4,   // no device, device lost, or a shader or pass failed
    WEIR_ERROR_UNSTABLE = 5, // NaN or blow-up; the message names the step and a time step that holds
    WEIR_ERROR_LOST = 6,     // a particle left the domain: a fault of the engine, never of the input
} WeirStatus;

// ---------------------------------------------------------------------------------------------------------
// Parameters. One list, src/core/params.inl, makes the struct below, the WGSL struct, the checks, the command
// line's --set, the page's panel and docs/parameters.md.

typedef enum WeirParameterKind {
    WEIR_PARAMETER_NUMBER, // one float
    WEIR_PARAMETER_VECTOR, // x, y, z (z is 0 in 2D)
    WEIR_PARAMETER_CHOICE, // one of some names, stored as their index
} WeirParameterKind;

// What the list knows about one parameter. All strings are static.
typedef struct WeirParameterInfo {
    const char *name;    // the same in C, WGSL, JSON, command line and page
    const char *unit;    // SI, "1" for none
    const char *help;    // one sentence
    const char *choices; // WEIR_PARAMETER_CHOICE: the names, separated by '|'; NULL otherwise
    WeirParameterKind kind;
    double default_value[3]; // one number, three for a vector, the index for a choice
    double minimum, maximum; // allowed range, ends included; both 0 for a choice
    const char *method;      // the only method that reads it; "" if every one does
    bool live; // true: may change while a simulation runs; false: takes effect at the next reset
} WeirParameterInfo;

// Number of parameters in the list.
uint32_t weir_parameter_count(void);
// Describes parameter `index`; NULL if index >= weir_parameter_count().
const WeirParameterInfo *weir_parameter_info(uint32_t index);

// ---------------------------------------------------------------------------------------------------------
// Scenes: what the fluid is, where it starts and what holds it. The same values as in scenes/*.json
// (docs/scene.schema.json), set by path: "title", "parameters.gas_constant", "domain.min", "fluid[0].box.max".

typedef struct WeirScene WeirScene;

// A scene with every parameter at its default, an empty domain from (-1,-1) to (1,1) and no fluid.
// Returns NULL only if memory runs out.
WeirScene *weir_scene_create(void);
WeirScene *weir_scene_copy(const WeirScene *scene);
void weir_scene_destroy(WeirScene *scene); // NULL is allowed

// Set one value by path. WEIR_ERROR_INPUT if the path is unknown, the type is wrong or the value is out of
// range; the scene is unchanged then and weir_scene_error() says why. Array items are made in order:
// "fluid[0]" first, then "fluid[1]". Method, then dimension, come before everything that has vectors. Lists of
// points, triangles and table rows are set one by one ("walls[0].polygon[3]") or all at once as one flat list.
WeirStatus weir_scene_set_number(WeirScene *scene, const char *path, double value);
WeirStatus weir_scene_set_numbers(WeirScene *scene, const char *path, const double *values, size_t count);
WeirStatus weir_scene_set_string(WeirScene *scene, const char *path, const char *value);
WeirStatus weir_scene_set_boolean(WeirScene *scene, const char *path, bool value);
// For loaders: reports a value at `path` whose type no scene key has (`type_name`, for example "null",
// "an object"). Gives the right message for known and unknown paths; always WEIR_ERROR_INPUT.
WeirStatus weir_scene_refuse(WeirScene *scene, const char *path, const char *type_name);
// For command lines: `text` is parsed as the type that the parameter `name` has: "2000", "0,-9.81", "grid".
WeirStatus weir_scene_set_parameter_text(WeirScene *scene, const char *name, const char *text);

// The same by calls. Vectors are x, y, z; z is ignored in 2D. Both add one piece of fluid.
WeirStatus weir_scene_set_domain(WeirScene *scene, const double min[3], const double max[3]);
WeirStatus weir_scene_add_box(WeirScene *scene, const double min[3], const double max[3],
                              const double velocity[3]);
WeirStatus weir_scene_add_ball(WeirScene *scene, const double center[3], double radius,
                               const double velocity[3]);

// Current value of a parameter; a vector gives 3 numbers, a choice its index. `values` holds 3.
WeirStatus weir_scene_get_parameter(const WeirScene *scene, const char *name, double values[3]);
const char *weir_scene_title(const WeirScene *scene);  // "" if none was set
const char *weir_scene_method(const WeirScene *scene); // "mueller" or "wcsph"
uint32_t weir_scene_dimension(const WeirScene *scene); // 2 or 3
void weir_scene_domain(const WeirScene *scene, double min[3], double max[3]);

// Checks the scene as a whole: some fluid, inside the domain, pieces that do not overlap, a particle count that
// fits. weir_sim_create() calls it too.
WeirStatus weir_scene_check(WeirScene *scene);
// Message of the last call that failed; "" if none did.
const char *weir_scene_error(const WeirScene *scene);
// Advice of the last weir_scene_check() that is no error, such as a time step above the stable one; "" if none.
const char *weir_scene_warning(const WeirScene *scene);
// Number of particles that the scene makes; 0 if it is not valid.
uint32_t weir_scene_particle_count(WeirScene *scene);
// Estimate of the largest stable time step in seconds for the scene's parameters (docs/method.md).
double weir_scene_stable_time_step(const WeirScene *scene);

// ---------------------------------------------------------------------------------------------------------
// Simulations

typedef struct WeirSim WeirSim;
typedef struct WeirBackend WeirBackend; // where the passes run; see weir_cpu_backend() and weir/weir_gpu.h

typedef struct WeirSimOptions {
    const WeirBackend *backend; // NULL: the CPU
    uint32_t threads;           // CPU only; 0: one per core. The result has the same bits for any number
    uint32_t max_steps;         // most steps that one weir_sim_advance() takes; 0: 64
    double max_lag;             // wall seconds that the accumulator may hold at most; 0: 0.1
} WeirSimOptions;

// The C solver on the CPU, always available.
const WeirBackend *weir_cpu_backend(void);

// Makes a simulation from a copy of the scene. `options` NULL: all defaults. Returns NULL only if memory runs
// out; any other trouble is in weir_sim_status() and weir_sim_error() of the object returned.
WeirSim *weir_sim_create(const WeirScene *scene, const WeirSimOptions *options);
void weir_sim_destroy(WeirSim *sim); // NULL is allowed

// WEIR_OK while it can go on, else the error that stopped it.
WeirStatus weir_sim_status(const WeirSim *sim);
const char *weir_sim_error(const WeirSim *sim);       // message of the last call that failed; "" if none
const char *weir_sim_warning(const WeirSim *sim);     // advice, "" if none
const char *weir_sim_backend(const WeirSim *sim);     // "cpu" or "gpu"
const char *weir_sim_device(const WeirSim *sim);      // "CPU, 2 threads, AVX2" or the adapter's name
uint32_t weir_sim_threads(const WeirSim *sim);        // 0 on the GPU
uint32_t weir_sim_particle_count(const WeirSim *sim); // of all: fluid, empty slots, walls, bodies
uint32_t weir_sim_fluid_slots(const WeirSim *sim);    // ids below are fluid or empty slots
uint32_t weir_sim_dimension(const WeirSim *sim);      // 2 or 3
uint64_t weir_sim_step_count(const WeirSim *sim);     // steps since the last reset
double weir_sim_time(const WeirSim *sim);             // simulated seconds since the last reset
const WeirScene *weir_sim_scene(const WeirSim *sim);  // as it runs now, changed parameters included

// Takes `steps` time steps. On the GPU they are queued; weir_sim_poll() learns of faults.
WeirStatus weir_sim_step(WeirSim *sim, uint32_t steps);
// Takes the steps due after `wall_seconds` more of wall time: fixed-step accumulator, so the speed depends on
// no display. Time that would need more than max_steps, or is older than max_lag, is dropped, never owed.
// *steps_taken (may be NULL) gets the number of steps; on the GPU they are queued, so weir_sim_step_count() may
// follow later.
WeirStatus weir_sim_advance(WeirSim *sim, double wall_seconds, uint32_t *steps_taken);
void weir_sim_set_max_steps(WeirSim *sim, uint32_t max_steps); // see WeirSimOptions; 0: 64
// Lets asynchronous work go on and checks for NaN, blow-up, lost particles and device faults. Never blocks. In a browser a
// simulation on the GPU compiles its shaders first: until then this says WEIR_PENDING, as do all calls that would step,
// change or read it, and these do nothing.
WeirStatus weir_sim_poll(WeirSim *sim);
// Steps until the simulated time is `time` seconds: exactly with adaptive steps, whose last one is shortened; to
// the nearest step with fixed ones. Natively it returns when that is done; in a browser it queues a batch and
// returns WEIR_PENDING until the time is reached.
WeirStatus weir_sim_run_until(WeirSim *sim, double time);
// The same, but at most `steps` steps: how a run is cut into calls changes no step of it. It is over when
// weir_sim_run_until() would do nothing; weir_sim_wait() comes before the next call.
WeirStatus weir_sim_step_until(WeirSim *sim, uint32_t steps, double time);
// Waits until all queued steps are done. In a browser, where nothing may block, returns WEIR_PENDING instead.
WeirStatus weir_sim_wait(WeirSim *sim);
// Back to the scene's start.
WeirStatus weir_sim_reset(WeirSim *sim);
// Changes a parameter of the running simulation; same checks and messages as weir_scene_set_*. Parameters that
// are not live are refused: change the scene and make a new simulation. It holds from the next step on; in a browser, where
// one that needs other shaders compiles them beside all else, from the first step after weir_sim_poll() found them ready.
WeirStatus weir_sim_set_parameter(WeirSim *sim, const char *name, const double *values, size_t count);
// True while a change waits for its shaders: steps go on as before it, and what else is set (the tool) waits too.
bool weir_sim_is_changing(const WeirSim *sim);
// Replaces positions and velocities (dimension * particle_count floats each: x0, y0, x1, y1, ...). Those of walls
// and bodies are not read: they stay where the scene starts them.
WeirStatus weir_sim_set_state(WeirSim *sim, const float *positions, const float *velocities);

// A tool that acts on the fluid within `radius` of `position` (metres): push away, pull in, or stir, which
// drags the fluid along with the tool's own `velocity` (m/s).
typedef enum WeirToolKind { WEIR_TOOL_NONE, WEIR_TOOL_PUSH, WEIR_TOOL_PULL, WEIR_TOOL_STIR } WeirToolKind;
typedef struct WeirTool {
    WeirToolKind kind;
    float position[3];
    float velocity[3];
    float radius;   // m
    float strength; // m/s^2 at the centre for push and pull; 1/s, rate of approach to the velocity, for stir
} WeirTool;
WeirStatus weir_sim_set_tool(WeirSim *sim, const WeirTool *tool); // NULL: none

// Particle data, ordered by id. Density and pressure belong to the positions that are read with them.
typedef enum WeirField {
    WEIR_FIELD_POSITION,     // x, y (and z in 3D) per particle, m
    WEIR_FIELD_VELOCITY,     // m/s
    WEIR_FIELD_ACCELERATION, // m/s^2, without the tool's share
    WEIR_FIELD_DENSITY,      // one per particle, kg/m^3
    WEIR_FIELD_PRESSURE,     // one per particle, Pa
    WEIR_FIELD_GROUP, // one per particle: 0 fluid, -1 an empty slot, k + 1 wall or body k (walls first)
} WeirField;
// Floats per particle of a field in `dimension` 2 or 3: the dimension for a vector, else 1.
uint32_t weir_field_components(WeirField field, uint32_t dimension);
// Copies a field of the current state; `capacity` is the number of floats that `values` holds, at least
// particle_count * components. Natively it waits for the device; in a browser it returns WEIR_PENDING until the
// copy that it started has arrived (then the values are those of the step at which it was started).
WeirStatus weir_sim_read(WeirSim *sim, WeirField field, float *values, size_t capacity);

// Positions and velocities of one moment: what weir_sim_read() of both gives natively, from one copy in a browser too.
// `capacity`: of each.
WeirStatus weir_sim_read_motion(WeirSim *sim, float *positions, float *velocities, size_t capacity);

// What a simulation knows of itself while it runs, without reading the particles. `mueller` knows step and time
// only; the rest is NaN or 0.
typedef struct WeirClock {
    uint64_t step;
    double time;        // s
    double time_step;   // s, of the next step
    double sound_speed; // m/s
    double max_speed;   // m/s, of the fluid
    double mach_number; // max_speed / sound_speed; above 0.1 the fluid is no longer nearly incompressible
    double max_density_error; // largest |rho / rho0 - 1|
    uint32_t fluid_particles, drained_particles, lost_particles;
} WeirClock;
WeirClock weir_sim_clock(const WeirSim *sim);

// Everything that Weir measures of free fluid: the same formulas for CPU and GPU. Sums are in double precision; without
// flags a GPU makes them in parts of single precision (an error of about 1e-6 of the sum of what they add up), in an order
// that depends on the state alone.
typedef struct WeirDiagnostics {
    uint64_t step;
    double time;
    double density_error_mean; // mean of max(rho - rho0, 0) / rho0: compression
    double density_error_max;  // largest of the same
    double kinetic_energy;     // J per metre of depth in 2D
    double potential_energy;   // J, zero at the domain's lowest point along gravity
    double momentum[3];        // kg m/s
    double max_speed;          // m/s
    double mean_neighbors;     // other particles inside the support radius; negative if not asked for
    uint32_t lost_particles;   // outside the domain or not finite
    uint64_t state_hash; // of positions and velocities by id; equal bits, equal hash; 0 if not asked for
} WeirDiagnostics;
// What costs more, by bit. On a GPU both need a copy of all particles, which is summed in double; without them the device sums in
// float, good to 2e-6 of a sum's terms, and that costs little.
typedef enum WeirDiagnose {
    WEIR_DIAGNOSE_NEIGHBORS = 1, // mean_neighbors: a neighbour search on the host
    WEIR_DIAGNOSE_HASH = 2,      // state_hash
} WeirDiagnose;
// `flags` of WeirDiagnose, or 0. WEIR_PENDING as weir_sim_read().
WeirStatus weir_sim_diagnose(WeirSim *sim, uint32_t flags, WeirDiagnostics *diagnostics);

// Neighbours from a sample of the fluid: cheap where weir_sim_diagnose() would be slow.
typedef struct WeirNeighborCount {
    uint32_t particles; // sampled
    double neighbors;   // other particles inside the support radius, mean
    double
        candidates; // other particles in the cells that a search through the grid visits, mean; NaN: not known
} WeirNeighborCount;
// Samples at most `particles` fluid particles (0: 1024). WEIR_PENDING as weir_sim_read().
WeirStatus weir_sim_count_neighbors(WeirSim *sim, uint32_t particles, WeirNeighborCount *found);
// Bytes of device memory that the particles, their order and the grid take; 0 on the CPU, where they are the process's.
uint64_t weir_sim_device_memory(const WeirSim *sim);

// Milliseconds per pass of the last measured step; `name` is the pass's name in C, WGSL and here.
typedef struct WeirPassTime {
    const char *name;
    double milliseconds;
} WeirPassTime;
// Returns the number of passes and fills at most `capacity`; 0 where the device gives no times.
uint32_t weir_sim_pass_times(const WeirSim *sim, WeirPassTime *times, uint32_t capacity);
// Milliseconds that the device takes for a step, averaged over batches of steps lately (on the CPU: the last step); 0 where
// that is not known. A step that is measured pass by pass takes longer.
double weir_sim_step_time(const WeirSim *sim);

#ifdef __cplusplus
}
#endif
