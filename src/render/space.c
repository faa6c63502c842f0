// A picture in 3D: shadow map, the scene with several samples per pixel, the occlusion of its hollows, the water, and
// the whole.
#include "render/renderer.h"

// What the effects' bind group 2 holds, binding by binding; ends with WEIR_SPACE_TEXTURES.
enum { MOST_BOUND = 10 };
static const WeirSpaceTexture bound[WEIR_TEXTURE_GROUPS][MOST_BOUND] = {
    [WEIR_TEXTURES_LIGHT] = {WEIR_SPACE_SHADOW, WEIR_SPACE_HEIGHT, WEIR_SPACE_CAUSTICS, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_DEPTH] = {WEIR_SPACE_DEPTH, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_SUMS] = {WEIR_SPACE_SUMS, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_ROWS] = {WEIR_SPACE_ROWS, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_HEIGHT] = {WEIR_SPACE_HEIGHT, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_COMPOSE] = {WEIR_SPACE_DEPTH, WEIR_SPACE_COLOR, WEIR_SPACE_OCCLUSION, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_FINISH] = {WEIR_SPACE_DEPTH, WEIR_SPACE_WATER, WEIR_SPACE_OCCLUSION, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_SURFACE] = {WEIR_SPACE_SURFACE, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_SURFACE_2] = {WEIR_SPACE_SURFACE_2, WEIR_SPACE_TEXTURES},
    [WEIR_TEXTURES_WATER] = {WEIR_SPACE_SHADOW, WEIR_SPACE_HEIGHT, WEIR_SPACE_CAUSTICS, WEIR_SPACE_SURFACE,
                             WEIR_SPACE_THICKNESS, WEIR_SPACE_DEPTH, WEIR_SPACE_SAMPLES, WEIR_SPACE_COLOR,
                             WEIR_SPACE_OCCLUSION, WEIR_SPACE_TEXTURES},
};

// The groups of water need its textures.
static bool is_of_water(WeirTextures group)
{
    return group >= WEIR_TEXTURES_FINISH;
}

static WGPUTextureBindingLayout binding_layout(WeirSpaceTexture texture)
{
    bool depth = texture == WEIR_SPACE_SHADOW || texture == WEIR_SPACE_DEPTH;
    return (WGPUTextureBindingLayout){
        // Textures are read texel by texel: filters would need more than every device has.
        .sampleType = depth ? WGPUTextureSampleType_Depth : WGPUTextureSampleType_UnfilterableFloat,
        .viewDimension = WGPUTextureViewDimension_2D,
        .multisampled = texture == WEIR_SPACE_DEPTH || texture == WEIR_SPACE_SAMPLES,
    };
}

void weir_space_create_layouts(WeirRenderer *renderer, WGPUDevice device)
{
    for (int group = WEIR_TEXTURES_LIGHT; group < WEIR_TEXTURE_GROUPS; group++) {
        WGPUBindGroupLayoutEntry entries[MOST_BOUND];
        uint32_t count = 0;
        for (; bound[group][count] != WEIR_SPACE_TEXTURES; count++) {
            entries[count] =
                (WGPUBindGroupLayoutEntry){.binding = count,
                                           .visibility = WGPUShaderStage_Vertex | WGPUShaderStage_Fragment,
                                           .texture = binding_layout(bound[group][count])};
        }
        renderer->texture_layouts[group] = wgpuDeviceCreateBindGroupLayout(
            device, &(WGPUBindGroupLayoutDescriptor){.entryCount = count, .entries = entries});
    }
}

static void release_sized(WeirSpace *space)
{
    for (int group = 0; group < WEIR_TEXTURE_GROUPS; group++) {
        if (space->groups[group]) wgpuBindGroupRelease(space->groups[group]);
        space->groups[group] = NULL;
    }
    for (int k = 0; k < WEIR_SPACE_TEXTURES; k++) {
        if (space->views[k]) wgpuTextureViewRelease(space->views[k]);
        if (space->textures[k]) {
            wgpuTextureDestroy(space->textures[k]);
            wgpuTextureRelease(space->textures[k]);
        }
        space->views[k] = NULL;
        space->textures[k] = NULL;
    }
    space->width = space->height = 0;
}

