// The effects' pipelines: shared text, the method's particles and the effect's own file make one shader; no vertex
// buffers.
#include "render/effect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

extern const char weir_wgsl_render_frame[], weir_wgsl_render_particle[];
extern const char weir_wgsl_render_particles_mueller[], weir_wgsl_render_particles_wcsph[];
extern const char weir_wgsl_render_background[], weir_wgsl_render_water[], weir_wgsl_render_particles[];
extern const char weir_wgsl_render_overlay[], weir_wgsl_render_field[], weir_wgsl_render_solid_field[];
extern const char weir_wgsl_render_bump[], weir_wgsl_render_liquid[];
extern const char weir_wgsl_render_flat_solids[], weir_wgsl_render_solid_state[];
extern const char weir_wgsl_render_space_space[], weir_wgsl_render_space_shadow[];
extern const char weir_wgsl_render_space_backdrop[], weir_wgsl_render_space_ground[];
extern const char weir_wgsl_render_space_spheres[], weir_wgsl_render_space_edges[];
extern const char weir_wgsl_render_space_occlusion[], weir_wgsl_render_space_compose[];
extern const char weir_wgsl_render_space_sphere[], weir_wgsl_render_space_edge[];
extern const char weir_wgsl_render_space_light[], weir_wgsl_render_space_gloss[];
extern const char weir_wgsl_render_space_solid[], weir_wgsl_render_space_solids[];
extern const char weir_wgsl_render_space_solid_shadow[], weir_wgsl_common_rotation[];
extern const char weir_wgsl_render_space_hollows[], weir_wgsl_render_space_liquid[];
extern const char weir_wgsl_render_space_lens[], weir_wgsl_render_space_height[];
extern const char weir_wgsl_render_space_calm[], weir_wgsl_render_space_caustics[];
extern const char weir_wgsl_render_space_surface[], weir_wgsl_render_space_shown[];
extern const char weir_wgsl_render_space_thickness[], weir_wgsl_render_space_smooth[];
extern const char weir_wgsl_render_space_clear_water[], weir_wgsl_render_space_front_edges[];
extern const char weir_wgsl_render_space_pool[], weir_wgsl_render_space_forms[];

typedef enum Target {
    TARGET_PICTURE,   // the caller's
    TARGET_SCENE,     // several samples, with depth
    TARGET_SHADOW,    // depth only
    TARGET_OCCLUSION, // one sample, no depth
    TARGET_COLOR,     // as the scene, one sample, no depth
    TARGET_SURFACE,   // of water, with depth
    TARGET_SMOOTH,    // the same without
    TARGET_THICKNESS, // of water
    TARGET_FIELD,     // of water in 2D
    TARGETS,
} Target;

enum { SHARED = 10 };

typedef struct Effect {
    const char *name; // of the WGSL file; its entry points are NAME_vertex and NAME_fragment
    const char *source;
    Target target;
    WeirTextures textures;
    const char *shared[SHARED]; // texts that others have too
    bool particles;             // reads them
    bool blends;                // premultiplied colours over what is there
    bool adds;                  // to what is there
    bool tests_depth;           // is hidden by what is nearer
    bool writes_depth;
    bool triangles; // a list of them, else a strip
    bool covers;    // alpha is the share of the samples that it covers
} Effect;

