// Sums over the neighbours of a particle, for passes that bring `struct Own`, `struct Sums`, add_pair() and
// state_of(), what add_pair wants to know of a neighbour but its coordinate.
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
                add_four(&sums, i, place, own, start, header, chunk.xy);
                add_four(&sums, i, place, own, start, header, chunk.zw);
            }
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
                add_pair(&sums, own, other, state_of(start, j), offset, j == i);
            }
        }
    }
    return sums;
}

// Loads first, so that they wait for memory together.
fn add_four(sums: ptr<function, Sums>, i: u32, place: Place, own: Own, start: u32, header: vec4u, entries: vec2u) {
    let a = listed(i, header, entries.x & 0xffffu);
    let b = listed(i, header, entries.x >> 16u);
    let c = listed(i, header, entries.y & 0xffffu);
    let d = listed(i, header, entries.y >> 16u);
    let other_a = coordinate[start + a];
    let other_b = coordinate[start + b];
    let other_c = coordinate[start + c];
    let other_d = coordinate[start + d];
    let state_a = state_of(start, a);
    let state_b = state_of(start, b);
    let state_c = state_of(start, c);
    let state_d = state_of(start, d);
    add_pair(sums, own, other_a, state_a, Vector(nearest(place - place_of(other_a))), a == i);
    add_pair(sums, own, other_b, state_b, Vector(nearest(place - place_of(other_b))), b == i);
    add_pair(sums, own, other_c, state_c, Vector(nearest(place - place_of(other_c))), c == i);
    add_pair(sums, own, other_d, state_d, Vector(nearest(place - place_of(other_d))), d == i);
}