void weir_space_release(WeirRenderer *renderer)
{
    release_sized(&renderer->space);
    for (int group = WEIR_TEXTURES_LIGHT; group < WEIR_TEXTURE_GROUPS; group++) {
        if (renderer->texture_layouts[group]) wgpuBindGroupLayoutRelease(renderer->texture_layouts[group]);
    }
}

static bool create_textures(WeirSpace *space, WGPUDevice device)
{
    const uint32_t width = space->width, height = space->height, *map = space->map;
    const bool water = space->water;
    const uint32_t half[2] = {(width + 1) / 2, (height + 1) / 2};
    const WGPUTextureUsage drawn = WGPUTextureUsage_RenderAttachment;
    const WGPUTextureUsage read = WGPUTextureUsage_RenderAttachment | WGPUTextureUsage_TextureBinding;
    const struct {
        WGPUTextureFormat format;
        WGPUTextureUsage usage;
        uint32_t width, height, samples;
    } wanted[WEIR_SPACE_TEXTURES] = {
        [WEIR_SPACE_SHADOW] = {WEIR_DEPTH_FORMAT, read, WEIR_SHADOW_SIZE, WEIR_SHADOW_SIZE, 1},
        [WEIR_SPACE_SAMPLES] = {WEIR_SCENE_FORMAT, water ? read : drawn, width, height, WEIR_SCENE_SAMPLES},
        [WEIR_SPACE_DEPTH] = {WEIR_DEPTH_FORMAT, read, width, height, WEIR_SCENE_SAMPLES},
        [WEIR_SPACE_COLOR] = {WEIR_SCENE_FORMAT, read, width, height, 1},
        [WEIR_SPACE_OCCLUSION] = {WEIR_OCCLUSION_FORMAT, read, half[0], half[1], 1},
        [WEIR_SPACE_SUMS] = {WEIR_THICKNESS_FORMAT, read, map[0], map[1], 1},
        [WEIR_SPACE_ROWS] = {WEIR_SURFACE_FORMAT, read, map[0], map[1], 1},
        [WEIR_SPACE_HEIGHT] = {WEIR_SURFACE_FORMAT, read, map[0], map[1], 1},
        [WEIR_SPACE_CAUSTICS] = {WEIR_THICKNESS_FORMAT, read, 2 * map[0], 2 * map[1], 1},
        [WEIR_SPACE_SURFACE] = {WEIR_SURFACE_FORMAT, read, width, height, 1},
        [WEIR_SPACE_SURFACE_2] = {WEIR_SURFACE_FORMAT, read, width, height, 1},
        [WEIR_SPACE_SURFACE_DEPTH] = {WEIR_DEPTH_FORMAT, drawn, width, height, 1},
        [WEIR_SPACE_THICKNESS] = {WEIR_THICKNESS_FORMAT, read, half[0], half[1], 1},
        [WEIR_SPACE_WATER] = {WEIR_SCENE_FORMAT, read, width, height, 1},
    };
    int count = water ? WEIR_SPACE_TEXTURES : WEIR_SPACE_SURFACE;
    for (int k = 0; k < count; k++) {
        space->textures[k] = wgpuDeviceCreateTexture(
            device, &(WGPUTextureDescriptor){.usage = wanted[k].usage,
                                             .dimension = WGPUTextureDimension_2D,
                                             .size = {wanted[k].width, wanted[k].height, 1},
                                             .format = wanted[k].format,
                                             .mipLevelCount = 1,
                                             .sampleCount = wanted[k].samples});
        if (!space->textures[k]) return false;
        space->views[k] = wgpuTextureCreateView(space->textures[k], NULL);
        if (!space->views[k]) return false;
    }
    return true;
}

