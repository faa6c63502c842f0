// Where the lists lie. A list is written in parts of eight entries, and those of 128 particles lie side by side. Part 0 is the
// header: how many entries follow, and in 3D the first candidate of each layer.
const NO_LIST = 0xffffffffu;

// With MARKS_MIXED, added to the number of entries where not all of them may be of fluid: in lists of WARP particles side by side
// if it is so in one of them, so that their threads do the same.
const MIXED_LIST = 0x80000000u;

// Particles of two solids touch within one spacing (common/contact.wgsl). Added to the number of entries of a free body's particle
// that another solid may touch while the list is in use.
const CONTACT_RANGE = 1.0; // spacings
const MEETS_SOLID = 0x40000000u;

// How many entries, of that word.
const LIST_COUNT = MEETS_SOLID - 1u;

const WARP = 32u;
const PART_STRIDE = 128u;

fn part_index(i: u32, part: u32) -> u32 {
    return ((i / PART_STRIDE) * (LIST_PARTS + 1u) + part) * PART_STRIDE + i % PART_STRIDE;
}

// In 3D threads of pass forces take the slots of fluid first: side by side they have as much to do, where every third particle
// is a wall's. (In 2D walls are few, and looking a slot up costs more: docs/performance/tries.md.) The slots in that order are
// the end of cell_start; in 2D those of solids alone, in the order of ids. Where that of the k-th particle stands:
const FLUID_FIRST = HAS_SOLIDS && DIMENSION == 3u;

fn fluid_first_at(k: u32) -> u32 {
    return arrayLength(&cell_start) - constants.particle_count + k;
}
