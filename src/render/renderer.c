// The renderer: pipelines made once, one uniform write and one submit per frame, nothing allocated per frame.
#include "render/renderer.h"
#include "core/scene.h"

#include <stdlib.h>
#include <string.h>

static void create_layouts(WeirRenderer *renderer, WGPUDevice device)
{
    WGPUBindGroupLayoutEntry frame_entries[2] = {
        {.binding = 0,
         .visibility = WGPUShaderStage_Vertex | WGPUShaderStage_Fragment | WGPUShaderStage_Compute,
         .buffer = {.type = WGPUBufferBindingType_Uniform, .minBindingSize = sizeof(WeirFrame)}},
        {.binding = 1,
         .visibility = WGPUShaderStage_Vertex | WGPUShaderStage_Fragment,
         .buffer = {.type = WGPUBufferBindingType_Uniform,
                    .minBindingSize = sizeof(uint32_t) * WEIR_COLOR_MAPS * WEIR_COLOR_STEPS}},
    };
    renderer->frame_layout = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 2, .entries = frame_entries});
    // Not read by the fragment stage: many phones give it few storage buffers. Compute passes make the last two.
    WGPUBindGroupLayoutEntry particle_entries[WEIR_PARTICLE_BINDINGS];
    for (uint32_t k = 0; k < WEIR_PARTICLE_BINDINGS; k++) {
        particle_entries[k] = (WGPUBindGroupLayoutEntry){
            .binding = k,
            .visibility = k < 3 ? WGPUShaderStage_Vertex | WGPUShaderStage_Compute : WGPUShaderStage_Vertex,
            .buffer = {.type = WGPUBufferBindingType_ReadOnlyStorage}};
    }
    renderer->particle_layout = wgpuDeviceCreateBindGroupLayout(
        device,
        &(WGPUBindGroupLayoutDescriptor){.entryCount = WEIR_PARTICLE_BINDINGS, .entries = particle_entries});
    // clear_water alone does: three, where WebGPU promises eight.
    for (uint32_t k = 0; k < 3; k++) particle_entries[k].visibility = WGPUShaderStage_Fragment;
    renderer->form_layout = wgpuDeviceCreateBindGroupLayout(
        device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 3, .entries = particle_entries});
    weir_flat_create_layouts(renderer, device);
    weir_space_create_layouts(renderer, device);
    for (int textures = 0; textures < WEIR_TEXTURE_GROUPS; textures++) {
        bool traced = textures == WEIR_TEXTURES_WATER;
        WGPUBindGroupLayout groups[3] = {renderer->frame_layout,
                                         traced ? renderer->form_layout : renderer->particle_layout,
                                         renderer->texture_layouts[textures]};
        renderer->pipeline_layouts[textures] = wgpuDeviceCreatePipelineLayout(
            device, &(WGPUPipelineLayoutDescriptor){
                        .bindGroupLayoutCount = textures == WEIR_TEXTURES_NONE ? 2 : 3,
                        .bindGroupLayouts = groups,
                    });
    }
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
    renderer->nothing = wgpuDeviceCreateBuffer(
        device, &(WGPUBufferDescriptor){.usage = WGPUBufferUsage_Storage, .size = sizeof(WeirSolidState)});
    if (!renderer->frame_buffer || !renderer->color_buffer || !renderer->nothing) return;
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
    if (!renderer->frame_layout) create_layouts(renderer, device);
    create_frame_group(renderer, device, weir_gpu_wgpu_queue(renderer->gpu));
    if (!renderer->profile) renderer->profile = weir_profile_create(renderer->gpu, NULL);
    if (renderer->frame_group) return WEIR_OK;
    return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No device memory for the renderer's uniforms.");
}

