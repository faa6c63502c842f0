// What a solid's particle sees of the fluid near it (Adami, Hu, Adams 2012): pressure, kept as the excess density that it
// stands for, and the velocity that friction takes. Sums for common/neighbors.wgsl.
struct Own {
    unused: u32,
}

struct Sums {
    weight: f32,
    pressure: f32,
    mean: Vector,
    moment: Vector,
}

fn no_sums() -> Sums {
    return Sums();
}

fn added(a: Sums, b: Sums) -> Sums {
    return Sums(a.weight + b.weight, a.pressure + b.pressure, a.mean + b.mean, a.moment + b.moment);
}

// Solid particles see no solid ones, so not themselves.
fn take_itself(sums: ptr<function, Sums>, own: Own, times: f32) {
}

// The kernel is 0 beyond the support.
fn add_pair(sums: ptr<function, Sums>, own: Own, other: Particle, offset: Vector, sure_fluid: bool) {
    let fluid = other.motion;
    let w = select(0.0, kernel_shape(within_support(length(offset))), is_fluid(u32(other.coordinate.w)));
    (*sums).weight += w;
    (*sums).pressure += w * pressure_of(fluid.w);
    (*sums).mean += w * vector_of(fluid);
    (*sums).moment += (w * (parameters.rest_density + fluid.w)) * offset;
}

fn share_of(i: u32, lane: u32) -> Sums {
    return sum_pairs(i, place_of(coordinate_at(reading_start() + i)), Own(0u), lane, opening_of(i, lane));
}

// Friction over that of laminar flow, of fluid that moves by `slip` m/s along a wall (docs/wcsph.md).
fn turbulence(slip: f32) -> f32 {
    let root = sqrt(slip * constants.inverse_turbulent_slip);
    return max(root * sqrt(root), 1.0);
}

// Motion as fluid sees it, of the particle in slot i, by its first thread, the workgroup's thread `local`. `velocity` and
// `acceleration` of its solid there.
fn fluid_motion(i: u32, own: vec4i, velocity: vec3f, acceleration: vec3f, local: u32) -> vec4f {
    let sums = all_sums(i, place_of(own), Own(0u), local, opening_of(i, 0u));
    var seen = velocity;
    var pressure = 0.0;
    if sums.weight > 1e-12 {
        let inverse = 1.0 / sums.weight;
        let slip = wide(sums.mean * inverse) - velocity;
        seen = velocity + (1.0 - 2.0 * turbulence(length(slip))) * slip;
        let fall = parameters.gravity.xyz - acceleration;
        pressure = max(sums.pressure * inverse + dot(fall, wide(sums.moment * (inverse * constants.quantum))), 0.0);
    }
    let stiffness = constants.sound_speed * constants.sound_speed;
    return vec4f(seen, (pressure - parameters.background_pressure) / stiffness);
}
