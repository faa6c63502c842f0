// First half of a step's move, with what empties slots on its way (weir_wcsph_drift). Used where the last step
// finishes, and by pass drift for the first one of a batch.
const FATE_STAYS = 0u;
const FATE_DRAINED = 1u;
const FATE_LOST = 2u;

struct Drifted {
    coordinate: vec4i,
    fate: u32,
}

// Along which axes a side (0 low, 1 high) is one of the domain's own walls. All axes at once: a loop over them costs
// browsers more than its work (common/near.wgsl).
fn walled_axes(side: u32) -> Axes {
    return !(periodic_axes() | axes_of(constants.open_sides >> side));
}

// Fluid beyond an open side, or beyond a wall by more than a support radius, is gone.
fn is_outside(at: Vector) -> bool {
    let low = vector_of(constants.domain_min) - select(Vector(), Vector(constants.search_radius), walled_axes(0u));
    let high = vector_of(constants.domain_max) + select(Vector(), Vector(constants.search_radius), walled_axes(1u));
    return any(((at < low) | (at > high)) & !periodic_axes());
}

fn is_in_drain(at: Vector, n: u32) -> bool {
    return all(at >= vector_of(drains[n].low)) && all(at <= vector_of(drains[n].high));
}

// Most fluid is in no group's box.
fn is_drained(at: Vector) -> bool {
    for (var group = 0u; group < DRAIN_GROUPS; group++) {
        if !is_in_drain(at, group) {
            continue;
        }
        let first = DRAIN_GROUPS + group * DRAIN_GROUP;
        for (var n = first; n < min(first + DRAIN_GROUP, DRAINS); n++) {
            if is_in_drain(at, n) {
                return true;
            }
        }
    }
    return false;
}

// An inlet's particle becomes free where it has passed the nozzle.
fn has_passed(at: Vector, group: u32) -> bool {
    let n = min(group - GROUP_INLET, EMITTERS - 1u);
    return dot(at - vector_of(emitters[n].center), vector_of(emitters[n].direction)) >= 0.0;
}

fn drifted(coordinate: vec4i, velocity: Vector, half: f32) -> Drifted {
    let place = place_of(coordinate) + quanta_of(half * velocity);
    let at = position_of(place);
    var group = u32(coordinate.w);
    var fate = FATE_STAYS;
    if group != GROUP_FLUID {
        group = select(group, GROUP_FLUID, has_passed(at, group));
    } else if is_drained(at) {
        fate = FATE_DRAINED;
    } else if is_outside(at) {
        fate = FATE_LOST;
    }
    group = select(GROUP_EMPTY, group, fate == FATE_STAYS);
    return Drifted(vec4i(wide_place(place), i32(group)), fate);
}
