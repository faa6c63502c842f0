// Acceleration as in forces.wgsl, with every particle checked against every other one.
//
// in:  sorted_position, flow
// out: acceleration, health.step
@group(0) @binding(BINDING_sorted_position) var<storage, read> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_flow) var<storage, read> flow: array<vec4f>;
@group(0) @binding(BINDING_acceleration) var<storage, read_write> acceleration: array<vec2f>;
@group(0) @binding(BINDING_health) var<storage, read_write> health: Health;

@compute @workgroup_size(WORKGROUP_SIZE)
fn forces_all_pairs(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
                    @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count {
        return;
    }
    if i == 0u {
        health.step += 1u;
    }
    let position = sorted_position[i];
    let own = own_of(flow[i]);
    let support_squared = parameters.support_radius * parameters.support_radius;
    var sums = PairSums();
    for (var j = 0u; j < constants.particle_count; j++) {
        let offset = position - sorted_position[j];
        let r_squared = dot(offset, offset);
        if r_squared < support_squared {
            add_pair(&sums, own, flow[j], offset, r_squared);
        }
    }
    acceleration[i] = acceleration_of(sums, own);
}
