// Before the passes of a read: they run unless the state is one that blew up, whose last good state is still to be put
// back. They work in the first of the working copies, where the host finds what they leave.
//
// in:  control
// out: control
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

@compute @workgroup_size(1)
fn begin_read() {
    control.clock.running = select(0u, 1u, is_well(control.bad_step, control.restored));
    if control.clock.running == 1u {
        control.clock.side = 0u;
    }
    // For walls: no step, on that copy.
    control.clocks[0] = control.clock;
    control.clocks[0].stepping = 0u;
    control.clocks[0].last_side = control.clock.side;
    control.clocks[0].noting = next_turn(control.clock.noting);
    if control.restored == 1u {
        // Ways of the step that went wrong.
        control.maxima[control.clock.noting].finish2_bits = 0u;
        control.maxima[control.clock.noting].drift2_bits = 0u;
    }
}
