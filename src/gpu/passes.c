#include "gpu/passes.h"
#include "gpu/platform.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SHADER(name) extern const char weir_wgsl_##name[];
SHADER(common_uniforms)
SHADER(common_index)
SHADER(common_grid)
SHADER(common_kernels)
SHADER(common_fluid)
SHADER(solve_count)
SHADER(solve_scan_reduce)
SHADER(solve_scan_write)
SHADER(solve_scatter)
SHADER(solve_density)
SHADER(solve_forces)
SHADER(solve_density_all_pairs)
SHADER(solve_forces_all_pairs)
SHADER(solve_integrate)

#define BIT(name) (1u << WEIR_BUFFER_##name)
enum { SORTED = BIT(sorted_position) | BIT(sorted_velocity) | BIT(sorted_id) };
enum { STATE = BIT(position) | BIT(velocity) | BIT(id) };

typedef enum Items { PARTICLES, CELL_BLOCKS } Items;

// Buffers that a pass reads, and those that it writes; the uniforms are bound to all.
static const struct {
    const char *name, *label, *source;
    uint32_t reads, writes;
    Items items; // one thread per particle, or one workgroup per block of cells
} table[WEIR_PASS_TOTAL] = {
    [WEIR_PASS_COUNT] = {"count", "pass count", weir_wgsl_solve_count, BIT(position) | BIT(id),
                         BIT(cell_count) | BIT(cell_link), PARTICLES},
    [WEIR_PASS_SCAN_REDUCE] = {"scan_reduce", "pass scan_reduce", weir_wgsl_solve_scan_reduce,
                               BIT(cell_count), BIT(block_sum), CELL_BLOCKS},
    [WEIR_PASS_SCAN_WRITE] = {"scan_write", "pass scan_write", weir_wgsl_solve_scan_write,
                              BIT(cell_count) | BIT(block_sum), BIT(cell_start), CELL_BLOCKS},
    [WEIR_PASS_SCATTER] = {"scatter", "pass scatter", weir_wgsl_solve_scatter,
                           STATE | BIT(cell_link) | BIT(cell_start), SORTED, PARTICLES},
    [WEIR_PASS_DENSITY] = {"density", "pass density", weir_wgsl_solve_density,
                           BIT(sorted_position) | BIT(sorted_velocity) | BIT(cell_start),
                           BIT(flow) | BIT(cell_count) | BIT(cell_link), PARTICLES},
    [WEIR_PASS_FORCES] = {"forces", "pass forces", weir_wgsl_solve_forces,
                          BIT(sorted_position) | BIT(flow) | BIT(cell_start), BIT(acceleration) | BIT(health),
                          PARTICLES},
    [WEIR_PASS_DENSITY_ALL_PAIRS] = {"density_all_pairs", "pass density_all_pairs",
                                     weir_wgsl_solve_density_all_pairs, STATE, BIT(flow) | SORTED, PARTICLES},
    [WEIR_PASS_FORCES_ALL_PAIRS] = {"forces_all_pairs", "pass forces_all_pairs",
                                    weir_wgsl_solve_forces_all_pairs, BIT(sorted_position) | BIT(flow),
                                    BIT(acceleration) | BIT(health), PARTICLES},
    [WEIR_PASS_INTEGRATE] = {"integrate", "pass integrate", weir_wgsl_solve_integrate,
                             SORTED | BIT(acceleration), STATE | BIT(health), PARTICLES},
};

const char *weir_pass_name(WeirPass pass)
{
    return table[pass].name;
}

uint32_t weir_pass_storage_buffers(WeirPass pass)
{
    uint32_t count = 0;
    for (uint32_t bound = table[pass].reads | table[pass].writes; bound; bound &= bound - 1) ++count;
    return count;
}

