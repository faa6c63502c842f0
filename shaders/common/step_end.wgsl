// For passes that begin a step.
@group(0) @binding(BINDING_step_end) var<storage, read_write> step_end: StepEnd;

// By one thread.
fn leave_sort_groups(sorting: u32) {
    for (var k = 0u; k < SORT_SIZES; k++) {
        step_end.sort_groups[k] = sorting * step_end.sort_groups[SORT_SIZES + k];
    }
}
