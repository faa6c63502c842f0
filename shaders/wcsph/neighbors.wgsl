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

// Across the end of an axis runs do not come in the order of their slots, and entries count from the lowest one.
const WRAPS = DIMENSION == 3u && (PERIODIC_X || PERIODIC_Y);

fn layer_of(header: vec4u, layer: u32) -> u32 {
    return select(select(header.w, header.z, layer == 1u), header.y, layer == 0u);
}

fn with_layer(header: vec4u, layer: u32, first: u32) -> vec4u {
    return select(select(vec4u(header.xyz, first), vec4u(header.xy, first, header.w), layer == 1u),
                  vec4u(header.x, first, header.zw), layer == 0u);
}

// A header with the lowest slot of each layer.
fn first_candidates(place: Place, reach: i32) -> vec4u {
    var header = vec4u(0u, vec3u(0xffffffffu));
    var walk = walk_around(place, reach);
    while next_run(&walk) {
        let begin = cell_start[walk.first_cell];
        if begin < cell_start[walk.end_cell] {
            header = with_layer(header, walk.run_layer, min(begin, layer_of(header, walk.run_layer)));
        }
    }
    return header;
}

fn make_list(i: u32, own: vec4i, start: u32) {
    let reach = (1u << constants.coordinate_bits) + 2u * control.allowance + 8u;
    let solid = is_solid(u32(own.w));
    let limit = f32(reach) * f32(reach);
    var header = vec4u(0u);
    if WRAPS {
        header = first_candidates(place_of(own), i32(reach));
    }
    var layer = 0xffffffffu;
    var layer_first = 0u;
    var chunk = vec4u(0u);
    var count = 0u;
    var fits = true;
    var walk = walk_around(place_of(own), i32(reach));
    while next_run(&walk) {
        let begin = cell_start[walk.first_cell];
        let end = cell_start[walk.end_cell];
        if begin >= end {
            continue;
        }
        if walk.run_layer != layer {
            layer = walk.run_layer;
            if !WRAPS {
                header = with_layer(header, layer, begin);
            }
            layer_first = layer_of(header, layer);
        }
        fits = fits && run_fits(i, layer_first, layer, begin, end);
        let shift = entry_shift(i, layer_first, layer);
        for (var first = begin; first < end; first += 32u) {
            for (var near = near_among(walk.place, start + first, start + end, limit, solid); near != 0u; near &= near - 1u) {
                chunk = pushed(chunk, first + firstTrailingBit(near) + shift);
                count += 1u;
                if count % 8u == 0u && count <= 8u * LIST_CHUNKS {
                    neighbor_list[chunk_index(i, count / 8u)] = chunk;
                }
            }
        }
    }
    fits = fits && count <= 8u * LIST_CHUNKS;
    // The last chunk is filled with the particle itself.
    if fits && count % 8u != 0u {
        let self_entry = own_entry(i, header);
        fits = self_entry != 0xffffu;
        for (; count % 8u != 0u; count++) {
            chunk = pushed(chunk, self_entry);
        }
        neighbor_list[chunk_index(i, count / 8u)] = chunk;
    }
    neighbor_list[chunk_index(i, 0u)] = vec4u(select(NO_LIST, count / 8u, fits), header.yzw);
}

// Bits of the near ones among the 32 candidates from `first` on, as far as they lie before `end`.
fn near_among(place: Place, first: u32, end: u32, limit: f32, solid: bool) -> u32 {
    let count = min(end - first, 32u);
    var near = 0u;
    for (var k = 0u; k < count; k += 4u) {
        // Loads first, so that they wait for memory together.
        let four = min(first + k + vec4u(0u, 1u, 2u, 3u), vec4u(end - 1u));
        let a = coordinate[four.x];
        let b = coordinate[four.y];
        let c = coordinate[four.z];
        let d = coordinate[four.w];
        let bits = is_near(place, a, limit, solid) | (is_near(place, b, limit, solid) << 1u)
            | (is_near(place, c, limit, solid) << 2u) | (is_near(place, d, limit, solid) << 3u);
        near |= bits << k;
    }
    return near & (0xffffffffu >> (32u - count));
}

// 1 or 0.
fn is_near(place: Place, other: vec4i, limit: f32, solid: bool) -> u32 {
    let offset = Vector(place - place_of(other));
    return select(0u, 1u, dot(offset, offset) < limit && !(HAS_SOLIDS && solid && is_solid(u32(other.w))));
}

// A chunk with an entry more; its first one falls out.
fn pushed(chunk: vec4u, entry: u32) -> vec4u {
    return (chunk >> vec4u(16u)) | (vec4u(chunk.yzw, entry) << vec4u(16u));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn neighbors(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
             @builtin(local_invocation_index) local: u32) {
    if !is_sorting() {
        return;
    }
    let thread = thread_index(workgroup, workgroups, local);
    let threads = workgroups.x * workgroups.y * WORKGROUP_SIZE;
    for (var cell = thread; cell <= constants.cell_count; cell += threads) {
        cell_link[cell] = 0u;
    }
    for (var i = thread; i < constants.particle_count; i += threads) {
        note_particle(i);
    }
}

fn note_particle(i: u32) {
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
