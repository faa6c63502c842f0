// Acceleration from pressure, viscosity and gravity; counts the step.
//
// in:  sorted_position, flow, cell_start
// out: acceleration, health.step
@group(0) @binding(BINDING_sorted_position) var<storage, read> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_flow) var<storage, read> flow: array<vec4f>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_acceleration) var<storage, read_write> acceleration: array<vec2f>;
@group(0) @binding(BINDING_health) var<storage, read_write> health: Health;

@compute @workgroup_size(WORKGROUP_SIZE)
fn forces(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
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
    let own_row = grid_row(position.y);
    let rows = grid_rows(own_row);
    let support_squared = parameters.support_radius * parameters.support_radius;
    var sums = PairSums();
    for (var row = rows.x; row <= rows.y; row++) {
        for (var segment = 0u; segment < SEGMENTS; segment++) {
            let run = grid_run(position, own_row, row, segment);
            let end = cell_start[run.y];
            for (var j = cell_start[run.x]; j < end; j++) {
                let offset = position - sorted_position[j];
                let r_squared = dot(offset, offset);
                if r_squared < support_squared {
                    add_pair(&sums, own, flow[j], offset, r_squared);
                }
            }
        }
    }
    acceleration[i] = acceleration_of(sums, own);
}