static WeirStatus prepare_pipelines(WeirRenderer *renderer, WeirMethod method, uint32_t dimension, bool water)
{
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    bool made = false;
    for (int kind = 0; kind < WEIR_EFFECTS; kind++) {
        WGPURenderPipeline *pipeline = &renderer->pipelines[method][kind];
        if (*pipeline || !weir_effect_needed((WeirEffectKind)kind, dimension, water)) continue;
        made = true;
        WGPUPipelineLayout layout = renderer->pipeline_layouts[weir_effect_textures((WeirEffectKind)kind)];
        *pipeline = weir_effect_create((WeirEffectKind)kind, method, device, layout, renderer->format);
        if (!*pipeline) {
            return weir_fail(&renderer->message, WEIR_ERROR_MEMORY,
                             "No memory for the renderer's pipelines.");
        }
    }
    // Where faults come at once (natively), a pipeline that is none must not be drawn with.
    if (!made || weir_gpu_poll(renderer->gpu) == WEIR_OK) return WEIR_OK;
    return weir_fail(&renderer->message, WEIR_ERROR_DEVICE, "The renderer's pipelines failed: %s.",
                     weir_gpu_error(renderer->gpu));
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
    for (int k = 0; k < WEIR_PARTICLE_BINDINGS; k++) wgpuBufferRelease(slot->buffers[k]);
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
    release_buffer(renderer->nothing);
    for (int method = 0; method < 2; method++) {
        for (int kind = 0; kind < WEIR_EFFECTS; kind++) {
            WGPURenderPipeline pipeline = renderer->pipelines[method][kind];
            if (pipeline) wgpuRenderPipelineRelease(pipeline);
        }
    }
    for (int textures = 0; textures < WEIR_TEXTURE_GROUPS; textures++) {
        WGPUPipelineLayout layout = renderer->pipeline_layouts[textures];
        if (layout) wgpuPipelineLayoutRelease(layout);
    }
    weir_profile_destroy(renderer->profile);
    weir_flat_release(renderer);
    weir_space_release(renderer);
    weir_crowd_release(renderer);
    weir_solids_release(renderer);
    if (renderer->form_layout) wgpuBindGroupLayoutRelease(renderer->form_layout);
    if (renderer->particle_layout) wgpuBindGroupLayoutRelease(renderer->particle_layout);
    if (renderer->frame_layout) wgpuBindGroupLayoutRelease(renderer->frame_layout);
    free(renderer);
}

const char *weir_renderer_error(const WeirRenderer *renderer)
{
    return renderer->message.text;
}

WeirStatus weir_renderer_prepare(WeirRenderer *renderer, const WeirScene *scene, WeirFluidStyle style)
{
    WeirStatus status = weir_frame_check_style(style, &renderer->message);
    if (status == WEIR_OK) status = prepare(renderer);
    if (status != WEIR_OK) return status;
    return prepare_pipelines(renderer, scene->method, scene->dimension, style == WEIR_FLUID_WATER);
}

double weir_renderer_draw_time(const WeirRenderer *renderer)
{
    return weir_profile_step(renderer->profile);
}

// Bind group of these particles: a known one, or a new one in the slot that was not drawn for longest. Slots
// not drawn for a while are given up, so that a destroyed simulation's buffers do not stay in memory.
static WGPUBindGroup particle_group(WeirRenderer *renderer, const WeirGpuParticles *particles,
                                    const WeirCrowd *crowd)
{
    bool wcsph = particles->method == WEIR_METHOD_WCSPH;
    // Bindings that no shader reads get the second one again.
    WGPUBuffer second = wcsph ? particles->motion : particles->velocity;
    WGPUBuffer buffers[WEIR_PARTICLE_BINDINGS] = {
        wcsph ? particles->coordinate : particles->position, second, wcsph ? second : particles->flow,
        crowd ? crowd->values : second, crowd ? crowd->shown : second};
    WeirParticleGroup *oldest = &renderer->groups[0], *found = NULL;
    for (WeirParticleGroup *slot = renderer->groups; slot < renderer->groups + WEIR_PARTICLE_GROUPS; slot++) {
        if (slot->group && memcmp(slot->buffers, buffers, sizeof buffers) == 0) {
            found = slot;
        } else if (slot->last_frame + WEIR_PARTICLE_GROUP_FRAMES < renderer->frame_count) {
            release_group(slot);
        }
        if (oldest->group && (!slot->group || slot->last_frame < oldest->last_frame)) oldest = slot;
    }
    if (!found) {
        found = oldest;
        release_group(found);
        WGPUBindGroupEntry entries[WEIR_PARTICLE_BINDINGS];
        for (uint32_t k = 0; k < WEIR_PARTICLE_BINDINGS; k++) {
            wgpuBufferAddRef(buffers[k]);
            found->buffers[k] = buffers[k];
            entries[k] = (WGPUBindGroupEntry){.binding = k, .buffer = buffers[k], .size = WGPU_WHOLE_SIZE};
        }
        found->group =
            wgpuDeviceCreateBindGroup(weir_gpu_wgpu_device(renderer->gpu),
                                      &(WGPUBindGroupDescriptor){.layout = renderer->particle_layout,
                                                                 .entryCount = WEIR_PARTICLE_BINDINGS,
                                                                 .entries = entries});
    }
    found->last_frame = renderer->frame_count;
    return found->group;
}

