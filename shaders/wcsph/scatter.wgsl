// Moves the whole particle data into its cell's run. Within a cell the order is by id, so that sums have one order
// and two runs give equal bits. Where count counted nothing, there is nothing to move.
//
// in:  coordinate, motion, id, cell_link, cell_start
// out: sorted_coordinate, sorted_motion, sorted_id
@group(0) @binding(BINDING_coordinate) var<storage, read> coordinate: array<vec4i>;
@group(0) @binding(BINDING_motion) var<storage, read> motion: array<vec4f>;
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_cell_link) var<storage, read> cell_link: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_sorted_coordinate) var<storage, read_write> sorted_coordinate: array<vec4i>;
@group(0) @binding(BINDING_sorted_motion) var<storage, read_write> sorted_motion: array<vec4f>;
@group(0) @binding(BINDING_sorted_id) var<storage, read_write> sorted_id: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn scatter(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
           @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    let next = constants.cell_count + 1u;
    if i >= constants.particle_count || cell_start[next] == 0u {
        return;
    }
    let at = coordinate[i];
    let own = id[i];
    var slot: u32;
    if u32(at.w) == GROUP_EMPTY {
        slot = cell_start[constants.cell_count] + cell_link[next + own];
    } else {
        let cell = grid_cell(at);
        slot = cell_start[cell];
        // The rank in the cell: how many of its ids are lower.
        for (var link = cell_link[cell]; link != 0u; link = cell_link[next + link - 1u]) {
            slot += select(0u, 1u, link < own + 1u);
        }
    }
    sorted_coordinate[slot] = at;
    sorted_motion[slot] = motion[i];
    sorted_id[slot] = own;
}
