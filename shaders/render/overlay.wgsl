// overlay: the domain's outline as a fine luminous line, and the tool's ring.
// in:  frame
// out: premultiplied colour; glow is added (it covers nothing)
// Instances 0 to 3 are the outline's sides, mitred so that no pixel is drawn twice; 4 is the ring.

const line_color = vec3f(0.38, 0.66, 0.95);
const ring_color = vec3f(0.52, 0.86, 1.00);
const glow_width = 14.0; // times frame.line_scale

@vertex
fn overlay_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) side: u32) -> Overlay {
    var overlay: Overlay;
    overlay.side = side;
    let glow = glow_width * frame.line_scale;
    if side == 4u {
        let radius = frame.tool_radius + glow;
        overlay.place = to_clip(to_pixels(frame.tool_position) + square_corner(vertex) * radius);
        return overlay;
    }
    // The side's two corners, one turn of 90 degrees per side; even vertices outside the line, odd ones inside.
    let low = to_pixels(frame.domain_min);
    let high = to_pixels(frame.domain_max);
    let turn = (side + (vertex >> 1u)) % 4u;
    let corner = vec2f(select(-1.0, 1.0, turn == 1u || turn == 2u), select(-1.0, 1.0, turn >= 2u));
    let reach = frame.particle_radius + select(-glow, glow, (vertex & 1u) == 0u);
    let half_size = max(0.5 * abs(high - low) + reach, vec2f(0.0));
    overlay.place = to_clip(0.5 * (low + high) + corner * half_size);
    return overlay;
}

struct Overlay {
    @builtin(position) place: vec4f,
    @location(0) @interpolate(flat) side: u32,
}

// Coverage of a line of `width` pixels at `distance` from its middle.
fn line_coverage(distance: f32, width: f32) -> f32 {
    return clamp(0.5 * width + 0.5 - abs(distance), 0.0, 1.0) * min(width, 1.0);
}

// Falls from 1 on the line to 0 at glow_width.
fn line_glow(distance: f32) -> f32 {
    let near = max(1.0 - abs(distance) / (glow_width * frame.line_scale), 0.0);
    return near * near * near;
}

fn outline(pixel: vec2f) -> vec4f {
    let distance = domain_distance(pixel);
    let alpha = 0.75 * line_coverage(distance, 1.25 * frame.line_scale);
    return vec4f(to_target(line_color) * (alpha + 0.10 * line_glow(distance)), alpha);
}

fn ring(pixel: vec2f) -> vec4f {
    let distance = length(pixel - to_pixels(frame.tool_position)) - frame.tool_radius;
    let alpha = mix(0.55, 0.95, frame.tool_pressed) * line_coverage(distance, 1.5 * frame.line_scale);
    // While pressed the disc within is lit too, most at its edge.
    let part = clamp(1.0 + distance / max(frame.tool_radius, 1.0), 0.0, 1.0);
    let fill = mix(0.015, 0.11, frame.tool_pressed) * part * part * clamp(0.5 - distance, 0.0, 1.0);
    let light = mix(0.12, 0.38, frame.tool_pressed) * line_glow(distance) + fill;
    return vec4f(to_target(ring_color) * (alpha + light), alpha);
}

@fragment
fn overlay_fragment(overlay: Overlay) -> @location(0) vec4f {
    if overlay.side == 4u { return ring(overlay.place.xy); }
    return outline(overlay.place.xy);
}
