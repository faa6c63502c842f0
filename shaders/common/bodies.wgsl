// Walls and bodies in time: the mirror of src/core/solids.c.
@group(0) @binding(BINDING_solid_state) var<storage, read_write> solid_state: array<SolidState>;
// WeirMotionRow, in four vectors: time and displacement, rotation, their rates.
@group(0) @binding(BINDING_motion_rows) var<storage, read> motion_rows: array<vec4f>;

// ---- Prescribed motion ----

struct Pose {
    displacement: vec3f,
    rotation: vec3f, // angle times axis
}

fn row_time(row: u32) -> f32 {
    return motion_rows[4u * row].x;
}

fn row_pose(row: u32) -> Pose {
    return Pose(motion_rows[4u * row].yzw, motion_rows[4u * row + 1u].xyz);
}

fn row_rates(row: u32) -> Pose {
    let middle = motion_rows[4u * row + 2u];
    return Pose(vec3f(motion_rows[4u * row + 1u].w, middle.xy), vec3f(middle.zw, motion_rows[4u * row + 3u].x));
}

// time - seconds, with the precision of their difference.
fn seconds_since(time: vec2u, seconds: f32) -> f32 {
    return (f32(time.y) * 0.0009765625 - seconds) + f32(time.x) / TICKS_PER_ROOT / TICKS_PER_ROOT;
}

// A moment of solid n's motion: the share s of the interval from `row` to the next row, clamped to the table.
struct Moment {
    row: u32,
    s: f32,
    outside: bool,
    time: vec2u, // inside the table, if it repeats
}

// time modulo the table's length, for times after its end.
fn fold(time: vec2u, first: f32, last: f32) -> vec2u {
    let start = ticks_of(max(first, 0.0));
    let length = subtract_ticks(ticks_of(max(last, 0.0)), start);
    var rest = subtract_ticks(time, start);
    for (var shift = 20i; shift >= 0; shift--) {
        let k = u32(shift);
        let part = vec2u(length.x << k, (length.y << k) | select(0u, length.x >> (32u - max(k, 1u)), k > 0u));
        let fits = k == 0u || (length.y >> (32u - max(k, 1u))) == 0u;
        if fits && !is_before(rest, part) {
            rest = subtract_ticks(rest, part);
        }
    }
    return add_ticks(start, rest);
}

fn moment_of(n: u32, given: vec2u) -> Moment {
    let first = solid_table[n].motion_first;
    let count = solid_table[n].motion_count;
    let last = first + count - 1u;
    var time = given;
    if solid_table[n].motion_repeats == 1u && count > 1u && seconds_since(time, row_time(last)) > 0.0 {
        time = fold(time, row_time(first), row_time(last));
    }
    if count == 1u || seconds_since(time, row_time(first)) <= 0.0 {
        return Moment(first, 0.0, true, time);
    }
    if seconds_since(time, row_time(last)) >= 0.0 {
        return Moment(last - 1u, 1.0, true, time);
    }
    var low = first;
    var high = last;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if seconds_since(time, row_time(middle)) >= 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    return Moment(low, seconds_since(time, row_time(low)) / (row_time(low + 1u) - row_time(low)), false, time);
}

// Cubic Hermite interpolation over one interval as a polynomial in s.
struct Cubic {
    start: vec3f,
    first: vec3f,
    second: vec3f,
    third: vec3f,
}

fn cubic_of(low: vec3f, rate: vec3f, high: vec3f, rate_high: vec3f, length: f32) -> Cubic {
    let way = high - low;
    return Cubic(low, length * rate, 3.0 * way - length * (2.0 * rate + rate_high),
                 length * (rate + rate_high) - 2.0 * way);
}

fn cubic_value(c: Cubic, s: f32) -> vec3f {
    return c.start + s * (c.first + s * (c.second + s * c.third));
}

// Mean slope between the shares a and b: no difference of nearly equal values.
fn cubic_slope(c: Cubic, a: f32, b: f32) -> vec3f {
    return c.first + (a + b) * c.second + (a * a + a * b + b * b) * c.third;
}

struct Cubics {
    displacement: Cubic,
    rotation: Cubic,
    length: f32,
}

fn cubics_of(row: u32) -> Cubics {
    let length = row_time(row + 1u) - row_time(row);
    let low = row_pose(row);
    let high = row_pose(row + 1u);
    let rate = row_rates(row);
    let rate_high = row_rates(row + 1u);
    return Cubics(cubic_of(low.displacement, rate.displacement, high.displacement, rate_high.displacement, length),
                  cubic_of(low.rotation, rate.rotation, high.rotation, rate_high.rotation, length), length);
}

