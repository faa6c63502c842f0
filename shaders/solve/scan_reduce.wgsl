// First half of the exclusive prefix sum over cell_count: the sum of each block of SCAN_BLOCK cells.
//
// in:  cell_count
// out: block_sum
@group(0) @binding(BINDING_cell_count) var<storage, read> cell_count: array<vec4u>;
@group(0) @binding(BINDING_block_sum) var<storage, read_write> block_sum: array<u32>;

var<workgroup> total: atomic<u32>; // wgpu-native does not zero it

@compute @workgroup_size(WORKGROUP_SIZE)
fn scan_reduce(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
               @builtin(local_invocation_index) local: u32) {
    if !is_sorting() {
        return;
    }
    let block = workgroup_index(workgroup, workgroups);
    let blocks = arrayLength(&block_sum);
    if local == 0u {
        atomicStore(&total, 0u);
    }
    workgroupBarrier();
    var sum = vec4u(0u);
    if block < blocks {
        for (var k = 0u; k < SCAN_VECTORS; k++) {
            sum += cell_count[(block * SCAN_VECTORS + k) * WORKGROUP_SIZE + local];
        }
    }
    atomicAdd(&total, sum.x + sum.y + sum.z + sum.w);
    workgroupBarrier();
    if local == 0u && block < blocks {
        block_sum[block] = atomicLoad(&total);
    }
}
