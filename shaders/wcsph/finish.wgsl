// Where solids move: the particles of solids where those are after the step, and with the velocity of its middle. Fluid is
// finished by pass forces.
//
// in:  coordinate, motion, solid_particle, solid_state, control
// out: coordinate, motion: the other working copy, or the state if that is to be sorted or no step follows
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_solid_particle) var<storage, read> solid_particle: array<SolidParticle>;

const OWN_CLOCK = false;

@compute @workgroup_size(WORKGROUP_SIZE)
fn finish(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
          @builtin(local_invocation_index) local: u32) {
    let particle = thread_index(workgroup, workgroups, local);
    if particle < constants.particle_count - constants.first_solid && now().stepping == 1u {
        finish_solid(solid_particle[particle].slot, solid_particle[particle].start);
    }
}

fn finish_solid(i: u32, start: vec3f) {
    let own = coordinate_at(side_start(now().last_side) + i);
    let n = u32(own.w) - GROUP_SOLID;
    if solid_table[n].kind == SOLID_FIXED {
        leave_fixed(i, own, motion_at(side_start(now().last_side) + i));
        return;
    }
    let arm = rotate(solid_state[NEW + n].orientation, start);
    let velocity = solid_state[NEW + n].velocity.xyz + cross(solid_state[NEW + n].angular_velocity.xyz, arm);
    leave_solid(i, vec4i(wide_place(place_of(own) + way_to(solid_state[NOW + n], start, place_of(own))), own.w), velocity);
}
