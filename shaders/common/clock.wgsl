// Time and time step (weir_wcsph_time_step, next_step), by one thread. Times are counts of 2^-42 s in two words.
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

const TICKS_PER_ROOT = 2097152.0; // 2^21: ticks of 2^-42 s are reached in two exact factors

fn ticks_of(seconds: f32) -> vec2u {
    let scaled = seconds * TICKS_PER_ROOT;
    let whole = floor(scaled);
    let fraction = u32(round((scaled - whole) * TICKS_PER_ROOT));
    // whole * 2^21 + fraction
    let w = u32(whole);
    let low = w << 21u;
    let sum = low + fraction;
    return vec2u(sum, (w >> 11u) + select(0u, 1u, sum < low));
}

fn add_ticks(a: vec2u, b: vec2u) -> vec2u {
    let low = a.x + b.x;
    return vec2u(low, a.y + b.y + select(0u, 1u, low < a.x));
}

// a - b, which is not negative.
fn subtract_ticks(a: vec2u, b: vec2u) -> vec2u {
    return vec2u(a.x - b.x, a.y - b.y - select(0u, 1u, a.x < b.x));
}

fn is_before(a: vec2u, b: vec2u) -> bool {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}

fn seconds_of(ticks: vec2u) -> f32 {
    return f32(ticks.y) * 0.0009765625 + f32(ticks.x) / TICKS_PER_ROOT / TICKS_PER_ROOT;
}

// The largest values of a step give the longest step that may follow.
fn take_maxima() {
    control.max_speed = bitcast<f32>(control.speed_bits);
    let acceleration = bitcast<f32>(control.acceleration_bits);
    control.speed_bits = 0u;
    control.acceleration_bits = 0u;
    control.free_dt = parameters.time_step;
    if FIXED_STEP {
        return;
    }
    let h = constants.smoothing_length;
    var dt = h / (constants.sound_speed + control.max_speed);
    if acceleration > 0.0 {
        dt = min(dt, sqrt(h / acceleration));
    }
    dt *= parameters.courant;
    if parameters.viscosity > 0.0 {
        dt = min(dt, 0.125 * h * h * parameters.rest_density / parameters.viscosity);
    }
    control.free_dt = dt;
}

// Length of the next step; the last two before `until` share what is left, so that none is tiny. 0: no step is left.
fn choose_step() {
    control.dt = 0.0;
    if control.steps_left > 0u && is_before(control.time, control.until) {
        let left = seconds_of(subtract_ticks(control.until, control.time));
        let shortened = select(control.free_dt, 0.5 * left, control.free_dt > 0.5 * left);
        control.dt = select(shortened, left, control.free_dt >= left);
    }
    control.running = select(0u, 1u, control.dt > 0.0 && control.bad_step == 0xffffffffu);
    control.drift_half = select(0.0, 0.5 * control.dt, control.running == 1u);
    let chance = control.steps % SORT_INTERVAL == 0u && control.stale == 1u;
    control.sorting = select(0u, 1u, control.running == 1u && (chance || any_layer_due()));
}

// Whether lists and cells are to be made anew at the next chance, because they might not last until the one after it,
// and for which way they would be made.
fn judge_order() {
    let way = control.moved_finish + control.moved_drift;
    control.travelled += way;
    control.moved_finish = 0u;
    control.moved_drift = 0u;
    let fastest = control.max_speed * max(control.free_dt, control.last_dt) * constants.inverse_quantum;
    let until_next = f32(SORT_INTERVAL) * (1.25 * max(fastest, f32(way)) + 4.0);
    let moved = f32(control.travelled - control.sorted_at);
    control.stale = select(0u, 1u, moved + until_next > f32(control.allowance));
    control.next_allowance = u32(clamp(2.0 * until_next, LEAST_ALLOWANCE, MOST_ALLOWANCE));
}

// Whether the step under way moves anything.
fn is_stepping() -> bool {
    return control.running == 1u && control.bad_step == 0xffffffffu;
}

// Between forces and finish: the step gets its number and time, and the next one its length.
fn advance_clock() {
    if !is_stepping() {
        control.running = 0u;
        control.finishing = 0u;
        return;
    }
    control.finishing = 1u;
    let end = add_ticks(control.time, ticks_of(control.dt));
    // A step that was shortened to end there ends there exactly.
    let left = seconds_of(subtract_ticks(control.until, control.time));
    control.time = end;
    if control.dt == left || !is_before(end, control.until) {
        control.time = control.until;
    }
    control.last_dt = control.dt;
    control.steps += 1u;
    control.steps_left -= 1u;
    control.error_bits = 0u;
    control.last_side = control.side;
    control.side = 1u - control.side;
    take_maxima();
    judge_order();
    choose_step();
}