fn pose_at(n: u32, time: vec2u) -> Pose {
    let at = moment_of(n, time);
    if solid_table[n].motion_count == 1u {
        return row_pose(at.row);
    }
    let c = cubics_of(at.row);
    return Pose(cubic_value(c.displacement, at.s), cubic_value(c.rotation, at.s));
}

// Mean rates over a step of `dt`.
fn mean_rates(n: u32, begin: vec2u, end: vec2u, dt: f32) -> Pose {
    if solid_table[n].motion_count == 1u {
        return Pose(vec3f(0.0), vec3f(0.0));
    }
    let a = moment_of(n, begin);
    let b = moment_of(n, end);
    if is_before(b.time, a.time) {
        // A table that starts anew jumps back: the rate is the table's own there.
        let c = cubics_of(b.row);
        return Pose(cubic_slope(c.displacement, b.s, b.s) / c.length, cubic_slope(c.rotation, b.s, b.s) / c.length);
    }
    var sum = Pose(vec3f(0.0), vec3f(0.0));
    for (var row = a.row; row <= b.row; row++) {
        let c = cubics_of(row);
        let low = select(0.0, a.s, row == a.row);
        let high = select(1.0, b.s, row == b.row);
        let whole = a.row == b.row && !a.outside && !b.outside;
        let share = select(high - low, dt / c.length, whole);
        sum.displacement += share * cubic_slope(c.displacement, low, high);
        sum.rotation += share * cubic_slope(c.rotation, low, high);
    }
    return Pose(sum.displacement / dt, sum.rotation / dt);
}

// Sine and cosine by their series after reduction to [-pi/4, pi/4]: WGSL's own may be off by 2^-11.
fn sine_cosine(angle: f32) -> vec2f {
    let turns = floor(angle / 1.57079632679 + 0.5);
    let x = (angle - turns * 1.5703125) - turns * 0.000483826794897; // pi / 2 in two parts
    let x2 = x * x;
    let s = x * (1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0))));
    let c = 1.0 - x2 / 2.0 * (1.0 - x2 / 12.0 * (1.0 - x2 / 30.0 * (1.0 - x2 / 56.0 * (1.0 - x2 / 90.0))));
    let quarter = i32(turns) & 3;
    let sine = select(select(s, c, quarter == 1), select(-s, -c, quarter == 3), quarter >= 2);
    let cosine = select(select(c, -s, quarter == 1), select(-c, s, quarter == 3), quarter >= 2);
    return vec2f(sine, cosine);
}

fn rotation_quaternion(rotation: vec3f) -> vec4f {
    let angle = length(rotation);
    let half = sine_cosine(0.5 * angle);
    return vec4f(rotation * select(0.5, half.x / max(angle, 1e-12), angle > 1e-12), half.y);
}

fn is_driven(n: u32) -> bool {
    return solid_table[n].kind == SOLID_DRIVEN && solid_table[n].motion_count > 0u;
}

// ---- Rigid bodies ----

// q after a turn with angular velocity w over dt: q + dt/2 (w, 0) q, normalised.
fn turned(q: vec4f, w: vec3f, dt: f32) -> vec4f {
    let part = cross(w, q.xyz) + q.w * w;
    return normalize(q + 0.5 * dt * vec4f(part, -dot(w, q.xyz)));
}

fn back(q: vec4f) -> vec4f {
    return vec4f(-q.xyz, q.w);
}

fn apply_inverse_inertia(n: u32, state: SolidState, v: vec3f) -> vec3f {
    let own = rotate(back(state.orientation), v);
    let result = vec3f(dot(solid_table[n].inverse_inertia[0].xyz, own), dot(solid_table[n].inverse_inertia[1].xyz, own),
                       dot(solid_table[n].inverse_inertia[2].xyz, own));
    return rotate(state.orientation, result);
}

// w x (I w), I from its inverse (adjugate over determinant); 0 in 2D, where w is an axis of inertia.
fn gyroscopic(n: u32, state: SolidState) -> vec3f {
    let a = solid_table[n].inverse_inertia[0].xyz;
    let b = solid_table[n].inverse_inertia[1].xyz;
    let c = solid_table[n].inverse_inertia[2].xyz;
    let determinant = dot(a, cross(b, c));
    if determinant == 0.0 {
        return vec3f(0.0);
    }
    let own = rotate(back(state.orientation), state.angular_velocity.xyz);
    let momentum = (cross(b, c) * own.x + cross(c, a) * own.y + cross(a, b) * own.z) / determinant;
    return cross(state.angular_velocity.xyz, rotate(state.orientation, momentum));
}

