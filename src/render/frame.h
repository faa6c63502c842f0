// What one frame shows, as the shaders take it, made from a view and a simulation.
#pragma once

#include <stddef.h>

#include "core/sim.h"
#include "gpu/gpu.h"
#include "render/color_map.h"

enum {
    WEIR_SHADOW_SIZE = 1024, // texels of the shadow map's side; space.wgsl: shadow_size
    WEIR_HEIGHT_SIZE =
        256, // of the map of the water's height, along the domain's longer side; that of its caustics is
             // twice as large
};

// Copied byte by byte to `struct Frame` of shaders/render/frame.wgsl, which says what each field means.
typedef struct WeirFrame {
    float eye[4], right[4], up[4], ahead[4];
    float projection[4];
    float light_rows[3][4];
    float domain_min[4], domain_max[4];
    float tool_position[4];
    float origin[4];
    uint32_t hidden[4];
    float size[2];
    float center[2];
    float tool_radius, tool_pressed, color_min, color_scale;
    uint32_t color_by, linear_target, first_body, tait;
    float pixels_per_meter, particle_radius, water_radius, line_scale;
    float border, rest_density, sound_speed, background_pressure;
    float quantum, sphere_radius, solid_radius, near;
    float pixel_size, light_range, absorption, occlusion_radius;
    float disc_radius;
    uint32_t faint_sides, water;
    float spacing;
    uint32_t shapes;
    float field_radius, disc_share;
    uint32_t fold, field_texel;
    uint32_t height_columns, height_rows;
    uint32_t photon_columns, photon_rows;
    uint32_t all_shown;
    uint32_t unused[2];
} WeirFrame;
_Static_assert(offsetof(WeirFrame, light_rows) == 80, "frame.wgsl: light_rows");
_Static_assert(offsetof(WeirFrame, hidden) == 192, "frame.wgsl: hidden");
_Static_assert(offsetof(WeirFrame, tool_radius) == 224, "frame.wgsl: tool_radius");
_Static_assert(offsetof(WeirFrame, border) == 272, "frame.wgsl: border");
_Static_assert(sizeof(WeirFrame) == 384, "frame.wgsl: size, a multiple of 16");

// Number of the solids before the scene's own walls: the domain's sides are one, if any is a wall.
uint32_t weir_scene_first_wall(const WeirScene *scene);
// Refuse what cannot be drawn and say why.
WeirStatus weir_frame_check_style(WeirFluidStyle style, WeirMessage *message);
WeirStatus weir_frame_check(const WeirView *view, uint32_t dimension, const void *target, uint32_t width,
                            uint32_t height, WeirMessage *message);
void weir_frame_fill(WeirFrame *frame, const WeirSim *sim, const WeirView *view, uint32_t width,
                     uint32_t height, WGPUTextureFormat format);
