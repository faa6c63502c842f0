// crowd_count: how many fluid particles lie around each point of a grid, and how they move, shared out among the eight
// next points.
// in:  frame, particles
// out: cells (cleared before), added up

@compute @workgroup_size(256)
fn crowd_count(@builtin(global_invocation_id) id: vec3u) {
    let particle = id.x + id.y * row_length;
    if particle >= arrayLength(&crowd) { return; }
    if particle_kind(particle) != FLUID { return; }
    let place = cell_place(particle);
    let velocity = particle_velocity(particle) * (motion_unit / frame.sound_speed);
    for (var corner = 0u; corner < 8u; corner++) {
        let cell = cell_index(place, corner);
        let share = corner_share(place, corner);
        let motion = vec3i(round(share * velocity));
        atomicAdd(&cells[cell], i32(share * cell_unit + 0.5));
        atomicAdd(&cells[cell + 1u], motion.x);
        atomicAdd(&cells[cell + 2u], motion.y);
        atomicAdd(&cells[cell + 3u], motion.z);
    }
}
