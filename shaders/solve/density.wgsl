// Density rho_i = sum_j m W(|x_i - x_j|), the particle itself included, and pressure. LANES threads share a particle's
// neighbours.
//
// in:  sorted_position, sorted_velocity, cell_start
// out: flow; the heads of cell_link are emptied for the next count
@group(0) @binding(BINDING_sorted_position) var<storage, read> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_sorted_velocity) var<storage, read> sorted_velocity: array<vec2f>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_flow) var<storage, read_write> flow: array<vec4f>;
@group(0) @binding(BINDING_cell_link) var<storage, read_write> cell_link: array<u32>;

var<workgroup> shares: array<f32, WORKGROUP_SIZE>;

// Over every LANES-th candidate, from the lane's own on.
fn sum_kernel(i: u32, lane: u32) -> f32 {
    let position = sorted_position[i];
    let own_row = grid_row(position.y);
    let rows = grid_rows(own_row);
    let support_squared = parameters.support_radius * parameters.support_radius;
    var sum = 0.0;
    for (var row = rows.x; row <= rows.y; row++) {
        for (var segment = 0u; segment < SEGMENTS; segment++) {
            let run = grid_run(position, own_row, row, segment);
            let end = cell_start[run.y];
            for (var j = cell_start[run.x] + lane; j < end; j += LANES) {
                let offset = position - sorted_position[j];
                let r_squared = dot(offset, offset);
                if r_squared < support_squared {
                    sum += density_kernel(r_squared);
                }
            }
        }
    }
    return sum;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn density(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
           @builtin(local_invocation_index) local: u32) {
    let thread = thread_index(workgroup, workgroups, local);
    for (var cell = thread; cell < constants.cell_count; cell += workgroups.x * workgroups.y * WORKGROUP_SIZE) {
        cell_link[cell] = 0u;
    }
    let i = thread / LANES;
    var sum = 0.0;
    if i < constants.particle_count {
        sum = sum_kernel(i, thread % LANES);
    }
    if LANES > 1u {
        shares[local] = sum;
        workgroupBarrier();
    }
    if i >= constants.particle_count || thread % LANES != 0u {
        return;
    }
    for (var lane = 1u; lane < LANES; lane++) {
        sum += shares[local + lane];
    }
    flow[i] = flow_of(sorted_velocity[i], sum);
}
