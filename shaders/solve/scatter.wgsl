// Moves the whole particle data into its cell's run. Within a cell the order is by id, so that sums have one order
// and two runs give equal bits.
//
// in:  position, velocity, id, cell_link, cell_start
// out: sorted_position, sorted_velocity, sorted_id
@group(0) @binding(BINDING_position) var<storage, read> position: array<vec2f>;
@group(0) @binding(BINDING_velocity) var<storage, read> velocity: array<vec2f>;
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_cell_link) var<storage, read> cell_link: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_sorted_position) var<storage, read_write> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_sorted_velocity) var<storage, read_write> sorted_velocity: array<vec2f>;
@group(0) @binding(BINDING_sorted_id) var<storage, read_write> sorted_id: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn scatter(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
           @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count {
        return;
    }
    let cell = grid_cell(position[i]);
    let own = id[i] + 1u;
    // The rank in the cell: how many of its ids are lower.
    var slot = cell_start[cell];
    for (var link = cell_link[cell]; link != 0u; link = cell_link[constants.cell_count + link - 1u]) {
        slot += select(0u, 1u, link < own);
    }
    sorted_position[slot] = position[i];
    sorted_velocity[slot] = velocity[i];
    sorted_id[slot] = id[i];
}
