// What solid particles see of the fluid near them (Adami, Hu, Adams 2012): pressure, kept as the excess density that it
// stands for, and for the laminar viscosity the mirrored velocity.
//
// in:  sorted_coordinate, sorted_motion (of the fluid), sorted_id, cell_start, solid_state, local_place
// out: sorted_motion (of solids)
@group(0) @binding(BINDING_sorted_coordinate) var<storage, read> sorted_coordinate: array<vec4i>;
@group(0) @binding(BINDING_sorted_motion) var<storage, read_write> sorted_motion: array<vec4f>;
@group(0) @binding(BINDING_sorted_id) var<storage, read> sorted_id: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_local_place) var<storage, read> local_place: array<vec4f>;

// Velocity and acceleration of solid `n` at a particle: a + alpha x r + w x (w x r).
struct WallMotion {
    velocity: vec3f,
    acceleration: vec3f,
}

fn wall_motion(n: u32, own_id: u32) -> WallMotion {
    let surface = solid_table[n].surface_velocity.xyz;
    if !MOVING_SOLIDS || solid_table[n].kind == SOLID_FIXED {
        return WallMotion(surface, vec3f(0.0));
    }
    let state = solid_state[NOW + n];
    let arm = rotate(state.orientation, local_place[own_id - constants.first_solid].xyz);
    let spin = cross(state.angular_velocity.xyz, arm);
    return WallMotion(state.velocity.xyz + spin + surface,
                      state.acceleration.xyz + cross(state.angular_acceleration.xyz, arm)
                          + cross(state.angular_velocity.xyz, spin));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn walls(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count || cell_start[constants.cell_count + 1u] == 0u {
        return;
    }
    let own = sorted_coordinate[i];
    if !is_solid(u32(own.w)) {
        return;
    }
    let support = f32(1u << constants.coordinate_bits);
    var weight = 0.0;
    var pressure = 0.0;
    var mean = Vector();
    var moment = Vector();
    var walk = walk_around(own);
    while next_run(&walk) {
        let end = cell_start[walk.end_cell];
        for (var j = cell_start[walk.first_cell]; j < end; j++) {
            let other = sorted_coordinate[j];
            let offset = Vector(walk.place - place_of(other));
            let r_squared = dot(offset, offset);
            if !is_solid(u32(other.w)) && r_squared < support * support {
                let fluid = sorted_motion[j];
                let w = kernel_shape(sqrt(r_squared) * constants.inverse_support);
                weight += w;
                pressure += w * pressure_of(fluid.w);
                mean += w * vector_of(fluid);
                moment += (w * (parameters.rest_density + fluid.w)) * offset;
            }
        }
    }
    let wall = wall_motion(u32(own.w) - GROUP_SOLID, sorted_id[i]);
    var seen = wall.velocity;
    var wall_pressure = 0.0;
    if weight > 1e-12 {
        let inverse = 1.0 / weight;
        seen = 2.0 * wall.velocity - wide(mean * inverse);
        let fall = parameters.gravity.xyz - wall.acceleration;
        wall_pressure = max(pressure * inverse + dot(fall, wide(moment * (inverse * constants.quantum))), 0.0);
    }
    let stiffness = constants.sound_speed * constants.sound_speed;
    let excess = (wall_pressure - parameters.background_pressure) / stiffness;
    sorted_motion[i] = vec4f(seen, excess);
}
