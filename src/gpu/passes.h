// The passes of `mueller`: one name for the WGSL file, its entry point, the profiler and messages.
#pragma once

#include "gpu/buffers.h"

typedef enum WeirPass {
    WEIR_PASS_COUNT,
    WEIR_PASS_SCAN_REDUCE,
    WEIR_PASS_SCAN_WRITE,
    WEIR_PASS_SCATTER,
    WEIR_PASS_DENSITY,
    WEIR_PASS_FORCES,
    WEIR_PASS_DENSITY_ALL_PAIRS,
    WEIR_PASS_FORCES_ALL_PAIRS,
    WEIR_PASS_INTEGRATE,
    WEIR_PASS_TOTAL
} WeirPass;

typedef struct WeirPasses {
    WeirGpu *gpu;
    const WeirBuffers *buffers;
    uint32_t particle_count;
    uint32_t kernels; // which of the pipelines run
    WGPUBindGroupLayout layout[WEIR_PASS_TOTAL];
    WGPUBindGroup bind_group[WEIR_PASS_TOTAL];
    WGPUComputePipeline pipeline[2][WEIR_PASS_TOTAL]; // by WeirParameters.kernels; made when first needed
} WeirPasses;

const char *weir_pass_name(WeirPass pass);
// Storage buffers that a pass binds: WebGPU promises no more than 8.
uint32_t weir_pass_storage_buffers(WeirPass pass);
// Makes what the passes of `parameters` need and does not exist yet. Faults go to `report`.
WeirStatus weir_passes_prepare(WeirPasses *passes, const WeirParameters *parameters, WeirReport *report,
                               WeirMessage *message);
void weir_passes_destroy(WeirPasses *passes);
// Records one pass.
void weir_pass_dispatch(const WeirPasses *passes, WeirPass pass, WGPUComputePassEncoder encoder);

// The whole WGSL of a pass, 0-terminated, from malloc: constants, structs, common parts, then `source`. NULL
// if memory runs out.
char *weir_pass_source(const char *source, uint32_t kernels, uint32_t scan_blocks);
// Compiles `source` with the entry point `name` and the explicit `layout`; faults go to `report` as `label`.
// NULL if memory runs out.
WGPUComputePipeline weir_pass_pipeline(WeirGpu *gpu, const char *name, const char *label, const char *source,
                                       WGPUBindGroupLayout layout, WeirReport *report);
