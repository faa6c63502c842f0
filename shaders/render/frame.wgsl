// Shared by all effects of the renderer: what one frame shows, and the colour maps.
// in:  frame      struct WeirFrame (src/render/frame.h)
//      color_maps sRGB colours as red | green << 8 | blue << 16, 256 of each of the 4 maps (src/render/color_map.c)
// Lengths are pixels of the target, y down, unless they are said to be metres.

struct Frame {
    // 3D only: where the camera is and its axes, unit vectors in the world.
    eye: vec4f,
    right: vec4f,
    up: vec4f,
    ahead: vec4f,
    projection: vec4f,           // clip.xy = xy * view.xy + zw * view.z
    light_rows: array<vec4f, 3>, // clip x, y and depth (0 to 1) of a point in the shadow map
    domain_min: vec4f,           // m
    domain_max: vec4f,           // m
    tool_position: vec4f,        // m
    origin: vec4f,               // wcsph: place of coordinate 0, m
    hidden: vec4u,               // bit per wall and body: not drawn
    size: vec2f,                 // of the picture
    center: vec2f,               // 2D: m, in the middle of the picture
    tool_radius: f32,            // 2D: pixels, 3D: m; 0: no ring
    tool_pressed: f32,           // 0 to 1
    color_min: f32,              // value at the start of the colour map
    color_scale: f32,            // 1 / (value at its end - color_min)
    color_by: u32,               // WeirColorBy
    linear_target: u32,          // 1 if the target encodes to sRGB itself
    first_body: u32,             // walls have lower numbers than bodies
    tait: u32,                   // wcsph: 1 for Tait's equation of state
    pixels_per_meter: f32,       // 2D
    particle_radius: f32,        // 2D: pixels
    water_radius: f32,           // 2D
    line_scale: f32,             // width of fine lines on this target
    border: f32,                 // 2D: the outline is drawn so far outside of the domain
    rest_density: f32,           // kg/m^3
    sound_speed: f32,            // wcsph: m/s
    background_pressure: f32,    // wcsph: Pa
    quantum: f32,                // wcsph: m
    sphere_radius: f32,          // 3D: m
    solid_radius: f32,           // 3D: m
    near: f32,                   // 3D: m
    pixel_size: f32,             // 3D: of a pixel one metre ahead, m
    light_range: f32,            // 3D: that depth 0 to 1 of the shadow map spans, m
    absorption: f32,             // 3D: of light in the fluid, 1/m
    occlusion_radius: f32,       // 3D: m
    disc_radius: f32,            // 2D: of wall and body particles, pixels
    faint_sides: u32,            // 2D: bit 2 axis + (0 low, 1 high): no wall is there
    water: u32,                  // 1 where the fluid is drawn as water
    spacing: f32,                // of the particles, m
    shapes: u32,                 // 1 where walls and bodies are drawn as shapes, not as particles
    field_radius: f32,           // 2D: how far a particle of water is spread, pixels
    disc_share: f32,             // 2D: how much of the particles is seen in the water, 0 to 1
    fold: u32,                   // 2D: bit 2 axis + side: a wall; bit 4 + axis: periodic
    field_texel: u32,            // 2D: of the field that the water is made of, pixels
    height_columns: u32,         // 3D: texels of the map of the water's height
    height_rows: u32,
    photon_columns: u32,         // 3D: caustics.wgsl
    photon_rows: u32,
    all_shown: u32,              // 3D: 1 where nobody is left out (crowd_gather.wgsl)
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> color_maps: array<vec4u, 256>;

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

// The same as weir_color_map(), sRGB from 0 to 1.
fn color_map(t: f32) -> vec3f {
    let step = min(u32(t * 255.0 + 0.5), 255u);
    return unpack4x8unorm(color_maps[frame.color_by * 64u + step / 4u][step % 4u]).rgb;
}

// sRGB to linear light (IEC 61966-2-1), and back.
fn to_linear(color: vec3f) -> vec3f {
    let low = color / 12.92;
    let high = pow((color + 0.055) / 1.055, vec3f(2.4));
    return select(high, low, color <= vec3f(0.04045));
}

fn to_srgb(color: vec3f) -> vec3f {
    let low = color * 12.92;
    let high = 1.055 * pow(max(color, vec3f(0.0)), vec3f(1.0 / 2.4)) - 0.055;
    return select(high, low, color <= vec3f(0.0031308));
}

// An sRGB colour as the target wants it: as it is, or linear where the target encodes.
fn to_target(color: vec3f) -> vec3f {
    if frame.linear_target == 0u { return color; }
    return to_linear(color);
}

// Signed distance from the domain's border in pixels, negative inside.
fn domain_distance(pixel: vec2f) -> f32 {
    let low = to_pixels(frame.domain_min.xy);
    let high = to_pixels(frame.domain_max.xy);
    let outside = abs(pixel - 0.5 * (low + high)) - 0.5 * abs(high - low) - frame.border;
    return length(max(outside, vec2f(0.0))) + min(max(outside.x, outside.y), 0.0);
}

// White noise in 0..1, the same for a pixel in every frame (integer hash after Jarzynski and Olano, "Hash
// Functions for GPU Rendering", 2020: pcg).
fn pixel_noise(pixel: vec2u) -> f32 {
    var state = (pixel.x + pixel.y * 65537u) * 747796405u + 2891336453u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return f32(((state >> 22u) ^ state) & 0xffffu) / 65535.0;
}

// Coverage of a line of `width` pixels at `distance` from its middle.
fn line_coverage(distance: f32, width: f32) -> f32 {
    return clamp(0.5 * width + 0.5 - abs(distance), 0.0, 1.0) * min(width, 1.0);
}

// sRGB of a wall or body. Bodies take warm colours in turn, which no colour map has beside each other.
fn solid_color(solid: u32) -> vec3f {
    if solid < frame.first_body { return vec3f(0.34, 0.40, 0.50); }
    switch (solid - frame.first_body) % 4u {
        case 0u: { return vec3f(0.93, 0.66, 0.36); }
        case 1u: { return vec3f(0.88, 0.47, 0.38); }
        case 2u: { return vec3f(0.60, 0.72, 0.46); }
        default: { return vec3f(0.78, 0.55, 0.70); }
    }
}

const line_color = vec3f(0.38, 0.66, 0.95);
const ring_color = vec3f(0.52, 0.86, 1.00);
const glow_width = 14.0; // times frame.line_scale

// Falls from 1 on the line to 0 at glow_width.
fn line_glow(distance: f32) -> f32 {
    let near = max(1.0 - abs(distance) / (glow_width * frame.line_scale), 0.0);
    return near * near * near;
}

// The tool's ring of `radius` around `middle`, premultiplied; its glow covers nothing.
fn ring(pixel: vec2f, middle: vec2f, radius: f32) -> vec4f {
    let distance = length(pixel - middle) - radius;
    let alpha = mix(0.55, 0.95, frame.tool_pressed) * line_coverage(distance, 1.5 * frame.line_scale);
    // While pressed the disc within is lit too, most at its edge.
    let part = clamp(1.0 + distance / max(radius, 1.0), 0.0, 1.0);
    let fill = mix(0.015, 0.11, frame.tool_pressed) * part * part * clamp(0.5 - distance, 0.0, 1.0);
    let light = mix(0.12, 0.38, frame.tool_pressed) * line_glow(distance) + fill;
    return vec4f(to_target(ring_color) * (alpha + light), alpha);
}
