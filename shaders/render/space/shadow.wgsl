// shadow: depth of the particles as the light sees them; water casts a shade of its own (shade.wgsl).
// in:  frame, particles, shown
// out: depth, 0 nearest to the light

@vertex
fn shadow_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) number: u32)
    -> @builtin(position) vec4f {
    let particle = shown[number];
    let kind = particle_kind(particle);
    if kind == HIDDEN || (kind == FLUID && frame.water != 0u) { return vec4f(2.0, 2.0, 2.0, 1.0); }
    let light = to_light(particle_position(particle));
    let radius = select(frame.solid_radius, frame.sphere_radius, kind == FLUID);
    let texels = vec2f(length(frame.light_rows[0].xyz), length(frame.light_rows[1].xyz)) * radius;
    // 0.9: between the inscribed square and the one around the disc.
    return vec4f(light.xy + 0.9 * square_corner(vertex) * max(texels, vec2f(1.2 / shadow_size)), light.z, 1.0);
}