static bool create_groups(WeirRenderer *renderer, WGPUDevice device)
{
    WeirSpace *space = &renderer->space;
    for (int group = WEIR_TEXTURES_LIGHT; group < WEIR_TEXTURE_GROUPS; group++) {
        if (is_of_water((WeirTextures)group) && !space->water) continue;
        WGPUBindGroupEntry entries[MOST_BOUND];
        uint32_t count = 0;
        for (; bound[group][count] != WEIR_SPACE_TEXTURES; count++) {
            entries[count] =
                (WGPUBindGroupEntry){.binding = count, .textureView = space->views[bound[group][count]]};
        }
        space->groups[group] =
            wgpuDeviceCreateBindGroup(device, &(WGPUBindGroupDescriptor){
                                                  .layout = renderer->texture_layouts[group],
                                                  .entryCount = count,
                                                  .entries = entries,
                                              });
        if (!space->groups[group]) return false;
    }
    return true;
}

WeirStatus weir_space_prepare(WeirRenderer *renderer, const WeirFrame *frame, uint32_t width, uint32_t height)
{
    WeirSpace *space = &renderer->space;
    const bool water = frame->water != 0;
    if (space->width == width && space->height == height && space->water == water &&
        space->map[0] == frame->height_columns && space->map[1] == frame->height_rows)
        return WEIR_OK;
    release_sized(space);
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    space->width = width;
    space->height = height;
    space->water = water;
    space->map[0] = frame->height_columns;
    space->map[1] = frame->height_rows;
    if (!create_textures(space, device) || !create_groups(renderer, device)) {
        release_sized(space);
        return weir_fail(&renderer->message, WEIR_ERROR_MEMORY,
                         "No device memory for the textures of a picture of %u x %u pixels.", width, height);
    }
    return WEIR_OK;
}

// A pass over the effects from `first` to `last` that are switched on.
static void draw_pass(WeirRenderer *renderer, const WeirDrawing *drawing,
                      const WGPURenderPassColorAttachment *color,
                      const WGPURenderPassDepthStencilAttachment *depth, WeirEffectKind first,
                      WeirEffectKind last)
{
    WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(
        drawing->encoder,
        &(WGPURenderPassDescriptor){.colorAttachmentCount = color ? 1 : 0,
                                    .colorAttachments = color,
                                    .depthStencilAttachment = depth,
                                    .timestampWrites = last == WEIR_EFFECT_COMPOSE ? drawing->ends : NULL});
    for (int kind = (int)first; kind <= (int)last; kind++) {
        WeirTextures textures = weir_effect_textures((WeirEffectKind)kind);
        if (textures == WEIR_TEXTURES_COMPOSE && drawing->water) textures = WEIR_TEXTURES_FINISH;
        if (renderer->effects & 1u << kind)
            weir_renderer_effect(renderer, pass, (WeirEffectKind)kind, renderer->space.groups[textures], 0,
                                 drawing);
    }
    wgpuRenderPassEncoderEnd(pass);
    wgpuRenderPassEncoderRelease(pass);
}

static WGPURenderPassColorAttachment cleared(WGPUTextureView view)
{
    return (WGPURenderPassColorAttachment){.view = view,
                                           .depthSlice = WGPU_DEPTH_SLICE_UNDEFINED,
                                           .loadOp = WGPULoadOp_Clear,
                                           .storeOp = WGPUStoreOp_Store,
                                           .clearValue = {.a = 1.0}};
}

static WGPURenderPassDepthStencilAttachment cleared_depth(WGPUTextureView view, float value)
{
    return (WGPURenderPassDepthStencilAttachment){.view = view,
                                                  .depthLoadOp = WGPULoadOp_Clear,
                                                  .depthStoreOp = WGPUStoreOp_Store,
                                                  .depthClearValue = value};
}

// One effect alone into a texture.
static void draw_into(WeirRenderer *renderer, const WeirDrawing *drawing, WeirSpaceTexture texture,
                      WeirEffectKind kind)
{
    WGPURenderPassColorAttachment color = cleared(renderer->space.views[texture]);
    color.clearValue.a = 0.0; // sums begin with nothing
    draw_pass(renderer, drawing, &color, NULL, kind, kind);
}

