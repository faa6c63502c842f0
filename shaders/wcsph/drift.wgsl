// First half of the move of a batch's first step: x += dt/2 v, rho += dt/2 drho; drains and open sides empty slots.
// The later steps' is done where the last one finishes. What is to be sorted stays in the state, the rest goes to a working copy.
//
// in:  coordinate, motion, id, step_end, solid_particle, solid_state, control
// out: coordinate, motion, counts and largest way in control
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_step_end) var<storage, read> step_end: StepEnd;
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_solid_particle) var<storage, read> solid_particle: array<SolidParticle>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: SharedControl;

var<workgroup> drift2_most: atomic<u32>; // wgpu-native does not zero it

@compute @workgroup_size(WORKGROUP_SIZE)
fn drift(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&drift2_most, 0u);
    }
    workgroupBarrier();
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count && control.clock.next_dt > 0.0 {
        drift_particle(i, select(side_start(control.clock.side), 0u, control.clock.sorting == 1u) + i);
    }
    workgroupBarrier();
    if local == 0u && atomicLoad(&drift2_most) > 0u {
        atomicMax(&control.maxima[control.clock.noting].drift2_bits, atomicLoad(&drift2_most));
    }
}

fn drift_particle(i: u32, target_slot: u32) {
    let old = coordinate_at(i);
    var own = motion_at(i);
    var at = old;
    let group = u32(old.w);
    if is_fluid(group) {
        let half = 0.5 * control.clock.next_dt;
        if control.clock.steps > 0u {
            own.w += half * step_end.density_rate[i];
        }
        let to = drifted(old, vector_of(own), half);
        at = to.coordinate;
        atomicMax(&drift2_most, way_bits(place_of(at) - place_of(old)));
        if to.fate == FATE_DRAINED {
            atomicAdd(&control.drained, 1u);
        } else if to.fate == FATE_LOST {
            atomicAdd(&control.lost, 1u);
        }
    } else if MOVING_SOLIDS && is_solid(group) && solid_table[group - GROUP_SOLID].kind != SOLID_FIXED {
        let start = solid_particle[id[i] - constants.first_solid].start;
        let way = way_to(solid_state[NOW + group - GROUP_SOLID], start, place_of(old));
        at = vec4i(wide_place(place_of(old) + way), old.w);
    }
    set_coordinate(target_slot, at);
    set_motion(target_slot, own);
}
