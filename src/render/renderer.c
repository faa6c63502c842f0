// The renderer: pipelines made once, one uniform write and one render pass per frame, nothing
// allocated per frame.
#include <math.h>
#include <stdlib.h>

#include "core/sim.h"
#include "render/renderer.h"

static bool target_encodes(WGPUTextureFormat format)
{
    return format == WGPUTextureFormat_BGRA8UnormSrgb || format == WGPUTextureFormat_RGBA8UnormSrgb;
}

static void create_layouts(WeirRenderer *renderer, WGPUDevice device)
{
    WGPUBindGroupLayoutEntry frame_entries[2] = {
        {.binding = 0,
         .visibility = WGPUShaderStage_Vertex | WGPUShaderStage_Fragment,
         .buffer = {.type = WGPUBufferBindingType_Uniform, .minBindingSize = sizeof(WeirFrame)}},
        {.binding = 1,
         .visibility = WGPUShaderStage_Vertex,
         .buffer = {.type = WGPUBufferBindingType_Uniform,
                    .minBindingSize = sizeof(uint32_t) * WEIR_COLOR_MAPS * WEIR_COLOR_STEPS}},
    };
    renderer->frame_layout = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 2, .entries = frame_entries});
    // Read by the vertex stage only: many phones give the fragment stage few storage buffers.
    WGPUBindGroupLayoutEntry particle_entries[3];
    for (uint32_t k = 0; k < 3; k++) {
        particle_entries[k] =
            (WGPUBindGroupLayoutEntry){.binding = k,
                                       .visibility = WGPUShaderStage_Vertex,
                                       .buffer = {.type = WGPUBufferBindingType_ReadOnlyStorage}};
    }
    renderer->particle_layout = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 3, .entries = particle_entries});
    WGPUBindGroupLayout groups[2] = {renderer->frame_layout, renderer->particle_layout};
    renderer->pipeline_layout = wgpuDeviceCreatePipelineLayout(
        device, &(WGPUPipelineLayoutDescriptor){.bindGroupLayoutCount = 2, .bindGroupLayouts = groups});
}

static void create_frame_group(WeirRenderer *renderer, WGPUDevice device, WGPUQueue queue)
{
    uint32_t words[WEIR_COLOR_MAPS * WEIR_COLOR_STEPS];
    weir_color_map_words(words);
    WGPUBufferUsage usage = WGPUBufferUsage_Uniform | WGPUBufferUsage_CopyDst;
    renderer->frame_buffer =
        wgpuDeviceCreateBuffer(device, &(WGPUBufferDescriptor){.usage = usage, .size = sizeof(WeirFrame)});
    renderer->color_buffer =
        wgpuDeviceCreateBuffer(device, &(WGPUBufferDescriptor){.usage = usage, .size = sizeof words});
    if (!renderer->frame_buffer || !renderer->color_buffer) return;
    wgpuQueueWriteBuffer(queue, renderer->color_buffer, 0, words, sizeof words);
    WGPUBindGroupEntry entries[2] = {
        {.binding = 0, .buffer = renderer->frame_buffer, .size = sizeof(WeirFrame)},
        {.binding = 1, .buffer = renderer->color_buffer, .size = sizeof words},
    };
    renderer->frame_group = wgpuDeviceCreateBindGroup(
        device,
        &(WGPUBindGroupDescriptor){.layout = renderer->frame_layout, .entryCount = 2, .entries = entries});
}

// Makes what lives as long as the renderer, once the device is there.
static WeirStatus prepare(WeirRenderer *renderer)
{
    if (renderer->frame_group) return WEIR_OK;
    WeirStatus status = weir_gpu_poll(renderer->gpu);
    if (status != WEIR_OK) {
        const char *reason =
            status == WEIR_PENDING ? "the device is not ready yet" : weir_gpu_error(renderer->gpu);
        return weir_fail(&renderer->message, status, "The renderer has no device: %s.", reason);
    }
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    if (!renderer->pipeline_layout) create_layouts(renderer, device);
    WeirEffectSetup setup = {
        .device = device, .layout = renderer->pipeline_layout, .format = renderer->format};
    for (int kind = 0; kind < WEIR_EFFECTS; kind++) {
        if (renderer->pipelines[kind]) continue;
        renderer->pipelines[kind] = weir_effect_create((WeirEffectKind)kind, &setup);
        if (!renderer->pipelines[kind]) {
            return weir_fail(&renderer->message, WEIR_ERROR_MEMORY,
                             "No memory for the renderer's pipelines.");
        }
    }
    create_frame_group(renderer, device, weir_gpu_wgpu_queue(renderer->gpu));
    if (renderer->frame_group) return WEIR_OK;
    return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No device memory for the renderer's uniforms.");
}

