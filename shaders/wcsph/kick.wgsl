// The particles of moving solids: their velocity in the middle of the step with the solid's new velocity,
// and their way to where the solid moves. Fluid is kicked by forces.
//
// in:  coordinate, solid_particle, solid_state, control
// out: kicked; its second copy: the way, in quanta
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_solid_particle) var<storage, read> solid_particle: array<SolidParticle>;
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn kick(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
        @builtin(local_invocation_index) local: u32) {
    let particle = thread_index(workgroup, workgroups, local);
    if particle >= constants.particle_count - constants.first_solid || control.stepping == 0u {
        return;
    }
    let i = solid_particle[particle].slot;
    let own = coordinate_at(side_start(control.last_side) + i);
    let group = u32(own.w);
    if solid_table[group - GROUP_SOLID].kind == SOLID_FIXED {
        return;
    }
    let n = group - GROUP_SOLID;
    let start = solid_particle[particle].start;
    let arm = rotate(solid_state[NEW + n].orientation, start);
    let velocity = solid_state[NEW + n].velocity.xyz + cross(solid_state[NEW + n].angular_velocity.xyz, arm);
    set_kicked(i, vec4f(velocity, kicked_at(i).w));
    let way = way_to(solid_state[NOW + n], start, place_of(own)); // less than a support: exact in a float
    set_kicked(constants.particle_count + i, vec4f(wide(Vector(way)), 0.0));
}
