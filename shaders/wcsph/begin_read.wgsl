// Before the passes of a read: they run unless the state is one that blew up, whose last good state is still to be put
// back. They work in the first of the working copies, where the host finds what they leave.
//
// in:  control
// out: control
@compute @workgroup_size(1)
fn begin_read() {
    control.running = select(0u, 1u, is_well(control.bad_step, control.restored));
    if control.running == 1u {
        control.moved_finish[0] = control.moved_finish[control.side];
        control.moved_drift[0] = control.moved_drift[control.side];
        control.side = 0u;
    }
    if control.restored == 1u {
        // Ways of the step that went wrong.
        control.moved_finish[0] = 0u;
        control.moved_drift[0] = 0u;
    }
}
