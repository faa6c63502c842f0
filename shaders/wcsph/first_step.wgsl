// Length of the first two steps after a new state, from the maxima that forces_read took.
//
// in:  control, its maxima
// out: control
@compute @workgroup_size(1)
fn first_step() {
    limit_step();
    control.starting = 0u;
    control.running = 0u;
    control.sorting = 0u;
}
