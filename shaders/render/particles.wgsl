// particles: every particle of fluid, walls and bodies a round anti-aliased disc.
// in:  frame, color_maps, particles
// out: premultiplied colour

struct Disc {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f, // pixels from the centre, y down
    @location(1) @interpolate(flat) color: vec3f,
    @location(2) @interpolate(flat) look: vec3f, // radius, pixels; 1 for a bead, 0 for a flat disc; how much of it is seen
}

@vertex
fn particles_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Disc {
    var disc: Disc;
    let kind = particle_kind(particle);
    let share = select(1.0, frame.disc_share, kind == FLUID && frame.water != 0u);
    if kind == HIDDEN || share == 0.0 {
        disc.place = vec4f(2.0, 2.0, 2.0, 1.0); // outside of the picture
        return disc;
    }
    let radius = select(frame.disc_radius, frame.particle_radius, kind == FLUID);
    let corner = square_corner(vertex) * max(radius + 0.5, 1.5);
    disc.look = vec3f(radius, select(0.0, 1.0, kind == FLUID), share);
    disc.place = to_clip(to_pixels(particle_position(particle).xy) + corner);
    disc.offset = corner;
    disc.color = to_target(particle_color(particle, kind));
    return disc;
}

// Share of a pixel at `distance` from the centre that a disc of `radius` covers. Its integral over the plane is
// pi radius^2 for every radius, so a particle keeps its brightness when it gets smaller than a pixel.
fn disc_coverage(distance: f32, radius: f32) -> f32 {
    // An edge one pixel wide adds pi/12 to the area; the radius that makes up for it:
    let edge = sqrt(max(radius * radius - 1.0 / 12.0, 0.25)) + 0.5;
    let crisp = clamp(edge - distance, 0.0, 1.0);
    // Small ones: a bump of fixed width, weighted. (1 - d^2/1.5^2)^2 integrates to pi 0.75, and its sum over the
    // pixels hardly depends on where in a pixel the centre lies, so that nothing flickers.
    let inside = max(1.0 - distance * distance / 2.25, 0.0);
    let soft = min(radius * radius / 0.75, 1.0) * inside * inside;
    return mix(soft, crisp, smoothstep(0.6, 0.85, radius));
}

@fragment
fn particles_fragment(disc: Disc) -> @location(0) vec4f {
    let radius = disc.look.x;
    let distance = length(disc.offset);
    let alpha = disc.look.z * disc_coverage(distance, radius);
    // Big enough discs look like beads: darker rim, a small light from above left.
    let detail = disc.look.y * smoothstep(1.5, 5.0, radius);
    let part = distance / radius;
    let rim = 1.0 - vec3f(0.46, 0.38, 0.28) * (detail * smoothstep(0.35, 1.05, part));
    let from_light = length(disc.offset / radius + vec2f(0.42, 0.42));
    let light = 0.30 * detail * (1.0 - smoothstep(0.0, 0.36, from_light));
    return vec4f(mix(disc.color * rim, vec3f(1.0), light) * alpha, alpha);
}
