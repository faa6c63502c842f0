// drho/dt with the new velocities and with density diffusion between fluid particles, then the step's second half:
// rho += dt/2 drho, x += dt/2 v + dt u; health; and the first half of the next step's move, if there is one.
//
// in:  sorted_coordinate, sorted_id, cell_start, kicked (its second half: shifting velocities, ways of moving solids)
// out: coordinate, motion, id, maxima and counts in control; where no step follows, kicked keeps the rates in w of its
//      second half
@group(0) @binding(BINDING_sorted_coordinate) var<storage, read> sorted_coordinate: array<vec4i>;
@group(0) @binding(BINDING_sorted_id) var<storage, read> sorted_id: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_kicked) var<storage, read_write> kicked: array<vec4f>;
@group(0) @binding(BINDING_coordinate) var<storage, read_write> coordinate: array<vec4i>;
@group(0) @binding(BINDING_motion) var<storage, read_write> motion: array<vec4f>;
@group(0) @binding(BINDING_id) var<storage, read_write> id: array<u32>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: SharedControl;

// Share of the rest density below which fluid is not stretched, but torn: docs/wcsph.md.
const LEAST_DENSITY = 0.8;

// The workgroup's largest density error, as bits.
var<workgroup> error_most: atomic<u32>; // wgpu-native does not zero it

// `shift_rate`: what shifting adds, drho/dt / rho.
fn density_rate(own: vec4i, own_motion: vec4f, shift_rate: f32) -> f32 {
    let support = f32(1u << constants.coordinate_bits);
    let c = constants.sound_speed;
    // Density by height, per quantum.
    let hydrostatic = vector_of(parameters.gravity) * (parameters.rest_density / (c * c) * constants.quantum);
    let velocity = vector_of(own_motion);
    var divergence = 0.0;
    var diffusion = 0.0;
    var walk = walk_around(own);
    while next_run(&walk) {
        let end = cell_start[walk.end_cell];
        for (var j = cell_start[walk.first_cell]; j < end; j++) {
            let other = sorted_coordinate[j];
            let offset = Vector(walk.place - place_of(other));
            let r_squared = dot(offset, offset);
            if BRANCH_FREE || r_squared < support * support {
                let neighbor = kicked[j];
                let slope = kernel_slope(sqrt(r_squared) * constants.inverse_support)
                    / (parameters.rest_density + neighbor.w);
                divergence += slope * dot(velocity - vector_of(neighbor), offset);
                if DIFFUSION {
                    // rho_j - rho_i less what the height between them makes
                    let excess = neighbor.w - own_motion.w + dot(offset, hydrostatic);
                    diffusion += select(0.0, slope * excess, !HAS_SOLIDS || !is_solid(u32(other.w)));
                }
            }
        }
    }
    let volume = constants.particle_mass * constants.gradient_factor;
    let compress = volume * constants.quantum;
    let diffuse = -volume * 2.0 * parameters.density_diffusion * constants.smoothing_length * c;
    return (parameters.rest_density + own_motion.w) * (compress * divergence + shift_rate) + diffuse * diffusion;
}

fn check_health(i: u32, speed_squared: f32, rate: f32) {
    let limit = constants.speed_limit;
    if is_finite(speed_squared) && is_finite(rate) && speed_squared <= limit * limit {
        return;
    }
    atomicAdd(&control.bad_particles, 1u);
    atomicMin(&control.bad_step, control.steps);
    atomicMin(&control.bad_id, sorted_id[i]);
    // Count sees it: what the sort left, half a step ago, is the last good state, and nothing may run over it.
}

// The seal of the domain's own walls: no fluid gets deeper into them than one spacing.
fn seal(place: ptr<function, Place>, velocity: ptr<function, Vector>) {
    let origin = vector_of(constants.origin);
    let depth = Vector(parameters.particle_spacing);
    let low = (vector_of(constants.domain_min) - depth - origin) * constants.inverse_quantum;
    let high = (vector_of(constants.domain_max) + depth - origin) * constants.inverse_quantum;
    for (var axis = 0u; axis < DIMENSION; axis++) {
        if has_wall(axis, 0u) && f32((*place)[axis]) < low[axis] {
            (*place)[axis] = i32(low[axis]);
            (*velocity)[axis] = max((*velocity)[axis], 0.0);
        }
        if has_wall(axis, 1u) && f32((*place)[axis]) > high[axis] {
            (*place)[axis] = i32(high[axis]);
            (*velocity)[axis] = min((*velocity)[axis], 0.0);
        }
    }
}

fn finish_fluid(i: u32, own: vec4i) {
    var own_motion = kicked[i];
    let shift = kicked[constants.particle_count + i];
    let rate = density_rate(own, own_motion, shift.w);
    var velocity = vector_of(own_motion);
    let last_half = 0.5 * control.last_dt;
    check_health(i, dot(velocity, velocity), rate);
    own_motion.w = max(own_motion.w + last_half * rate, (LEAST_DENSITY - 1.0) * parameters.rest_density);
    let error = bitcast<u32>(abs(own_motion.w) / parameters.rest_density);
    if error > atomicLoad(&error_most) {
        atomicMax(&error_most, error);
    }
    var way = last_half * velocity;
    if SHIFTING && u32(own.w) == GROUP_FLUID {
        way += control.last_dt * vector_of(shift);
    }
    var place = moved(place_of(own), way);
    if u32(own.w) == GROUP_FLUID {
        seal(&place, &velocity);
        own_motion = vec4f(wide(velocity), own_motion.w);
    }
    let finished = vec4i(wide_place(place), own.w);
    let half = control.drift_half;
    if half == 0.0 {
        kicked[constants.particle_count + i].w = rate;
        coordinate[i] = finished;
        motion[i] = own_motion;
        return;
    }
    own_motion.w += half * rate;
    let to = drifted(finished, velocity, half);
    if to.fate == FATE_DRAINED {
        atomicAdd(&control.drained, 1u);
    } else if to.fate == FATE_LOST {
        atomicAdd(&control.lost, 1u);
    }
    coordinate[i] = to.coordinate;
    motion[i] = own_motion;
}

fn finish(i: u32) {
    let own = sorted_coordinate[i];
    let group = u32(own.w);
    id[i] = sorted_id[i];
    if is_fluid(group) {
        finish_fluid(i, own);
        return;
    }
    var place = own;
    if MOVING_SOLIDS && is_solid(group) && solid_table[group - GROUP_SOLID].kind != SOLID_FIXED {
        let way = Place(vector_of(kicked[constants.particle_count + i]));
        place = vec4i(wide_place(wrapped(place_of(own) + way)), own.w);
    }
    coordinate[i] = place;
    var own_motion = kicked[i];
    if HAS_SOLIDS && is_solid(group) {
        own_motion += vec4f(solid_table[group - GROUP_SOLID].surface_velocity.xyz, 0.0);
    }
    motion[i] = own_motion;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn continuity(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
              @builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&error_most, 0u);
    }
    workgroupBarrier();
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count && control.finishing == 1u {
        finish(i);
    }
    workgroupBarrier();
    if local == 0u && atomicLoad(&error_most) > 0u {
        atomicMax(&control.error_bits, atomicLoad(&error_most));
    }
}
