// When emitters act: in the first half of a step's move, at the time of its middle (src/core/cpu/wcsph_emitters.c).
fn middle_of_step() -> vec2u {
    return add_ticks(control.time, ticks_of(control.drift_half));
}

fn any_layer_due() -> bool {
    let moves = control.drift_half > 0.0 && control.bad_step == 0xffffffffu;
    return EMITTER_COUNT > 0u && moves && !is_before(middle_of_step(), control.next_due);
}
