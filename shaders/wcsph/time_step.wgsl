// The step's time and the length of the next one, where no solid moves: otherwise pass solids does it.
//
// in:  control, its maxima
// out: control
@compute @workgroup_size(1)
fn time_step() {
    advance_clock();
}
