// field: what of the fluid lies around each point of the picture.
// in:  frame, particles
// out: sums over the fluid's particles: weight, weight * way to the particle, weight * place on the colour map

@vertex
fn field_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Bump {
    if particle_kind(particle) != FLUID { return no_bump(); }
    return bump_corner(vertex, particle, color_value(particle));
}

@fragment
fn field_fragment(bump: Bump) -> @location(0) vec4f {
    return bump_sums(bump);
}
