// New velocities of walls and bodies from the forces on them, the second half of the solids' move and the first half of the
// next step's. One workgroup.
//
// in:  solid_state, solid_sum, blocks, motion_rows, control
// out: solid_state, control
@group(0) @binding(BINDING_solid_sum) var<storage, read> solid_sum: array<vec4f>;
@group(0) @binding(BINDING_blocks) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

var<workgroup> largest: atomic<u32>; // acceleration of free bodies, as bits
var<workgroup> finish_most: atomic<u32>; // ways
var<workgroup> drift_most: atomic<u32>;

fn kicked_solid(n: u32) -> SolidState {
    var state = solid_state[NOW + n];
    if solid_table[n].kind != SOLID_FREE {
        if is_driven(n) {
            state = kicked_driven(n, state, control.clock.dt);
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
    state = kicked_free(n, state, (sums[0] + sums[2]).xyz, (sums[1] + sums[3]).xyz, control.clock.dt);
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
    if control.clock.stepping == 1u {
        let next_half = 0.5 * control.clock.next_dt;
        let next = add_ticks(control.clock.time, ticks_of(next_half));
        for (var n = local; n < SOLID_COUNT; n += WORKGROUP_SIZE) {
            let kicked = kicked_solid(n);
            let finished = drifted_solid(n, kicked, 0.5 * control.clock.dt, control.clock.time);
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
    if local == 0u && control.clock.stepping == 1u {
        let step = &control.maxima[control.clock.noting];
        (*step).acceleration_bits = max((*step).acceleration_bits, atomicLoad(&largest));
        (*step).moved_finish = max((*step).moved_finish, atomicLoad(&finish_most));
        (*step).moved_drift = max((*step).moved_drift, atomicLoad(&drift_most));
    }
}
