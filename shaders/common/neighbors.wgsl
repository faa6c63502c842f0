// Sums over the neighbours of a particle, for passes that bring `struct Own`, `struct Sums`, no_sums(), added(), add_pair(),
// and take_itself(), which takes back what the particle added to its own sums as the filling of a list. Furthermore share_of(),
// the sums of one lane by sum_pairs(); reading_start(), where in `coordinate` and `motion` the particles are;
// way_since_lists(), the largest way of one since lists were made; and `cell_start`. Pass forces has all this twice.
//
// Particles keep their slots for some steps after they were sorted. A list holds, in 16 bits each, all that was within
// the support and twice `allowance` then; so it misses nobody while no particle has moved farther than that. When one has, or
// where a list did not fit, the cells are walked, as far out as particles have moved: the same neighbours, and for a lone
// thread in the same order.
//
// What bounds large scenes is the number of instructions of add_pair(), not its loads (docs/performance.md, Roofline).
//
// LANES threads, side by side in a workgroup, share a particle's neighbours. Several leave their shares for the first one,
// which after a barrier finds all_sums(). A lone one sums where it asks for all_sums(): brought there from before, the
// sums cost large scenes up to a tenth of pass forces (H100).

// By the workgroup's threads.
var<workgroup> shares: array<Sums, select(1u, WORKGROUP_SIZE, LANES > 1u)>;

// The head of a list and a lane's first chunk of it.
struct Opening {
    header: vec4u,
    chunk: vec2u,
}

fn opening_of(i: u32, lane: u32) -> Opening {
    if !LISTS {
        return Opening();
    }
    let at = 2u * part_index(i, 0u);
    return Opening(vec4u(list_chunk(at), list_chunk(at + 1u)), list_chunk(chunk_index(i, lane)));
}

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
fn all_sums(i: u32, place: Place, own: Own, local: u32, opening: Opening) -> Sums {
    if LANES == 1u {
        return sum_pairs(i, place, own, 0u, opening);
    }
    var sums = shares[local];
    for (var lane = 1u; lane < LANES; lane++) {
        sums = added(sums, shares[local + lane]);
    }
    return sums;
}

// A lane's share: every LANES-th chunk of the list, or 32 candidates of a run of cells.
fn sum_pairs(i: u32, place: Place, own: Own, lane: u32, opening: Opening) -> Sums {
    let start = reading_start();
    let moved = way_since_lists();
    if LISTS && moved <= control.allowance {
        let header = opening.header;
        if header.x != NO_LIST {
            if MARKS_MIXED && header.x < MIXED_LIST {
                return sum_listed(i, place, own, lane, start, opening, true);
            }
            return sum_listed(i, place, own, lane, start, opening, false);
        }
    }
    return sum_walk(place, own, lane, start, moved + (control.listed_at - control.sorted_at));
}

// Lists are read four entries at a time.
fn chunk_index(i: u32, chunk: u32) -> u32 {
    return 2u * part_index(i, 1u + (chunk >> 1u)) + (chunk & 1u);
}

// From a lane's chunk to its next one.
fn chunk_stride(chunk: u32) -> u32 {
    if LANES == 1u {
        return select(2u * PART_STRIDE - 1u, 1u, (chunk & 1u) == 0u);
    }
    return LANES * PART_STRIDE;
}

// Each chunk is loaded while the one before it is summed. `fluid`: all that it lists is.
fn sum_listed(i: u32, place: Place, own: Own, lane: u32, start: u32, opening: Opening, fluid: bool) -> Sums {
    var sums = no_sums();
    let header = opening.header;
    let count = header.x & LIST_COUNT;
    let chunks = (count + 3u) / 4u;
    let bases = list_bases(start, i, header);
    var at = chunk_index(i, lane);
    var next = opening.chunk;
    for (var c = lane; c < chunks; c += LANES) {
        let words = next;
        at += chunk_stride(c);
        next = list_chunk(at);
        let slots = vec4u(listed(bases, words.x & 0xffffu), listed(bases, words.x >> 16u),
                          listed(bases, words.y & 0xffffu), listed(bases, words.y >> 16u));
        add_four(&sums, place, own, slots, fluid);
    }
    if lane == 0u {
        take_itself(&sums, own, f32(4u * chunks - count));
    }
    return sums;
}

fn sum_walk(place: Place, own: Own, lane: u32, start: u32, moved: u32) -> Sums {
    var sums = no_sums();
    let support = f32(1u << constants.coordinate_bits);
    let limit = support * support;
    var walk = walk_around(place, i32(1u << constants.coordinate_bits) + i32(moved));
    while next_run(&walk) {
        let begin = cell_start[walk.first_cell];
        let end = cell_start[walk.end_cell];
        if DIMENSION == 2u {
            // Every second candidate is near: all add themselves, those beyond the support 0.
            for (var j = start + begin + lane; j < start + end; j += LANES) {
                let other = particle_at(j);
                add_pair(&sums, own, other, Vector(walk.place - place_of(other.coordinate)), false);
            }
            continue;
        }
        for (var at = begin + 32u * lane; at < end; at += 32u * LANES) {
            for (var near = near_among(walk.place, start + at, end - at, limit, 0u).bits; near != 0u; near &= near - 1u) {
                let j = start + at + firstTrailingBit(near);
                let other = particle_at(j);
                add_pair(&sums, own, other, Vector(walk.place - place_of(other.coordinate)), false);
            }
        }
    }
    return sums;
}

// Loads first: compilers spread them over the sums as registers allow.
fn add_four(sums: ptr<function, Sums>, place: Place, own: Own, slots: vec4u, fluid: bool) {
    let a = particle_at(slots.x);
    let b = particle_at(slots.y);
    let c = particle_at(slots.z);
    let d = particle_at(slots.w);
    add_pair(sums, own, a, offset_to(place, a), fluid);
    add_pair(sums, own, b, offset_to(place, b), fluid);
    add_pair(sums, own, c, offset_to(place, c), fluid);
    add_pair(sums, own, d, offset_to(place, d), fluid);
}

fn offset_to(place: Place, other: Particle) -> Vector {
    return Vector(nearest(place - place_of(other.coordinate)));
}
