// Sums over the state's free fluid.
//
// in:  coordinate, motion (the state)
// out: fluid_sums
fn own_sums(i: u32) -> FluidSums {
    let particle = particle_at(i);
    if u32(particle.coordinate.w) != GROUP_FLUID {
        return FluidSums();
    }
    let place = wide(position_of(place_of(particle.coordinate)));
    return sums_of(place, wide(vector_of(particle.motion)), particle.motion.w / parameters.rest_density);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn diagnose(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
            @builtin(local_invocation_index) local: u32) {
    leave_sums(workgroup, workgroups, local);
}
