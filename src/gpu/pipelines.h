// Pipelines that a device has made so far. A simulation whose shaders have the same text as those of one before it starts
// without compiling: the same scene again, with more particles, or with parameters that it had before.
#pragma once

#include <webgpu/webgpu.h>

enum { WEIR_KEPT_PIPELINES = 128 }; // a simulation has about 20

typedef struct WeirKeptPipeline {
    WGPUComputePipeline pipeline; // NULL: none
    uint64_t key;                 // weir_pipeline_key()
    uint64_t used;                // when it was last looked for
} WeirKeptPipeline;

typedef struct WeirPipelines {
    WeirKeptPipeline kept[WEIR_KEPT_PIPELINES];
    uint64_t clock;
} WeirPipelines;

// Hash of a pass's label and its whole WGSL, which tells its layout too.
uint64_t weir_pipeline_key(const char *label, const char *source);
// With a reference for the caller; NULL if there is none.
WGPUComputePipeline weir_pipelines_find(WeirPipelines *pipelines, uint64_t key);
// Adds one, with a reference of its own, in the place of the one that nobody has looked for the longest.
void weir_pipelines_keep(WeirPipelines *pipelines, uint64_t key, WGPUComputePipeline pipeline);
void weir_pipelines_release(WeirPipelines *pipelines);
