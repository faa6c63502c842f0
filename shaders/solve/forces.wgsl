// Acceleration from pressure, viscosity and gravity; counts the step. LANES threads share a particle's neighbours.
//
// in:  sorted_position, flow, cell_start
// out: acceleration, health.step
@group(0) @binding(BINDING_sorted_position) var<storage, read> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_flow) var<storage, read> flow: array<vec4f>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_acceleration) var<storage, read_write> acceleration: array<vec2f>;
@group(0) @binding(BINDING_health) var<storage, read_write> health: Health;

var<workgroup> shares: array<PairSums, WORKGROUP_SIZE>;

// Over every LANES-th candidate, from the lane's own on.
fn sum_pairs(i: u32, own: Own, lane: u32) -> PairSums {
    let position = sorted_position[i];
    let own_row = grid_row(position.y);
    let rows = grid_rows(own_row);
    let support_squared = parameters.support_radius * parameters.support_radius;
    var sums = PairSums();
    for (var row = rows.x; row <= rows.y; row++) {
        for (var segment = 0u; segment < SEGMENTS; segment++) {
            let run = grid_run(position, own_row, row, segment);
            let end = cell_start[run.y];
            for (var j = cell_start[run.x] + lane; j < end; j += LANES) {
                let offset = position - sorted_position[j];
                let r_squared = dot(offset, offset);
                if r_squared < support_squared {
                    add_pair(&sums, own, flow[j], offset, r_squared);
                }
            }
        }
    }
    return sums;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn forces(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
          @builtin(local_invocation_index) local: u32) {
    let thread = thread_index(workgroup, workgroups, local);
    if thread == 0u {
        health.step += 1u;
    }
    let i = thread / LANES;
    var own: Own;
    var sums = PairSums();
    if i < constants.particle_count {
        own = own_of(flow[i]);
        sums = sum_pairs(i, own, thread % LANES);
    }
    if LANES > 1u {
        shares[local] = sums;
        workgroupBarrier();
    }
    if i >= constants.particle_count || thread % LANES != 0u {
        return;
    }
    for (var lane = 1u; lane < LANES; lane++) {
        sums.pressure += shares[local + lane].pressure;
        sums.viscosity += shares[local + lane].viscosity;
    }
    acceleration[i] = acceleration_of(sums, own);
}