#define SPHERE                   weir_wgsl_render_space_sphere
#define LENS                     weir_wgsl_render_space_lens
#define LIGHT                    weir_wgsl_render_space_light
#define POOL                     weir_wgsl_render_space_pool
#define FORMS                    weir_wgsl_render_space_forms
#define GLOSS                    weir_wgsl_render_space_gloss
#define ROTATION                 weir_wgsl_common_rotation
#define SOLID_STATE              weir_wgsl_render_solid_state
#define SOLID                    weir_wgsl_render_space_solid
#define HOLLOWS                  weir_wgsl_render_space_hollows
#define SHOWN                    weir_wgsl_render_space_shown
#define LIQUID                   weir_wgsl_render_space_liquid
#define BUMP                     weir_wgsl_render_bump
#define EDGE                     weir_wgsl_render_space_edge
#define EFFECT(label, text, ...) {.name = label, .source = weir_wgsl_render_##text, __VA_ARGS__}
static const Effect effects[WEIR_EFFECTS] = {
    [WEIR_EFFECT_FIELD] =
        EFFECT("field", field, .target = TARGET_FIELD, .shared = {BUMP}, .particles = true, .adds = true),
    [WEIR_EFFECT_SOLID_FIELD] = EFFECT("solid_field", solid_field, .target = TARGET_FIELD, .shared = {BUMP},
                                       .particles = true, .adds = true),
    [WEIR_EFFECT_BACKGROUND] = EFFECT("background", background, .blends = false),
    [WEIR_EFFECT_LIQUID] = EFFECT("liquid", liquid, .textures = WEIR_TEXTURES_FIELD, .blends = true),
    [WEIR_EFFECT_WATER] = EFFECT("water", water, .particles = true, .blends = true),
    [WEIR_EFFECT_PARTICLES] = EFFECT("particles", particles, .particles = true, .blends = true),
    [WEIR_EFFECT_FLAT_SOLIDS] = EFFECT("flat_solids", flat_solids, .textures = WEIR_TEXTURES_EDGES,
                                       .shared = {ROTATION, SOLID_STATE}, .blends = true),
    [WEIR_EFFECT_OVERLAY] = EFFECT("overlay", overlay, .blends = true),
    [WEIR_EFFECT_SHADOW] = EFFECT("shadow", space_shadow, .target = TARGET_SHADOW, .shared = {SHOWN},
                                  .particles = true, .tests_depth = true, .writes_depth = true),
    [WEIR_EFFECT_SOLID_SHADOW] = EFFECT("solid_shadow", space_solid_shadow, .target = TARGET_SHADOW,
                                        .shared = {ROTATION, SOLID_STATE, SOLID}, .triangles = true,
                                        .tests_depth = true, .writes_depth = true),
    [WEIR_EFFECT_BACKDROP] = EFFECT("backdrop", space_backdrop, .target = TARGET_SCENE),
    [WEIR_EFFECT_GROUND] =
        EFFECT("ground", space_ground, .target = TARGET_SCENE, .textures = WEIR_TEXTURES_LIGHT,
               .shared = {LENS, LIGHT, POOL}, .blends = true, .tests_depth = true, .writes_depth = true),
    [WEIR_EFFECT_SOLIDS] =
        EFFECT("solids", space_solids, .target = TARGET_SCENE, .textures = WEIR_TEXTURES_LIGHT,
               .shared = {LENS, LIGHT, GLOSS, ROTATION, SOLID_STATE, SOLID}, .triangles = true,
               .tests_depth = true, .writes_depth = true),
    [WEIR_EFFECT_SPHERES] =
        EFFECT("spheres", space_spheres, .target = TARGET_SCENE, .textures = WEIR_TEXTURES_LIGHT,
               .shared = {LENS, LIGHT, GLOSS, SPHERE, LIQUID, SHOWN}, .particles = true, .tests_depth = true,
               .writes_depth = true, .covers = true),
    [WEIR_EFFECT_EDGES] = EFFECT("edges", space_edges, .target = TARGET_SCENE, .shared = {EDGE},
                                 .blends = true, .tests_depth = true),
    [WEIR_EFFECT_OCCLUSION] =
        EFFECT("occlusion", space_occlusion, .target = TARGET_OCCLUSION, .textures = WEIR_TEXTURES_DEPTH),
    [WEIR_EFFECT_COMPOSE] =
        EFFECT("compose", space_compose, .textures = WEIR_TEXTURES_COMPOSE, .shared = {HOLLOWS}),
    [WEIR_EFFECT_HEIGHT] = EFFECT("height", space_height, .target = TARGET_THICKNESS,
                                  .shared = {LIQUID, LENS}, .particles = true, .adds = true),
    [WEIR_EFFECT_CALM] =
        EFFECT("calm", space_calm, .target = TARGET_SMOOTH, .textures = WEIR_TEXTURES_SUMS, .shared = {LENS}),
    [WEIR_EFFECT_CAUSTICS] = EFFECT("caustics", space_caustics, .target = TARGET_THICKNESS,
                                    .textures = WEIR_TEXTURES_HEIGHT, .shared = {LENS}, .adds = true),
    [WEIR_EFFECT_SURFACE] =
        EFFECT("surface", space_surface, .target = TARGET_SURFACE, .shared = {SPHERE, LIQUID, SHOWN},
               .particles = true, .tests_depth = true, .writes_depth = true),
    [WEIR_EFFECT_THICKNESS] =
        EFFECT("thickness", space_thickness, .target = TARGET_THICKNESS, .textures = WEIR_TEXTURES_DEPTH,
               .shared = {LIQUID}, .particles = true, .adds = true),
    [WEIR_EFFECT_SMOOTH] = EFFECT("smooth", space_smooth, .target = TARGET_SMOOTH,
                                  .textures = WEIR_TEXTURES_SURFACE, .shared = {LIQUID}),
    [WEIR_EFFECT_CLEAR_WATER] =
        EFFECT("clear_water", space_clear_water, .target = TARGET_COLOR, .textures = WEIR_TEXTURES_WATER,
               .shared = {LENS, LIGHT, HOLLOWS, LIQUID, POOL, GLOSS, ROTATION, SOLID_STATE, SOLID, FORMS}),
    [WEIR_EFFECT_FRONT_EDGES] = EFFECT("front_edges", space_front_edges, .target = TARGET_COLOR,
                                       .textures = WEIR_TEXTURES_SURFACE, .shared = {EDGE}, .blends = true),
};

