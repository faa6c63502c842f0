// water: soft wide discs under the particles, which join to one body of water; fast ones glow.
// in:  frame, color_maps, particles
// out: premultiplied colour

const glow_spread = 0.9; // a glow reaches so much further than the body

struct Water {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f,                             // from the centre, 1 at the edge
    @location(1) @interpolate(flat) color: vec3f,
    @location(2) @interpolate(flat) glow: vec2f,            // strength, squared edge of the glow in body radii
}

@vertex
fn water_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Water {
    var water: Water;
    if particle_kind(particle) != FLUID {
        water.place = vec4f(2.0, 2.0, 2.0, 1.0); // outside of the picture
        return water;
    }
    let t = color_value(particle);
    let glow = smoothstep(0.45, 1.0, t);
    let spread = 1.0 + glow_spread * glow;
    let radius = frame.water_radius * spread;
    // Water and its light end at the walls.
    let middle = to_pixels(particle_position(particle).xy);
    let low = to_pixels(vec2f(frame.domain_min.x, frame.domain_max.y)) - frame.border;
    let high = to_pixels(vec2f(frame.domain_max.x, frame.domain_min.y)) + frame.border;
    let corner = clamp(middle + square_corner(vertex) * radius, low, high);
    water.place = to_clip(corner);
    water.offset = (corner - middle) / radius;
    // From further down the map: darker and richer than the discs on top. A diverging map has no "further down".
    water.color = to_target(color_map(select(0.72 * t, t, frame.color_by == 2u)));
    water.glow = vec2f(0.16 * glow, spread * spread);
    return water;
}

@fragment
fn water_fragment(water: Water) -> @location(0) vec4f {
    let part = dot(water.offset, water.offset);
    let near = max(1.0 - part * water.glow.y, 0.0);
    let far = max(1.0 - part, 0.0);
    let alpha = 0.5 * near * near;
    let light = water.glow.x * far * far * far;
    // The light covers a little, so that many glows in one place do not add up to white.
    return vec4f(water.color * (0.72 * alpha + light), min(alpha + 0.8 * light, 1.0));
}
