// Particles of the method mueller: the solver's own buffers, one element per particle, all in one order.

@group(1) @binding(0) var<storage, read> position: array<vec2f>; // m
@group(1) @binding(1) var<storage, read> velocity: array<vec2f>; // m/s
@group(1) @binding(2) var<storage, read> flow: array<vec4f>;     // velocity, density, pressure

fn particle_group(particle: u32) -> u32 {
    return 0u;
}
fn particle_position(particle: u32) -> vec3f {
    return vec3f(position[particle], 0.0);
}
fn particle_velocity(particle: u32) -> vec3f {
    return vec3f(velocity[particle], 0.0);
}
fn particle_speed(particle: u32) -> f32 {
    return length(velocity[particle]);
}
fn particle_density(particle: u32) -> f32 {
    return flow[particle].z;
}
fn particle_pressure(particle: u32) -> f32 {
    return flow[particle].w;
}
