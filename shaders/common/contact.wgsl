// What acts at close range alone: the barrier between fluid and solids, contact of solids. Few particles need either, so they
// search for themselves. And how solids move, where the fluid wants to know.
@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;

// A last barrier keeps fast fluid out of walls, and lets go of what two solids squeeze: docs/wcsph.md.
const BARRIER_RANGE = 0.85; // spacings
const BARRIER_STRENGTH = 4.0;
const BRAKE_RANGE = 2.0;    // spacings
const BRAKE_STRENGTH = 2.4; // over the Courant number
const BRAKE_LIMIT = 0.1;    // c0
const BARRIER_SHARE = 0.5;  // of overlap and approach, that one step may take
const START_PACE = 1000.0;  // before the first step: no bound

// Velocity of a solid at one of its particles, from where that is.
fn motion_of_solid(group: u32, place: Place) -> vec3f {
    let n = group - GROUP_SOLID;
    if !MOVING_SOLIDS || solid_table[n].kind == SOLID_FIXED {
        return vec3f(0.0);
    }
    let center = coordinate_of(solid_state[NOW + n].position.xyz - constants.origin.xyz);
    let arm = wide(Vector(shortest(place - center)) * constants.quantum);
    return solid_state[NOW + n].velocity.xyz + cross(solid_state[NOW + n].angular_velocity.xyz, arm);
}

// What a particle in its face may stand for, in particles of fluid (weir_solid_bulk()): less than 1 in a light body.
fn bulk_of(group: u32) -> f32 {
    return solid_table[group - GROUP_SOLID].freedom.w;
}

// The same between it and fluid (weir_solid_barrier()).
fn barrier_bulk(group: u32) -> f32 {
    let n = group - GROUP_SOLID;
    let dragged = solid_state[NOW + n].force.w;
    let mass = solid_table[n].mass;
    return min(bulk_of(group) * select(1.0, dragged / mass, dragged > mass), 1.0);
}

// With what its surface slides.
fn solid_velocity(group: u32, place: Place) -> vec3f {
    return solid_table[group - GROUP_SOLID].surface_velocity.xyz + motion_of_solid(group, place);
}

// A surface that slides along itself displaces no fluid.
fn displacing_velocity(group: u32, place: Place) -> Vector {
    return vector_of(vec4f(motion_of_solid(group, place), 0.0));
}

// Of fluid and a solid's particle, one of each, with the solid's own velocity: motion of solids is as the fluid sees it.
fn approach_velocity(own: vec4i, own_motion: vec4f, other: vec4i, other_motion: vec4f) -> Vector {
    if is_solid(u32(own.w)) {
        return vector_of(vec4f(solid_velocity(u32(own.w), place_of(own)), 0.0)) - vector_of(other_motion);
    }
    return vector_of(own_motion) - vector_of(vec4f(solid_velocity(u32(other.w), place_of(other)), 0.0));
}

// The barrier's acceleration. `reach`, quanta: nobody farther away acts. (A warp waits for the one thread that searches here, and
// a small scene for that warp: candidates are loaded together.)
fn barrier_of(own: vec4i, own_motion: vec4f, reach: f32) -> Vector {
    let barrier_range = quanta_of_spacings(BARRIER_RANGE);
    let brake_range = quanta_of_spacings(BRAKE_RANGE);
    let solid = is_solid(u32(own.w));
    let start = side_start(now().last_side);
    // One spacing per step, over the speed of sound.
    let sound_way = constants.sound_speed * now().dt;
    let pace = select(START_PACE, parameters.particle_spacing / sound_way, sound_way > 0.0);
    let share = BARRIER_SHARE * pace;
    var sum = Vector();
    var walk = walk_around(place_of(own), i32(reach) + 4 + i32(now().travelled - control.sorted_at));
    while next_run(&walk) {
        let end = cell_start[walk.end_cell];
        for (var at = cell_start[walk.first_cell]; at < end; at += 32u) {
            for (var found = near_among(walk.place, start + at, end - at, reach * reach, 0u).bits; found != 0u; found &= found - 1u) {
                let j = start + at + firstTrailingBit(found);
                let other = coordinate_at(j);
                if u32(other.w) == GROUP_EMPTY || is_solid(u32(other.w)) == solid {
                    continue;
                }
                let offset = Vector(walk.place - place_of(other));
                let r = max(length(offset), barrier_range / 3.0);
                let push = BARRIER_STRENGTH * max(barrier_range / r - 1.0, 0.0);
                let overlap = max(barrier_range - r, 0.0) / quanta_of_spacings(1.0);
                let approach = -dot(approach_velocity(own, own_motion, other, motion_at(j)), offset)
                    / (r * constants.sound_speed);
                let bounded = min(push, share * (pace * overlap + max(approach, 0.0)));
                let rate = min(BRAKE_STRENGTH / parameters.courant * max(1.0 - r / brake_range, 0.0), share);
                let bulk = barrier_bulk(select(u32(other.w), u32(own.w), solid));
                sum += (bulk * (bounded + rate * max(approach - BRAKE_LIMIT, 0.0)) / r) * offset;
            }
        }
    }
    return (constants.sound_speed * constants.sound_speed / parameters.particle_spacing) * sum;
}

// Whether contact_force() may find another solid. `header`: the first word of the particle's list.
fn may_touch(header: u32) -> bool {
    let is_told = LISTS && header != NO_LIST && now().travelled - control.listed_at <= control.allowance;
    return !is_told || (header & MEETS_SOLID) != 0u;
}

// Penalty contact of a free body's particle with other solids closer than CONTACT_RANGE: stiff as the fluid, half
// damped, never attracting; less so if either is light. In w the mass of fluid that so many pairs would move.
fn contact_force(own: vec4i) -> vec4f {
    let spacing = parameters.particle_spacing;
    let mass = constants.particle_mass;
    let c = constants.sound_speed;
    let group = u32(own.w);
    let velocity = solid_velocity(group, place_of(own));
    var force = Vector();
    var pressed = 0.0;
    let start = side_start(now().last_side);
    let reach = quanta_of_spacings(CONTACT_RANGE);
    var walk = walk_around(place_of(own), i32(reach) + 4 + i32(now().travelled - control.sorted_at));
    while next_run(&walk) {
        let end = cell_start[walk.end_cell];
        for (var at = cell_start[walk.first_cell]; at < end; at += 32u) {
            for (var found = near_among(walk.place, start + at, end - at, reach * reach, 0u).bits; found != 0u; found &= found - 1u) {
                let other = coordinate_at(start + at + firstTrailingBit(found));
                let offset = Vector(walk.place - place_of(other)) * constants.quantum;
                let r = length(offset);
                if r == 0.0 || !is_solid(u32(other.w)) || u32(other.w) == group {
                    continue;
                }
                let relative = velocity - solid_velocity(u32(other.w), place_of(other));
                let push = 0.25 * mass * c * c / (spacing * spacing) * (spacing - r)
                    - 0.5 * mass * c / spacing * dot(relative, wide(offset)) / r;
                let bulk = min(bulk_of(group), bulk_of(u32(other.w)));
                force += (bulk * max(push, 0.0) / r) * offset;
                pressed += bulk * mass;
            }
        }
    }
    return vec4f(wide(force), pressed);
}
