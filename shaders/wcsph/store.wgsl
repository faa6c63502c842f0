// After the first sort, and after a blow-up: the working copy of the last step becomes the state.
//
// in:  coordinate, motion (the working copy), control
// out: coordinate, motion (the state)
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn store(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count {
        set_coordinate(i, coordinate_at(side_start(control.clock.last_side) + i));
        set_motion(i, motion_at(side_start(control.clock.last_side) + i));
    }
}
