// crowd_gather: how crowded it is around each fluid particle: 0 for a lonely drop, about a half at a surface, 1 in the
// middle of the fluid.
// in:  frame, particles, cells
// out: crowd

@compute @workgroup_size(256)
fn crowd_gather(@builtin(global_invocation_id) id: vec3u) {
    let particle = id.x + id.y * row_length;
    if particle >= arrayLength(&crowd) { return; }
    if particle_kind(particle) != FLUID {
        crowd[particle] = 1.0;
        return;
    }
    let place = cell_place(particle);
    var sum = 0.0;
    for (var corner = 0u; corner < 8u; corner++) {
        let share = corner_share(place, corner);
        sum += share * (f32(atomicLoad(&cells[cell_index(place, corner)])) / cell_unit - share); // without itself
    }
    // Behind the domain's sides there is no fluid to count.
    let low = place - 1.0;
    let high = (frame.domain_max.xyz - frame.domain_min.xyz) / (2.0 * frame.spacing) - low;
    let room = 0.55 + 0.45 * clamp(min(low, high), vec3f(0.0), vec3f(1.0));
    crowd[particle] = sum / (particles_per_cell * room.x * room.y * room.z);
}