WeirTextures weir_effect_textures(WeirEffectKind kind)
{
    return effects[kind].textures;
}

bool weir_effect_needed(WeirEffectKind kind, uint32_t dimension, bool water)
{
    if (dimension == 3) return kind >= WEIR_EFFECT_SHADOW && (kind < WEIR_EFFECT_HEIGHT || water);
    bool liquid = kind <= WEIR_EFFECT_SOLID_FIELD || kind == WEIR_EFFECT_LIQUID;
    return kind < WEIR_EFFECT_SHADOW && !(liquid && !water) && !(kind == WEIR_EFFECT_WATER && water);
}

static WGPUStringView text_view(const char *text)
{
    return (WGPUStringView){.data = text, .length = strlen(text)};
}

WGPUShaderModule weir_effect_module(WGPUDevice device, const char *name, const char *const *parts,
                                    size_t count)
{
    size_t length = 0;
    for (size_t k = 0; k < count; k++) length += strlen(parts[k]);
    char *source = malloc(length + 1), *end = source;
    if (!source) return NULL;
    for (size_t k = 0; k < count; k++) {
        size_t size = strlen(parts[k]);
        memcpy(end, parts[k], size);
        end += size;
    }
    WGPUShaderSourceWGSL wgsl = {.chain = {.sType = WGPUSType_ShaderSourceWGSL},
                                 .code = {.data = source, .length = length}};
    WGPUShaderModuleDescriptor descriptor = {.nextInChain = &wgsl.chain, .label = text_view(name)};
    WGPUShaderModule module = wgpuDeviceCreateShaderModule(device, &descriptor);
    free(source);
    return module;
}

static WGPUShaderModule effect_module(const Effect *effect, WeirMethod method, WGPUDevice device)
{
    const char *parts[5 + SHARED] = {weir_wgsl_render_frame};
    size_t count = 1;
    if (effect->particles) {
        parts[count++] = method == WEIR_METHOD_WCSPH ? weir_wgsl_render_particles_wcsph
                                                     : weir_wgsl_render_particles_mueller;
        parts[count++] = weir_wgsl_render_particle;
    }
    if (effect >= &effects[WEIR_EFFECT_SHADOW]) parts[count++] = weir_wgsl_render_space_space;
    for (int k = 0; k < SHARED && effect->shared[k]; k++) parts[count++] = effect->shared[k];
    parts[count++] = effect->source;
    return weir_effect_module(device, effect->name, parts, count);
}

