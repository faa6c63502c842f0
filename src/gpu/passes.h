// Passes of a solver: one name for the WGSL file, its entry point, the profiler and messages. A method lists its
// passes and buffers in two tables (mueller_passes.c, wcsph_passes.c).
#pragma once

#include "gpu/parts.h"

enum { WEIR_MAX_PASSES = 28, WEIR_SETTINGS_LENGTH = 2048 };

// What a pass is spread over.
typedef enum WeirItems {
    WEIR_ITEMS_PARTICLES, // one thread per particle
    WEIR_ITEMS_SHARES,    // several threads per particle
    WEIR_ITEMS_STEP, // the same, and more in workgroups of their own for solid particles that see fluid (wcsph)
    WEIR_ITEMS_CELL_BLOCKS,  // one workgroup per block of the scan
    WEIR_ITEMS_ONE,          // one workgroup
    WEIR_ITEMS_SOLIDS,       // one thread per solid particle (wcsph)
    WEIR_ITEMS_SOLID_SHARES, // several threads per solid particle (wcsph)
    WEIR_ITEMS_SORTING, // threads that may take several particles each: they often have nothing to do (wcsph)
    WEIR_ITEMS_BLOCKS,  // one workgroup per block of solid particles (wcsph)
    WEIR_ITEMS_FREE_BLOCKS, // the same of free bodies alone
    WEIR_ITEMS_SUMS,        // one workgroup per share of the particles (sums.h)
    WEIR_ITEMS_TOTAL
} WeirItems;

// Of `size` threads, that hold so many.
static inline uint32_t weir_workgroups_of(uint32_t size, uint32_t threads)
{
    return (threads + size - 1) / size;
}

static inline uint32_t weir_workgroups(uint32_t threads)
{
    return weir_workgroups_of(WEIR_WORKGROUP_SIZE, threads);
}

// In a list of parts: those behind it come with `seen_` before each name that they declare, so that one pass may have two sums
// over neighbours.
extern const char weir_seen_parts[];

typedef struct WeirPassInfo {
    const char *name, *label, *source;
    const char *settings;     // WGSL constants of this pass, NULL for none
    const char *const *parts; // WGSL before its own and after the method's, ended by NULL; NULL for none
    uint32_t reads, writes;   // storage buffers by bit; uniform buffers are bound to all
    WeirItems items;
} WeirPassInfo;

// What a method is made of.
typedef struct WeirMethodInfo {
    const WeirBufferInfo *buffers;
    const WeirPassInfo *passes;
    uint32_t buffer_count, pass_count;
    const char *const *parts;          // WGSL before each pass's own, ended by NULL
    const WeirPartFunction *functions; // for buffers in parts; NULL for none
} WeirMethodInfo;

// Pipelines for one choice of settings.
typedef struct WeirVariant {
    char settings[WEIR_SETTINGS_LENGTH];
    WGPUComputePipeline pipeline[WEIR_MAX_PASSES]; // made when first needed
    uint64_t key[WEIR_MAX_PASSES];                 // weir_pipeline_key()
} WeirVariant;

typedef struct WeirPasses {
    WeirGpu *gpu;
    const WeirMethodInfo *method;
    const WeirBuffers *buffers;
    uint32_t groups[WEIR_ITEMS_TOTAL]; // workgroups by what a pass is spread over
    uint32_t
        share_threads; // of a workgroup over WEIR_ITEMS_SHARES and WEIR_ITEMS_STEP; others have WEIR_WORKGROUP_SIZE
    WGPUBindGroupLayout layout[WEIR_MAX_PASSES];
    WGPUBindGroup bind_group[WEIR_MAX_PASSES];
    WeirVariant variants[2];
    uint32_t current, next; // the variant that runs, and the one prepared last
    bool in_background;     // pipelines come later than they are asked for: until then the report is pending
} WeirPasses;

// Storage buffers that a pass binds, each in one part: WebGPU promises no more than 8.
uint32_t weir_pass_storage_buffers(const WeirPassInfo *pass);
// WEIR_ERROR_MEMORY with a message if the device allows a pass fewer than the parts of its buffers are.
WeirStatus weir_passes_check(const WeirPasses *passes, WeirMessage *message);
// Makes what the passes in the bits of `needed` lack under `settings`, WGSL constants of at most
// WEIR_SETTINGS_LENGTH - 1 characters. Faults go to `report`. Not to be called while pipelines are under way.
WeirStatus weir_passes_prepare(WeirPasses *passes, const char *settings, uint32_t needed, WeirReport *report,
                               WeirMessage *message);
// What was prepared last runs from now on.
void weir_passes_use_prepared(WeirPasses *passes);
// The pipelines that run were made without a fault: the device keeps them for other simulations.
void weir_passes_keep(const WeirPasses *passes);
void weir_passes_destroy(WeirPasses *passes);
// Workgroups of a dispatch along its two dimensions.
void weir_pass_groups(const WeirGpu *gpu, uint32_t groups, uint32_t size[2]);
// Records one pass.
void weir_pass_dispatch(const WeirPasses *passes, uint32_t pass, WGPUComputePassEncoder encoder);
// The same with 3 k + turn workgroups along the first dimension, up to two more than it needs: so its shader knows whose turn it is.
void weir_pass_dispatch_turn(const WeirPasses *passes, uint32_t pass, uint32_t turn,
                             WGPUComputePassEncoder encoder);
// The same with workgroups by three numbers of a buffer, from byte `offset` on.
void weir_pass_dispatch_indirect(const WeirPasses *passes, uint32_t pass, WGPUComputePassEncoder encoder,
                                 WGPUBuffer sizes, uint64_t offset);

// The whole WGSL of a pass, 0-terminated, from malloc: constants (`threads` of a workgroup), structs, the method's parts, `parts`
// (NULL for none), then `source`. NULL if memory runs out.
char *weir_pass_source(const WeirMethodInfo *method, uint32_t threads, const char *settings,
                       const char *const *parts, const char *source);
// Compiles `source` with the entry point `name` and the explicit `layout`; faults go to `report` as `label`, or if that is NULL
// to the device. NULL if memory runs out.
WGPUComputePipeline weir_pass_pipeline(WeirGpu *gpu, const char *name, const char *label, const char *source,
                                       WGPUBindGroupLayout layout, WeirReport *report);
