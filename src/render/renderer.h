// Inside of the renderer, for its own files and its tests.
#pragma once

#include "gpu/profile.h"
#include "render/effect.h"
#include "render/frame.h"

enum { WEIR_PARTICLE_BINDINGS = 5 }; // shaders/render: group 1

// Bind groups of the particle buffers drawn lately: a simulation shows a few sets of buffers in turn.
typedef struct WeirParticleGroup {
    // As bound; references held, so that no new buffer gets their address.
    WGPUBuffer buffers[WEIR_PARTICLE_BINDINGS];
    WGPUBindGroup group; // NULL: free
    uint64_t last_frame;
} WeirParticleGroup;
enum { WEIR_PARTICLE_GROUPS = 8, WEIR_PARTICLE_GROUP_FRAMES = 120 };

// The textures between the passes of a picture in 3D, and the bind groups that hold them.
typedef enum WeirSpaceTexture {
    WEIR_SPACE_SHADOW,    // the shadow map
    WEIR_SPACE_SAMPLES,   // the scene's colours, several samples per pixel
    WEIR_SPACE_DEPTH,     // its depth, as many samples
    WEIR_SPACE_COLOR,     // its colours, one per pixel
    WEIR_SPACE_OCCLUSION, // half as wide and high
    WEIR_SPACE_SUMS,      // of exponentials of the particles' heights
    WEIR_SPACE_ROWS,      // heights, smoothed along rows
    WEIR_SPACE_HEIGHT,    // of the water's surface over the floor
    WEIR_SPACE_CAUSTICS,  // the light that it bends, on the floor
    // Those of water alone:
    WEIR_SPACE_SURFACE,       // its depth and its share of a pixel
    WEIR_SPACE_SURFACE_2,     // smoothing goes there and back
    WEIR_SPACE_SURFACE_DEPTH, // what tells which sphere is nearer
    WEIR_SPACE_THICKNESS,     // half as wide and high
    WEIR_SPACE_WATER,         // the scene's colours with the water
    WEIR_SPACE_TEXTURES,
} WeirSpaceTexture;

typedef struct WeirSpace {
    uint32_t width, height; // of the picture that they are made for; 0: none yet
    uint32_t map[2];        // columns and rows of the water's heights
    bool water;             // with those of water
    WGPUTexture textures[WEIR_SPACE_TEXTURES];
    WGPUTextureView views[WEIR_SPACE_TEXTURES];
    WGPUBindGroup groups[WEIR_TEXTURE_GROUPS];
} WeirSpace;

// crowd.c: how crowded it is around each particle, and which ones can be seen.
enum { WEIR_CROWD_STAGES = 2 };
typedef struct WeirCrowd {
    WGPUBindGroupLayout layout;
    WGPUPipelineLayout pipeline_layout;
    WGPUComputePipeline pipelines[WEIR_CROWD_STAGES];
    uint32_t count, cell_count; // of particles and cells in the buffers
    WGPUBuffer cells, values, shown;
    WGPUBuffer draw; // what draws those shown: arguments of an indirect draw
    WGPUBindGroup group;
} WeirCrowd;

// solids.c: walls and bodies as shapes.
typedef struct WeirSolids {
    WGPUBuffer states;    // whose shapes these are, a reference; NULL: none
    WGPUBuffer shapes;    // array<WeirCorner>, in 2D array<WeirFlatShape>
    WGPUBindGroup group;  // in place of the particles'
    WGPUBuffer edges;     // 2D: of polygons
    WGPUBindGroup edged;  // they are in
    uint32_t shape_count; // corners, in 2D shapes; 0: walls and bodies are drawn as particles
    WGPUBuffer forms;     // 3D: array<WeirForm>
    WGPUBindGroup traced; // 3D: what rays meet; in place of the particles' too
} WeirSolids;