void weir_renderer_effect(WeirRenderer *renderer, WGPURenderPassEncoder pass, WeirEffectKind kind,
                          WGPUBindGroup textures, uint32_t number, const WeirDrawing *drawing)
{
    uint32_t vertices = 4, instances = 1;
    WGPUBuffer counted = NULL;
    WGPUBindGroup particles = drawing->particles;
    switch (kind) {
    case WEIR_EFFECT_FIELD:
    case WEIR_EFFECT_SOLID_FIELD:
    case WEIR_EFFECT_WATER:
    case WEIR_EFFECT_PARTICLES:
    case WEIR_EFFECT_HEIGHT:
    case WEIR_EFFECT_THICKNESS:
        instances = drawing->particle_count;
        break;
    case WEIR_EFFECT_SHADOW:
    case WEIR_EFFECT_SPHERES:
    case WEIR_EFFECT_SURFACE:
        counted = renderer->crowd.draw;
        break;
    case WEIR_EFFECT_CAUSTICS:
        instances = drawing->frame->photon_columns * drawing->frame->photon_rows;
        break;
    case WEIR_EFFECT_OVERLAY: // four sides of the outline, then the ring
        instances = drawing->frame->tool_radius > 0.0f ? 5 : 4;
        break;
    case WEIR_EFFECT_EDGES:
    case WEIR_EFFECT_FRONT_EDGES:
        instances = 12;
        break;
    case WEIR_EFFECT_GROUND:
        break;
    case WEIR_EFFECT_SOLIDS:
    case WEIR_EFFECT_SOLID_SHADOW:
        vertices = renderer->solids.shape_count;
        if (vertices == 0) return;
        particles = renderer->solids.group;
        break;
    case WEIR_EFFECT_FLAT_SOLIDS:
        instances = renderer->solids.shape_count;
        if (instances == 0) return;
        particles = renderer->solids.group;
        break;
    case WEIR_EFFECT_CLEAR_WATER:
        particles = renderer->solids.traced;
        vertices = 3;
        break;
    default:
        vertices = 3;
        break; // the whole picture
    }
    wgpuRenderPassEncoderSetPipeline(pass, renderer->pipelines[drawing->method][kind]);
    wgpuRenderPassEncoderSetBindGroup(pass, 0, renderer->frame_group, 0, NULL);
    wgpuRenderPassEncoderSetBindGroup(pass, 1, particles, 0, NULL);
    if (textures) wgpuRenderPassEncoderSetBindGroup(pass, 2, textures, 0, NULL);
    if (counted)
        wgpuRenderPassEncoderDrawIndirect(pass, counted, 0);
    else
        wgpuRenderPassEncoderDraw(pass, vertices, instances, 0, number);
}

