// Before the passes of a read: they run unless the state is one that blew up, which the sorted particles, the last good
// ones, must outlive.
//
// in:  control
// out: control.running
@compute @workgroup_size(1)
fn begin_read() {
    control.running = select(0u, 1u, control.bad_step == 0xffffffffu || control.restored == 1u);
}
