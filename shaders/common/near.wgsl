// Which candidates of a run of cells are near: up to 32 are tested before what passed is dealt with, so that the lanes of a warp
// take as long as the one with most that passed. One by one, all lanes would take part wherever one of them has somebody near.

// Candidates that are loaded together, so that they wait for memory together: as many as coordinate_block() gives.
const BLOCK = 8u;

// Bits of those within sqrt(limit) among the next 32 candidates, of which `left` are left of the run. Of groups less 1, those below
// `unseen` are not looked for.
fn near_among(place: Place, first: u32, left: u32, limit: f32, unseen: u32) -> u32 {
    var near = 0u;
    for (var k = 0u; k < min(left, 32u); k += BLOCK) {
        near |= near_block(place, first + k, limit, unseen) << k;
    }
    return near & (0xffffffffu >> (32u - min(left, 32u)));
}

fn near_block(place: Place, first: u32, limit: f32, unseen: u32) -> u32 {
    var candidates = coordinate_block(first); // beyond the run's end too, where it does not count
    var near = 0u;
    for (var k = 0u; k < BLOCK; k++) {
        let offset = Vector(place - place_of(candidates[k]));
        let is_seen = !(HAS_SOLIDS && u32(candidates[k].w) - GROUP_SOLID < unseen);
        near |= select(0u, 1u << k, dot(offset, offset) < limit && is_seen);
    }
    return near;
}
