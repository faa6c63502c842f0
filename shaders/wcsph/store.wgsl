// After the first sort, and after a blow-up: the working copy of the last step becomes the state.
//
// in:  coordinate, motion (the working copy), control
// out: coordinate, motion (the state)
@group(0) @binding(BINDING_coordinate) var<storage, read_write> coordinate: array<vec4i>;
@group(0) @binding(BINDING_motion) var<storage, read_write> motion: array<vec4f>;
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn store(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
         @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i < constants.particle_count {
        coordinate[i] = coordinate[side_start(control.last_side) + i];
        motion[i] = motion[side_start(control.last_side) + i];
    }
}
