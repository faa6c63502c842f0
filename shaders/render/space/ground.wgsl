// ground: the floor, which fades into the backdrop.
// in:  frame, light
// out: premultiplied sRGB

struct Ground {
    @builtin(position) place: vec4f,
    @location(0) point: vec3f, // m
}

@vertex
fn ground_vertex(@builtin(vertex_index) vertex: u32) -> Ground {
    let corner = square_corner(vertex) * ground_extent();
    let middle = 0.5 * (frame.domain_min.xyz + frame.domain_max.xyz);
    var ground: Ground;
    ground.point = vec3f(middle.x + corner.x, ground_height(), middle.z + corner.y);
    ground.place = project(to_view(ground.point));
    return ground;
}

@fragment
fn ground_fragment(ground: Ground) -> @location(0) vec4f {
    if frame.eye.y < ground.point.y { discard; } // from below one looks through it
    let direction = normalize(ground.point - frame.eye.xyz);
    let seen = floor_light(ground.point, direction, fwidth(ground.point.xz), lit_share(ground.point));
    return vec4f(exposed(seen.rgb) * seen.a, seen.a);
}
