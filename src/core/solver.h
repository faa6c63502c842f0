// What a solver is: the contract between a simulation (sim.c) and the code that steps it, on CPU or GPU.
//
// A solver owns the particles. Each function below may be called only when the previous ones
// returned; none may block when it runs in a browser. The CPU solver is the reference: a GPU solver
// must follow it pass by pass.
#pragma once

#include "core/parameters.h"

typedef struct WeirSolver WeirSolver;

// Particle data on the host, ordered by id; owned by the solver, valid until its next call.
typedef struct WeirState {
    uint32_t count;
    uint64_t step;             // steps taken when the copy was made
    const float *position;     // x, y per particle, m
    const float *velocity;     // x, y per particle, m/s
    const float *acceleration; // x, y per particle, m/s^2, at these positions
    const float *density;      // kg/m^3, at these positions
    const float *pressure;     // Pa, at these positions
} WeirState;

// What the integrate pass found since the last reset.
typedef struct WeirHealth {
    uint32_t bad_particles;  // faster than constants.speed_limit or not finite, counted over all steps
    uint64_t first_bad_step; // 1-based step that found the first of them; valid if bad_particles > 0
} WeirHealth;

typedef struct WeirSolverInterface {
    void (*destroy)(WeirSolver *solver);
    // New parameters or constants (same particle count); they hold from the next step on.
    WeirStatus (*configure)(WeirSolver *solver, const WeirParameters *parameters,
                            const WeirConstants *constants);
    // Replaces positions and velocities (ordered by id) and resets step count and health.
    WeirStatus (*set_state)(WeirSolver *solver, const float *position, const float *velocity);
    WeirStatus (*step)(WeirSolver *solver, uint32_t steps);
    // Lets callbacks run, gives what is known of the particles' health, and the error that stopped
    // the device.
    WeirStatus (*poll)(WeirSolver *solver, WeirHealth *health);
    // Finishes all queued work; WEIR_PENDING where it may not block.
    WeirStatus (*wait)(WeirSolver *solver);
    // Evaluates density, pressure and acceleration of the current state and copies all to the host.
    // WEIR_PENDING while the copy is under way.
    WeirStatus (*read)(WeirSolver *solver, WeirState *state);
    uint32_t (*pass_times)(const WeirSolver *solver, WeirPassTime *times, uint32_t capacity);
} WeirSolverInterface;

// First member of every solver.
struct WeirSolver {
    const WeirSolverInterface *interface;
    char device[128];    // for people: what it runs on
    uint32_t threads;    // 0 on the GPU
    WeirMessage message; // of the last call that failed
};

typedef struct WeirSolverSetup {
    WeirParameters parameters;
    WeirConstants constants;
    const float *position; // particle_count * 2, copied
    const float *velocity;
    uint32_t threads; // as in WeirSimOptions
} WeirSolverSetup;

struct WeirBackend {
    const char *name; // "cpu", "gpu"
    // On failure returns NULL with *status and message set. `backend` may be the first member of
    // something larger.
    WeirSolver *(*create_solver)(const WeirBackend *backend, const WeirSolverSetup *setup, WeirStatus *status,
                                 WeirMessage *message);
};
