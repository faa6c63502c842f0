// Inside of the renderer, for its own files and its tests.
#pragma once

#include <stddef.h>

#include "gpu/gpu.h"
#include "render/color_map.h"

// What one frame shows, copied byte by byte to `struct Frame` of shaders/render/frame.wgsl.
typedef struct WeirFrame {
    float center[2];
    float size[2];
    float domain_min[2];
    float domain_max[2];
    float tool_position[2];
    float tool_radius;
    float tool_pressed;
    float color_min;
    float color_scale;
    uint32_t color_by;
    uint32_t linear_target;
    float pixels_per_meter;
    float particle_radius;
    float body_radius;
    float line_scale;
    float rest_density;
    float unused;
} WeirFrame;
_Static_assert(offsetof(WeirFrame, tool_radius) == 40, "frame.wgsl: tool_radius");
_Static_assert(offsetof(WeirFrame, color_by) == 56, "frame.wgsl: color_by");
_Static_assert(offsetof(WeirFrame, rest_density) == 80, "frame.wgsl: rest_density");
_Static_assert(sizeof(WeirFrame) == 88, "frame.wgsl: size, a multiple of 8");

// The effects in the order they are drawn; one WGSL file each.
typedef enum WeirEffectKind {
    WEIR_EFFECT_BACKGROUND,
    WEIR_EFFECT_BODY,
    WEIR_EFFECT_PARTICLES,
    WEIR_EFFECT_OVERLAY,
    WEIR_EFFECTS, // how many
} WeirEffectKind;

// What the effects share: layouts of bind group 0 (frame, colour maps) and 1 (particles).
typedef struct WeirEffectSetup {
    WGPUDevice device;
    WGPUPipelineLayout layout;
    WGPUTextureFormat format;
} WeirEffectSetup;
// Builds the pipeline of one effect; NULL if memory runs out. Faults of the shader go to the device.
WGPURenderPipeline weir_effect_create(WeirEffectKind kind, const WeirEffectSetup *setup);
// Records one effect into a pass whose bind groups are set.
void weir_effect_draw(WeirEffectKind kind, WGPURenderPipeline pipeline, WGPURenderPassEncoder pass,
                      const WeirFrame *frame, uint32_t particle_count);

// Bind groups of the particle buffers drawn lately: a simulation shows a few sets of buffers in turn.
typedef struct WeirParticleGroup {
    WGPUBuffer
        buffers[3]; // position, velocity, flow; references held, so that no new buffer gets their address
    WGPUBindGroup group; // NULL: free
    uint64_t last_frame;
} WeirParticleGroup;
enum { WEIR_PARTICLE_GROUPS = 8, WEIR_PARTICLE_GROUP_FRAMES = 120 };

struct WeirRenderer {
    WeirGpu *gpu;
    WGPUTextureFormat format;
    WGPUBindGroupLayout frame_layout, particle_layout;
    WGPUPipelineLayout pipeline_layout;
    WGPURenderPipeline pipelines[WEIR_EFFECTS];
    WGPUBuffer frame_buffer, color_buffer;
    WGPUBindGroup frame_group;
    WeirParticleGroup groups[WEIR_PARTICLE_GROUPS];
    uint64_t frame_count;
    uint32_t effects; // bit per WeirEffectKind that is drawn; all by default
    WeirMessage message;
};