// state.force.w: the mass of the fluid in reach of the body's particles, which it drags along.
fn kicked_free(n: u32, given: SolidState, force: vec3f, torque: vec3f, dt: f32) -> SolidState {
    var state = given;
    let alpha = apply_inverse_inertia(n, state, torque - gyroscopic(n, state));
    let mass = solid_table[n].mass;
    let slow = select(1.0, mass / state.force.w, mass < state.force.w);
    var a = vec3f(0.0);
    if mass > 0.0 {
        a = force / mass + parameters.gravity.xyz;
    }
    state.acceleration = vec4f(slow * a * solid_table[n].freedom.xyz, 0.0);
    state.angular_acceleration = vec4f(slow * alpha * solid_table[n].angular_freedom.xyz, 0.0);
    state.velocity += dt * state.acceleration;
    state.angular_velocity += dt * state.angular_acceleration;
    return state;
}

// The mean velocities over the step, so that the second half's move ends where the motion is.
fn kicked_driven(n: u32, given: SolidState, dt: f32) -> SolidState {
    var state = given;
    let rates = mean_rates(n, control.clock.began, add_ticks(control.clock.began, ticks_of(dt)), dt);
    state.acceleration = vec4f((rates.displacement - state.velocity.xyz) / dt, 0.0);
    state.angular_acceleration = vec4f((rates.rotation - state.angular_velocity.xyz) / dt, 0.0);
    state.velocity = vec4f(rates.displacement, 0.0);
    state.angular_velocity = vec4f(rates.rotation, 0.0);
    return state;
}

// 900 m from the origin float32 knows 0.06 mm, and a step is less. So the position moves by whole units, twice what float32 tells
// apart there, and the rest waits. (Kahan's sum is shorter, but some drivers take (a + b) - a for b.)
fn moved_by(given: SolidState, way: vec3f) -> SolidState {
    var state = given;
    let exponent = max(bitcast<vec3u>(state.position.xyz) & vec3u(0x7f800000u), vec3u(0x20000000u));
    let unit = bitcast<vec3f>(exponent - vec3u(22u << 23u));
    let sum = state.rest.xyz + way;
    let whole = round(sum / unit) * unit;
    state.position += vec4f(whole, 0.0);
    state.rest = vec4f(sum - whole, 0.0);
    return state;
}

// Out of the domain by half of its longest side: there a body stays.
fn has_left(state: SolidState) -> bool {
    let low = constants.domain_min.xyz;
    let high = constants.domain_max.xyz;
    let away = max(low - state.position.xyz, state.position.xyz - high);
    let outside = select(away, vec3f(0.0), vec3<bool>(PERIODIC_X, PERIODIC_Y, PERIODIC_Z));
    let sides = high - low;
    return max(max(outside.x, outside.y), outside.z) > 0.5 * max(max(sides.x, sides.y), sides.z);
}

// After a move over `dt`, half a step, that ends at `time`.
fn drifted_solid(n: u32, given: SolidState, dt: f32, time: vec2u) -> SolidState {
    var state = given;
    if dt == 0.0 {
        return state;
    }
    if is_driven(n) {
        let pose = pose_at(n, time);
        state.position = vec4f(solid_table[n].position.xyz, 0.0);
        state.rest = vec4f(0.0);
        state = moved_by(state, pose.displacement);
        state.orientation = rotation_quaternion(pose.rotation);
    } else if solid_table[n].kind == SOLID_FREE && has_left(state) {
        state.velocity = vec4f(0.0);
        state.angular_velocity = vec4f(0.0);
    } else if solid_table[n].kind == SOLID_FREE {
        state = moved_by(state, dt * state.velocity.xyz);
        state.orientation = turned(state.orientation, state.angular_velocity.xyz, dt);
    }
    return state;
}

// How far a move from one state to the other takes any particle of solid n, not less, as way_bits(): a turn by q moves what is
// r away by at most 2 |q - 1| r. What float32 rounds of places is in it.
fn solid_way_bits(n: u32, before: SolidState, after: SolidState) -> u32 {
    if solid_table[n].kind == SOLID_FIXED {
        return 0u;
    }
    let radius = solid_table[n].position.w;
    let turn = min(length(after.orientation - before.orientation), length(after.orientation + before.orientation));
    let way = length(after.position.xyz - before.position.xyz + after.rest.xyz - before.rest.xyz) + 2.0 * radius * turn
        + 1e-6 * (length(after.position.xyz - constants.origin.xyz) + radius);
    let quanta = min(way * constants.inverse_quantum, 1e8) + 4.0;
    return bitcast<u32>(quanta * quanta);
}
