// Counts the particles of each cell, and links them into one list per cell so that scatter can order them by id.
// Empty slots lie behind the last cell, in any order.
//
// in:  coordinate, id, control
// out: cell_count (was 0), cell_link: the head of each cell's list (was 0: empty), then the next of each id; an
//      entry is an id plus 1, 0 ends the list. Of an empty slot: its rank among them. For pass neighbors 0 slots put in order.
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_cell_count) var<storage, read_write> cell_count: array<atomic<u32>>;
@group(0) @binding(BINDING_cell_link) var<storage, read_write> cell_link: array<atomic<u32>>;

var<workgroup> empty_slots: atomic<u32>; // wgpu-native does not zero it
var<workgroup> empty_before: atomic<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn count(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    if !is_sorting() {
        return;
    }
    let stride = workgroups.x * workgroups.y * WORKGROUP_SIZE;
    if thread_index(workgroup, workgroups, local) == 0u {
        atomicStore(&cell_link[fluid_put_at()], 0u);
        atomicStore(&cell_link[solids_put_at()], 0u);
    }
    for (var first = workgroup_index(workgroup, workgroups) * WORKGROUP_SIZE; first < constants.particle_count; first += stride) {
        count_block(first + local, local);
    }
}

fn count_block(i: u32, local: u32) {
    if local == 0u {
        atomicStore(&empty_slots, 0u);
    }
    workgroupBarrier();
    var is_empty = false;
    var own = 0u;
    var rank = 0u;
    if i < constants.particle_count {
        let at = coordinate_at(i);
        own = id[i];
        is_empty = u32(at.w) == GROUP_EMPTY;
        if is_empty {
            rank = atomicAdd(&empty_slots, 1u);
        } else {
            let cell = grid_cell(wrapped(place_of(at)));
            atomicAdd(&cell_count[cell], 1u);
            atomicStore(&cell_link[link_at(own)], atomicExchange(&cell_link[cell], own + 1u));
        }
    }
    // One addition per workgroup: there may be very many empty slots.
    workgroupBarrier();
    if local == 0u && atomicLoad(&empty_slots) > 0u {
        atomicStore(&empty_before, atomicAdd(&cell_count[constants.cell_count], atomicLoad(&empty_slots)));
    }
    workgroupBarrier();
    if is_empty {
        atomicStore(&cell_link[link_at(own)], atomicLoad(&empty_before) + rank);
    }
}
