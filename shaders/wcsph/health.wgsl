// After a blow-up: who and where the particle is that was found first.
//
// in:  coordinate, id, control
// out: control.bad_id, bad_place
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

@compute @workgroup_size(1)
fn health() {
    if control.bad_step != 0xffffffffu {
        control.bad_id = id[control.bad_slot];
        control.bad_place = coordinate_at(side_start(control.clock.last_side) + control.bad_slot);
    }
}