// Constants that C decides: binding numbers by name, sizes, and the kernels' choice, so that no
// pass branches on it.
static size_t write_constants(char *text, size_t capacity, uint32_t kernels, uint32_t scan_blocks)
{
    size_t length = 0;
#define APPEND(...)                                                                                          \
    length += (size_t)snprintf(text ? text + length : NULL, text ? capacity - length : 0, __VA_ARGS__)
    APPEND("const WORKGROUP_SIZE = %du;\nconst SCAN_VECTORS = %du;\nconst SCAN_BLOCKS = %uu;\n",
           WEIR_WORKGROUP_SIZE, WEIR_SCAN_VECTORS, scan_blocks);
    APPEND("const TUTORIAL_KERNELS = %s;\n", kernels == WEIR_KERNELS_TUTORIAL ? "true" : "false");
    for (int name = 0; name < WEIR_BUFFER_TOTAL; ++name)
        APPEND("const BINDING_%s = %du;\n", weir_buffer_name(name), name);
#undef APPEND
    return length;
}

char *weir_pass_source(const char *source, uint32_t kernels, uint32_t scan_blocks)
{
    const char *parts[] = {weir_wgsl_structs,
                           weir_wgsl_common_uniforms,
                           weir_wgsl_common_index,
                           weir_wgsl_common_grid,
                           weir_wgsl_common_kernels,
                           weir_wgsl_common_fluid,
                           source};
    enum { PARTS = sizeof parts / sizeof *parts };
    size_t constants = write_constants(NULL, 0, kernels, scan_blocks), size = constants + 1;
    for (int n = 0; n < PARTS; ++n) size += strlen(parts[n]);
    char *text = malloc(size);
    if (!text) return NULL;
    char *end = text + write_constants(text, size, kernels, scan_blocks);
    for (int n = 0; n < PARTS; ++n) {
        size_t length = strlen(parts[n]);
        memcpy(end, parts[n], length);
        end += length;
    }
    *end = 0;
    return text;
}

static WGPUBufferBindingType binding_type(WeirPass pass, int name)
{
    if (name <= WEIR_BUFFER_constants) return WGPUBufferBindingType_Uniform;
    if (table[pass].writes >> name & 1) return WGPUBufferBindingType_Storage;
    if (table[pass].reads >> name & 1) return WGPUBufferBindingType_ReadOnlyStorage;
    return WGPUBufferBindingType_BindingNotUsed;
}

static void make_bind_group(WeirPasses *passes, WeirPass pass)
{
    WGPUBindGroupLayoutEntry layout[WEIR_BUFFER_TOTAL] = {0};
    WGPUBindGroupEntry entries[WEIR_BUFFER_TOTAL] = {0};
    size_t count = 0;
    for (int name = 0; name < WEIR_BUFFER_TOTAL; ++name) {
        WGPUBufferBindingType type = binding_type(pass, name);
        if (type == WGPUBufferBindingType_BindingNotUsed) continue;
        layout[count] = (WGPUBindGroupLayoutEntry){
            .binding = (uint32_t)name, .visibility = WGPUShaderStage_Compute, .buffer.type = type};
        entries[count++] = (WGPUBindGroupEntry){.binding = (uint32_t)name,
                                                .buffer = passes->buffers->handle[name],
                                                .size = passes->buffers->size[name]};
    }
    WGPUStringView label = weir_gpu_text(table[pass].label);
    passes->layout[pass] = wgpuDeviceCreateBindGroupLayout(
        passes->gpu->device,
        &(WGPUBindGroupLayoutDescriptor){.label = label, .entryCount = count, .entries = layout});
    passes->bind_group[pass] = wgpuDeviceCreateBindGroup(
        passes->gpu->device,
        &(WGPUBindGroupDescriptor){
            .label = label, .layout = passes->layout[pass], .entryCount = count, .entries = entries});
}

