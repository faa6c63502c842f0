// After a sort: each particle's list (common/neighbors.wgsl), the slots of solid particles, and the state's ids.
// Solid particles list fluid alone.
//
// in:  coordinate, sorted_id, cell_start, control
// out: neighbor_list, solid_slot, id; cell_link's heads are emptied for the next count
@group(0) @binding(BINDING_coordinate) var<storage, read> coordinate: array<vec4i>;
@group(0) @binding(BINDING_sorted_id) var<storage, read> sorted_id: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_neighbor_list) var<storage, read_write> neighbor_list: array<vec4u>;
@group(0) @binding(BINDING_solid_slot) var<storage, read_write> solid_slot: array<u32>;
@group(0) @binding(BINDING_id) var<storage, read_write> id: array<u32>;
@group(0) @binding(BINDING_cell_link) var<storage, read_write> cell_link: array<u32>;

fn make_list(i: u32, own: vec4i, start: u32) {
    let reach = (1u << constants.coordinate_bits) + 2u * control.allowance + 8u;
    let solid = is_solid(u32(own.w));
    var header = vec4u(0u);
    var layer = 0xffffffffu;
    var chunk = vec4u(0u);
    var count = 0u;
    var fits = true;
    var walk = walk_around(place_of(own), i32(reach));
    while next_run(&walk) {
        let first = cell_start[walk.first_cell];
        let end = cell_start[walk.end_cell];
        if walk.run_layer != layer && first < end {
            layer = walk.run_layer;
            header = select(select(vec4u(header.xyz, first), vec4u(header.xy, first, header.w), layer == 1u),
                            vec4u(header.x, first, header.zw), layer == 0u);
        }
        for (var j = first; j < end; j++) {
            let other = coordinate[start + j];
            let offset = Vector(walk.place - place_of(other));
            if dot(offset, offset) < f32(reach) * f32(reach) && !(solid && is_solid(u32(other.w))) {
                let entry = entry_of(i, header, layer, j);
                fits = fits && entry != NO_ENTRY;
                chunk = (chunk >> vec4u(16u)) | (vec4u(chunk.yzw, entry) << vec4u(16u));
                count += 1u;
                if count % 8u == 0u && count <= 8u * LIST_CHUNKS {
                    neighbor_list[chunk_index(i, count / 8u)] = chunk;
                }
            }
        }
    }
    fits = fits && count <= 8u * LIST_CHUNKS;
    // The last chunk is filled with the particle itself, which adds nothing.
    if fits && count % 8u != 0u {
        let self_entry = entry_of(i, header, own_layer(header, i), i);
        fits = self_entry != NO_ENTRY;
        while count % 8u != 0u {
            chunk = (chunk >> vec4u(16u)) | (vec4u(chunk.yzw, self_entry) << vec4u(16u));
            count += 1u;
        }
        neighbor_list[chunk_index(i, count / 8u)] = chunk;
    }
    neighbor_list[chunk_index(i, 0u)] = vec4u(select(NO_LIST, count / 8u, fits), header.yzw);
}

// The layer whose entries reach the particle itself.
fn own_layer(header: vec4u, i: u32) -> u32 {
    return select(select(2u, 1u, i - header.z < 16384u), 0u, i - header.y < 16384u);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn neighbors(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
             @builtin(local_invocation_index) local: u32) {
    if !is_sorting() {
        return;
    }
    let i = thread_index(workgroup, workgroups, local);
    for (var cell = i; cell <= constants.cell_count; cell += workgroups.x * workgroups.y * WORKGROUP_SIZE) {
        cell_link[cell] = 0u;
    }
    if i >= constants.particle_count {
        return;
    }
    id[i] = sorted_id[i];
    if sorted_id[i] >= constants.first_solid {
        solid_slot[sorted_id[i] - constants.first_solid] = i;
    }
    let start = side_start(control.side);
    let own = coordinate[start + i];
    if LISTS && u32(own.w) != GROUP_EMPTY {
        make_list(i, own, start);
    }
}
