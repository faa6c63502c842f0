// First half of a step's move, with what empties slots on its way (weir_wcsph_drift). Used where the last step
// finishes, and by pass drift for the first one of a batch.
const FATE_STAYS = 0u;
const FATE_DRAINED = 1u;
const FATE_LOST = 2u;

struct Drifted {
    coordinate: vec4i,
    fate: u32,
}

fn is_periodic(axis: u32) -> bool {
    return (axis == 0u && PERIODIC_X) || (axis == 1u && PERIODIC_Y) || (axis == 2u && PERIODIC_Z);
}

// Is the side (0 low, 1 high) of an axis one of the domain's own walls?
fn has_wall(axis: u32, side: u32) -> bool {
    return !is_periodic(axis) && ((constants.open_sides >> (2u * axis + side)) & 1u) == 0u;
}

// Fluid beyond an open side, or beyond a wall by more than a support radius, is gone.
fn is_outside(at: Vector) -> bool {
    let reach = constants.search_radius;
    for (var axis = 0u; axis < DIMENSION; axis++) {
        if is_periodic(axis) {
            continue;
        }
        let low = select(0.0, reach, has_wall(axis, 0u));
        let high = select(0.0, reach, has_wall(axis, 1u));
        if at[axis] < constants.domain_min[axis] - low || at[axis] > constants.domain_max[axis] + high {
            return true;
        }
    }
    return false;
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
