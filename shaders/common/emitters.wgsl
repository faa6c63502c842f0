// When emitters act: in the first half of a step's move, at the time of the next one's middle (src/core/cpu/wcsph_emitters.c).
fn middle_of_step(clock: Clock) -> vec2u {
    return add_ticks(clock.time, ticks_of(0.5 * clock.next_dt));
}

// At a chance, whether a layer is due before the next one, if the steps until then are as long as this one may be.
fn any_layer_due(clock: Clock) -> bool {
    let chance = clock.steps % EMISSION_INTERVAL == 0u;
    let next_chance = add_ticks(middle_of_step(clock), ticks_of(f32(EMISSION_INTERVAL) * clock.free_dt));
    return EMITTER_COUNT > 0u && chance && !is_before(next_chance, control.next_due);
}

// Whether layers are born before the step under way. `bad_step`: of control, which passes hold in two types.
fn is_emitting(bad_step: u32) -> bool {
    return is_well(bad_step, 0u) && control.clock.next_dt > 0.0 && any_layer_due(control.clock);
}
