// Particles of the method wcsph: the solver's own buffers, one element per particle, all in one order.

@group(1) @binding(0) var<storage, read> coordinate: array<vec4i>; // quanta from frame.origin, group
@group(1) @binding(1) var<storage, read> motion: array<vec4f>;     // velocity, m/s; excess density, kg/m^3

fn particle_group(particle: u32) -> u32 {
    return u32(coordinate[particle].w);
}
fn particle_position(particle: u32) -> vec3f {
    return frame.origin.xyz + frame.quantum * vec3f(coordinate[particle].xyz);
}
fn particle_velocity(particle: u32) -> vec3f {
    return motion[particle].xyz;
}
fn particle_speed(particle: u32) -> f32 {
    return length(motion[particle].xyz);
}
fn particle_density(particle: u32) -> f32 {
    return frame.rest_density + motion[particle].w;
}
// The equation of state, docs/wcsph.md.
fn particle_pressure(particle: u32) -> f32 {
    let stiffness = frame.sound_speed * frame.sound_speed;
    let excess = motion[particle].w;
    if frame.tait == 0u { return stiffness * excess + frame.background_pressure; }
    let ratio = 1.0 + excess / frame.rest_density;
    let cube = ratio * ratio * ratio;
    return stiffness * frame.rest_density / 7.0 * (cube * cube * ratio - 1.0) + frame.background_pressure;
}
