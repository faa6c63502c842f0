// Sums over all particles, after density.
//
// in:  sorted_position, flow
// out: fluid_sums
@group(0) @binding(BINDING_sorted_position) var<storage, read> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_flow) var<storage, read> flow: array<vec4f>;

fn own_sums(i: u32) -> FluidSums {
    let own = flow[i];
    let error = (own.z - parameters.rest_density) / parameters.rest_density;
    return sums_of(vec3f(sorted_position[i], 0.0), vec3f(own.xy, 0.0), error);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn diagnose(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
            @builtin(local_invocation_index) local: u32) {
    leave_sums(workgroup, workgroups, local);
}
