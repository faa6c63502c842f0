// The method `mueller` on the GPU.
#pragma once

#include "gpu/passes.h"
#include "gpu/profile.h"
#include "gpu/readback.h"

typedef struct WeirMueller {
    WeirSolver base;
    WeirGpu *gpu;
    WeirParameters parameters;
    WeirConstants constants;
    WeirBuffers buffers;
    WeirPasses passes;
    WeirProfile *profile; // NULL: no timestamps
    WeirReport *report;   // faults of what was made for this solver

    uint64_t steps;       // queued since the last set_state()
    uint32_t device_step; // what health.step will hold once the queue is done
    uint64_t work;        // submits that changed the state, counted
    uint64_t state_work;  // `work` when the state was last replaced

    WeirReadback *health_copy;
    uint64_t health_work, health_known_work; // `work` of the copy under way, and of the one that came last
    WeirHealth health;

    WeirReadback *state_copy;
    uint64_t state_copy_step; // steps taken when it was queued
    bool state_copy_stale;    // the state was replaced since
    float *host;              // the arrays of WeirState, one after the other
} WeirMueller;

// mueller_read.c: what travels from the device to the host.
WeirStatus weir_mueller_read(WeirSolver *solver, WeirState *state);
// Starts or takes a copy of the health; never blocks.
void weir_mueller_poll_health(WeirMueller *solver);
// WEIR_OK, or the first error of device or solver, with its message.
WeirStatus weir_mueller_check(WeirMueller *solver);
// Commands to record; `label` is a static text.
WGPUCommandEncoder weir_mueller_commands(WeirMueller *solver, const char *label);
// Queues count to forces on the current state, which then is in the sorted order, as flow is.
void weir_mueller_evaluate(WeirMueller *solver, WGPUCommandEncoder encoder);
// Bytes of the copy that weir_mueller_read() makes, per particle: position, flow, acceleration, id.
enum { WEIR_STATE_COPY_BYTES = 8 + 16 + 8 + 4 };
// Floats of the host's arrays per particle: position, velocity, acceleration, density, pressure.
enum { WEIR_HOST_FLOATS = 2 + 2 + 2 + 1 + 1 };
