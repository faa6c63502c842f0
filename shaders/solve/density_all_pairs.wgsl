// Density and pressure as in density.wgsl, with every particle checked against every other one and no sort: the
// sorted copies keep the order of the state.
//
// in:  position, velocity, id
// out: flow, sorted_position, sorted_velocity, sorted_id
@group(0) @binding(BINDING_position) var<storage, read> position: array<vec2f>;
@group(0) @binding(BINDING_velocity) var<storage, read> velocity: array<vec2f>;
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_flow) var<storage, read_write> flow: array<vec4f>;
@group(0) @binding(BINDING_sorted_position) var<storage, read_write> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_sorted_velocity) var<storage, read_write> sorted_velocity: array<vec2f>;
@group(0) @binding(BINDING_sorted_id) var<storage, read_write> sorted_id: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn density_all_pairs(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
                     @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count {
        return;
    }
    let support_squared = parameters.support_radius * parameters.support_radius;
    var sum = 0.0;
    for (var j = 0u; j < constants.particle_count; j++) {
        let offset = position[i] - position[j];
        let r_squared = dot(offset, offset);
        if r_squared < support_squared {
            sum += density_kernel(r_squared);
        }
    }
    flow[i] = flow_of(velocity[i], sum);
    sorted_position[i] = position[i];
    sorted_velocity[i] = velocity[i];
    sorted_id[i] = id[i];
}
