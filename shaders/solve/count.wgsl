// Counts the particles of each cell, and links them into one list per cell so that scatter can order them by id.
//
// in:  position, id
// out: cell_count (was 0), cell_link: the head of each cell's list (was 0: empty), then the next of each id; an
//      entry is an id plus 1, 0 ends the list
@group(0) @binding(BINDING_position) var<storage, read> position: array<vec2f>;
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_cell_count) var<storage, read_write> cell_count: array<atomic<u32>>;
@group(0) @binding(BINDING_cell_link) var<storage, read_write> cell_link: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn count(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count {
        return;
    }
    let cell = grid_cell(position[i]);
    atomicAdd(&cell_count[cell], 1u);
    let next = atomicExchange(&cell_link[cell], id[i] + 1u);
    atomicStore(&cell_link[constants.cell_count + id[i]], next);
}
