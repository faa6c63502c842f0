#include "gpu/profile.h"
#include "gpu/platform.h"
#include "gpu/readback.h"

#include <stdlib.h>

enum { QUERIES = 2 * WEIR_MAX_PASSES, RESOLVE_SIZE = 8 * QUERIES };

struct WeirProfile {
    WeirGpu *gpu;
    WGPUQuerySet queries;
    WGPUBuffer resolved;
    WeirReadback *readback;
    const char *passes[WEIR_MAX_PASSES]; // names, of the step under way, in order
    uint32_t count;
    double nanoseconds; // per tick
    WeirPassTime times[WEIR_MAX_PASSES];
    uint32_t time_count;
};

WeirProfile *weir_profile_create(WeirGpu *gpu, WeirReport *report)
{
    WeirProfile *profile = gpu->timestamps ? calloc(1, sizeof *profile) : NULL;
    if (!profile) return NULL;
    profile->gpu = gpu;
    weir_report_begin(report);
    profile->queries =
        wgpuDeviceCreateQuerySet(gpu->device, &(WGPUQuerySetDescriptor){.label = weir_gpu_text("profile"),
                                                                        .type = WGPUQueryType_Timestamp,
                                                                        .count = QUERIES});
    profile->resolved = weir_gpu_create_buffer(
        gpu, "profile", WGPUBufferUsage_QueryResolve | WGPUBufferUsage_CopySrc, RESOLVE_SIZE);
    profile->readback = weir_readback_create(gpu, "profile readback", 1, &(uint64_t){RESOLVE_SIZE});
    weir_report_end(report, "profile");
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
    profile->count = 0;
}

WGPUComputePassEncoder weir_profile_begin_pass(WeirProfile *profile, const char *pass,
                                               WGPUCommandEncoder encoder)
{
    uint32_t n = profile->count++;
    profile->passes[n] = pass;
    WGPUPassTimestampWrites writes = {
        .querySet = profile->queries, .beginningOfPassWriteIndex = 2 * n, .endOfPassWriteIndex = 2 * n + 1};
    WGPUComputePassDescriptor descriptor = {.label = weir_gpu_text(pass), .timestampWrites = &writes};
    return wgpuCommandEncoderBeginComputePass(encoder, &descriptor);
}

void weir_profile_end_pass(WeirProfile *profile, WGPUComputePassEncoder encoder)
{
    (void)profile;
    wgpuComputePassEncoderEnd(encoder);
    wgpuComputePassEncoderRelease(encoder);
}

void weir_profile_resolve(WeirProfile *profile, WGPUCommandEncoder encoder)
{
    wgpuCommandEncoderResolveQuerySet(encoder, profile->queries, 0, 2 * profile->count, profile->resolved, 0);
    weir_readback_copy(profile->readback, encoder, 0, profile->resolved, 0);
}

void weir_profile_submitted(WeirProfile *profile)
{
    weir_readback_start(profile->readback);
}

void weir_profile_poll(WeirProfile *profile)
{
    if (!profile || weir_readback_state(profile->readback) != WEIR_READBACK_READY) return;
    const uint64_t *ticks = weir_readback_data(profile->readback, 0);
    profile->time_count = ticks ? profile->count : 0;
    for (uint32_t n = 0; n < profile->time_count; ++n) {
        uint64_t begin = ticks[2 * n], end = ticks[2 * n + 1];
        double elapsed = end > begin ? (double)(end - begin) : 0.0;
        profile->times[n] = (WeirPassTime){profile->passes[n], elapsed * profile->nanoseconds * 1e-6};
    }
    weir_readback_finish(profile->readback);
}

double weir_profile_step(const WeirProfile *profile)
{
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
