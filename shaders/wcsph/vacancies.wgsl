// Where layers of emitters are due: which slots are empty, by id, and how many of each block of ids.
//
// in:  coordinate, id, control
// out: vacancy: the place of the empty slot plus 1, or 0; then the blocks' counts, which emit leaves at 0
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_vacancy) var<storage, read_write> vacancy: array<atomic<u32>>;
@group(0) @binding(BINDING_control) var<storage, read> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn vacancies(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
             @builtin(local_invocation_index) local: u32) {
    if !is_emitting(control.bad_step) {
        return;
    }
    let threads = workgroups.x * workgroups.y * WORKGROUP_SIZE;
    for (var i = thread_index(workgroup, workgroups, local); i < constants.particle_count; i += threads) {
        let own = id[i];
        if own >= constants.first_solid {
            continue;
        }
        let is_empty = u32(coordinate_at(i).w) == GROUP_EMPTY;
        atomicStore(&vacancy[own], select(0u, i + 1u, is_empty));
        if is_empty {
            atomicAdd(&vacancy[constants.first_solid + own / VACANCY_BLOCK], 1u);
        }
    }
}
