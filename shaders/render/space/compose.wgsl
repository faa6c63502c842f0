// compose: the scene's colours, darkened where light hardly gets to, and the tool's ring over them.
// in:  frame, depth, color, occlusion
// out: the target's colours

@group(2) @binding(0) var depths: texture_depth_multisampled_2d;
@group(2) @binding(1) var colors: texture_2d<f32>;
@group(2) @binding(2) var occlusions: texture_2d<f32>;

@vertex
fn compose_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// The mean over a block of 4 x 4 of those pixels that are as far ahead.
fn occlusion_at(pixel: vec2u) -> f32 {
    let ahead = frame.near / max(textureLoad(depths, pixel, 0), 1e-6);
    let last = vec2i(textureDimensions(occlusions)) - 1;
    let corner = vec2i(pixel / 2u) - select(vec2i(2), vec2i(1), (pixel & vec2u(1u)) == vec2u(1u));
    var sum = 0.0;
    var weight = 1e-4;
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let found = textureLoad(occlusions, clamp(corner + vec2i(x, y), vec2i(0), last), 0).xy;
            let share = clamp(1.5 - abs(found.y - ahead) / frame.occlusion_radius, 0.0, 1.0);
            sum += share * found.x;
            weight += share;
        }
    }
    return sum / weight;
}

@fragment
fn compose_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(place.xy);
    let dark = occlusion_at(pixel);
    var color = textureLoad(colors, pixel, 0).rgb;
    // Hollows keep some colour: light that came through the fluid.
    color *= mix(vec3f(1.0), vec3f(0.30, 0.36, 0.46), dark);
    var seen = to_target(color);
    if frame.tool_radius > 0.0 {
        let middle = to_view(frame.tool_position.xyz);
        if middle.z > frame.near {
            let radius = frame.tool_radius / (frame.pixel_size * middle.z);
            let over = ring(place.xy, view_to_pixel(middle), radius);
            seen = over.rgb + seen * (1.0 - over.a);
        }
    }
    return vec4f(seen, 1.0);
}
