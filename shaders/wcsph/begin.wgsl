// Before the first step of a batch: its length, and the first half of the solids' move.
//
// in:  control, solid_state, motion_rows
// out: control, solid_state
@compute @workgroup_size(WORKGROUP_SIZE)
fn begin(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        control.finishing = 0u;
        choose_step();
    }
    storageBarrier();
    workgroupBarrier();
    if MOVING_SOLIDS {
        for (var n = local; n < SOLID_COUNT; n += WORKGROUP_SIZE) {
            solid_state[NOW + n] = drifted_solid(n, solid_state[NOW + n], control.drift_half,
                                            add_ticks(control.time, ticks_of(control.drift_half)));
        }
    }
}
