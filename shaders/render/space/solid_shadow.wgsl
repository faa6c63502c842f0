// solid_shadow: depth of walls and bodies as the light sees them.
// in:  frame, corners, solid_state
// out: depth, 0 nearest to the light

@vertex
fn solid_shadow_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(to_light(corner_now(vertex).point), 1.0);
}
