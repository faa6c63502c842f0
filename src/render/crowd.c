// How crowded it is around each particle, counted on the device before it is drawn: lonely ones are drops of the water, and
// those whom others hide on all sides are left out.
#include "render/renderer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

extern const char weir_wgsl_render_frame[], weir_wgsl_render_particle[];
extern const char weir_wgsl_render_particles_wcsph[];
extern const char weir_wgsl_render_space_crowd[];
extern const char weir_wgsl_render_space_crowd_count[], weir_wgsl_render_space_crowd_gather[];

enum {
    GROUP_SIZE = 256,
    GROUPS_PER_ROW = 65535, // crowd.wgsl: row_length
    MOST_CELLS = 1 << 22,
    CELL_BYTES = 16,
    VALUE_BYTES = 8, // of a particle
    BINDINGS = 4,
    STAGES = WEIR_CROWD_STAGES,
};

// Vertices of each instance, instances, and where they begin; crowd_gather counts the instances.
static const uint32_t draw_none[4] = {4, 0, 0, 0};

static void release_buffer(WGPUBuffer *buffer)
{
    if (*buffer) {
        wgpuBufferDestroy(*buffer);
        wgpuBufferRelease(*buffer);
    }
    *buffer = NULL;
}

static void release_buffers(WeirCrowd *crowd)
{
    if (crowd->group) wgpuBindGroupRelease(crowd->group);
    crowd->group = NULL;
    release_buffer(&crowd->cells);
    release_buffer(&crowd->values);
    release_buffer(&crowd->shown);
    release_buffer(&crowd->draw);
    crowd->count = crowd->cell_count = 0;
}

void weir_crowd_release(WeirRenderer *renderer)
{
    WeirCrowd *crowd = &renderer->crowd;
    release_buffers(crowd);
    for (int stage = 0; stage < STAGES; stage++) {
        if (crowd->pipelines[stage]) wgpuComputePipelineRelease(crowd->pipelines[stage]);
    }
    if (crowd->pipeline_layout) wgpuPipelineLayoutRelease(crowd->pipeline_layout);
    if (crowd->layout) wgpuBindGroupLayoutRelease(crowd->layout);
    *crowd = (WeirCrowd){.layout = NULL};
}

static void create_layouts(WeirRenderer *renderer, WGPUDevice device)
{
    WGPUBindGroupLayoutEntry entries[BINDINGS];
    for (uint32_t k = 0; k < BINDINGS; k++) {
        entries[k] = (WGPUBindGroupLayoutEntry){.binding = k,
                                                .visibility = WGPUShaderStage_Compute,
                                                .buffer = {.type = WGPUBufferBindingType_Storage}};
    }
    renderer->crowd.layout = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = BINDINGS, .entries = entries});
    WGPUBindGroupLayout groups[3] = {renderer->frame_layout, renderer->particle_layout,
                                     renderer->crowd.layout};
    renderer->crowd.pipeline_layout = wgpuDeviceCreatePipelineLayout(
        device, &(WGPUPipelineLayoutDescriptor){.bindGroupLayoutCount = 3, .bindGroupLayouts = groups});
}

static WGPUComputePipeline create_pipeline(WeirRenderer *renderer, WGPUDevice device, int stage)
{
    static const char *const names[STAGES] = {"crowd_count", "crowd_gather"};
    const char *parts[] = {weir_wgsl_render_frame, weir_wgsl_render_particles_wcsph,
                           weir_wgsl_render_particle, weir_wgsl_render_space_crowd,
                           stage == 0 ? weir_wgsl_render_space_crowd_count
                                      : weir_wgsl_render_space_crowd_gather};
    WGPUShaderModule module = weir_effect_module(device, names[stage], parts, sizeof parts / sizeof *parts);
    if (!module) return NULL;
    WGPUStringView name = {.data = names[stage], .length = strlen(names[stage])};
    WGPUComputePipeline pipeline = wgpuDeviceCreateComputePipeline(
        device, &(WGPUComputePipelineDescriptor){.label = name,
                                                 .layout = renderer->crowd.pipeline_layout,
                                                 .compute = {.module = module, .entryPoint = name}});
    wgpuShaderModuleRelease(module);
    return pipeline;
}

