// When emitters act: in the first half of a step's move, at the time of its middle (src/core/cpu/wcsph_emitters.c).
fn middle_of_step() -> vec2u {
    return add_ticks(control.time, ticks_of(control.drift_half));
}

fn layer_due(n: u32) -> bool {
    let time = middle_of_step();
    let moves = control.drift_half > 0.0 && control.bad_step == 0xffffffffu;
    return moves && !is_before(time, control.due[n].xy) && !is_before(control.due[n].zw, time);
}

fn any_layer_due() -> bool {
    for (var n = 0u; n < EMITTER_COUNT; n++) {
        if layer_due(n) {
            return true;
        }
    }
    return false;
}
