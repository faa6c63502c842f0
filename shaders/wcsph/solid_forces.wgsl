// Forces and torques on solids, summed over one block of particles per workgroup, always in the same order.
//
// in:  kicked (forces by slot; for a read accelerations), solid_particle, solid_state, blocks: solid, first id, last id + 1
// out: solid_sum, four per block: force and torque of the fluid, of contact; in the forces' w how much fluid is around, and how
//      much contact would move, kg
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;
@group(0) @binding(BINDING_solid_particle) var<storage, read> solid_particle: array<SolidParticle>;
@group(0) @binding(BINDING_blocks) var<storage, read> blocks: array<vec4u>;
@group(0) @binding(BINDING_solid_sum) var<storage, read_write> solid_sum: array<vec4f>;

var<workgroup> partial: array<array<vec4f, 4>, WORKGROUP_SIZE>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn solid_forces(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
                    @builtin(local_invocation_index) local: u32) {
    let b = min(workgroup_index(workgroup, workgroups), arrayLength(&blocks) - 1u);
    let block = blocks[b];
    let orientation = solid_state[NOW + block.x].orientation;
    var sums = array<vec4f, 4>();
    for (var id = block.y + local; id < block.z; id += WORKGROUP_SIZE) {
        let particle = id - constants.first_solid;
        let arm = rotate(orientation, solid_particle[particle].start);
        let slot = solid_particle[particle].slot;
        var fluid: vec4f;
        var contact = vec4f();
        if FORCES_READ {
            fluid = vec4f(constants.particle_mass * kicked_at(slot).xyz, 0.0);
        } else {
            fluid = kicked_at(constants.particle_count + slot);
            contact = kicked_at(slot);
        }
        sums[0] += fluid;
        sums[1] += vec4f(cross(arm, fluid.xyz), 0.0);
        sums[2] += contact;
        sums[3] += vec4f(cross(arm, contact.xyz), 0.0);
    }
    partial[local] = sums;
    for (var half = WORKGROUP_SIZE / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if local < half {
            for (var k = 0u; k < 4u; k++) {
                partial[local][k] += partial[local + half][k];
            }
        }
    }
    if local < 4u {
        solid_sum[4u * b + local] = partial[0][local];
    }
}
