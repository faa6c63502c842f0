// Time and time step (weir_wcsph_time_step, next_step), by one thread. Times are counts of 2^-42 s in two words.
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;
// Sizes of the dispatches of the next sort, then those that they have if there is one.
@group(0) @binding(BINDING_sort_groups) var<storage, read_write> sort_groups: array<vec4u, 2u * SORT_SIZES>;

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

// Density error from which steps get shorter: three times what the method is valid for.
const VIOLENT_ERROR = 0.1;

// The largest values of the last step give the longest one that may follow that under way.
fn limit_step() {
    control.max_speed = bitcast<f32>(control.speed_bits);
    let acceleration = bitcast<f32>(control.acceleration_bits);
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
    let error = bitcast<f32>(control.error_bits);
    if error > VIOLENT_ERROR {
        dt *= max(sqrt(VIOLENT_ERROR / error), 0.1); // a step that vanishes would find no blow-up
    }
    if parameters.viscosity > 0.0 {
        dt = min(dt, 0.125 * h * h * parameters.rest_density / parameters.viscosity);
    }
    control.free_dt = dt;
}

// Length of the next step; the last two before `until` share what is left, so that none is tiny. 0: no step is left.
fn choose_step() {
    control.next_dt = 0.0;
    if control.steps_left > 0u && is_before(control.time, control.until) && control.bad_step == 0xffffffffu {
        let left = seconds_of(subtract_ticks(control.until, control.time));
        let shortened = select(control.free_dt, 0.5 * left, control.free_dt > 0.5 * left);
        control.next_dt = select(shortened, left, control.free_dt >= left);
    }
    let chance = control.steps % SORT_INTERVAL == 0u && control.stale == 1u;
    control.sorting = select(0u, 1u, control.next_dt > 0.0 && (chance || any_layer_due()));
    for (var k = 0u; k < SORT_SIZES; k++) {
        sort_groups[k] = control.sorting * sort_groups[SORT_SIZES + k];
    }
}

// Whether lists and cells are to be made anew at the next chance, because they might not last until the one after it,
// and for which way they would be made.
fn judge_order() {
    let way = control.moved_finish[control.side] + control.moved_drift[control.side];
    control.reached = control.travelled + way;
    control.moved_finish[1u - control.side] = 0u;
    control.moved_drift[1u - control.side] = 0u;
    let fastest = control.max_speed * max(control.free_dt, control.dt) * constants.inverse_quantum;
    let until_next = f32(SORT_INTERVAL) * (1.25 * max(fastest, f32(way)) + 4.0);
    let moved = f32(control.reached - control.sorted_at);
    control.stale = select(0u, 1u, moved + until_next > f32(control.allowance));
    control.next_allowance = u32(clamp(2.0 * until_next, LEAST_ALLOWANCE, MOST_ALLOWANCE));
}

// Before forces: the step under way gets its number, length and time, and the next one its length. Not in a read, between
// steps.
fn advance_clock() {
    if control.running == 0u || control.next_dt == 0.0 || control.bad_step != 0xffffffffu {
        control.stepping = 0u;
        return;
    }
    control.stepping = 1u;
    control.last_side = control.side;
    control.dt = control.next_dt;
    control.began = control.time;
    let end = add_ticks(control.time, ticks_of(control.dt));
    // A step that was shortened to end there ends there exactly.
    let left = seconds_of(subtract_ticks(control.until, control.time));
    control.time = end;
    if control.dt == left || !is_before(end, control.until) {
        control.time = control.until;
    }
    control.steps += 1u;
    control.steps_left -= 1u;
    limit_step();
    control.speed_bits = 0u;
    control.acceleration_bits = 0u;
    control.error_bits = 0u;
    judge_order();
    choose_step();
}
