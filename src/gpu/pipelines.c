#include "gpu/pipelines.h"

#include <stddef.h>

// FNV-1a; a 0 stands between the two texts.
uint64_t weir_pipeline_key(const char *label, const char *source)
{
    const char *const texts[2] = {label, source};
    uint64_t hash = 0xcbf29ce484222325u;
    for (int n = 0; n < 2; ++n) {
        const char *at = texts[n];
        do hash = (hash ^ (unsigned char)*at) * 0x100000001b3u;
        while (*at++);
    }
    return hash;
}

static WeirKeptPipeline *kept(WeirPipelines *pipelines, uint64_t key)
{
    for (int n = 0; n < WEIR_KEPT_PIPELINES; ++n) {
        WeirKeptPipeline *one = &pipelines->kept[n];
        if (!one->pipeline || one->key != key) continue;
        one->used = ++pipelines->clock;
        return one;
    }
    return NULL;
}

WGPUComputePipeline weir_pipelines_find(WeirPipelines *pipelines, uint64_t key)
{
    const WeirKeptPipeline *found = kept(pipelines, key);
    if (!found) return NULL;
    wgpuComputePipelineAddRef(found->pipeline);
    return found->pipeline;
}

void weir_pipelines_keep(WeirPipelines *pipelines, uint64_t key, WGPUComputePipeline pipeline)
{
    if (kept(pipelines, key)) return;
    WeirKeptPipeline *oldest = &pipelines->kept[0];
    for (int n = 1; n < WEIR_KEPT_PIPELINES; ++n)
        if (pipelines->kept[n].used < oldest->used) oldest = &pipelines->kept[n];
    if (oldest->pipeline) wgpuComputePipelineRelease(oldest->pipeline);
    wgpuComputePipelineAddRef(pipeline);
    *oldest = (WeirKeptPipeline){pipeline, key, ++pipelines->clock};
}

void weir_pipelines_release(WeirPipelines *pipelines)
{
    for (int n = 0; n < WEIR_KEPT_PIPELINES; ++n)
        if (pipelines->kept[n].pipeline) wgpuComputePipelineRelease(pipelines->kept[n].pipeline);
    *pipelines = (WeirPipelines){0};
}
