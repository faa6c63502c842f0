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

@fragment
fn compose_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(place.xy);
    var color = textureLoad(colors, pixel, 0).rgb;
    if frame.water == 0u { // else clear_water has done it
        let ahead = frame.near / max(textureLoad(depths, pixel, 0), 1e-6);
        color = darkened(color, occlusion_at(occlusions, pixel, ahead));
    }
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
