// New velocities of walls and bodies from the forces on them, the second half of the solids' move and the first half of the
// next step's. One workgroup.
//
// in:  solid_state, solid_sum, blocks, motion_rows, control
// out: solid_state, control
@group(0) @binding(BINDING_solid_sum) var<storage, read> solid_sum: array<vec4f>;
@group(0) @binding(BINDING_blocks) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

var<workgroup> acceleration2_most: atomic<u32>; // squares, as bits: acceleration of free bodies,
var<workgroup> finish2_most: atomic<u32>;       // and ways
var<workgroup> drift2_most: atomic<u32>;

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
    let mass = solid_table[n].mass;
    let share = select(1.0, mass / sums[2].w, sums[2].w > mass);
    state = kicked_free(n, state, (sums[0] + share * sums[2]).xyz, (sums[1] + share * sums[3]).xyz, control.clock.dt);
    let square = dot(state.acceleration.xyz, state.acceleration.xyz);
    if is_finite(square) {
        atomicMax(&acceleration2_most, bitcast<u32>(square));
    }
    return state;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn solids(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&acceleration2_most, 0u);
        atomicStore(&finish2_most, 0u);
        atomicStore(&drift2_most, 0u);
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
            atomicMax(&finish2_most, solid_way_bits(n, kicked, finished));
            if next_half > 0.0 {
                atomicMax(&drift2_most, solid_way_bits(n, finished, drifted));
            }
        }
    }
    workgroupBarrier();
    if local == 0u && control.clock.stepping == 1u {
        let step = &control.maxima[control.clock.noting];
        (*step).acceleration2_bits = max((*step).acceleration2_bits, atomicLoad(&acceleration2_most));
        (*step).finish2_bits = max((*step).finish2_bits, atomicLoad(&finish2_most));
        (*step).drift2_bits = max((*step).drift2_bits, atomicLoad(&drift2_most));
    }
}
