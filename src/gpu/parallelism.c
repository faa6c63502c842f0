#include "gpu/parallelism.h"
#include "gpu/passes.h"
#include "gpu/platform.h"
#include "gpu/profile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const char weir_wgsl_device_parallelism[];

// H100 and H200: 132 multiprocessors that each add 4 x 32 numbers per cycle and have a sum after 4.
static const uint32_t tuned_parallelism = 65536;
// Where nothing can be measured: about that of a laptop's card.
static const uint32_t usual_parallelism = 16384;
static const uint32_t least_parallelism = 256, most_parallelism = 1u << 22;
static const double saturated = 3.0; // times as long as one workgroup: all that is added waits
enum { FIRST_GROUPS = 8, MOST_JUDGED = 8 };
// Of the chain. Browsers tell times in steps of 0.1 ms.
enum { FINE_TURNS = 1 << 14, COARSE_TURNS = 1 << 17 };

struct WeirParallelism {
    WeirGpu *gpu;
    WGPUBindGroupLayout layout;
    WGPUComputePipeline pipeline;
    WGPUBindGroup bind_group;
    WGPUBuffer chain;
    WeirProfile *profile;
    uint32_t groups;
    uint32_t last, judged; // what so many threads told before, rounded; how often they told something
};

static const float chain_start[4] = {0.5f, 0.999f, 0.0f, 0.0f};

uint32_t weir_parallelism_rounded(double threads)
{
    uint32_t power = least_parallelism;
    while (power < most_parallelism && threads > 2.0 * power) power *= 4;
    return power;
}

double weir_parallelism_ratio(const WeirGpu *gpu)
{
    return (double)gpu->parallelism / tuned_parallelism;
}

void weir_parallelism_destroy(WeirParallelism *measuring)
{
    if (!measuring) return;
    weir_profile_destroy(measuring->profile);
    weir_gpu_destroy_buffer(measuring->gpu, measuring->chain, sizeof chain_start);
    if (measuring->bind_group) wgpuBindGroupRelease(measuring->bind_group);
    if (measuring->pipeline) wgpuComputePipelineRelease(measuring->pipeline);
    if (measuring->layout) wgpuBindGroupLayoutRelease(measuring->layout);
    free(measuring);
}

static WGPUComputePipeline make_pipeline(WeirGpu *gpu, WGPUBindGroupLayout layout)
{
    char source[4096];
    unsigned turns = weir_platform_can_wait() ? FINE_TURNS : COARSE_TURNS;
    snprintf(source, sizeof source, "const WORKGROUP_SIZE = %uu;\nconst TURNS = %uu;\n%s",
             (unsigned)WEIR_WORKGROUP_SIZE, turns, weir_wgsl_device_parallelism);
    return weir_pass_pipeline(gpu, "parallelism", "parallelism", source, layout, NULL);
}

static void run_chain(const WeirParallelism *measuring, const char *pass, uint32_t groups,
                      WGPUCommandEncoder encoder)
{
    WGPUComputePassEncoder one = weir_profile_begin_pass(measuring->profile, pass, encoder);
    wgpuComputePassEncoderSetPipeline(one, measuring->pipeline);
    wgpuComputePassEncoderSetBindGroup(one, 0, measuring->bind_group, 0, NULL);
    wgpuComputePassEncoderDispatchWorkgroups(one, groups, 1, 1);
    weir_profile_end_pass(measuring->profile, one);
}

static void measure(WeirParallelism *measuring)
{
    WeirGpu *gpu = measuring->gpu;
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(gpu->device, NULL);
    weir_profile_start(measuring->profile);
    run_chain(measuring, "parallelism, one", 1, encoder);
    run_chain(measuring, "parallelism, many", measuring->groups, encoder);
    weir_profile_resolve(measuring->profile, encoder);
    weir_gpu_submit(gpu, encoder, "parallelism");
    weir_profile_submitted(measuring->profile);
}

// NULL where nothing can be measured.
static WeirParallelism *begin(WeirGpu *gpu)
{
    WeirProfile *profile = weir_profile_create(gpu, NULL);
    WeirParallelism *measuring = profile ? calloc(1, sizeof *measuring) : NULL;
    if (!measuring) {
        weir_profile_destroy(profile);
        return NULL;
    }
    *measuring = (WeirParallelism){.gpu = gpu, .profile = profile, .groups = FIRST_GROUPS};
    WGPUBindGroupLayoutEntry storage = {
        .binding = 0, .visibility = WGPUShaderStage_Compute, .buffer.type = WGPUBufferBindingType_Storage};
    measuring->layout = wgpuDeviceCreateBindGroupLayout(
        gpu->device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 1, .entries = &storage});
    measuring->pipeline = make_pipeline(gpu, measuring->layout);
    measuring->chain = weir_gpu_create_buffer(
        gpu, "parallelism", WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst, sizeof chain_start);
    wgpuQueueWriteBuffer(gpu->queue, measuring->chain, 0, chain_start, sizeof chain_start);
    WGPUBindGroupEntry chain = {.binding = 0, .buffer = measuring->chain, .size = sizeof chain_start};
    measuring->bind_group = wgpuDeviceCreateBindGroup(
        gpu->device,
        &(WGPUBindGroupDescriptor){.layout = measuring->layout, .entryCount = 1, .entries = &chain});
    measure(measuring);
    return measuring;
}

// Threads, or 0 if it must be measured again: with more of them, or because a device wakes up, or works for others too. Two
// measurements are to agree.
static double judge(WeirParallelism *measuring)
{
    WeirPassTime times[2];
    bool is_told = weir_profile_times(measuring->profile, times, 2) == 2 && times[0].milliseconds > 0.0;
    if (!is_told) return usual_parallelism; // a device that was lost says so itself
    double ratio = times[1].milliseconds / times[0].milliseconds;
    if (ratio < saturated && 2 * measuring->groups <= measuring->gpu->max_groups) {
        measuring->groups *= 2;
        return 0.0;
    }
    uint32_t last = measuring->last;
    measuring->last = weir_parallelism_rounded((double)measuring->groups * WEIR_WORKGROUP_SIZE / ratio);
    return measuring->last == last || ++measuring->judged == MOST_JUDGED ? measuring->last : 0.0;
}

// What needs no measurement, or 0.
static uint32_t told(const WeirGpu *gpu)
{
    bool is_meant = !gpu->told_device[0] || strcmp(gpu->told_device, gpu->name) == 0;
    if (is_meant && gpu->options.parallelism > 0) return gpu->options.parallelism;
    // Its threads are the host's few; but what large devices do is right there too, and tests see it so.
    return gpu->software ? tuned_parallelism : 0;
}

// Threads, or 0 while the measurement is under way.
static double go_on(WeirGpu *gpu)
{
    if (!gpu->measuring) {
        gpu->measuring = begin(gpu);
        return gpu->measuring ? 0.0 : usual_parallelism;
    }
    weir_profile_poll(gpu->measuring->profile);
    if (!weir_profile_ready(gpu->measuring->profile)) return 0.0;
    double threads = judge(gpu->measuring);
    if (threads == 0.0) measure(gpu->measuring);
    return threads;
}

bool weir_parallelism_poll(WeirGpu *gpu)
{
    if (gpu->parallelism > 0) return true;
    double threads = told(gpu);
    if (threads == 0.0) threads = go_on(gpu);
    if (threads == 0.0) return false;
    gpu->parallelism = weir_parallelism_rounded(threads);
    weir_parallelism_destroy(gpu->measuring);
    gpu->measuring = NULL;
    return true;
}
