// Shared by the effects that draw the domain's twelve edges as fine lines.

struct Edge {
    @builtin(position) place: vec4f,
    @location(0) side: f32, // pixels from the line's middle, times w
    @location(1) depth: f32,
}

// Corner of the strip of pixels that an edge of the domain, 0 to 11, covers.
fn edge_corner(vertex: u32, index: u32) -> Edge {
    // Four edges along each axis.
    let axis = index / 4u;
    let turn = vec2f(f32(index & 1u), f32((index >> 1u) & 1u));
    var corner = vec3f(0.0, turn);
    if axis == 1u { corner = vec3f(turn.x, 0.0, turn.y); }
    if axis == 2u { corner = vec3f(turn, 0.0); }
    var opposite = corner;
    opposite[axis] = 1.0;
    let low = frame.domain_min.xyz;
    let size = frame.domain_max.xyz - low;
    var start = to_view(low + size * corner);
    var end = to_view(low + size * opposite);
    // What lies behind the near plane is cut off, or its pixel would have no meaning.
    let cut = 1.01 * frame.near;
    if start.z < cut && end.z > cut { start = mix(start, end, (cut - start.z) / (end.z - start.z)); }
    if end.z < cut && start.z > cut { end = mix(end, start, (cut - end.z) / (start.z - end.z)); }
    var edge: Edge;
    if start.z < cut && end.z < cut {
        edge.place = vec4f(2.0, 2.0, 2.0, 1.0);
        return edge;
    }
    let run = view_to_pixel(end) - view_to_pixel(start);
    let across = vec2f(-run.y, run.x) / max(length(run), 1e-6);
    let width = 0.6 * frame.line_scale + 1.0;
    let side = select(-width, width, (vertex & 1u) == 1u);
    var place = project(select(start, end, vertex >= 2u));
    place = vec4f(place.xy + across * side * vec2f(2.0, -2.0) / frame.size * place.w, place.zw);
    edge.place = place;
    edge.side = side * place.w;
    edge.depth = place.w;
    return edge;
}

// Premultiplied sRGB.
fn edge_color(edge: Edge) -> vec4f {
    let away = abs(edge.side / edge.depth);
    let alpha = 0.50 * clamp(0.6 * frame.line_scale + 0.5 - away, 0.0, 1.0);
    return vec4f(vec3f(0.74, 0.90, 1.00) * alpha, alpha);
}
