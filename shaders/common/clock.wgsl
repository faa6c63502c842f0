// Time and time step (core/cpu/wcsph.c), for passes with a `control`. Times are counts of 2^-42 s in two words.

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
fn limit_step(clock: ptr<function, Clock>, last: Maxima) {
    (*clock).max_speed = sqrt(bitcast<f32>(last.speed2_bits));
    let acceleration = sqrt(bitcast<f32>(last.acceleration2_bits));
    (*clock).free_dt = parameters.time_step;
    if FIXED_STEP {
        return;
    }
    let h = constants.smoothing_length;
    var dt = h / (constants.sound_speed + (*clock).max_speed);
    if acceleration > 0.0 {
        dt = min(dt, sqrt(h / acceleration));
    }
    dt *= parameters.courant;
    let error = bitcast<f32>(last.excess_bits) / parameters.rest_density;
    if error > VIOLENT_ERROR {
        dt *= max(sqrt(VIOLENT_ERROR / error), 0.1); // a step that vanishes would find no blow-up
    }
    (*clock).free_dt = min(dt, constants.viscous_step);
}

// Length of the next step; the last two before `until` share what is left, so that none is tiny. 0: no step is left.
fn choose_step(clock: ptr<function, Clock>) {
    let left = (*clock).left;
    let free = (*clock).free_dt;
    let next = select(select(free, 0.5 * left, free > 0.5 * left), left, free >= left);
    (*clock).next_dt = select(0.0, next, (*clock).steps_left > 0u);
    (*clock).running = select(0u, 1u, (*clock).next_dt > 0.0);
    let lists = (*clock).stale == 1u && (*clock).steps % LIST_INTERVAL == 0u;
    let sorts = (*clock).worn == 1u && (*clock).steps % SORT_INTERVAL == 0u && (lists || SORT_INTERVAL > LIST_INTERVAL);
    (*clock).sorting = select(0u, 1u, (*clock).running == 1u && (sorts || any_layer_due(*clock)));
    (*clock).listing = select((*clock).sorting, 1u, (*clock).running == 1u && lists);
}

// What particles of the step under way would all find alike: the speed by which shifting goes (one particle that flies faster
// than the method is valid for must not shake all the others), the excess density for the weight of fluid one support deep and the
// pressure rho0 v^2 / 2 at which the fastest fluid stagnates, and the diffusion of density.
fn note_flow(clock: ptr<function, Clock>) {
    let c = constants.sound_speed;
    let dt = (*clock).dt;
    let speed = min((*clock).max_speed, 0.1 * c);
    (*clock).flow_speed = min(speed, constants.shifting_limit / dt);
    let weight = parameters.support_radius * length(parameters.gravity.xyz);
    (*clock).due_excess = parameters.rest_density * (weight + 0.5 * speed * speed) / (c * c);
    (*clock).diffusion = min(parameters.density_diffusion / constants.acoustic_rate, constants.diffusion_limit / dt - dt);
}

// Whether lists are to be made anew at the next chance, because they might not last until the one after it, and for which way
// they would be made. And whether particles are sorted too, because they might stray so far from their cells until the next
// chance for that that lists cost more, or in 3D miss neighbours.
fn judge_order(clock: ptr<function, Clock>, last: Maxima) {
    let way = way_of(last);
    (*clock).travelled += way;
    let fastest = (*clock).max_speed * max((*clock).free_dt, (*clock).dt) * constants.inverse_quantum;
    let next_way = 1.25 * max(fastest, f32(way)) + 4.0;
    let until_next = f32(LIST_INTERVAL) * next_way;
    let moved = f32((*clock).travelled - control.listed_at);
    (*clock).stale = select(0u, 1u, moved + until_next > f32(control.allowance));
    let allowance = clamp(f32(LIST_LIFE) * until_next, LEAST_ALLOWANCE, MOST_ALLOWANCE);
    (*clock).next_allowance = u32(allowance);
    let stray = f32((*clock).travelled - control.sorted_at) + f32(SORT_INTERVAL - LIST_INTERVAL + 2u) * next_way;
    (*clock).worn = select(0u, 1u, stray + 2.0 * allowance > MOST_STRAY);
}

// The step that is prepared begins: what the one before it noted decides how it goes on.
fn decide(clock: ptr<function, Clock>, last: Maxima) {
    if last.bad == 1u {
        (*clock).running = 0u;
        (*clock).stepping = 0u;
    }
    if (*clock).stepping == 1u {
        limit_step(clock, last);
        note_flow(clock);
        judge_order(clock, last);
        choose_step(clock);
    }
}

// The step after it, if one follows: its number, length and time.
fn prepared(before: Clock) -> Clock {
    var clock = before;
    clock.stepping = before.running;
    if before.running == 0u {
        return clock;
    }
    clock.last_side = before.side;
    clock.side = 1u - before.side;
    clock.noting = next_turn(before.noting);
    clock.dt = before.next_dt;
    clock.began = before.time;
    clock.time = add_ticks(before.time, ticks_of(clock.dt));
    // A step that was shortened to end there ends there exactly.
    if clock.dt == before.left || !is_before(clock.time, control.until) {
        clock.time = control.until;
    }
    clock.left = time_left(clock.time);
    clock.steps += 1u;
    clock.steps_left -= 1u;
    return clock;
}

fn time_left(time: vec2u) -> f32 {
    return select(0.0, seconds_of(subtract_ticks(control.until, time)), is_before(time, control.until));
}

fn next_turn(turn: u32) -> u32 {
    return select(turn + 1u, 0u, turn == 2u);
}

fn last_turn(turn: u32) -> u32 {
    return select(turn - 1u, 2u, turn == 0u);
}
