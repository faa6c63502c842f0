// Where a layer of an emitter is due: which slots are empty, by id.
//
// in:  coordinate, id, control
// out: vacancies: the place of the empty slot plus 1, or 0
@group(0) @binding(BINDING_coordinate) var<storage, read> coordinate: array<vec4i>;
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_vacancy) var<storage, read_write> vacancy: array<u32>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn vacancies(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
             @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count || !any_layer_due() {
        return;
    }
    if id[i] < constants.first_solid {
        vacancy[id[i]] = select(0u, i + 1u, u32(coordinate[i].w) == GROUP_EMPTY);
    }
}
