// backdrop: what lies behind everything: sky and, far away, floor.
// in:  frame
// out: every pixel, opaque

@vertex
fn backdrop_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn backdrop_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let noise = (pixel_noise(vec2u(place.xy)) - 0.5) / 255.0;
    let light = surroundings(normalize(to_world(pixel_ray(place.xy))));
    return vec4f(exposed(light) + noise, 1.0);
}