// Cells that hold the domain; crowd.wgsl: cell_index().
static uint32_t cells_for(const WeirFrame *frame)
{
    double cells = 1.0;
    for (int k = 0; k < 3; k++) {
        double size = (double)(frame->domain_max[k] - frame->domain_min[k]);
        cells *= ceil(size / (2.0 * (double)frame->spacing)) + 3.0;
    }
    return cells < MOST_CELLS ? (uint32_t)cells : MOST_CELLS;
}

static bool create_buffers(WeirCrowd *crowd, WGPUDevice device, uint32_t count, uint32_t cell_count)
{
    release_buffers(crowd);
    const WGPUBufferUsage storage = WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst;
    const struct {
        WGPUBuffer *buffer;
        WGPUBufferUsage usage;
        uint64_t size;
    } wanted[BINDINGS] = {
        {&crowd->cells, storage, (uint64_t)CELL_BYTES * cell_count},
        {&crowd->values, storage, (uint64_t)VALUE_BYTES * count},
        {&crowd->shown, storage, sizeof(uint32_t) * (uint64_t)count},
        {&crowd->draw, storage | WGPUBufferUsage_Indirect | WGPUBufferUsage_CopySrc, sizeof draw_none},
    };
    WGPUBindGroupEntry entries[BINDINGS];
    for (uint32_t k = 0; k < BINDINGS; k++) {
        *wanted[k].buffer = wgpuDeviceCreateBuffer(
            device, &(WGPUBufferDescriptor){.usage = wanted[k].usage, .size = wanted[k].size});
        if (!*wanted[k].buffer) return false;
        entries[k] = (WGPUBindGroupEntry){.binding = k, .buffer = *wanted[k].buffer, .size = WGPU_WHOLE_SIZE};
    }
    crowd->group = wgpuDeviceCreateBindGroup(
        device,
        &(WGPUBindGroupDescriptor){.layout = crowd->layout, .entryCount = BINDINGS, .entries = entries});
    crowd->count = count;
    crowd->cell_count = cell_count;
    return crowd->group != NULL;
}

WeirStatus weir_crowd_prepare(WeirRenderer *renderer, const WeirFrame *frame, uint32_t count)
{
    WeirCrowd *crowd = &renderer->crowd;
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    if (!crowd->layout) create_layouts(renderer, device);
    bool good = true;
    for (int stage = 0; stage < STAGES; stage++) {
        if (!crowd->pipelines[stage]) crowd->pipelines[stage] = create_pipeline(renderer, device, stage);
        good = good && crowd->pipelines[stage];
    }
    uint32_t cell_count = cells_for(frame), needed = count > 0 ? count : 1;
    if (good && (crowd->count != needed || crowd->cell_count != cell_count))
        good = create_buffers(crowd, device, needed, cell_count);
    if (good) return WEIR_OK;
    release_buffers(crowd);
    return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No device memory to draw %u particles.", count);
}

void weir_crowd_count(WeirRenderer *renderer, const WeirDrawing *drawing)
{
    WGPUCommandEncoder encoder = drawing->encoder;
    uint32_t count = drawing->particle_count;
    const WeirCrowd *crowd = &renderer->crowd;
    uint32_t groups = (count + GROUP_SIZE - 1) / GROUP_SIZE;
    uint32_t rows = (groups + GROUPS_PER_ROW - 1) / GROUPS_PER_ROW;
    wgpuQueueWriteBuffer(weir_gpu_wgpu_queue(renderer->gpu), crowd->draw, 0, draw_none, sizeof draw_none);
    wgpuCommandEncoderClearBuffer(encoder, crowd->cells, 0, (uint64_t)CELL_BYTES * crowd->cell_count);
    WGPUComputePassEncoder pass = wgpuCommandEncoderBeginComputePass(
        encoder, &(WGPUComputePassDescriptor){.timestampWrites = drawing->begins});
    for (int stage = 0; stage < STAGES && groups > 0; stage++) {
        wgpuComputePassEncoderSetPipeline(pass, crowd->pipelines[stage]);
        wgpuComputePassEncoderSetBindGroup(pass, 0, renderer->frame_group, 0, NULL);
        wgpuComputePassEncoderSetBindGroup(pass, 1, drawing->uncounted, 0, NULL);
        wgpuComputePassEncoderSetBindGroup(pass, 2, crowd->group, 0, NULL);
        wgpuComputePassEncoderDispatchWorkgroups(pass, rows > 1 ? GROUPS_PER_ROW : groups, rows, 1);
    }
    wgpuComputePassEncoderEnd(pass);
    wgpuComputePassEncoderRelease(pass);
}
