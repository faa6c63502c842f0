// New velocities of walls and bodies from the forces on them, the second half of the solids' move and the first half of the
// next step's. One workgroup.
//
// in:  solid_state, solid_sum, blocks, motion_rows, control
// out: solid_state, control
@group(0) @binding(BINDING_solid_sum) var<storage, read> solid_sum: array<vec4f>;
@group(0) @binding(BINDING_blocks) var<storage, read> blocks: array<vec4u>;

var<workgroup> largest: atomic<u32>; // acceleration of free bodies, as bits
var<workgroup> finish_most: atomic<u32>; // ways
var<workgroup> drift_most: atomic<u32>;

fn kicked_solid(n: u32) -> SolidState {
    var state = solid_state[NOW + n];
    if solid_table[n].kind != SOLID_FREE {
        if is_driven(n) {
            state = kicked_driven(n, state, control.dt);
        }
        return state;
    }
    var sums = array<vec4f, 4>();
    for (var b = 0u; b < FREE_BLOCKS; b++) {
        if blocks[b].x == n {
            for (var k = 0u; k < 4u; k++) {
                sums[k] += solid_sum[4u * b + k];
            }
        }
    }
    // Contact moves the body, but the force that is told is the fluid's.
    state.force = sums[0];
    state.torque = sums[1];
    state = kicked_free(n, state, (sums[0] + sums[2]).xyz, (sums[1] + sums[3]).xyz, control.dt);
    let acceleration = length(state.acceleration.xyz);
    if is_finite(acceleration) {
        atomicMax(&largest, bitcast<u32>(acceleration));
    }
    return state;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn solids(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&largest, 0u);
        atomicStore(&finish_most, 0u);
        atomicStore(&drift_most, 0u);
    }
    workgroupBarrier();
    if control.stepping == 1u {
        let next_half = 0.5 * control.next_dt;
        let next = add_ticks(control.time, ticks_of(next_half));
        for (var n = local; n < SOLID_COUNT; n += WORKGROUP_SIZE) {
            let kicked = kicked_solid(n);
            let finished = drifted_solid(n, kicked, 0.5 * control.dt, control.time);
            let drifted = drifted_solid(n, finished, next_half, next);
            solid_state[SAVED + n] = solid_state[NOW + n];
            solid_state[NEW + n] = kicked;
            solid_state[NOW + n] = drifted;
            atomicMax(&finish_most, solid_way(n, kicked, finished));
            if next_half > 0.0 {
                atomicMax(&drift_most, solid_way(n, finished, drifted));
            }
        }
    }
    workgroupBarrier();
    if local == 0u && control.stepping == 1u {
        control.acceleration_bits = max(control.acceleration_bits, atomicLoad(&largest));
        let side = 1u - control.last_side;
        control.moved_finish[side] = max(control.moved_finish[side], atomicLoad(&finish_most));
        control.moved_drift[side] = max(control.moved_drift[side], atomicLoad(&drift_most));
    }
}
