// Shared by all effects of the renderer: what one frame shows, the particles, the colour maps.
// in:  frame      struct WeirFrame (src/render/renderer.h)
//      color_maps sRGB colours as red | green << 8 | blue << 16, 256 of each of the 4 maps (src/render/color_map.c)
//      position, velocity, flow: the solver's own buffers, one element per particle, all in one order
// Lengths are pixels of the target, y down, unless they are said to be metres.

struct Frame {
    center: vec2f,         // m, in the middle of the picture
    size: vec2f,           // of the picture
    domain_min: vec2f,     // m
    domain_max: vec2f,     // m
    tool_position: vec2f,  // m
    tool_radius: f32,      // 0: no ring
    tool_pressed: f32,     // 0 to 1
    color_min: f32,        // value at the start of the colour map
    color_scale: f32,      // 1 / (value at its end - color_min)
    color_by: u32,         // WeirColorBy
    linear_target: u32,    // 1 if the target encodes to sRGB itself
    pixels_per_meter: f32,
    particle_radius: f32,
    body_radius: f32,
    line_scale: f32,       // width of fine lines on this target
    rest_density: f32,     // kg/m^3
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> color_maps: array<vec4u, 256>;
@group(1) @binding(0) var<storage, read> position: array<vec2f>; // m
@group(1) @binding(1) var<storage, read> velocity: array<vec2f>; // m/s
@group(1) @binding(2) var<storage, read> flow: array<vec4f>;     // velocity, density, pressure

// Corner `index` (0..3) of a square from -1 to 1, as a triangle strip.
fn square_corner(index: u32) -> vec2f {
    return vec2f(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
}

fn to_pixels(point: vec2f) -> vec2f {
    return (point - frame.center) * frame.pixels_per_meter * vec2f(1.0, -1.0) + 0.5 * frame.size;
}

fn to_clip(pixel: vec2f) -> vec4f {
    return vec4f((pixel / frame.size * 2.0 - 1.0) * vec2f(1.0, -1.0), 0.0, 1.0);
}

// Place of a particle on the colour map, 0 to 1.
fn color_value(particle: u32) -> f32 {
    var value: f32;
    switch frame.color_by {
        case 0u: { value = length(velocity[particle]); }
        case 1u: { value = flow[particle].z; }
        case 2u: { value = (flow[particle].z - frame.rest_density) / frame.rest_density; }
        default: { value = flow[particle].w; }
    }
    return clamp((value - frame.color_min) * frame.color_scale, 0.0, 1.0);
}

// The same as weir_color_map(), sRGB from 0 to 1.
fn color_map(t: f32) -> vec3f {
    let step = min(u32(t * 255.0 + 0.5), 255u);
    return unpack4x8unorm(color_maps[frame.color_by * 64u + step / 4u][step % 4u]).rgb;
}

// An sRGB colour as the target wants it: as it is, or linear where the target encodes (IEC 61966-2-1).
fn to_target(color: vec3f) -> vec3f {
    if frame.linear_target == 0u { return color; }
    let low = color / 12.92;
    let high = pow((color + 0.055) / 1.055, vec3f(2.4));
    return select(high, low, color <= vec3f(0.04045));
}

// Signed distance from the domain's border in pixels, negative inside. The border is drawn one particle radius
// outside the walls, which hold the particles' centres, so that discs touch it and do not cross it.
fn domain_distance(pixel: vec2f) -> f32 {
    let low = to_pixels(frame.domain_min);
    let high = to_pixels(frame.domain_max);
    let outside = abs(pixel - 0.5 * (low + high)) - 0.5 * abs(high - low) - frame.particle_radius;
    return length(max(outside, vec2f(0.0))) + min(max(outside.x, outside.y), 0.0);
}
