// For a read: a working copy of the state as it is.
//
// in:  coordinate, motion (the state), control
// out: coordinate, motion (the working copy)
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn load(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count && control.clock.running == 1u {
        set_coordinate(side_start(control.clock.side) + i, coordinate_at(i));
        set_motion(side_start(control.clock.side) + i, motion_at(i));
    }
}
