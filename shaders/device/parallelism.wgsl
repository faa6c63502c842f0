// How many threads a device runs as fast as one (src/gpu/parallelism.h): each adds up a chain of products of which every one
// waits for the one before.
@group(0) @binding(0) var<storage, read_write> chain: array<f32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn parallelism(@builtin(global_invocation_id) thread: vec3u) {
    var sum = chain[0] + f32(thread.x);
    let factor = chain[1];
    for (var turn = 0u; turn < TURNS; turn++) {
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
        sum = fma(sum, factor, 1.0);
    }
    if sum == -1.0 { // never: the chain is there for its time
        chain[2] = sum;
    }
}
