// Sums over the neighbours of a particle, for passes that bring `struct Own`, `struct Sums`, added(), add_pair(), and
// add_itself(), what the particle adds to its own sums: a list may hold it several times, and each time `itself` keeps it
// from adding anything. Furthermore share_of(), the sums of one lane by sum_pairs(); reading_start(), where in `coordinate`
// and `motion` the particles are; and way_since_sort(), the largest way of one from where it was sorted.
//
// Particles keep their slots for some steps after they were sorted. A list holds, in 16 bits each, all that was within
// the support and twice `allowance` then, eight to a chunk; so it misses nobody while no particle has moved farther than
// that. When one has, or where a list did not fit, the cells are walked, as far out as particles have moved: the same
// neighbours, and for a lone thread in the same order.
//
// LANES threads, side by side in a workgroup, share a particle's neighbours. Several leave their shares for the first one,
// which after a barrier finds all_sums(). A lone one sums where it asks for all_sums(): brought there from before, the
// sums cost large scenes up to a tenth of pass forces (H100).
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_neighbor_list) var<storage, read> neighbor_list: array<vec4u>;

// By the workgroup's threads.
var<workgroup> shares: array<Sums, select(1u, WORKGROUP_SIZE, LANES > 1u)>;

// What the lanes of item i leave for all_sums(). To be called by all threads of a workgroup.
fn leave_shares(works: bool, i: u32, lane: u32, local: u32) {
    if LANES > 1u {
        if works {
            shares[local] = share_of(i, lane);
        }
        workgroupBarrier();
    }
}

// Of the particle in slot i, for its first thread, which is the workgroup's thread `local`.
fn all_sums(i: u32, place: Place, own: Own, local: u32) -> Sums {
    if LANES == 1u {
        return sum_pairs(i, place, own, 0u);
    }
    var sums = shares[local];
    for (var lane = 1u; lane < LANES; lane++) {
        sums = added(sums, shares[local + lane]);
    }
    return sums;
}

// A lane's share: every LANES-th chunk of the list, or candidate of a run of cells.
fn sum_pairs(i: u32, place: Place, own: Own, lane: u32) -> Sums {
    let start = reading_start();
    let moved = way_since_sort();
    var sums: Sums;
    if LISTS && moved <= control.allowance {
        let header = neighbor_list[chunk_index(i, 0u)];
        if header.x != NO_LIST {
            for (var c = 1u + lane; c <= header.x; c += LANES) {
                let chunk = neighbor_list[chunk_index(i, c)];
                // Not unrolled by hand: software adapters would compile it for a minute.
                for (var half = 0u; half < 2u; half++) {
                    let words = select(chunk.zw, chunk.xy, half == 0u);
                    let slots = vec4u(listed(i, header, words.x & 0xffffu), listed(i, header, words.x >> 16u),
                                      listed(i, header, words.y & 0xffffu), listed(i, header, words.y >> 16u));
                    add_four(&sums, i, place, own, start, slots);
                }
            }
            if lane == 0u {
                add_itself(&sums, own);
            }
            return sums;
        }
    }
    let support = f32(1u << constants.coordinate_bits);
    var walk = walk_around(place, i32(1u << constants.coordinate_bits) + i32(moved));
    while next_run(&walk) {
        let end = cell_start[walk.end_cell];
        for (var j = cell_start[walk.first_cell] + lane; j < end; j += LANES) {
            let other = coordinate[start + j];
            let offset = Vector(walk.place - place_of(other));
            if BRANCH_FREE || dot(offset, offset) < support * support {
                add_pair(&sums, own, other, motion[start + j], offset, false);
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
    let motion_a = motion[start + slots.x];
    let motion_b = motion[start + slots.y];
    let motion_c = motion[start + slots.z];
    let motion_d = motion[start + slots.w];
    add_pair(sums, own, a, motion_a, offset_to(place, a), slots.x == i);
    add_pair(sums, own, b, motion_b, offset_to(place, b), slots.y == i);
    add_pair(sums, own, c, motion_c, offset_to(place, c), slots.z == i);
    add_pair(sums, own, d, motion_d, offset_to(place, d), slots.w == i);
}

fn offset_to(place: Place, other: vec4i) -> Vector {
    return Vector(nearest(place - place_of(other)));
}
