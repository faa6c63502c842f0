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
    if dot(normal, view) < 0.0 { normal = -normal; } // seen from inside where the near plane cuts it open
    // The shadow map knows the face itself too, as steps of a texel: looked up from as far before it as those reach.
    let texel = 2.0 / (shadow_size * length(frame.light_rows[0].xyz));
    let lit = lit_share_within(face.point + normal * (4.0 * texel), 1.0) * smoothstep(-0.05, 0.15, dot(normal, sun));
    return vec4f(exposed(shade(face.color, 0.30, normal, view, mix(0.25, 1.0, lit) * sunlight_at(face.point))), 1.0);
}
