// Before the first step of a batch: its length, and the first half of the solids' move.
//
// in:  control, solid_state, motion_rows
// out: control, step_end (sizes of dispatches), solid_state
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

var<workgroup> drift2_most: atomic<u32>; // wgpu-native does not zero it

// The first step's turn is 0.
fn start_batch() {
    var clock = control.clock;
    clock.steps_left = control.steps_asked;
    clock.left = select(time_left(clock.time), 0.0, control.bad_step != 0xffffffffu);
    choose_step(&clock);
    control.maxima[2] = control.maxima[clock.noting];
    control.maxima[0] = Maxima();
    clock.noting = 2u;
    control.clock = clock;
    control.clocks[0] = prepared(clock);
    leave_sort_groups(clock);
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn begin(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        atomicStore(&drift2_most, 0u);
        start_batch();
    }
    storageBarrier();
    workgroupBarrier();
    if MOVING_SOLIDS {
        let half = 0.5 * control.clock.next_dt;
        for (var n = local; n < SOLID_COUNT; n += WORKGROUP_SIZE) {
            let before = solid_state[NOW + n];
            let after = drifted_solid(n, before, half, add_ticks(control.clock.time, ticks_of(half)));
            solid_state[NOW + n] = after;
            if half > 0.0 {
                atomicMax(&drift2_most, solid_way_bits(n, before, after));
            }
        }
        workgroupBarrier();
        if local == 0u {
            let last = &control.maxima[control.clock.noting];
            (*last).drift2_bits = max((*last).drift2_bits, atomicLoad(&drift2_most));
        }
    }
}
