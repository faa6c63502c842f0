// edges: the domain's twelve edges as fine lines.
// in:  frame
// out: premultiplied sRGB

@vertex
fn edges_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> Edge {
    return edge_corner(vertex, index);
}

@fragment
fn edges_fragment(edge: Edge) -> @location(0) vec4f {
    return edge_color(edge);
}
