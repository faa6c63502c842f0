// Where the lists lie. A list is written in parts of eight entries, and those of 128 particles lie side by side. Part 0 is the
// header: how many entries follow, and in 3D the first candidate of each layer.
const NO_LIST = 0xffffffffu;
const PART_STRIDE = 128u;

fn part_index(i: u32, part: u32) -> u32 {
    return ((i / PART_STRIDE) * (LIST_PARTS + 1u) + part) * PART_STRIDE + i % PART_STRIDE;
}
