// The step's time and the length of the next one, where neither walls nor forces do it: in 3D without solids.
//
// in:  control, its maxima
// out: control, step_end (sizes of dispatches)
@group(0) @binding(BINDING_control) var<storage, read_write> control: SharedControl;

@compute @workgroup_size(1)
fn time_step() {
    tell_clock(begun(0u, control.clocks[0].noting));
}
