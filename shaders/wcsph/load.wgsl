// For a read: a working copy of the state as it is.
//
// in:  coordinate, motion (the state), control
// out: coordinate, motion (the working copy)
@group(0) @binding(BINDING_coordinate) var<storage, read_write> coordinate: array<vec4i>;
@group(0) @binding(BINDING_motion) var<storage, read_write> motion: array<vec4f>;
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn load(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count && control.running == 1u {
        coordinate[side_start(control.side) + i] = coordinate[i];
        motion[side_start(control.side) + i] = motion[i];
    }
}
