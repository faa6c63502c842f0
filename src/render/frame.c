#include "render/frame.h"

#include <math.h>

#include "core/scene.h"
#include "render/camera.h"

// Towards the light, a unit vector; space.wgsl: sun.
static const float light_direction[3] = {-0.3496f, 0.8591f, 0.3737f};
enum { LEAST_HEIGHT_SIZE = 32 }; // texels of the map of heights along the shorter side

typedef struct Check {
    const char *name;
    float value;
    bool positive; // else any finite number
} Check;

static WeirStatus check_numbers(const Check *checks, size_t count, WeirMessage *message)
{
    for (size_t k = 0; k < count; k++) {
        if (isfinite(checks[k].value) && (!checks[k].positive || checks[k].value > 0.0f)) continue;
        return weir_fail(message, WEIR_ERROR_INPUT, "%s is %g; it must be a finite number%s.", checks[k].name,
                         (double)checks[k].value, checks[k].positive ? " above 0" : "");
    }
    return WEIR_OK;
}

static WeirStatus check_camera(const WeirView *view, WeirMessage *message)
{
    const Check checks[] = {
        {"camera_target[0]", view->camera_target[0], false},
        {"camera_target[1]", view->camera_target[1], false},
        {"camera_target[2]", view->camera_target[2], false},
        {"camera_yaw", view->camera_yaw, false},
        {"camera_distance", view->camera_distance, true},
        {"camera_shift[0]", view->camera_shift[0], false},
        {"camera_shift[1]", view->camera_shift[1], false},
    };
    if (!(fabsf(view->camera_pitch) <= 1.571f)) {
        return weir_fail(message, WEIR_ERROR_INPUT, "camera_pitch is %g; it must be between -1.57 and 1.57.",
                         (double)view->camera_pitch);
    }
    if (!(view->camera_field_of_view >= 0.01f && view->camera_field_of_view <= 3.0f)) {
        return weir_fail(message, WEIR_ERROR_INPUT,
                         "camera_field_of_view is %g; it must be between 0.01 and 3 rad.",
                         (double)view->camera_field_of_view);
    }
    return check_numbers(checks, sizeof checks / sizeof *checks, message);
}

WeirStatus weir_frame_check_style(WeirFluidStyle style, WeirMessage *message)
{
    if ((uint32_t)style <= WEIR_FLUID_WATER) return WEIR_OK;
    return weir_fail(message, WEIR_ERROR_INPUT, "fluid_style is %u; allowed are 0 and 1.", (unsigned)style);
}

WeirStatus weir_frame_check(const WeirView *view, uint32_t dimension, const void *target, uint32_t width,
                            uint32_t height, WeirMessage *message)
{
    if (!view || !target) return weir_fail(message, WEIR_ERROR_INPUT, "A frame needs a view and a target.");
    if (width == 0 || height == 0) {
        return weir_fail(message, WEIR_ERROR_INPUT, "The target is %u x %u pixels; both must be at least 1.",
                         width, height);
    }
    if ((uint32_t)view->color_by >= WEIR_COLOR_MAPS) {
        return weir_fail(message, WEIR_ERROR_INPUT, "color_by is %u; allowed are 0 to %d.",
                         (unsigned)view->color_by, WEIR_COLOR_MAPS - 1);
    }
    WeirStatus status = weir_frame_check_style(view->fluid_style, message);
    if (status != WEIR_OK) return status;
    const Check shared[] = {
        {"color_min", view->color_min, false},
        {"color_max", view->color_max, false},
        {"particle_radius", view->particle_radius, true},
        {"tool_position[0]", view->tool_position[0], false},
        {"tool_position[1]", view->tool_position[1], false},
        {"tool_position[2]", view->tool_position[2], false},
        {"tool_radius", view->tool_radius, false},
        {"tool_pressed", view->tool_pressed, false},
    };
    status = check_numbers(shared, sizeof shared / sizeof *shared, message);
    if (status != WEIR_OK) return status;
    if (dimension == 3) return check_camera(view, message);
    const Check flat[] = {
        {"center[0]", view->center[0], false},
        {"center[1]", view->center[1], false},
        {"pixels_per_meter", view->pixels_per_meter, true},
    };
    return check_numbers(flat, sizeof flat / sizeof *flat, message);
}

uint32_t weir_scene_first_wall(const WeirScene *scene)
{
    bool closed = false;
    for (uint32_t axis = 0; axis < scene->dimension; axis++) {
        closed |= !scene->periodic[axis] && !(scene->open[axis][0] && scene->open[axis][1]);
    }
    return closed ? 1 : 0;
}