WGPUComputePipeline weir_pass_pipeline(WeirGpu *gpu, const char *name, const char *label, const char *source,
                                       WGPUBindGroupLayout layout, WeirReport *report)
{
    WGPUShaderSourceWGSL wgsl = {.chain.sType = WGPUSType_ShaderSourceWGSL, .code = weir_gpu_text(source)};
    WGPUShaderModuleDescriptor module_descriptor = {.nextInChain = &wgsl.chain,
                                                    .label = weir_gpu_text(label)};
    weir_report_begin(report);
    WGPUShaderModule module =
        weir_platform_shader_module(gpu, &module_descriptor, gpu->options.trusted_shaders);
    WGPUPipelineLayout pipeline_layout = wgpuDeviceCreatePipelineLayout(
        gpu->device, &(WGPUPipelineLayoutDescriptor){.label = weir_gpu_text(label),
                                                     .bindGroupLayoutCount = 1,
                                                     .bindGroupLayouts = &layout});
    WGPUComputePipeline pipeline = wgpuDeviceCreateComputePipeline(
        gpu->device,
        &(WGPUComputePipelineDescriptor){.label = weir_gpu_text(label),
                                         .layout = pipeline_layout,
                                         .compute = {.module = module, .entryPoint = weir_gpu_text(name)}});
    weir_report_end(report, label);
    if (pipeline_layout) wgpuPipelineLayoutRelease(pipeline_layout);
    if (module) wgpuShaderModuleRelease(module);
    return pipeline;
}

static bool make_pipeline(WeirPasses *passes, WeirPass pass, WeirReport *report)
{
    char *source = weir_pass_source(table[pass].source, passes->kernels, passes->buffers->scan_blocks);
    if (!source) return false;
    passes->pipeline[passes->kernels][pass] = weir_pass_pipeline(
        passes->gpu, table[pass].name, table[pass].label, source, passes->layout[pass], report);
    free(source);
    return true;
}

static bool needs(const WeirParameters *parameters, WeirPass pass)
{
    bool all_pairs = pass == WEIR_PASS_DENSITY_ALL_PAIRS || pass == WEIR_PASS_FORCES_ALL_PAIRS;
    return pass == WEIR_PASS_INTEGRATE || all_pairs == (parameters->search == WEIR_SEARCH_ALL_PAIRS);
}

WeirStatus weir_passes_prepare(WeirPasses *passes, const WeirParameters *parameters, WeirReport *report,
                               WeirMessage *message)
{
    passes->kernels = parameters->kernels;
    for (int pass = 0; pass < WEIR_PASS_TOTAL; ++pass) {
        if (!needs(parameters, pass)) continue;
        if (!passes->bind_group[pass]) {
            weir_report_begin(report);
            make_bind_group(passes, pass);
            weir_report_end(report, table[pass].label);
        }
        if (!passes->pipeline[passes->kernels][pass] && !make_pipeline(passes, pass, report))
            return weir_fail(message, WEIR_ERROR_MEMORY, "%s: no memory for its source", table[pass].label);
    }
    return weir_report_check(report, message);
}

void weir_passes_destroy(WeirPasses *passes)
{
    for (int pass = 0; pass < WEIR_PASS_TOTAL; ++pass) {
        if (passes->bind_group[pass]) wgpuBindGroupRelease(passes->bind_group[pass]);
        if (passes->layout[pass]) wgpuBindGroupLayoutRelease(passes->layout[pass]);
        for (int kernels = 0; kernels < 2; ++kernels) {
            if (passes->pipeline[kernels][pass]) wgpuComputePipelineRelease(passes->pipeline[kernels][pass]);
        }
    }
}

void weir_pass_dispatch(const WeirPasses *passes, WeirPass pass, WGPUComputePassEncoder encoder)
{
    uint32_t groups = table[pass].items == PARTICLES
                          ? (passes->particle_count + WEIR_WORKGROUP_SIZE - 1) / WEIR_WORKGROUP_SIZE
                          : passes->buffers->scan_blocks;
    uint32_t rows = (groups + passes->gpu->max_groups - 1) / passes->gpu->max_groups;
    wgpuComputePassEncoderSetPipeline(encoder, passes->pipeline[passes->kernels][pass]);
    wgpuComputePassEncoderSetBindGroup(encoder, 0, passes->bind_group[pass], 0, NULL);
    wgpuComputePassEncoderDispatchWorkgroups(encoder, (groups + rows - 1) / rows, rows, 1);
}
