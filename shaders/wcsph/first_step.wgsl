// Length of the first two steps after a new state, from the maxima that forces_read took.
//
// in:  control, its maxima
// out: control
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

@compute @workgroup_size(1)
fn first_step() {
    var clock = control.clock;
    limit_step(&clock, control.maxima[clock.noting]);
    clock.running = 0u;
    clock.sorting = 0u;
    clock.listing = 0u;
    control.clock = clock;
    control.starting = 0u;
}