// One of an effect's passes, which reads what the one before it made.
static void draw_number(WeirRenderer *renderer, const WeirDrawing *drawing, WeirSpaceTexture texture,
                        WeirEffectKind kind, WeirTextures textures, uint32_t number)
{
    if (!(renderer->effects & 1u << kind)) return;
    WGPURenderPassColorAttachment color = cleared(renderer->space.views[texture]);
    WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(
        drawing->encoder, &(WGPURenderPassDescriptor){.colorAttachmentCount = 1, .colorAttachments = &color});
    weir_renderer_effect(renderer, pass, kind, renderer->space.groups[textures], number, drawing);
    wgpuRenderPassEncoderEnd(pass);
    wgpuRenderPassEncoderRelease(pass);
}

// An even number of passes, so that the result lies where the surface was drawn.
static void smooth_surface(WeirRenderer *renderer, const WeirDrawing *drawing)
{
    enum { PASSES = 8 };
    for (uint32_t k = 0; k < PASSES; k++) {
        bool back = k % 2;
        draw_number(renderer, drawing, back ? WEIR_SPACE_SURFACE : WEIR_SPACE_SURFACE_2, WEIR_EFFECT_SMOOTH,
                    back ? WEIR_TEXTURES_SURFACE_2 : WEIR_TEXTURES_SURFACE, k);
    }
}

// The water over the scene that has been drawn.
static void draw_water(WeirRenderer *renderer, const WeirDrawing *drawing)
{
    const WGPUTextureView *views = renderer->space.views;
    WGPURenderPassColorAttachment color = cleared(views[WEIR_SPACE_SURFACE]);
    WGPURenderPassDepthStencilAttachment depth = cleared_depth(views[WEIR_SPACE_SURFACE_DEPTH], 0.0f);
    depth.depthStoreOp = WGPUStoreOp_Discard;
    draw_pass(renderer, drawing, &color, &depth, WEIR_EFFECT_SURFACE, WEIR_EFFECT_SURFACE);
    draw_into(renderer, drawing, WEIR_SPACE_THICKNESS, WEIR_EFFECT_THICKNESS);
    smooth_surface(renderer, drawing);
    color = cleared(views[WEIR_SPACE_WATER]);
    draw_pass(renderer, drawing, &color, NULL, WEIR_EFFECT_CLEAR_WATER, WEIR_EFFECT_FRONT_EDGES);
}

void weir_space_draw(WeirRenderer *renderer, const WeirDrawing *drawing)
{
    const WGPUTextureView *views = renderer->space.views;
    weir_crowd_count(renderer, drawing);
    WGPURenderPassDepthStencilAttachment depth = cleared_depth(views[WEIR_SPACE_SHADOW], 1.0f);
    draw_pass(renderer, drawing, NULL, &depth, WEIR_EFFECT_SHADOW, WEIR_EFFECT_SOLID_SHADOW);
    if (drawing->water) {
        draw_into(renderer, drawing, WEIR_SPACE_SUMS, WEIR_EFFECT_HEIGHT);
        draw_number(renderer, drawing, WEIR_SPACE_ROWS, WEIR_EFFECT_CALM, WEIR_TEXTURES_SUMS, 0);
        draw_number(renderer, drawing, WEIR_SPACE_HEIGHT, WEIR_EFFECT_CALM, WEIR_TEXTURES_ROWS, 1);
        draw_into(renderer, drawing, WEIR_SPACE_CAUSTICS, WEIR_EFFECT_CAUSTICS);
    }
    WGPURenderPassColorAttachment color = cleared(views[WEIR_SPACE_SAMPLES]);
    color.resolveTarget = views[WEIR_SPACE_COLOR];
    if (!drawing->water) color.storeOp = WGPUStoreOp_Discard;
    depth = cleared_depth(views[WEIR_SPACE_DEPTH], 0.0f);
    draw_pass(renderer, drawing, &color, &depth, WEIR_EFFECT_BACKDROP, WEIR_EFFECT_EDGES);
    draw_into(renderer, drawing, WEIR_SPACE_OCCLUSION, WEIR_EFFECT_OCCLUSION);
    if (drawing->water) draw_water(renderer, drawing);
    color = cleared(drawing->target);
    draw_pass(renderer, drawing, &color, NULL, WEIR_EFFECT_COMPOSE, WEIR_EFFECT_COMPOSE);
}