WeirRenderer *weir_renderer_create(WeirGpu *gpu, uint32_t format)
{
    WeirRenderer *renderer = calloc(1, sizeof *renderer);
    if (!renderer) return NULL;
    renderer->gpu = gpu;
    renderer->format = (WGPUTextureFormat)format;
    renderer->effects = (1u << WEIR_EFFECTS) - 1u;
    if (weir_gpu_poll(gpu) == WEIR_OK) prepare(renderer); // else with the first frame
    return renderer;
}

static void release_group(WeirParticleGroup *slot)
{
    if (!slot->group) return;
    wgpuBindGroupRelease(slot->group);
    for (int k = 0; k < 3; k++) wgpuBufferRelease(slot->buffers[k]);
    *slot = (WeirParticleGroup){.group = NULL};
}

static void release_buffer(WGPUBuffer buffer)
{
    if (!buffer) return;
    wgpuBufferDestroy(buffer);
    wgpuBufferRelease(buffer);
}

void weir_renderer_destroy(WeirRenderer *renderer)
{
    if (!renderer) return;
    for (int slot = 0; slot < WEIR_PARTICLE_GROUPS; slot++) release_group(&renderer->groups[slot]);
    if (renderer->frame_group) wgpuBindGroupRelease(renderer->frame_group);
    release_buffer(renderer->frame_buffer);
    release_buffer(renderer->color_buffer);
    for (int kind = 0; kind < WEIR_EFFECTS; kind++) {
        if (renderer->pipelines[kind]) wgpuRenderPipelineRelease(renderer->pipelines[kind]);
    }
    if (renderer->pipeline_layout) wgpuPipelineLayoutRelease(renderer->pipeline_layout);
    if (renderer->particle_layout) wgpuBindGroupLayoutRelease(renderer->particle_layout);
    if (renderer->frame_layout) wgpuBindGroupLayoutRelease(renderer->frame_layout);
    free(renderer);
}

const char *weir_renderer_error(const WeirRenderer *renderer)
{
    return renderer->message.text;
}

// Bind group of these particles: a known one, or a new one in the slot that was not drawn for longest. Slots
// not drawn for a while are given up, so that a destroyed simulation's buffers do not stay in memory.
static WGPUBindGroup particle_group(WeirRenderer *renderer, const WeirGpuParticles *particles)
{
    WGPUBuffer buffers[3] = {particles->position, particles->velocity, particles->flow};
    WeirParticleGroup *oldest = &renderer->groups[0], *found = NULL;
    for (WeirParticleGroup *slot = renderer->groups; slot < renderer->groups + WEIR_PARTICLE_GROUPS; slot++) {
        if (slot->group && slot->buffers[0] == buffers[0] && slot->buffers[1] == buffers[1] &&
            slot->buffers[2] == buffers[2]) {
            found = slot;
        } else if (slot->last_frame + WEIR_PARTICLE_GROUP_FRAMES < renderer->frame_count) {
            release_group(slot);
        }
        if (slot->last_frame < oldest->last_frame) oldest = slot;
    }
    if (!found) {
        found = oldest;
        release_group(found);
        WGPUBindGroupEntry entries[3];
        for (uint32_t k = 0; k < 3; k++) {
            wgpuBufferAddRef(buffers[k]);
            found->buffers[k] = buffers[k];
            entries[k] = (WGPUBindGroupEntry){.binding = k, .buffer = buffers[k], .size = WGPU_WHOLE_SIZE};
        }
        found->group = wgpuDeviceCreateBindGroup(
            weir_gpu_wgpu_device(renderer->gpu),
            &(WGPUBindGroupDescriptor){
                .layout = renderer->particle_layout, .entryCount = 3, .entries = entries});
    }
    found->last_frame = renderer->frame_count;
    return found->group;
}

static WeirStatus check_input(WeirRenderer *renderer, const WeirView *view, const void *target,
                              uint32_t width, uint32_t height)
{
    WeirMessage *message = &renderer->message;
    if (!view || !target) return weir_fail(message, WEIR_ERROR_INPUT, "A frame needs a view and a target.");
    if (width == 0 || height == 0) {
        return weir_fail(message, WEIR_ERROR_INPUT, "The target is %u x %u pixels; both must be at least 1.",
                         width, height);
    }
    if ((uint32_t)view->color_by >= WEIR_COLOR_MAPS) {
        return weir_fail(message, WEIR_ERROR_INPUT, "color_by is %u; allowed are 0 to %d.",
                         (unsigned)view->color_by, WEIR_COLOR_MAPS - 1);
    }
    const struct {
        const char *name;
        float value;
        bool positive; // else any finite number
    } numbers[] = {
        {"color_min", view->color_min, false},
        {"color_max", view->color_max, false},
        {"center[0]", view->center[0], false},
        {"center[1]", view->center[1], false},
        {"pixels_per_meter", view->pixels_per_meter, true},
        {"particle_radius", view->particle_radius, true},
        {"tool_position[0]", view->tool_position[0], false},
        {"tool_position[1]", view->tool_position[1], false},
        {"tool_radius", view->tool_radius, false},
        {"tool_pressed", view->tool_pressed, false},
    };
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        if (isfinite(numbers[k].value) && (!numbers[k].positive || numbers[k].value > 0.0f)) continue;
        return weir_fail(message, WEIR_ERROR_INPUT, "%s is %g; it must be a finite number%s.",
                         numbers[k].name, (double)numbers[k].value, numbers[k].positive ? " above 0" : "");
    }
    return WEIR_OK;
}

