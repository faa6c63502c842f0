// crowd_gather: how crowded it is around each fluid particle: 0 for a lonely drop, about a half at a surface, 1 in the
// middle of the fluid; and how much its motion differs from theirs, in speeds of sound. Which particles can be seen.
// in:  frame, particles, cells
// out: crowd, shown, draw[1]

var<workgroup> found: atomic<u32>; // wgpu-native does not zero it
var<workgroup> first: u32;

// Shares of the full number of particles around one from which on it is buried, and how far it is then from sides of the
// domain that one sees through, in cells. Between spheres one sees deeper than into water.
const buried_in_water = vec2f(0.95, 0.8);
const buried_by_spheres = vec2f(0.985, 1.3);

struct Around {
    others: f32,   // particles, shares of the full number
    with_it: f32,  // the same with the particle itself
    motion: f32,   // of the others, relative to it
}

fn around(particle: u32, place: vec3f) -> Around {
    let velocity = particle_velocity(particle) / frame.sound_speed;
    var sum = vec2f(0.0);
    var motion = vec3f(0.0);
    for (var corner = 0u; corner < 8u; corner++) {
        let share = corner_share(place, corner);
        let cell = cell_index(place, corner);
        let count = f32(atomicLoad(&cells[cell])) / cell_unit;
        let moves = vec3f(f32(atomicLoad(&cells[cell + 1u])), f32(atomicLoad(&cells[cell + 2u])),
                          f32(atomicLoad(&cells[cell + 3u]))) / motion_unit;
        sum += share * vec2f(count - share, count);
        motion += share * (moves - count * velocity);
    }
    return Around(sum.x / particles_per_cell, sum.y / particles_per_cell, length(motion) / max(sum.x, 0.5));
}

// Distances from the domain's low sides and high sides, in cells.
struct Sides {
    low: vec3f,
    high: vec3f,
}

fn from_sides(place: vec3f) -> Sides {
    let low = place - 1.0;
    return Sides(low, (frame.domain_max.xyz - frame.domain_min.xyz) / (2.0 * frame.spacing) - low);
}

// Distance from the nearest side that the eye looks in through, or, where the fluid casts a shadow, the sun.
fn from_windows(sides: Sides) -> f32 {
    let from_light = frame.light_rows[2].xyz * select(1.0, 0.0, frame.water != 0u);
    let by_low = (frame.eye.xyz < frame.domain_min.xyz) | (from_light > vec3f(0.0));
    let by_high = (frame.eye.xyz > frame.domain_max.xyz) | (from_light < vec3f(0.0));
    let away = min(select(vec3f(1e9), sides.low, by_low), select(vec3f(1e9), sides.high, by_high));
    return min(min(away.x, away.y), away.z);
}

// Of a particle of fluid, its crowd. Whether others hide it on all sides.
fn measure(particle: u32) -> bool {
    let place = cell_place(particle);
    let near = around(particle, place);
    let sides = from_sides(place);
    // Behind the domain's sides there is no fluid to count.
    let inside = clamp(min(sides.low, sides.high), vec3f(0.0), vec3f(1.0));
    let room = 0.55 + 0.45 * inside;
    let full = 0.5 + 0.5 * inside; // with the particle itself
    crowd[particle] = vec2f(near.others / (room.x * room.y * room.z), near.motion);
    let buried = select(buried_by_spheres, buried_in_water, frame.water != 0u);
    return near.with_it > buried.x * full.x * full.y * full.z && from_windows(sides) > buried.y;
}

fn can_be_seen(particle: u32) -> bool {
    if particle >= arrayLength(&crowd) { return false; }
    let kind = particle_kind(particle);
    if kind != FLUID {
        crowd[particle] = vec2f(1.0, 0.0);
        return kind != HIDDEN;
    }
    return !measure(particle) || frame.all_shown != 0u;
}

@compute @workgroup_size(256)
fn crowd_gather(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) local: u32) {
    if local == 0u { atomicStore(&found, 0u); }
    workgroupBarrier();
    let particle = id.x + id.y * row_length;
    let is_shown = can_be_seen(particle);
    var number = 0u;
    if is_shown { number = atomicAdd(&found, 1u); }
    workgroupBarrier();
    if local == 0u { first = atomicAdd(&draw[1], atomicLoad(&found)); }
    workgroupBarrier();
    if is_shown { shown[first + number] = particle; }
}
