// Where the chunks of a list lie: those of 128 particles side by side. Chunk 0 is the header: how many follow, and in 3D
// the first candidate of each layer.
const NO_LIST = 0xffffffffu;

fn chunk_index(i: u32, chunk: u32) -> u32 {
    return ((i >> 7u) * (LIST_CHUNKS + 1u) + chunk) * 128u + (i & 127u);
}
