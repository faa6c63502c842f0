// Milliseconds per pass: now and then one step runs with a compute pass of its own, and a pair of timestamps,
// for each pass. The steps of the same submit after it share another pair: browsers round timestamps to 0.1 ms.
#pragma once

#include "gpu/passes.h"

typedef struct WeirProfile WeirProfile;

// NULL where the device gives no timestamps or memory runs out: all calls then do nothing. `report`: NULL for none.
WeirProfile *weir_profile_create(WeirGpu *gpu, WeirReport *report);
void weir_profile_destroy(WeirProfile *profile);
// True if a step may be measured: none is under way.
bool weir_profile_ready(const WeirProfile *profile);
// Starts to measure a step; each pass is then recorded between begin and end. `pass` is a static text.
void weir_profile_start(WeirProfile *profile);
WGPUComputePassEncoder weir_profile_begin_pass(WeirProfile *profile, const char *pass,
                                               WGPUCommandEncoder encoder);
void weir_profile_end_pass(WeirProfile *profile, WGPUComputePassEncoder encoder);
// A compute pass for `steps` more steps, which the caller ends.
WGPUComputePassEncoder weir_profile_begin_batch(WeirProfile *profile, uint32_t steps,
                                                WGPUCommandEncoder encoder);
// In place of passes and batch, one span over several passes, as one step: what the first of them is given, and the last.
WGPUPassTimestampWrites weir_profile_span_begin(WeirProfile *profile);
WGPUPassTimestampWrites weir_profile_span_end(const WeirProfile *profile);
// Ends the measurement: before and after its commands are submitted.
void weir_profile_resolve(WeirProfile *profile, WGPUCommandEncoder encoder);
void weir_profile_submitted(WeirProfile *profile);
// Takes times that have arrived.
void weir_profile_poll(WeirProfile *profile);
// Milliseconds per step: of the batches measured lately, or else of the step measured last, all passes; 0 if none is known.
double weir_profile_step(const WeirProfile *profile);
uint32_t weir_profile_times(const WeirProfile *profile, WeirPassTime *times, uint32_t capacity);
