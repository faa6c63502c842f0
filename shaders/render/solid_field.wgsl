// solid_field: what of walls and bodies lies around each point of the picture. The domain's own sides are half planes, which
// liquid knows.
// in:  frame, particles
// out: sums over their particles: weight, weight * way to the particle

@vertex
fn solid_field_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Bump {
    let group = particle_group(particle);
    if group == group_empty || particle_kind(particle) == FLUID || is_hidden(group) { return no_bump(); }
    return bump_corner(vertex, particle, 0.0);
}

@fragment
fn solid_field_fragment(bump: Bump) -> @location(0) vec4f {
    return bump_sums(bump);
}