WeirLook weir_scene_look(const WeirScene *scene, uint32_t solid)
{
    uint32_t first = weir_scene_first_wall(scene);
    if (solid < first) return WEIR_LOOK_HIDDEN;
    uint32_t wall = solid - first;
    if (wall >= scene->wall_count) return WEIR_LOOK_BODY;
    bool around = scene->wall[wall].inside && scene->dimension == 3;
    return around ? WEIR_LOOK_HIDDEN : WEIR_LOOK_WALL;
}

static void fill_solids(WeirFrame *frame, const WeirScene *scene)
{
    for (uint32_t axis = 0; axis < 2; axis++) {
        for (uint32_t side = 0; side < 2; side++) {
            bool faint = scene->periodic[axis] || scene->open[axis][side];
            frame->faint_sides |= (uint32_t)faint << (2 * axis + side);
        }
    }
    frame->first_body = weir_scene_first_wall(scene) + scene->wall_count;
    for (uint32_t solid = 0; solid < frame->first_body && solid < 128; solid++) {
        if (weir_scene_look(scene, solid) == WEIR_LOOK_HIDDEN) frame->hidden[solid / 32] |= 1u << solid % 32;
    }
}

// What is beyond the domain's sides in 2D: the other end, or a wall.
static void fill_fold(WeirFrame *frame, const WeirScene *scene)
{
    for (uint32_t axis = 0; axis < 2; axis++) {
        if (scene->periodic[axis]) frame->fold |= 16u << axis;
        for (uint32_t side = 0; side < 2; side++) {
            bool wall = !scene->periodic[axis] && !scene->open[axis][side];
            frame->fold |= (uint32_t)wall << (2 * axis + side);
        }
    }
}

// A particle covers a few of the field's texels at least; that of large ones needs fewer. Where the support is many
// spacings wide, particles lie in clusters, and between them is no air.
static void fill_water(WeirFrame *frame, const WeirParameters *parameters)
{
    float spacing = parameters->particle_spacing, support = parameters->support_radius;
    float radius = fminf(fmaxf(2.2f * spacing, 0.5f * support), 4.0f * spacing) * frame->pixels_per_meter;
    frame->field_texel = radius < 9.0f ? 1 : 2;
    frame->field_radius = fmaxf(radius, 2.5f);
    // Large particles show in their water.
    frame->disc_share = fminf(fmaxf((frame->particle_radius - 5.0f) / 5.0f, 0.0f), 1.0f);
}

static void fill_flat(WeirFrame *frame, const WeirView *view, const WeirParameters *parameters, bool wcsph)
{
    float scale = view->pixels_per_meter;
    frame->pixels_per_meter = scale;
    frame->particle_radius = view->particle_radius * scale;
    // Larger than half a spacing, so that walls and bodies look closed.
    frame->disc_radius = fmaxf(0.72f * parameters->particle_spacing * scale, frame->particle_radius);
    frame->water_radius = fmaxf(1.5f * parameters->particle_spacing * scale, 1.5f);
    fill_water(frame, parameters);
    frame->tool_radius = fmaxf(view->tool_radius, 0.0f) * scale;
    // mueller's walls hold the particles' centres; wcsph's are where the lattice's half spacing ends.
    frame->border = frame->particle_radius;
    if (wcsph)
        frame->border = fmaxf(frame->border - 0.5f * parameters->particle_spacing * scale, 0.0f) + 0.6f;
    for (int k = 0; k < 2; k++) frame->center[k] = view->center[k];
}

// The shadow map holds the whole domain, whichever way it lies.
static void fill_light(WeirFrame *frame)
{
    const float *toward = light_direction;
    float right[3] = {toward[2], 0.0f, -toward[0]};
    float length = sqrtf(weir_dot3(right, right));
    for (int k = 0; k < 3; k++) right[k] /= length;
    const float up[3] = {toward[1] * right[2] - toward[2] * right[1],
                         toward[2] * right[0] - toward[0] * right[2],
                         toward[0] * right[1] - toward[1] * right[0]};
    const float away[3] = {-toward[0], -toward[1], -toward[2]};
    const float *axes[3] = {right, up, away};
    float center[3], half[3];
    for (int k = 0; k < 3; k++) {
        center[k] = 0.5f * (frame->domain_min[k] + frame->domain_max[k]);
        half[k] = 0.5f * (frame->domain_max[k] - frame->domain_min[k]) + 2.0f * frame->sphere_radius;
    }
    for (int row = 0; row < 3; row++) {
        float extent = 0.0f;
        for (int k = 0; k < 3; k++) extent += fabsf(axes[row][k]) * half[k];
        float scale = row == 2 ? 0.5f / extent : 1.0f / extent;
        for (int k = 0; k < 3; k++) frame->light_rows[row][k] = scale * axes[row][k];
        frame->light_rows[row][3] = (row == 2 ? 0.5f : 0.0f) - scale * weir_dot3(axes[row], center);
        if (row == 2) frame->light_range = 2.0f * extent;
    }
}

