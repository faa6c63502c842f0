// front_edges: those parts of the domain's edges that lie before the water, over it.
// in:  frame, surface
// out: premultiplied sRGB

@group(2) @binding(0) var surface: texture_2d<f32>;

@vertex
fn front_edges_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> Edge {
    return edge_corner(vertex, index);
}

@fragment
fn front_edges_fragment(edge: Edge) -> @location(0) vec4f {
    let water = abs(textureLoad(surface, vec2u(edge.place.xy), 0).x);
    let nearer = edge.depth < frame.near / max(water, 1e-6) + 0.5 * frame.spacing;
    return edge_color(edge) * f32(water > 0.0 && nearer);
}
