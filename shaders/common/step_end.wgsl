// For passes that begin a step.
@group(0) @binding(BINDING_step_end) var<storage, read_write> step_end: StepEnd;

// By one thread.
fn leave_sort_groups(clock: Clock) {
    for (var k = 0u; k < SORT_SIZES; k++) {
        let wanted = select(clock.sorting, clock.listing, k == SORT_LISTS);
        step_end.sort_groups[k] = wanted * step_end.sort_groups[SORT_SIZES + k];
    }
}
