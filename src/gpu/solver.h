// What the solvers on the GPU have in common: recording steps in batches, queueing them, health and state on their
// way to the host. A method's solver has a WeirGpuSolver as its first member and brings its own passes.
#pragma once

#include "gpu/passes.h"
#include "gpu/profile.h"
#include "gpu/readback.h"

typedef struct WeirGpuSolver WeirGpuSolver;

// Where passes are recorded: into one compute pass, or, if measured, each into one of its own.
typedef struct WeirRecorder {
    WeirGpuSolver *solver;
    WGPUCommandEncoder encoder;
    WGPUComputePassEncoder pass; // NULL: measured
} WeirRecorder;

// Something that follows from the state, on its way to the host.
typedef struct WeirGpuCopy {
    WeirReadback *readback;
    bool stale;                           // the state was replaced since it was queued
    void (*queue)(WeirGpuSolver *solver); // queues commands that fill it, and submits them
    // Turns what came into *found; WEIR_PENDING: another copy is needed.
    WeirStatus (*take)(WeirGpuSolver *solver, void *found);
} WeirGpuCopy;

struct WeirGpuSolver {
    WeirSolver base;
    WeirGpu *gpu;
    WeirParameters parameters;
    WeirConstants constants;
    WeirBuffers buffers;
    WeirPasses passes;
    WeirProfile *profile; // NULL: no timestamps
    WeirReport *report;   // faults of what was made for this solver

    // In a browser its first pipelines come later; until then it does nothing, and says WEIR_PENDING.
    bool starting, running;
    WeirStatus (*start)(WeirGpuSolver *solver); // the state is written: the first commands on it

    // What is to hold while base.changing: those of a change come later too, and all goes on as before until they are there.
    WeirParameters wanted_parameters;
    WeirConstants wanted_constants;
    // WGSL constants of what is wanted, and the passes that it needs, by bit.
    uint32_t (*choose)(const WeirGpuSolver *solver, char settings[WEIR_SETTINGS_LENGTH]);
    void (*take_change)(
        WeirGpuSolver *solver); // it holds now, and is uploaded: what else follows; NULL for nothing

    uint64_t work;       // submits that changed the state, counted
    uint64_t state_work; // `work` when the state was last replaced

    WeirReadback *health_copy;
    uint32_t health_buffer; // what it copies, from the start
    uint64_t health_size;
    uint64_t health_work, health_known_work; // `work` of the copy under way, and of the one that came last
    // Called when a copy arrived that is not older than the state; `found` NULL: the device failed.
    void (*take_health)(WeirGpuSolver *solver, const void *found);
    WeirHealth health;

    bool wants_motion, copied_motion;               // of the state copy: position, velocity and group alone
    WeirGpuCopy state_copy, sums_copy, gather_copy; // of a WeirState, WeirDiagnosticSums, WeirGathered
};

// Makes report, buffers (`sizes` by buffer), passes, profile and the copies' readbacks; that of the state has `pieces` of
// `piece_sizes`. What was made before a failure is freed by weir_gpu_solver_destroy().
WeirStatus weir_gpu_solver_make(WeirGpuSolver *solver, const WeirMethodInfo *method,
                                const WeirBufferSize *sizes, uint32_t scan_blocks, uint32_t pieces,
                                const uint64_t *piece_sizes, WeirMessage *message);
// Frees all but the solver itself.
void weir_gpu_solver_destroy(WeirGpuSolver *solver);
// Begins work on the state that was written, now or when the pipelines are there.
WeirStatus weir_gpu_solver_begin(WeirGpuSolver *solver);
// Does what waited for pipelines that are there now. WEIR_OK: it can work; WEIR_PENDING while it is starting; or the first
// error of device or solver, with its message in base.message.
WeirStatus weir_gpu_solver_ready(WeirGpuSolver *solver);

// The state was replaced: copies under way are not of it.
void weir_gpu_solver_replaced(WeirGpuSolver *solver);

// Commands to record; `label` is a static text.
WGPUCommandEncoder weir_gpu_solver_commands(WeirGpuSolver *solver, const char *label);
WeirRecorder weir_recorder_begin(WeirGpuSolver *solver, WGPUCommandEncoder encoder);
// A recorder of a step that is measured pass by pass.
WeirRecorder weir_recorder_measure(WeirGpuSolver *solver, WGPUCommandEncoder encoder);
// One of `steps` steps that may be `measured` together, after such a step.
WeirRecorder weir_recorder_batch(WeirGpuSolver *solver, WGPUCommandEncoder encoder, uint32_t steps,
                                 bool measured);
void weir_record(const WeirRecorder *recorder, uint32_t pass);
// A pass whose shader is to know whose `turn` it is, 0 to 2: weir_pass_dispatch_turn().
void weir_record_turn(const WeirRecorder *recorder, uint32_t pass, uint32_t turn);
// A pass whose workgroups the device decides, by three numbers in buffer `sizes` from byte `offset` on.
void weir_record_indirect(const WeirRecorder *recorder, uint32_t pass, uint32_t sizes, uint64_t offset);
void weir_recorder_end(const WeirRecorder *recorder);
// Submits steps, which changes the state.
void weir_gpu_solver_submit_steps(WeirGpuSolver *solver, WGPUCommandEncoder encoder, bool measured);

// Steps that one submit may hold: less than 50 ms, after which a watchdog or a browser's frame would suffer. By the
// step measured last; before there is one, by the candidates `pairs` that a step visits, as on an integrated GPU.
uint32_t weir_steps_per_submit(const WeirGpuSolver *solver, double pairs);

// The parts of WeirSolverInterface that are the same for all.
WeirStatus weir_gpu_solver_configure(WeirSolver *solver, const WeirParameters *parameters,
                                     const WeirConstants *constants);
WeirStatus weir_gpu_solver_poll(WeirSolver *solver, WeirHealth *health);
WeirStatus weir_gpu_solver_wait(WeirSolver *solver);
WeirStatus weir_gpu_solver_read(WeirSolver *solver, WeirState *state);
WeirStatus weir_gpu_solver_read_motion(WeirSolver *solver, WeirState *state);
WeirStatus weir_gpu_solver_diagnose(WeirSolver *solver, WeirDiagnosticSums *sums);
WeirStatus weir_gpu_solver_gather(WeirSolver *solver, WeirGathered *gathered);
uint32_t weir_gpu_solver_pass_times(const WeirSolver *solver, WeirPassTime *times, uint32_t capacity);
double weir_gpu_solver_step_time(const WeirSolver *solver);
