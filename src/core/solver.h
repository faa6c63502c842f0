// What a solver is: the contract between a simulation (sim.c) and the code that steps it, on CPU or GPU.
//
// A solver owns the particles. Each function below may be called only when the previous ones
// returned; none may block when it runs in a browser. The CPU solver is the reference: a GPU solver
// must follow it pass by pass.
#pragma once

#include "core/world.h"

typedef struct WeirSolver WeirSolver;

// Particle data on the host, ordered by id; owned by the solver, valid until its next call.
typedef struct WeirState {
    uint32_t count;
    uint32_t dimension;           // 2 or 3: components of the vectors below
    uint64_t step;                // steps taken when the copy was made
    const float *position;        // m
    const float *velocity;        // m/s
    const float *acceleration;    // m/s^2, at these positions
    const float *density;         // kg/m^3, at these positions
    const float *pressure;        // Pa, at these positions; of solid particles extrapolated from the fluid
    const uint32_t *group;        // WEIR_GROUP_...; NULL: all fluid
    const WeirSolidState *solids; // NULL: none
    double time;                  // s since set_state(); negative: steps of one length (mueller)
} WeirState;

// Sums over free fluid, of which its diagnostics follow (diagnostics.h).
typedef struct WeirDiagnosticSums {
    uint64_t step; // as WeirState's
    double time;
    uint64_t particles, lost;
    double place[3]; // m, from the domain's lowest corner along gravity
    double velocity[3], speed2;
    double density_error; // max(rho / rho0 - 1, 0)
    double speed2_max, density_error_max;
} WeirDiagnosticSums;

// What a scene's probes look at (probe.h), and nothing else.
typedef struct WeirGathered {
    // Fluid near the points and lines that they look at; without acceleration and group. Solids if a probe measures a force.
    WeirState state;
    // Per probe. Of a front: the largest dot product of a particle's place with its direction, -INFINITY without fluid; of a
    // mass: how many particles of fluid are inside.
    const double *found;
} WeirGathered;

// What the solver found since set_state().
typedef struct WeirHealth {
    uint32_t bad_particles;  // faster than constants.speed_limit or not finite, counted over all steps
    uint64_t first_bad_step; // 1-based step that found the first of them; valid if bad_particles > 0
    uint32_t first_bad_id;   // wcsph: of one of that step's (CPU: the lowest id; GPU: the first by cells)
    float first_bad_position[3];
    // wcsph only (has_clock), as of the last step known:
    bool has_clock;
    uint64_t steps;
    double time;
    float time_step;         // s, of the next step
    float max_speed;         // m/s, of the fluid
    float max_density_error; // largest |rho / rho0 - 1| of the fluid, less the background's share
    uint32_t fluid_particles;
    uint32_t drained_particles, lost_particles; // since set_state(): by drains; through the domain's sides
} WeirHealth;

typedef struct WeirSolverInterface {
    void (*destroy)(WeirSolver *solver);
    // New parameters or constants (same particle count); they hold from the next step on.
    WeirStatus (*configure)(WeirSolver *solver, const WeirParameters *parameters,
                            const WeirConstants *constants);
    // Replaces the particles (same count, same solids) and resets step count, clock and health.
    WeirStatus (*set_state)(WeirSolver *solver, const WeirParticles *particles);
    // Takes `steps` steps. wcsph: the step that would pass the time `until` (s since set_state(); INFINITY: none)
    // is shortened to end there, and the remaining ones do nothing and do not count.
    WeirStatus (*step)(WeirSolver *solver, uint32_t steps, double until);
    // Lets callbacks run, gives what is known of the particles' health, and the error that stopped
    // the device.
    WeirStatus (*poll)(WeirSolver *solver, WeirHealth *health);
    // Finishes all queued work; WEIR_PENDING where it may not block.
    WeirStatus (*wait)(WeirSolver *solver);
    // Evaluates density, pressure and acceleration of the current state and copies all to the host.
    // WEIR_PENDING while the copy is under way. wcsph, after a blow-up: the last good state, on the CPU at most 64 steps
    // old, on the GPU that of the middle of the bad step.
    WeirStatus (*read)(WeirSolver *solver, WeirState *state);
    // The same without evaluating: position, velocity, group and time alone. WEIR_ERROR_UNSTABLE after a blow-up: only read()
    // tells. NULL where it would be no faster.
    WeirStatus (*read_motion)(WeirSolver *solver, WeirState *state);
    // The sums of weir_sum_fluid() without copying the particles or evaluating forces; to single precision. WEIR_PENDING while
    // they are under way; WEIR_ERROR_UNSTABLE and NULL as above.
    WeirStatus (*diagnose)(WeirSolver *solver, WeirDiagnosticSums *sums);
    // For the probes of the solver's setup, without copying the rest, and with forces evaluated only if one measures them.
    // WEIR_PENDING and WEIR_ERROR_UNSTABLE as above, the latter also where more fluid is gathered than ever should be. NULL
    // where read() is as fast.
    WeirStatus (*gather)(WeirSolver *solver, WeirGathered *gathered);
    uint32_t (*pass_times)(const WeirSolver *solver, WeirPassTime *times, uint32_t capacity);
    // Milliseconds per step; 0: not known. NULL: those of all passes.
    double (*step_time)(const WeirSolver *solver);
} WeirSolverInterface;

// First member of every solver.
struct WeirSolver {
    const WeirSolverInterface *interface;
    char device[128];    // for people: what it runs on
    uint32_t threads;    // 0 on the GPU
    uint64_t memory;     // bytes of the device's buffers; 0 on the CPU
    bool changing;       // configure() waits for shaders, in a browser; steps go on as before until it holds
    WeirMessage message; // of the last call that failed
};

typedef enum WeirMethod { WEIR_METHOD_MUELLER, WEIR_METHOD_WCSPH } WeirMethod;

typedef struct WeirSolverSetup {
    WeirMethod method;
    WeirParameters parameters;
    WeirConstants constants;
    const WeirWorld *world;              // copied
    uint32_t threads;                    // as in WeirSimOptions
    const struct WeirProbePiece *probes; // for gather(); copied
    uint32_t probe_count;
} WeirSolverSetup;

struct WeirBackend {
    const char *name; // "cpu", "gpu"
    // On failure returns NULL with *status and message set. `backend` may be the first member of
    // something larger.
    WeirSolver *(*create_solver)(const WeirBackend *backend, const WeirSolverSetup *setup, WeirStatus *status,
                                 WeirMessage *message);
};
