// Second half of the exclusive prefix sum: cell_start[c] = number of particles in the cells before c. Each
// workgroup adds up the blocks before its own, so no third dispatch is needed.
//
// in:  cell_count, block_sum
// out: cell_start; beyond the last cell it holds the particle count. cell_count is emptied for the next count
@group(0) @binding(BINDING_cell_count) var<storage, read_write> cell_count: array<vec4u>;
@group(0) @binding(BINDING_block_sum) var<storage, read> block_sum: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read_write> cell_start: array<vec4u>;

var<workgroup> before: atomic<u32>; // wgpu-native does not zero it
var<workgroup> thread_sum: array<u32, WORKGROUP_SIZE>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn scan_write(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
              @builtin(local_invocation_index) local: u32) {
    if !is_sorting() {
        return;
    }
    // The last row of workgroups may reach beyond the blocks.
    let blocks = arrayLength(&block_sum);
    let writes = workgroup_index(workgroup, workgroups) < blocks;
    let block = min(workgroup_index(workgroup, workgroups), blocks - 1u);
    if local == 0u {
        atomicStore(&before, 0u);
    }
    workgroupBarrier();
    var earlier = 0u;
    for (var b = local; b < block; b += WORKGROUP_SIZE) {
        earlier += block_sum[b];
    }
    atomicAdd(&before, earlier);

    let first = (block * WORKGROUP_SIZE + local) * SCAN_VECTORS;
    var counts: array<vec4u, SCAN_VECTORS>;
    var own = 0u;
    for (var k = 0u; k < SCAN_VECTORS; k++) {
        counts[k] = cell_count[first + k];
        own += counts[k].x + counts[k].y + counts[k].z + counts[k].w;
    }
    thread_sum[local] = own;
    workgroupBarrier();
    // Inclusive prefix sum over the threads, doubling the distance (Hillis and Steele 1986).
    for (var distance = 1u; distance < WORKGROUP_SIZE; distance *= 2u) {
        var other = 0u;
        if local >= distance {
            other = thread_sum[local - distance];
        }
        workgroupBarrier();
        thread_sum[local] += other;
        workgroupBarrier();
    }

    var start = atomicLoad(&before) + thread_sum[local] - own;
    for (var k = 0u; k < SCAN_VECTORS && writes; k++) {
        let n = counts[k];
        cell_count[first + k] = vec4u(0u);
        cell_start[first + k] = vec4u(start, start + n.x, start + n.x + n.y, start + n.x + n.y + n.z);
        start += n.x + n.y + n.z + n.w;
    }
}
