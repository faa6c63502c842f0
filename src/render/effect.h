// The effects of a frame and their pipelines.
#pragma once

#include "gpu/gpu.h"

// In the order in which they are drawn; one WGSL file each. First those of a picture in 2D, then those in 3D.
typedef enum WeirEffectKind {
    WEIR_EFFECT_FIELD,       // of water in 2D alone
    WEIR_EFFECT_SOLID_FIELD, // likewise
    WEIR_EFFECT_BACKGROUND,
    WEIR_EFFECT_LIQUID, // of water in 2D alone
    WEIR_EFFECT_WATER,  // of particles in 2D alone
    WEIR_EFFECT_PARTICLES,
    WEIR_EFFECT_FLAT_SOLIDS,
    WEIR_EFFECT_OVERLAY,
    WEIR_EFFECT_SHADOW,
    WEIR_EFFECT_SOLID_SHADOW,
    WEIR_EFFECT_BACKDROP,
    WEIR_EFFECT_GROUND,
    WEIR_EFFECT_SOLIDS,
    WEIR_EFFECT_SPHERES,
    WEIR_EFFECT_EDGES,
    WEIR_EFFECT_OCCLUSION,
    WEIR_EFFECT_COMPOSE,
    // Those of water in 3D alone:
    WEIR_EFFECT_HEIGHT,
    WEIR_EFFECT_CALM,
    WEIR_EFFECT_CAUSTICS,
    WEIR_EFFECT_SURFACE,
    WEIR_EFFECT_THICKNESS,
    WEIR_EFFECT_SMOOTH,
    WEIR_EFFECT_CLEAR_WATER,
    WEIR_EFFECT_FRONT_EDGES,
    WEIR_EFFECTS, // how many
} WeirEffectKind;

enum { WEIR_SCENE_SAMPLES = 4 };                             // of a pixel of the scene in 3D
#define WEIR_SCENE_FORMAT     WGPUTextureFormat_RGBA8Unorm   // its colours, sRGB
#define WEIR_DEPTH_FORMAT     WGPUTextureFormat_Depth32Float // its depth, and the shadow map's
#define WEIR_OCCLUSION_FORMAT WGPUTextureFormat_RG16Float
#define WEIR_SURFACE_FORMAT   WGPUTextureFormat_RG32Float // the water's depth, and its share of a pixel
#define WEIR_THICKNESS_FORMAT                                                                                \
    WGPUTextureFormat_RGBA16Float                       // sums: of water and foam, m; of heights; of light
#define WEIR_FIELD_FORMAT WGPUTextureFormat_RGBA16Float // sums over particles in 2D

// What bind group 2 holds: nothing, or what effects read beside the particles.
typedef enum WeirTextures {
    WEIR_TEXTURES_NONE,
    // 2D, flat.c:
    WEIR_TEXTURES_FIELD, // the sums over particles
    WEIR_TEXTURES_EDGES, // no texture, but the polygons' edges
    // 3D, space.c:
    WEIR_TEXTURES_LIGHT,     // the shadow map, the water's height, its caustics
    WEIR_TEXTURES_DEPTH,     // the scene's depth
    WEIR_TEXTURES_SUMS,      // the sums of its height
    WEIR_TEXTURES_ROWS,      // the same smoothed along rows
    WEIR_TEXTURES_HEIGHT,    // the water's height
    WEIR_TEXTURES_COMPOSE,   // depth, colour, occlusion
    WEIR_TEXTURES_FINISH,    // the same with the water's colour
    WEIR_TEXTURES_SURFACE,   // the water's surface
    WEIR_TEXTURES_SURFACE_2, // the same after an odd number of passes of smoothing
    WEIR_TEXTURES_WATER,     // all that clear_water reads
    WEIR_TEXTURE_GROUPS,
} WeirTextures;

// One shader of several texts; NULL if memory runs out.
WGPUShaderModule weir_effect_module(WGPUDevice device, const char *name, const char *const *parts,
                                    size_t count);
WeirTextures weir_effect_textures(WeirEffectKind kind);
// Whether a picture has it, with the fluid as water or as particles.
bool weir_effect_needed(WeirEffectKind kind, uint32_t dimension, bool water);
// Builds the pipeline of one effect; `target` is the format of the picture in the end. NULL if memory runs out. Faults
// of the shader go to the device.
WGPURenderPipeline weir_effect_create(WeirEffectKind kind, WeirMethod method, WGPUDevice device,
                                      WGPUPipelineLayout layout, WGPUTextureFormat target);
