// What solid particles see of the fluid near them (Adami, Hu, Adams 2012): pressure, kept as the excess density that it
// stands for, and for the laminar viscosity the mirrored velocity.
// The first workgroup does the clock instead, which nobody here reads.
//
// in:  coordinate, motion (of the fluid), cell_start, neighbor_list, solid_particle, solid_state, control
// out: motion (of solids), control
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_solid_particle) var<storage, read> solid_particle: array<SolidParticle>;

fn reading_start() -> u32 {
    return side_start(control.side);
}

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

fn way_since_sort() -> u32 {
    return control.travelled + control.moved_finish[control.side] + control.moved_drift[control.side] - control.sorted_at;
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

// Velocity and acceleration of solid `n` at a particle: sway (a + alpha x r) + w x (w x r).
struct WallMotion {
    velocity: vec3f,
    acceleration: vec3f,
}

// weir_solid_sway()
const CALM = 6.0; // times what is dragged

fn sway_of(n: u32, state: SolidState) -> f32 {
    let dragged = state.force.w;
    return select(1.0, min(max(solid_table[n].mass, dragged) / (CALM * dragged), 1.0), dragged > 0.0);
}

fn wall_motion(n: u32, particle: u32) -> WallMotion {
    let surface = solid_table[n].surface_velocity.xyz;
    if !MOVING_SOLIDS || solid_table[n].kind == SOLID_FIXED {
        return WallMotion(surface, vec3f(0.0));
    }
    let state = solid_state[NOW + n];
    let arm = rotate(state.orientation, solid_particle[particle].start);
    let spin = cross(state.angular_velocity.xyz, arm);
    return WallMotion(state.velocity.xyz + spin + surface,
                      sway_of(n, state) * (state.acceleration.xyz + cross(state.angular_acceleration.xyz, arm))
                          + cross(state.angular_velocity.xyz, spin));
}

fn share_of(particle: u32, lane: u32) -> Sums {
    let i = solid_particle[particle].slot;
    return sum_pairs(i, place_of(coordinate_at(reading_start() + i)), Own(0u), lane);
}

// By the first thread of the solid particle, the workgroup's thread `local`.
fn see_fluid(particle: u32, local: u32) {
    let i = solid_particle[particle].slot;
    let start = reading_start();
    let own = coordinate_at(start + i);
    let sums = all_sums(i, place_of(own), Own(0u), local);
    let wall = wall_motion(u32(own.w) - GROUP_SOLID, particle);
    var seen = wall.velocity;
    var wall_pressure = 0.0;
    if sums.weight > 1e-12 {
        let inverse = 1.0 / sums.weight;
        seen = 2.0 * wall.velocity - wide(sums.mean * inverse);
        let fall = parameters.gravity.xyz - wall.acceleration;
        wall_pressure = max(sums.pressure * inverse + dot(fall, wide(sums.moment * (inverse * constants.quantum))), 0.0);
    }
    let stiffness = constants.sound_speed * constants.sound_speed;
    let excess = (wall_pressure - parameters.background_pressure) / stiffness;
    set_motion(start + i, vec4f(seen, excess));
}

var<workgroup> fastest_solid: atomic<u32>; // m/s, as bits

// For forces, which may spare itself a search then.
fn note_solid_speed(local: u32) {
    if local == 0u {
        atomicStore(&fastest_solid, 0u);
    }
    workgroupBarrier();
    for (var n = local; n < SOLID_COUNT; n += WORKGROUP_SIZE) {
        let state = solid_state[NOW + n];
        let speed = length(state.velocity.xyz) + length(state.angular_velocity.xyz) * solid_table[n].position.w;
        if solid_table[n].kind != SOLID_FIXED {
            atomicMax(&fastest_solid, bitcast<u32>(1.001 * speed));
        }
    }
    workgroupBarrier();
    if local == 0u {
        control.solid_speed = bitcast<f32>(atomicLoad(&fastest_solid));
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn walls(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    if workgroup_index(workgroup, workgroups) == 0u {
        if local == 0u {
            advance_clock();
        }
        if MOVING_SOLIDS {
            note_solid_speed(local);
        }
        return;
    }
    let thread = thread_index(workgroup, workgroups, local) - WORKGROUP_SIZE;
    let particle = thread / LANES;
    let runs = control.running == 1u && is_well(control.bad_step, control.restored);
    let works = particle < constants.particle_count - constants.first_solid && runs;
    leave_shares(works, particle, thread % LANES, local);
    if works && thread % LANES == 0u {
        see_fluid(particle, local);
    }
}
