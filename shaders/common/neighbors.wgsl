// Sums over the neighbours of a particle, for passes that bring `struct Own`, `struct Sums`, add_pair(),
// state_of(), what add_pair wants to know of a neighbour but its coordinate, and add_itself(), what the particle adds to
// its own sums: a list may hold it several times, and each time `itself` keeps it from adding anything.
//
// Particles keep their slots for some steps after they were sorted. A list holds, in 16 bits each, all that was within
// the support and twice `allowance` then, eight to a chunk; so it misses nobody while no particle has moved farther than
// that. When one has, or where a list did not fit, the cells are walked, as far out as particles have moved: the same
// neighbours in the same order.
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_neighbor_list) var<storage, read> neighbor_list: array<vec4u>;

// Looks up the candidates in the side of the working copies that begins at `start`; `moved`: the largest way since the sort.
fn sum_pairs(i: u32, place: Place, own: Own, start: u32, moved: u32, allowance: u32) -> Sums {
    var sums: Sums;
    if LISTS && moved <= allowance {
        let header = neighbor_list[chunk_index(i, 0u)];
        if header.x != NO_LIST {
            for (var c = 1u; c <= header.x; c++) {
                let chunk = neighbor_list[chunk_index(i, c)];
                // Not unrolled by hand: software adapters would compile it for a minute.
                for (var half = 0u; half < 2u; half++) {
                    let words = select(chunk.zw, chunk.xy, half == 0u);
                    let slots = vec4u(listed(i, header, words.x & 0xffffu), listed(i, header, words.x >> 16u),
                                      listed(i, header, words.y & 0xffffu), listed(i, header, words.y >> 16u));
                    add_four(&sums, i, place, own, start, slots);
                }
            }
            add_itself(&sums, own);
            return sums;
        }
    }
    let support = f32(1u << constants.coordinate_bits);
    var walk = walk_around(place, i32(1u << constants.coordinate_bits) + i32(moved));
    while next_run(&walk) {
        let end = cell_start[walk.end_cell];
        for (var j = cell_start[walk.first_cell]; j < end; j++) {
            let other = coordinate[start + j];
            let offset = Vector(walk.place - place_of(other));
            if BRANCH_FREE || dot(offset, offset) < support * support {
                add_pair(&sums, own, other, state_of(start, j), offset, false);
            }
        }
    }
    return sums;
}

// Loads first, so that they wait for memory together.
fn add_four(sums: ptr<function, Sums>, i: u32, place: Place, own: Own, start: u32, slots: vec4u) {
    let a = coordinate[start + slots.x];
    let b = coordinate[start + slots.y];
    let c = coordinate[start + slots.z];
    let d = coordinate[start + slots.w];
    let state_a = state_of(start, slots.x);
    let state_b = state_of(start, slots.y);
    let state_c = state_of(start, slots.z);
    let state_d = state_of(start, slots.w);
    add_pair(sums, own, a, state_a, offset_to(place, a), slots.x == i);
    add_pair(sums, own, b, state_b, offset_to(place, b), slots.y == i);
    add_pair(sums, own, c, state_c, offset_to(place, c), slots.z == i);
    add_pair(sums, own, d, state_d, offset_to(place, d), slots.w == i);
}

fn offset_to(place: Place, other: vec4i) -> Vector {
    return Vector(nearest(place - place_of(other)));
}
