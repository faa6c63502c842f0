// Which candidates of a run of cells are near. First the tests of up to 32 of them, then the few that passed: a warp's lanes take as
// long as the one with most of those. Testing and summing one by one, all would take part in each candidate that any has near.

// Candidates that are loaded together, so that they wait for memory together.
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
    var candidates: array<vec4i, BLOCK>;
    for (var k = 0u; k < BLOCK; k++) {
        candidates[k] = coordinate[first + k]; // beyond the run's end too, where it does not count
    }
    var near = 0u;
    for (var k = 0u; k < BLOCK; k++) {
        let offset = Vector(place - place_of(candidates[k]));
        let is_seen = !(HAS_SOLIDS && u32(candidates[k].w) - GROUP_SOLID < unseen);
        near |= select(0u, 1u << k, dot(offset, offset) < limit && is_seen);
    }
    return near;
}
