#include "gpu/profile.h"
#include "gpu/platform.h"
#include "gpu/readback.h"

#include <stdlib.h>

// Pairs of the passes, and one of the batch after them.
enum { QUERIES = 2 * (WEIR_MAX_PASSES + 1), RESOLVE_SIZE = 8 * QUERIES };
static const double newest_share = 0.25; // of the mean over batches

struct WeirProfile {
    WeirGpu *gpu;
    WGPUQuerySet queries;
    WGPUBuffer resolved;
    WeirReadback *readback;
    const char *passes[WEIR_MAX_PASSES]; // names, of the step under way, in order
    uint32_t count, batch_steps;         // batch_steps 0: no batch
    double nanoseconds;                  // per tick
    double batch_step;                   // ms of a step, averaged; 0: not known
    WeirPassTime times[WEIR_MAX_PASSES];
    uint32_t time_count;
};

WeirProfile *weir_profile_create(WeirGpu *gpu, WeirReport *report)
{
    WeirProfile *profile = gpu->timestamps ? calloc(1, sizeof *profile) : NULL;
    if (!profile) return NULL;
    profile->gpu = gpu;
    if (report) weir_report_begin(report);
    profile->queries =
        wgpuDeviceCreateQuerySet(gpu->device, &(WGPUQuerySetDescriptor){.label = weir_gpu_text("profile"),
                                                                        .type = WGPUQueryType_Timestamp,
                                                                        .count = QUERIES});
    profile->resolved = weir_gpu_create_buffer(
        gpu, "profile", WGPUBufferUsage_QueryResolve | WGPUBufferUsage_CopySrc, RESOLVE_SIZE);
    profile->readback = weir_readback_create(gpu, "profile readback", 1, &(uint64_t){RESOLVE_SIZE});
    if (report) weir_report_end(report, "profile");
    profile->nanoseconds = weir_platform_timestamp_period(gpu);
    if (profile->readback) return profile;
    weir_profile_destroy(profile);
    return NULL;
}

void weir_profile_destroy(WeirProfile *profile)
{
    if (!profile) return;
    weir_readback_destroy(profile->readback);
    weir_gpu_destroy_buffer(profile->gpu, profile->resolved, RESOLVE_SIZE);
    if (profile->queries) wgpuQuerySetRelease(profile->queries);
    free(profile);
}

bool weir_profile_ready(const WeirProfile *profile)
{
    return profile && weir_readback_state(profile->readback) == WEIR_READBACK_IDLE;
}

void weir_profile_start(WeirProfile *profile)
{
    profile->count = profile->batch_steps = 0;
}

static WGPUComputePassEncoder begin_timed(const WeirProfile *profile, uint32_t pair, const char *label,
                                          WGPUCommandEncoder encoder)
{
    WGPUPassTimestampWrites writes = {.querySet = profile->queries,
                                      .beginningOfPassWriteIndex = 2 * pair,
                                      .endOfPassWriteIndex = 2 * pair + 1};
    WGPUComputePassDescriptor descriptor = {.label = weir_gpu_text(label), .timestampWrites = &writes};
    return wgpuCommandEncoderBeginComputePass(encoder, &descriptor);
}

WGPUComputePassEncoder weir_profile_begin_pass(WeirProfile *profile, const char *pass,
                                               WGPUCommandEncoder encoder)
{
    uint32_t n = profile->count++;
    profile->passes[n] = pass;
    return begin_timed(profile, n, pass, encoder);
}

void weir_profile_end_pass(WeirProfile *profile, WGPUComputePassEncoder encoder)
{
    (void)profile;
    wgpuComputePassEncoderEnd(encoder);
    wgpuComputePassEncoderRelease(encoder);
}

WGPUComputePassEncoder weir_profile_begin_batch(WeirProfile *profile, uint32_t steps,
                                                WGPUCommandEncoder encoder)
{
    profile->batch_steps = steps;
    return begin_timed(profile, profile->count, "steps", encoder);
}

WGPUPassTimestampWrites weir_profile_span_begin(WeirProfile *profile)
{
    profile->batch_steps = 1;
    return (WGPUPassTimestampWrites){.querySet = profile->queries,
                                     .beginningOfPassWriteIndex = 0,
                                     .endOfPassWriteIndex = WGPU_QUERY_SET_INDEX_UNDEFINED};
}

WGPUPassTimestampWrites weir_profile_span_end(const WeirProfile *profile)
{
    return (WGPUPassTimestampWrites){.querySet = profile->queries,
                                     .beginningOfPassWriteIndex = WGPU_QUERY_SET_INDEX_UNDEFINED,
                                     .endOfPassWriteIndex = 1};
}

void weir_profile_resolve(WeirProfile *profile, WGPUCommandEncoder encoder)
{
    uint32_t pairs = profile->count + (profile->batch_steps > 0 ? 1 : 0);
    wgpuCommandEncoderResolveQuerySet(encoder, profile->queries, 0, 2 * pairs, profile->resolved, 0);
    weir_readback_copy(profile->readback, encoder, 0, profile->resolved, 0);
}

void weir_profile_submitted(WeirProfile *profile)
{
    weir_readback_start(profile->readback);
}

static double milliseconds(const WeirProfile *profile, const uint64_t ticks[2])
{
    return ticks[1] > ticks[0] ? (double)(ticks[1] - ticks[0]) * profile->nanoseconds * 1e-6 : 0.0;
}

static void take_batch(WeirProfile *profile, const uint64_t ticks[2])
{
    double step = milliseconds(profile, ticks) / profile->batch_steps;
    if (profile->batch_step > 0.0) step = profile->batch_step + newest_share * (step - profile->batch_step);
    profile->batch_step = step;
}

void weir_profile_poll(WeirProfile *profile)
{
    if (!profile || weir_readback_state(profile->readback) != WEIR_READBACK_READY) return;
    const uint64_t *ticks = weir_readback_data(profile->readback, 0);
    profile->time_count = ticks ? profile->count : 0;
    for (uint32_t n = 0; n < profile->time_count; ++n)
        profile->times[n] = (WeirPassTime){profile->passes[n], milliseconds(profile, ticks + 2 * n)};
    if (ticks && profile->batch_steps > 0) take_batch(profile, ticks + 2 * profile->count);
    weir_readback_finish(profile->readback);
}

double weir_profile_step(const WeirProfile *profile)
{
    if (profile && profile->batch_step > 0.0) return profile->batch_step;
    double total = 0.0;
    for (uint32_t n = 0; profile && n < profile->time_count; ++n) total += profile->times[n].milliseconds;
    return total;
}

uint32_t weir_profile_times(const WeirProfile *profile, WeirPassTime *times, uint32_t capacity)
{
    if (!profile) return 0;
    for (uint32_t n = 0; n < profile->time_count && n < capacity; ++n) times[n] = profile->times[n];
    return profile->time_count;
}
