// crowd_gather: how crowded it is around each fluid particle: 0 for a lonely drop, about a half at a surface, 1 in the
// middle of the fluid; and how much its motion differs from theirs, in speeds of sound.
// in:  frame, particles, cells
// out: crowd

@compute @workgroup_size(256)
fn crowd_gather(@builtin(global_invocation_id) id: vec3u) {
    let particle = id.x + id.y * row_length;
    if particle >= arrayLength(&crowd) { return; }
    if particle_kind(particle) != FLUID {
        crowd[particle] = vec2f(1.0, 0.0);
        return;
    }
    let place = cell_place(particle);
    let velocity = particle_velocity(particle) / frame.sound_speed;
    var sum = 0.0;
    var motion = vec3f(0.0); // of the others, relative to it
    for (var corner = 0u; corner < 8u; corner++) {
        let share = corner_share(place, corner);
        let cell = cell_index(place, corner);
        let count = f32(atomicLoad(&cells[cell])) / cell_unit;
        let moves = vec3f(f32(atomicLoad(&cells[cell + 1u])), f32(atomicLoad(&cells[cell + 2u])),
                          f32(atomicLoad(&cells[cell + 3u]))) / motion_unit;
        sum += share * (count - share); // without itself
        motion += share * (moves - count * velocity);
    }
    // Behind the domain's sides there is no fluid to count.
    let low = place - 1.0;
    let high = (frame.domain_max.xyz - frame.domain_min.xyz) / (2.0 * frame.spacing) - low;
    let room = 0.55 + 0.45 * clamp(min(low, high), vec3f(0.0), vec3f(1.0));
    let torn = sum / (particles_per_cell * room.x * room.y * room.z);
    crowd[particle] = vec2f(torn, length(motion) / max(sum, 0.5));
}
