// When emitters act: in the first half of a step's move, at the time of the next one's middle (src/core/cpu/wcsph_emitters.c).
fn middle_of_step() -> vec2u {
    return add_ticks(control.time, ticks_of(0.5 * control.next_dt));
}

fn any_layer_due() -> bool {
    let moves = control.next_dt > 0.0 && control.bad_step == 0xffffffffu;
    return EMITTER_COUNT > 0u && moves && !is_before(middle_of_step(), control.next_due);
}
