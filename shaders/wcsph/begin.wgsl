// Before the first step of a batch: its length, and the first half of the solids' move.
//
// in:  control, solid_state, motion_rows
// out: control, solid_state
var<workgroup> way_most: atomic<u32>; // wgpu-native does not zero it

@compute @workgroup_size(WORKGROUP_SIZE)
fn begin(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&way_most, 0u);
        choose_step();
        control.running = select(0u, 1u, control.next_dt > 0.0);
    }
    storageBarrier();
    workgroupBarrier();
    if MOVING_SOLIDS {
        let half = 0.5 * control.next_dt;
        for (var n = local; n < SOLID_COUNT; n += WORKGROUP_SIZE) {
            let before = solid_state[NOW + n];
            let after = drifted_solid(n, before, half, add_ticks(control.time, ticks_of(half)));
            solid_state[NOW + n] = after;
            if half > 0.0 {
                atomicMax(&way_most, solid_way(n, before, after));
            }
        }
        workgroupBarrier();
        if local == 0u {
            control.moved_drift[control.side] = max(control.moved_drift[control.side], atomicLoad(&way_most));
        }
    }
}
