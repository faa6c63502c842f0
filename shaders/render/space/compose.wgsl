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

fn color_at(pixel: vec2i) -> vec3f {
    return textureLoad(colors, clamp(pixel, vec2i(0), vec2i(frame.size) - 1), 0).rgb;
}

fn brightness(pixel: vec2i) -> f32 {
    return dot(color_at(pixel), vec3f(0.30, 0.59, 0.11));
}

fn color_between(place: vec2f) -> vec3f {
    let corner = vec2i(floor(place - 0.5));
    let part = place - 0.5 - vec2f(corner);
    let above = mix(color_at(corner), color_at(corner + vec2i(1, 0)), part.x);
    let below = mix(color_at(corner + vec2i(0, 1)), color_at(corner + 1), part.x);
    return mix(above, below, part.y);
}

// The mean along an edge, whose direction is across the change of brightness (after Lottes, "FXAA", 2009).
fn along_edge(place: vec2f) -> vec3f {
    let pixel = vec2i(place);
    let a = brightness(pixel + vec2i(-1, -1));
    let b = brightness(pixel + vec2i(1, -1));
    let c = brightness(pixel + vec2i(-1, 1));
    let d = brightness(pixel + vec2i(1, 1));
    let way = vec2f(c + d - a - b, a + c - b - d);
    let steep = max(abs(way.x), abs(way.y));
    if steep < 0.01 { return color_at(pixel); }
    let step = way / max(min(abs(way.x), abs(way.y)) + 0.03, 0.25 * steep);
    let reach = clamp(step, vec2f(-4.0), vec2f(4.0));
    let near = color_between(place + reach / 6.0) + color_between(place - reach / 6.0);
    let far = color_between(place + 0.5 * reach) + color_between(place - 0.5 * reach);
    return 0.3 * near + 0.2 * far;
}

@fragment
fn compose_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(place.xy);
    let found = textureLoad(colors, pixel, 0);
    var color = found.rgb;
    if frame.water == 0u { // else clear_water has done it
        let ahead = frame.near / max(textureLoad(depths, pixel, 0), 1e-6);
        color = darkened(color, occlusion_at(occlusions, pixel, ahead));
    }
    if frame.water != 0u && found.a < 0.5 { color = along_edge(place.xy); }
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
