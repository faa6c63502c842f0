// Which candidates of a run of cells are near: up to 32 are tested before what passed is dealt with, so that the lanes of a warp
// take as long as the one with most that passed. One by one, all lanes would take part wherever one of them has somebody near.

// Candidates that are loaded together, so that they wait for memory together: as many as coordinate_block() gives.
const BLOCK = 8u;

struct Near {
    bits: u32,   // who is near
    groups: u32, // the bits of the groups of all that were looked at, near or not
}

// Those within sqrt(limit) among the next 32 candidates, of which `left` are left of the run. Of groups less 1, those below
// `unseen` are not looked for.
fn near_among(place: Place, first: u32, left: u32, limit: f32, unseen: u32) -> Near {
    var near = Near();
    for (var k = 0u; k < min(left, 32u); k += BLOCK) {
        let block = near_block(place, first + k, limit, unseen);
        near.bits |= block.bits << k;
        near.groups |= block.groups;
    }
    near.bits &= 0xffffffffu >> (32u - min(left, 32u));
    return near;
}

// Written out, not a loop: Firefox counts every loop's turns lest it never ends, and the driver then cannot unroll it. Making
// lists took six times as long by that (docs/performance/tries.md).
fn near_block(place: Place, first: u32, limit: f32, unseen: u32) -> Near {
    let found = coordinate_block(first); // beyond the run's end too, where it does not count
    let groups = found[0].w | found[1].w | found[2].w | found[3].w | found[4].w | found[5].w | found[6].w | found[7].w;
    return Near(near_bit(place, found[0], limit, unseen) | (near_bit(place, found[1], limit, unseen) << 1u)
        | (near_bit(place, found[2], limit, unseen) << 2u) | (near_bit(place, found[3], limit, unseen) << 3u)
        | (near_bit(place, found[4], limit, unseen) << 4u) | (near_bit(place, found[5], limit, unseen) << 5u)
        | (near_bit(place, found[6], limit, unseen) << 6u) | (near_bit(place, found[7], limit, unseen) << 7u), u32(groups));
}

fn near_bit(place: Place, candidate: vec4i, limit: f32, unseen: u32) -> u32 {
    let offset = Vector(place - place_of(candidate));
    let is_seen = !(HAS_SOLIDS && u32(candidate.w) - GROUP_SOLID < unseen);
    return select(0u, 1u, dot(offset, offset) < limit && is_seen);
}