// Texels as wide as long.
static void fill_height_map(WeirFrame *frame, const float size[3])
{
    float texel = fmaxf(size[0], size[2]) / WEIR_HEIGHT_SIZE;
    frame->height_columns = (uint32_t)fmaxf(roundf(size[0] / texel), LEAST_HEIGHT_SIZE);
    frame->height_rows = (uint32_t)fmaxf(roundf(size[2] / texel), LEAST_HEIGHT_SIZE);
}

// Photons start on the texels of the map of the water's height, and beyond its sides towards the light as far as that
// comes while it sinks, bent into the water, from two thirds of the domain's height.
static void fill_photons(WeirFrame *frame, const float size[3])
{
    const float reach = 0.3f * size[1];
    const uint32_t texels[2] = {frame->height_columns, frame->height_rows};
    uint32_t count[2];
    for (int k = 0; k < 2; k++) {
        float share = fminf(reach / size[2 * k], 0.5f);
        count[k] = texels[k] + (uint32_t)ceilf(share * (float)texels[k]);
    }
    frame->photon_columns = count[0];
    frame->photon_rows = count[1];
}

static void fill_space(WeirFrame *frame, const WeirView *view, const WeirParameters *parameters,
                       uint32_t width, uint32_t height)
{
    WeirCameraAxes axes = weir_camera_axes(view, width, height);
    for (int k = 0; k < 3; k++) {
        frame->eye[k] = axes.eye[k];
        frame->right[k] = axes.right[k];
        frame->up[k] = axes.up[k];
        frame->ahead[k] = axes.ahead[k];
    }
    for (int k = 0; k < 2; k++) {
        frame->projection[k] = axes.focal[k];
        frame->projection[2 + k] = axes.shift[k];
    }
    frame->near = axes.near;
    frame->pixel_size = 2.0f / (axes.focal[1] * (float)height);
    frame->tool_radius = fmaxf(view->tool_radius, 0.0f);
    frame->sphere_radius = view->particle_radius;
    // A little larger than half a spacing, so that walls and bodies look closed.
    frame->solid_radius = 0.68f * parameters->particle_spacing;
    float size[3];
    for (int k = 0; k < 3; k++) size[k] = frame->domain_max[k] - frame->domain_min[k];
    frame->absorption = 2.6f / size[1];
    frame->occlusion_radius = fmaxf(0.045f * cbrtf(size[0] * size[1] * size[2]), 3.0f * frame->sphere_radius);
    fill_light(frame);
    fill_height_map(frame, size);
    fill_photons(frame, size);
}

static bool target_encodes(WGPUTextureFormat format)
{
    return format == WGPUTextureFormat_BGRA8UnormSrgb || format == WGPUTextureFormat_RGBA8UnormSrgb;
}

void weir_frame_fill(WeirFrame *frame, const WeirSim *sim, const WeirView *view, uint32_t width,
                     uint32_t height, WGPUTextureFormat format)
{
    const WeirConstants *constants = weir_sim_constants(sim);
    const WeirParameters *parameters = weir_sim_parameters(sim);
    const WeirScene *scene = weir_sim_scene(sim);
    float range = view->color_max - view->color_min;
    *frame = (WeirFrame){
        .size = {(float)width, (float)height},
        .tool_pressed = fminf(fmaxf(view->tool_pressed, 0.0f), 1.0f),
        .color_min = view->color_min,
        .color_scale = range != 0.0f ? 1.0f / range : 0.0f,
        .color_by = (uint32_t)view->color_by,
        .linear_target = target_encodes(format),
        .tait = parameters->equation_of_state == WEIR_EQUATION_TAIT,
        .line_scale = fminf(fmaxf((float)(width < height ? width : height) / 1000.0f, 1.0f), 4.0f),
        .rest_density = parameters->rest_density,
        .sound_speed = constants->sound_speed,
        .background_pressure = parameters->background_pressure,
        .quantum = constants->quantum,
        .spacing = parameters->particle_spacing,
        .water = view->fluid_style == WEIR_FLUID_WATER,
    };
    for (int k = 0; k < 3; k++) {
        frame->domain_min[k] = constants->domain_min[k];
        frame->domain_max[k] = constants->domain_max[k];
        frame->tool_position[k] = view->tool_position[k];
        frame->origin[k] = constants->origin[k];
    }
    bool wcsph = scene->method == WEIR_METHOD_WCSPH;
    if (wcsph) fill_solids(frame, scene);
    if (scene->dimension == 2) fill_fold(frame, scene);
    if (scene->dimension == 3)
        fill_space(frame, view, parameters, width, height);
    else
        fill_flat(frame, view, parameters, wcsph);
}
