// overlay: the domain's outline as a fine luminous line, and the tool's ring.
// in:  frame
// out: premultiplied colour; glow is added (it covers nothing)
// Instances 0 to 3 are the outline's sides, mitred so that no pixel is drawn twice; 4 is the ring.

@vertex
fn overlay_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) side: u32) -> Overlay {
    var overlay: Overlay;
    overlay.side = side;
    let glow = glow_width * frame.line_scale;
    if side == 4u {
        let radius = frame.tool_radius + glow;
        overlay.place = to_clip(to_pixels(frame.tool_position.xy) + square_corner(vertex) * radius);
        return overlay;
    }
    // The side's two corners, one turn of 90 degrees per side; even vertices outside the line, odd ones inside.
    let low = to_pixels(frame.domain_min.xy);
    let high = to_pixels(frame.domain_max.xy);
    let turn = (side + (vertex >> 1u)) % 4u;
    let corner = vec2f(select(-1.0, 1.0, turn == 1u || turn == 2u), select(-1.0, 1.0, turn >= 2u));
    let reach = frame.border + select(-glow, glow, (vertex & 1u) == 0u);
    let half_size = max(0.5 * abs(high - low) + reach, vec2f(0.0));
    overlay.place = to_clip(0.5 * (low + high) + corner * half_size);
    return overlay;
}

struct Overlay {
    @builtin(position) place: vec4f,
    @location(0) @interpolate(flat) side: u32,
}

fn outline(pixel: vec2f, side: u32) -> vec4f {
    let distance = domain_distance(pixel);
    // Top, right, bottom, left; where no wall is the line is faint.
    let bit = array(3u, 1u, 2u, 0u)[side];
    let strength = select(1.0, 0.22, ((frame.faint_sides >> bit) & 1u) != 0u);
    let alpha = 0.75 * strength * line_coverage(distance, 1.25 * frame.line_scale);
    return vec4f(to_target(line_color) * (alpha + 0.10 * strength * line_glow(distance)), alpha);
}

@fragment
fn overlay_fragment(overlay: Overlay) -> @location(0) vec4f {
    if overlay.side == 4u { return ring(overlay.place.xy, to_pixels(frame.tool_position.xy), frame.tool_radius); }
    return outline(overlay.place.xy, overlay.side);
}
