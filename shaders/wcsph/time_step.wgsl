// The step's time and the length of the next one, where there are no solids: otherwise a thread of pass walls does it.
//
// in:  control, its maxima
// out: control
@compute @workgroup_size(1)
fn time_step() {
    advance_clock();
}
