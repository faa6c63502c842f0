// When emitters act: in the first half of a step's move, at the time of the next one's middle (src/core/cpu/wcsph_emitters.c).
fn middle_of_step() -> vec2u {
    return add_ticks(control.time, ticks_of(0.5 * control.next_dt));
}

// At a chance, whether a layer is due before the next one, if the steps until then are as long as this one may be.
fn any_layer_due() -> bool {
    let moves = control.next_dt > 0.0 && control.bad_step == 0xffffffffu;
    let chance = control.steps % EMISSION_INTERVAL == 0u;
    let next_chance = add_ticks(middle_of_step(), ticks_of(f32(EMISSION_INTERVAL) * control.free_dt));
    return EMITTER_COUNT > 0u && moves && chance && !is_before(next_chance, control.next_due);
}
