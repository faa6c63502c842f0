// The second half of a step's move with health (core/cpu/wcsph_motion.c): rho += dt/2 drho, x += dt/2 v + dt u; and the first half
// of the next step's move, if there is one. Of fluid by pass forces, of which one thread of a workgroup calls clear_finish() before, and
// publish_finish() after all others are through; of solids' particles by pass finish, if any move. After common/drift.wgsl.
@group(0) @binding(BINDING_control) var<storage, read_write> control: SharedControl;

var<workgroup> clock: Clock; // the workgroup's own, where pass forces moves it on or a read needs another

// The step under way. OWN_CLOCK: of the pass.
fn now() -> Clock {
    if OWN_CLOCK {
        return clock;
    }
    return control.clock;
}

// Share of the rest density below which fluid is not stretched, but torn: docs/wcsph.md.
const LEAST_DENSITY = 0.8;

// The workgroup's largest density error, and squares of the longest ways, as bits.
var<workgroup> excess_most: atomic<u32>; // wgpu-native does not zero them
var<workgroup> finish2_most: atomic<u32>;
var<workgroup> drift2_most: atomic<u32>;

fn clear_finish() {
    atomicStore(&excess_most, 0u);
    atomicStore(&finish2_most, 0u);
    atomicStore(&drift2_most, 0u);
}

fn publish_finish() {
    if (atomicLoad(&excess_most) | atomicLoad(&finish2_most) | atomicLoad(&drift2_most)) > 0u {
        atomicMax(&control.maxima[now().noting].excess_bits, atomicLoad(&excess_most));
        atomicMax(&control.maxima[now().noting].finish2_bits, atomicLoad(&finish2_most));
        atomicMax(&control.maxima[now().noting].drift2_bits, atomicLoad(&drift2_most));
    }
}

fn take_excess(excess: f32) {
    let bits = bitcast<u32>(abs(excess));
    if bits > atomicLoad(&excess_most) {
        atomicMax(&excess_most, bits);
    }
}

fn take_finish(bits: u32) {
    if bits > atomicLoad(&finish2_most) {
        atomicMax(&finish2_most, bits);
    }
}

fn take_drift(bits: u32) {
    if bits > atomicLoad(&drift2_most) {
        atomicMax(&drift2_most, bits);
    }
}

fn check_health(i: u32, speed_squared: f32, rate: f32) {
    let limit = constants.speed_limit;
    if is_finite(speed_squared) && is_finite(rate) && speed_squared <= limit * limit {
        return;
    }
    atomicAdd(&control.bad_particles, 1u);
    atomicMax(&control.maxima[now().noting].bad, 1u);
    atomicMin(&control.bad_step, now().steps);
    atomicMin(&control.bad_slot, i);
    // The next step sees it: what this one began with, half a step ago, is the last good state, and nothing may run over it.
}

// The seal of the domain's own walls: no fluid stays deeper in them than half a spacing, where their first layer lies.
fn seal(place: ptr<function, Place>, velocity: ptr<function, Vector>) {
    let low = place_of(constants.seal_low);
    let high = place_of(constants.seal_high);
    *velocity = select(*velocity, max(*velocity, Vector()), *place < low);
    *velocity = select(*velocity, min(*velocity, Vector()), *place > high);
    *place = clamp(*place, low, high);
}

// `kicked`: new velocity, density in the middle of the step. `shift`: shifting velocity, drho/dt.
fn finish_fluid(i: u32, own: vec4i, kicked_motion: vec4f, shift: vec4f) {
    var own_motion = kicked_motion;
    let rate = shift.w;
    var velocity = vector_of(own_motion);
    let last_half = 0.5 * now().dt;
    check_health(i, dot(velocity, velocity), rate);
    own_motion.w = max(own_motion.w + last_half * rate, (LEAST_DENSITY - 1.0) * parameters.rest_density);
    take_excess(own_motion.w);
    var way = last_half * velocity;
    if SHIFTING && u32(own.w) == GROUP_FLUID {
        way += now().dt * vector_of(shift);
    }
    var place = place_of(own) + quanta_of(way);
    if u32(own.w) == GROUP_FLUID {
        seal(&place, &velocity);
        own_motion = vec4f(wide(velocity), own_motion.w);
    }
    take_finish(way_bits(place - place_of(own)));
    let finished = vec4i(wide_place(place), own.w);
    let half = 0.5 * now().next_dt;
    if half == 0.0 {
        leave(i, finished, own_motion);
        return;
    }
    own_motion.w += half * rate;
    let to = drifted(finished, velocity, half);
    if to.fate == FATE_DRAINED {
        atomicAdd(&control.drained, 1u);
    } else if to.fate == FATE_LOST {
        atomicAdd(&control.lost, 1u);
    }
    take_drift(way_bits(place_of(to.coordinate) - place));
    leave(i, to.coordinate, own_motion);
}

// Whether particles go to the state: they are to be sorted, or no step follows.
fn is_leaving() -> bool {
    return now().sorting == 1u || now().next_dt == 0.0;
}

// Where the next step, or whoever comes after this one, finds it.
fn leave(i: u32, at: vec4i, own_motion: vec4f) {
    let target_slot = select(side_start(now().side), 0u, is_leaving()) + i;
    set_coordinate(target_slot, at);
    set_motion(target_slot, own_motion);
}

// A particle of a solid, in the velocity of which is not yet what its surface slides. Its density is what walls saw.
fn leave_solid(i: u32, at: vec4i, velocity: vec3f) {
    let surface = solid_table[u32(at.w) - GROUP_SOLID].surface_velocity.xyz;
    leave(i, at, vec4f(velocity + surface, motion_at(side_start(now().last_side) + i).w));
}

// Of a solid that stays where it is: it stands in both working copies (pass scatter), so only the state may lack it.
fn leave_fixed(i: u32, at: vec4i, own_motion: vec4f) {
    if is_leaving() {
        leave(i, at, own_motion);
    }
}
