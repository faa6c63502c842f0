// crowd_count: how many fluid particles lie around each point of a grid, shared out among the eight next points.
// in:  frame, particles
// out: cells (cleared before), added up

@compute @workgroup_size(256)
fn crowd_count(@builtin(global_invocation_id) id: vec3u) {
    let particle = id.x + id.y * row_length;
    if particle >= arrayLength(&crowd) { return; }
    if particle_kind(particle) != FLUID { return; }
    let place = cell_place(particle);
    for (var corner = 0u; corner < 8u; corner++) {
        atomicAdd(&cells[cell_index(place, corner)], u32(corner_share(place, corner) * cell_unit + 0.5));
    }
}