// flat.c: the fields that water in 2D is made of: of the fluid, of solids.
enum { WEIR_FLAT_TEXTURES = 2 };
typedef struct WeirFlat {
    uint32_t width, height; // texels; 0: none yet
    WGPUTexture textures[WEIR_FLAT_TEXTURES];
    WGPUTextureView views[WEIR_FLAT_TEXTURES];
    WGPUBindGroup group;
} WeirFlat;

struct WeirRenderer {
    WeirGpu *gpu;
    WGPUTextureFormat format;
    // Bind group 0: frame and colour maps, 1: particles, 2: textures.
    WGPUBindGroupLayout frame_layout, particle_layout, texture_layouts[WEIR_TEXTURE_GROUPS];
    WGPUBindGroupLayout form_layout; // group 1 where fragments meet forms with rays
    WGPUPipelineLayout pipeline_layouts[WEIR_TEXTURE_GROUPS];
    WGPURenderPipeline pipelines[2][WEIR_EFFECTS]; // by WeirMethod; made when first drawn
    WGPUBuffer frame_buffer, color_buffer;
    WGPUBuffer nothing; // bound where a scene has no solids: zeros
    WGPUBindGroup frame_group;
    WeirParticleGroup groups[WEIR_PARTICLE_GROUPS];
    WeirFlat flat;
    WeirSpace space;
    WeirCrowd crowd;
    WeirSolids solids;
    uint64_t frame_count;
    uint32_t effects;     // bit per WeirEffectKind that is drawn; all by default
    bool all_shown;       // also those whom others hide on all sides; for tests
    WeirProfile *profile; // of pictures
    WeirMessage message;
};

// What the parts of one frame are recorded with.
typedef struct WeirDrawing {
    WGPUCommandEncoder encoder;
    WGPUBindGroup particles;
    WGPUBindGroup uncounted; // the particles without what crowd.c makes; in 3D
    uint32_t particle_count;
    WeirMethod method;
    const WeirFrame *frame;
    bool water; // the fluid's style
    // Of a picture that is measured, for its first pass and its last one.
    const WGPUPassTimestampWrites *begins, *ends;
    WGPUTextureView target;
} WeirDrawing;

// weir_renderer_draw() with any buffers in place of the simulation's own; the input is not checked.
WeirStatus weir_renderer_draw_particles(WeirRenderer *renderer, const WeirSim *sim,
                                        const WeirGpuParticles *particles, const WeirView *view, void *target,
                                        uint32_t width, uint32_t height);

// Records one effect into a pass, with its bind groups; `textures` is bind group 2, NULL for none. `number` is that of its first
// instance.
void weir_renderer_effect(WeirRenderer *renderer, WGPURenderPassEncoder pass, WeirEffectKind kind,
                          WGPUBindGroup textures, uint32_t number, const WeirDrawing *drawing);

// flat.c
void weir_flat_create_layouts(WeirRenderer *renderer, WGPUDevice device);
// Makes the fields for a picture, if they are not there.
WeirStatus weir_flat_prepare(WeirRenderer *renderer, const WeirFrame *frame);
void weir_flat_draw(WeirRenderer *renderer, const WeirDrawing *drawing);
void weir_flat_release(WeirRenderer *renderer);

// crowd.c
WeirStatus weir_crowd_prepare(WeirRenderer *renderer, const WeirFrame *frame, uint32_t count);
// The first pass of a picture in 3D.
void weir_crowd_count(WeirRenderer *renderer, const WeirDrawing *drawing);
void weir_crowd_release(WeirRenderer *renderer);

// solids.c
WeirStatus weir_solids_prepare(WeirRenderer *renderer, const WeirScene *scene,
                               const WeirGpuParticles *particles);
void weir_solids_release(WeirRenderer *renderer);

// space.c
void weir_space_create_layouts(WeirRenderer *renderer, WGPUDevice device);
// Makes the textures for a picture of that size, if they are not there.
WeirStatus weir_space_prepare(WeirRenderer *renderer, const WeirFrame *frame, uint32_t width,
                              uint32_t height);
void weir_space_draw(WeirRenderer *renderer, const WeirDrawing *drawing);
void weir_space_release(WeirRenderer *renderer);