static WGPUTextureFormat color_format(const Effect *effect, WGPUTextureFormat target)
{
    static const WGPUTextureFormat formats[TARGETS] = {
        [TARGET_SCENE] = WEIR_SCENE_FORMAT,    [TARGET_OCCLUSION] = WEIR_OCCLUSION_FORMAT,
        [TARGET_COLOR] = WEIR_SCENE_FORMAT,    [TARGET_SURFACE] = WEIR_SURFACE_FORMAT,
        [TARGET_SMOOTH] = WEIR_SURFACE_FORMAT, [TARGET_THICKNESS] = WEIR_THICKNESS_FORMAT,
        [TARGET_FIELD] = WEIR_FIELD_FORMAT,
    };
    return effect->target == TARGET_PICTURE ? target : formats[effect->target];
}

// The shadow map keeps what is nearest to the light at depth 0; the scene's depth falls with distance.
static WGPUDepthStencilState depth_state(const Effect *effect)
{
    WGPUCompareFunction nearer =
        effect->target == TARGET_SHADOW ? WGPUCompareFunction_Less : WGPUCompareFunction_Greater;
    return (WGPUDepthStencilState){
        .format = WEIR_DEPTH_FORMAT,
        .depthWriteEnabled = effect->writes_depth ? WGPUOptionalBool_True : WGPUOptionalBool_False,
        .depthCompare = effect->tests_depth ? nearer : WGPUCompareFunction_Always,
        .stencilFront = {.compare = WGPUCompareFunction_Always},
        .stencilBack = {.compare = WGPUCompareFunction_Always},
    };
}

WGPURenderPipeline weir_effect_create(WeirEffectKind kind, WeirMethod method, WGPUDevice device,
                                      WGPUPipelineLayout layout, WGPUTextureFormat target)
{
    const Effect *effect = &effects[kind];
    WGPUShaderModule module = effect_module(effect, method, device);
    if (!module) return NULL;
    char vertex_entry[32], fragment_entry[32];
    snprintf(vertex_entry, sizeof vertex_entry, "%s_vertex", effect->name);
    snprintf(fragment_entry, sizeof fragment_entry, "%s_fragment", effect->name);
    WGPUBlendComponent over = {.operation = WGPUBlendOperation_Add,
                               .srcFactor = WGPUBlendFactor_One,
                               .dstFactor = WGPUBlendFactor_OneMinusSrcAlpha};
    if (effect->adds) over.dstFactor = WGPUBlendFactor_One;
    WGPUBlendState blend = {.color = over, .alpha = over};
    WGPUColorTargetState color = {.format = color_format(effect, target),
                                  .blend = effect->blends || effect->adds ? &blend : NULL,
                                  .writeMask = WGPUColorWriteMask_All};
    WGPUFragmentState fragment = {
        .module = module, .entryPoint = text_view(fragment_entry), .targetCount = 1, .targets = &color};
    WGPUDepthStencilState depth = depth_state(effect);
    bool has_depth =
        effect->target == TARGET_SCENE || effect->target == TARGET_SHADOW || effect->target == TARGET_SURFACE;
    WGPURenderPipelineDescriptor descriptor = {
        .label = text_view(effect->name),
        .layout = layout,
        .vertex = {.module = module, .entryPoint = text_view(vertex_entry)},
        .primitive = {.topology = effect->triangles ? WGPUPrimitiveTopology_TriangleList
                                                    : WGPUPrimitiveTopology_TriangleStrip,
                      .frontFace = WGPUFrontFace_CCW,
                      .cullMode = WGPUCullMode_None},
        .depthStencil = has_depth ? &depth : NULL,
        .multisample = {.count = effect->target == TARGET_SCENE ? WEIR_SCENE_SAMPLES : 1,
                        .mask = 0xFFFFFFFF,
                        .alphaToCoverageEnabled = effect->covers},
        .fragment = effect->target == TARGET_SHADOW ? NULL : &fragment,
    };
    WGPURenderPipeline pipeline = wgpuDeviceCreateRenderPipeline(device, &descriptor);
    wgpuShaderModuleRelease(module);
    return pipeline;
}