static void submit(WeirRenderer *renderer, WeirDrawing *drawing, uint32_t dimension)
{
    WGPUQueue queue = weir_gpu_wgpu_queue(renderer->gpu);
    wgpuQueueWriteBuffer(queue, renderer->frame_buffer, 0, drawing->frame, sizeof *drawing->frame);
    drawing->encoder = wgpuDeviceCreateCommandEncoder(weir_gpu_wgpu_device(renderer->gpu), NULL);
    weir_profile_poll(renderer->profile);
    bool measured = weir_profile_ready(renderer->profile);
    WGPUPassTimestampWrites begins, ends;
    if (measured) {
        weir_profile_start(renderer->profile);
        begins = weir_profile_span_begin(renderer->profile);
        ends = weir_profile_span_end(renderer->profile);
        drawing->begins = &begins;
        drawing->ends = &ends;
    }
    if (dimension == 3)
        weir_space_draw(renderer, drawing);
    else
        weir_flat_draw(renderer, drawing);
    if (measured) weir_profile_resolve(renderer->profile, drawing->encoder);
    WGPUCommandBuffer commands = wgpuCommandEncoderFinish(drawing->encoder, NULL);
    wgpuQueueSubmit(queue, 1, &commands);
    wgpuCommandBufferRelease(commands);
    wgpuCommandEncoderRelease(drawing->encoder);
    if (measured) weir_profile_submitted(renderer->profile);
}

WeirStatus weir_renderer_draw_particles(WeirRenderer *renderer, const WeirSim *sim,
                                        const WeirGpuParticles *particles, const WeirView *view, void *target,
                                        uint32_t width, uint32_t height)
{
    uint32_t dimension = weir_sim_dimension(sim);
    WeirStatus status = prepare(renderer);
    bool water = view->fluid_style == WEIR_FLUID_WATER, deep = dimension == 3;
    if (status == WEIR_OK) status = prepare_pipelines(renderer, particles->method, dimension, water);
    if (status == WEIR_OK) status = weir_solids_prepare(renderer, weir_sim_scene(sim), particles);
    if (status != WEIR_OK) return status;
    WeirFrame frame;
    weir_frame_fill(&frame, sim, view, width, height, renderer->format);
    frame.shapes = renderer->solids.shape_count > 0;
    // Between small spheres one sees to the middle.
    frame.all_shown = renderer->all_shown || (!water && view->particle_radius < 0.5f * frame.spacing);
    if (deep) status = weir_space_prepare(renderer, &frame, width, height);
    if (status == WEIR_OK && deep) status = weir_crowd_prepare(renderer, &frame, particles->count);
    if (status == WEIR_OK && water && !deep) status = weir_flat_prepare(renderer, &frame);
    if (status != WEIR_OK) return status;
    WeirDrawing drawing = {.particles = particle_group(renderer, particles, deep ? &renderer->crowd : NULL),
                           .uncounted = deep ? particle_group(renderer, particles, NULL) : NULL,
                           .particle_count = particles->count,
                           .method = particles->method,
                           .frame = &frame,
                           .water = water,
                           .target = target};
    if (!drawing.particles || (deep && !drawing.uncounted))
        return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No memory to draw the particles.");
    submit(renderer, &drawing, dimension);
    renderer->frame_count++;
    return WEIR_OK;
}

WeirStatus weir_renderer_draw(WeirRenderer *renderer, WeirSim *sim, const WeirView *view, void *target,
                              uint32_t width, uint32_t height)
{
    uint32_t dimension = sim ? weir_sim_dimension(sim) : 2;
    WeirStatus status = weir_frame_check(view, dimension, target, width, height, &renderer->message);
    if (status != WEIR_OK) return status;
    WeirGpuParticles particles;
    if (!sim || !weir_gpu_particles(sim, &particles) || particles.gpu != renderer->gpu) {
        return weir_fail(
            &renderer->message, WEIR_ERROR_INPUT,
            "The simulation does not run on the renderer's device; make it with weir_gpu_backend() of "
            "the same WeirGpu.");
    }
    return weir_renderer_draw_particles(renderer, sim, &particles, view, target, width, height);
}
