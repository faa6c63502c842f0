// First half of a step's move, with what empties slots on its way (core/cpu/wcsph_motion.c). Used where the last step finishes, and
// by pass drift for the first one of a batch.
const FATE_STAYS = 0u;
const FATE_DRAINED = 1u;
const FATE_LOST = 2u;

struct Drifted {
    coordinate: vec4i,
    fate: u32,
}

// Fluid beyond an open side, or beyond a wall by more than a support radius, is gone.
fn is_outside(place: Place) -> bool {
    return any((place < place_of(constants.inside_low)) | (place > place_of(constants.inside_high)));
}

fn is_in_drain(at: Vector, n: u32) -> bool {
    return all(at >= vector_of(drains[n].low)) && all(at <= vector_of(drains[n].high));
}

// Most fluid is in no group's box.
fn is_drained(place: Place) -> bool {
    let at = position_of(place);
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
fn has_passed(place: Place, group: u32) -> bool {
    let at = position_of(place);
    let n = min(group - GROUP_INLET, EMITTERS - 1u);
    return dot(at - vector_of(emitters[n].center), vector_of(emitters[n].direction)) >= 0.0;
}

fn drifted(coordinate: vec4i, velocity: Vector, half: f32) -> Drifted {
    let place = place_of(coordinate) + quanta_of(half * velocity);
    var group = u32(coordinate.w);
    var fate = FATE_STAYS;
    if group != GROUP_FLUID {
        group = select(group, GROUP_FLUID, has_passed(place, group));
    } else if DRAIN_GROUPS > 0u && is_drained(place) {
        fate = FATE_DRAINED;
    } else if is_outside(place) {
        fate = FATE_LOST;
    }
    group = select(GROUP_EMPTY, group, fate == FATE_STAYS);
    return Drifted(vec4i(wide_place(place), i32(group)), fate);
}
