// The step's second half where solids move (common/finish.wgsl); elsewhere forces does it.
//
// in:  coordinate, kicked (its second copy: shifting velocities and drho/dt, ways of moving solids)
// out: coordinate, motion: the other working copy, or the state if that is to be sorted or no step follows; maxima and
//      counts in control

fn finish_particle(i: u32) {
    let own = coordinate_at(side_start(control.last_side) + i);
    let group = u32(own.w);
    if is_fluid(group) {
        finish_fluid(i, own, kicked_at(i), kicked_at(constants.particle_count + i));
        return;
    }
    var place = own;
    var own_motion = kicked_at(i);
    if is_solid(group) {
        if solid_table[group - GROUP_SOLID].kind != SOLID_FIXED {
            let way = Place(vector_of(kicked_at(constants.particle_count + i)));
            place = vec4i(wide_place(place_of(own) + way), own.w);
        }
        own_motion += vec4f(solid_table[group - GROUP_SOLID].surface_velocity.xyz, 0.0);
    }
    leave(i, place, own_motion);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn finish(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
          @builtin(local_invocation_index) local: u32) {
    if local == 0u {
        clear_finish();
    }
    workgroupBarrier();
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count && control.stepping == 1u {
        finish_particle(i);
    }
    workgroupBarrier();
    if local == 0u {
        publish_finish();
    }
}
