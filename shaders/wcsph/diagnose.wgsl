// Sums over the state's free fluid.
//
// in:  coordinate, motion (the state)
// out: fluid_sums
@compute @workgroup_size(WORKGROUP_SIZE)
fn diagnose(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
            @builtin(local_invocation_index) local: u32) {
    let group = workgroup_index(workgroup, workgroups);
    let share = particle_share(group, workgroups);
    var sums = FluidSums();
    for (var i = share.x + local; i < share.y; i += WORKGROUP_SIZE) {
        let particle = particle_at(i);
        if u32(particle.coordinate.w) == GROUP_FLUID {
            let place = wide(position_of(place_of(particle.coordinate)));
            let velocity = wide(vector_of(particle.motion));
            sums = joined(sums, sums_of(place, velocity, particle.motion.w / parameters.rest_density));
        }
    }
    leave_sums(sums, local, group);
}
