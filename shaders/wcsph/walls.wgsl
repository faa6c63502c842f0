// What solid particles see of the fluid near them (common/seen.wgsl). With ONE_PASS for reads alone, and at the start.
// The first workgroup does the clock instead, and finds how fast solids move; nobody else here reads what it writes.
//
// in:  coordinate, motion (of the fluid), cell_start, neighbor_list, solid_particle, solid_state, control
// out: motion (of solids), control, step_end (sizes of dispatches)
@group(0) @binding(BINDING_control) var<storage, read_write> control: SharedControl;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_solid_particle) var<storage, read> solid_particle: array<SolidParticle>;

fn reading_start() -> u32 {
    return side_start(control.clocks[0].last_side);
}

fn way_since_lists() -> u32 {
    let last = last_turn(control.clocks[0].noting);
    return control.clocks[0].travelled + way_of(maxima_of_step(last)) - control.listed_at;
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

// By the first thread of the solid particle in slot i, the workgroup's thread `local`.
fn see_fluid(particle: u32, i: u32, local: u32) {
    let own = coordinate_at(reading_start() + i);
    let wall = wall_motion(u32(own.w) - GROUP_SOLID, particle);
    set_motion(reading_start() + i, fluid_motion(i, own, wall.velocity, wall.acceleration, local));
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
            tell_clock(begun(0u, control.clocks[0].noting));
        }
        if MOVING_SOLIDS {
            note_solid_speed(local);
        }
        return;
    }
    let thread = thread_index(workgroup, workgroups, local) - WORKGROUP_SIZE;
    let particle = thread / LANES;
    let runs = control.clocks[0].running == 1u && is_well(atomicLoad(&control.bad_step), control.restored);
    let works = particle < constants.particle_count - constants.first_solid && runs;
    var i = 0u;
    if works {
        if FLUID_FIRST && !MOVING_SOLIDS {
            i = cell_start[fluid_first_at(constants.first_solid + particle)]; // in the order of slots: side by side their lists lie too
        } else {
            i = solid_particle[particle].slot;
        }
    }
    leave_shares(works, i, thread % LANES, local);
    if works && thread % LANES == 0u {
        see_fluid(particle, i, local);
    }
}