static void fill_frame(WeirFrame *frame, WeirSim *sim, const WeirView *view, uint32_t width, uint32_t height,
                       WGPUTextureFormat format)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    const WeirParameters *parameters = weir_sim_parameters(sim);
    float range = view->color_max - view->color_min;
    *frame = (WeirFrame){
        .size = {(float)width, (float)height},
        .tool_radius = fmaxf(view->tool_radius, 0.0f) * view->pixels_per_meter,
        .tool_pressed = fminf(fmaxf(view->tool_pressed, 0.0f), 1.0f),
        .color_min = view->color_min,
        .color_scale = range != 0.0f ? 1.0f / range : 0.0f,
        .color_by = (uint32_t)view->color_by,
        .linear_target = target_encodes(format),
        .pixels_per_meter = view->pixels_per_meter,
        .particle_radius = view->particle_radius * view->pixels_per_meter,
        .body_radius = fmaxf(1.5f * parameters->particle_spacing * view->pixels_per_meter, 1.5f),
        .line_scale = fminf(fmaxf((float)(width < height ? width : height) / 1000.0f, 1.0f), 4.0f),
        .rest_density = parameters->rest_density,
    };
    for (int k = 0; k < 2; k++) {
        frame->center[k] = view->center[k];
        frame->domain_min[k] = constants->domain_min[k];
        frame->domain_max[k] = constants->domain_max[k];
        frame->tool_position[k] = view->tool_position[k];
    }
}

static void encode(WeirRenderer *renderer, const WeirFrame *frame, WGPUBindGroup particles, uint32_t count,
                   WGPUTextureView target)
{
    WGPUQueue queue = weir_gpu_wgpu_queue(renderer->gpu);
    wgpuQueueWriteBuffer(queue, renderer->frame_buffer, 0, frame, sizeof *frame);
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(weir_gpu_wgpu_device(renderer->gpu), NULL);
    WGPURenderPassColorAttachment attachment = {.view = target,
                                                .depthSlice = WGPU_DEPTH_SLICE_UNDEFINED,
                                                .loadOp = WGPULoadOp_Clear,
                                                .storeOp = WGPUStoreOp_Store,
                                                .clearValue = {.a = 1.0}};
    WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(
        encoder, &(WGPURenderPassDescriptor){.colorAttachmentCount = 1, .colorAttachments = &attachment});
    wgpuRenderPassEncoderSetBindGroup(pass, 0, renderer->frame_group, 0, NULL);
    wgpuRenderPassEncoderSetBindGroup(pass, 1, particles, 0, NULL);
    for (int kind = 0; kind < WEIR_EFFECTS; kind++) {
        if (!(renderer->effects & 1u << kind)) continue;
        weir_effect_draw((WeirEffectKind)kind, renderer->pipelines[kind], pass, frame, count);
    }
    wgpuRenderPassEncoderEnd(pass);
    WGPUCommandBuffer commands = wgpuCommandEncoderFinish(encoder, NULL);
    wgpuQueueSubmit(queue, 1, &commands);
    wgpuCommandBufferRelease(commands);
    wgpuRenderPassEncoderRelease(pass);
    wgpuCommandEncoderRelease(encoder);
}

WeirStatus weir_renderer_draw(WeirRenderer *renderer, WeirSim *sim, const WeirView *view, void *target,
                              uint32_t width, uint32_t height)
{
    WeirStatus status = check_input(renderer, view, target, width, height);
    if (status != WEIR_OK) return status;
    WeirGpuParticles particles;
    if (!sim || !weir_gpu_particles(sim, &particles) || particles.gpu != renderer->gpu) {
        return weir_fail(
            &renderer->message, WEIR_ERROR_INPUT,
            "The simulation does not run on the renderer's device; make it with weir_gpu_backend() of "
            "the same WeirGpu.");
    }
    status = prepare(renderer);
    if (status != WEIR_OK) return status;
    WGPUBindGroup group = particle_group(renderer, &particles);
    if (!group) return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No memory to draw the particles.");
    WeirFrame frame;
    fill_frame(&frame, sim, view, width, height, renderer->format);
    encode(renderer, &frame, group, particles.count, (WGPUTextureView)target);
    renderer->frame_count++;
    return WEIR_OK;
}
