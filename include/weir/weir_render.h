// Draws a simulation that runs on the GPU: in 2D every particle a round anti-aliased disc, in 3D a shaded sphere,
// the fluid coloured by a quantity; or the fluid as water with a smooth surface, in 2D coloured too, in 3D clear. Walls and
// bodies are drawn as their shapes, where they are at the moment. All drawing reads the solver's own buffers; nothing is copied
// to the host. Link weir_render.
#pragma once

#include "weir/weir_gpu.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct WeirRenderer WeirRenderer;

typedef enum WeirColorBy {
    WEIR_COLOR_SPEED,         // m/s
    WEIR_COLOR_DENSITY,       // kg/m^3
    WEIR_COLOR_DENSITY_ERROR, // (rho - rho0) / rho0
    WEIR_COLOR_PRESSURE,      // Pa
} WeirColorBy;

// How the fluid is drawn.
typedef enum WeirFluidStyle {
    WEIR_FLUID_PARTICLES, // discs or shaded spheres, coloured by a quantity
    WEIR_FLUID_WATER, // one body of water. 3D: it has no colour map: color_by, color_min and color_max are unused
} WeirFluidStyle;

// What one frame shows. Lengths in metres unless said otherwise.
typedef struct WeirView {
    WeirColorBy color_by;
    float color_min, color_max; // values at the two ends of the colour map, clamped beyond
    float particle_radius;      // drawn radius of a particle; at least 0.5 pixels are drawn
    float tool_position[3];     // the pointer tool's ring
    float tool_radius;          // 0: no ring
    float tool_pressed;         // 0 to 1: the ring is brighter while the tool acts
    // Simulations in 2D:
    float center[2];        // point of the domain in the middle of the picture
    float pixels_per_meter; // of the target's own (device) pixels
    // Simulations in 3D. The camera looks at the target from `distance` away; yaw 0 and pitch 0 look along -z with
    // x to the right, a positive yaw moves the camera towards +x, a positive pitch upwards.
    float camera_target[3];
    float camera_yaw, camera_pitch; // rad; pitch between -1.57 and 1.57
    float camera_distance;
    float camera_field_of_view; // rad, of the picture's height
    float camera_shift[2];      // where the target appears: 0, 0 in the middle, 1, 1 at the top right corner
    WeirFluidStyle fluid_style;
} WeirView;

// The camera as a matrix, column by column: clip = matrix * (x, y, z, 1). Depth (clip z / clip w) is 1 at the near
// plane and goes to 0 far away.
void weir_view_matrix(const WeirView *view, uint32_t width, uint32_t height, float matrix[16]);
// The ray from the camera through the pixel x, y (y down); `direction` has length 1.
void weir_view_ray(const WeirView *view, uint32_t width, uint32_t height, float x, float y, float origin[3],
                   float direction[3]);

// How a wall or body (0, 1, ... as in WEIR_FIELD_GROUP - 1) is drawn. Hidden are the domain's own sides, which its
// outline shows, and in 3D walls around the fluid, which would hide it.
typedef enum WeirLook { WEIR_LOOK_HIDDEN, WEIR_LOOK_WALL, WEIR_LOOK_BODY } WeirLook;
WeirLook weir_scene_look(const WeirScene *scene, uint32_t solid);

// For a colour target of `format`, a WGPUTextureFormat. NULL only if memory runs out.
WeirRenderer *weir_renderer_create(WeirGpu *gpu, uint32_t format);
// Makes the pipelines that pictures of such scenes need, which their first picture does otherwise: to be called when a simulation
// is made, a browser then compiles both at the same time. Faults of shaders show in weir_gpu_poll(). WEIR_ERROR_INPUT for an
// unknown style.
WeirStatus weir_renderer_prepare(WeirRenderer *renderer, const WeirScene *scene, WeirFluidStyle style);
void weir_renderer_destroy(WeirRenderer *renderer); // NULL is allowed
// Queues one frame into `target`, a WGPUTextureView of width x height pixels. WEIR_ERROR_INPUT if `sim` does not
// run on the renderer's device.
WeirStatus weir_renderer_draw(WeirRenderer *renderer, WeirSim *sim, const WeirView *view, void *target,
                              uint32_t width, uint32_t height);
// Milliseconds that the device takes for a picture, averaged over those drawn lately; 0 where it gives no times or none is known
// yet.
double weir_renderer_draw_time(const WeirRenderer *renderer);
// Message of the last call that failed; "" if none.
const char *weir_renderer_error(const WeirRenderer *renderer);
// sRGB bytes of the colour map at `t` in 0..1, the same as the shader's: for legends and the CPU fallback.
void weir_color_map(WeirColorBy color_by, float t, uint8_t rgb[3]);

#ifdef __cplusplus
}
#endif
