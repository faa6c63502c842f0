// solids: walls and bodies as the shapes that they are.
// in:  frame, corners, solid_state, shadow map
// out: sRGB, opaque; depth

struct Face {
    @builtin(position) place: vec4f,
    @location(0) point: vec3f, // m
    @location(1) normal: vec3f,
    @location(2) @interpolate(flat) color: vec3f, // linear
}

@vertex
fn solids_vertex(@builtin(vertex_index) vertex: u32) -> Face {
    let corner = corner_now(vertex);
    var face: Face;
    face.point = corner.point;
    face.place = project(to_view(corner.point));
    face.normal = corner.normal;
    face.color = to_linear(solid_color(corner.solid)) * corner.tone;
    return face;
}

@fragment
fn solids_fragment(face: Face) -> @location(0) vec4f {
    let view = normalize(frame.eye.xyz - face.point);
    var normal = normalize(face.normal);
    // Seen from inside where the near plane cuts it open; at the rim of what is round normals may lean away a little.
    if dot(normal, view) < -0.3 { normal = -normal; }
    return vec4f(exposed(shade(face.color, 0.30, normal, view, light_on_solid(face.point, normal))), 1.0);
}
