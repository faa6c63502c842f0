// The clock moves on: for passes with a `control` that all particles write.
fn maxima_of_step(n: u32) -> Maxima {
    var found = Maxima();
    found.speed2_bits = atomicLoad(&control.maxima[n].speed2_bits);
    found.acceleration2_bits = atomicLoad(&control.maxima[n].acceleration2_bits);
    found.excess_bits = atomicLoad(&control.maxima[n].excess_bits);
    found.finish2_bits = atomicLoad(&control.maxima[n].finish2_bits);
    found.drift2_bits = atomicLoad(&control.maxima[n].drift2_bits);
    found.bad = atomicLoad(&control.maxima[n].bad);
    return found;
}

fn clear_maxima_of_step(n: u32) {
    atomicStore(&control.maxima[n].speed2_bits, 0u);
    atomicStore(&control.maxima[n].acceleration2_bits, 0u);
    atomicStore(&control.maxima[n].excess_bits, 0u);
    atomicStore(&control.maxima[n].finish2_bits, 0u);
    atomicStore(&control.maxima[n].drift2_bits, 0u);
}

// The step that is prepared in clocks[at], after that which noted the maxima of the turn before.
fn begun(at: u32, turn: u32) -> Clock {
    var now = control.clocks[at];
    decide(&now, maxima_of_step(last_turn(turn)));
    return now;
}

// By one thread: all other passes find it in control.clock.
fn tell_clock(now: Clock) {
    if now.stepping == 0u {
        control.clock.stepping = 0u;
        return;
    }
    control.clock = now;
    clear_maxima_of_step(next_turn(now.noting));
    leave_sort_groups(now);
}
