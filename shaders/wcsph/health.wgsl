// After a blow-up: where the particle is that was found first. One workgroup, which otherwise has nothing to do.
//
// in:  coordinate, id, control
// out: control.bad_place
@group(0) @binding(BINDING_coordinate) var<storage, read> coordinate: array<vec4i>;
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn health(@builtin(local_invocation_index) local: u32) {
    if control.bad_step == 0xffffffffu {
        return;
    }
    for (var i = local; i < constants.particle_count; i += WORKGROUP_SIZE) {
        if id[i] == control.bad_id {
            control.bad_place = coordinate[side_start(control.last_side) + i];
        }
    }
}
