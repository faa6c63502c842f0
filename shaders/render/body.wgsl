// body: soft wide discs under the particles, which join to one body of water; fast ones glow.
// in:  frame, color_maps, position, velocity, flow
// out: premultiplied colour

const glow_spread = 0.9; // a glow reaches so much further than the body

struct Body {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f, // from the centre, 1 at the edge
    @location(1) @interpolate(flat) color: vec3f,
    @location(2) @interpolate(flat) glow: f32,
}

@vertex
fn body_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Body {
    let t = color_value(particle);
    let corner = square_corner(vertex);
    var body: Body;
    body.glow = smoothstep(0.45, 1.0, t);
    let radius = frame.body_radius * (1.0 + glow_spread * body.glow);
    body.place = to_clip(to_pixels(position[particle]) + corner * radius);
    body.offset = corner;
    // From further down the map: darker and richer than the discs on top. A diverging map has no "further down".
    body.color = color_map(select(0.72 * t, t, frame.color_by == 2u));
    return body;
}

@fragment
fn body_fragment(body: Body) -> @location(0) vec4f {
    let part = dot(body.offset, body.offset);
    let spread = 1.0 + glow_spread * body.glow;
    let near = max(1.0 - part * spread * spread, 0.0);
    let far = max(1.0 - part, 0.0);
    // Water and its light end at the walls.
    let share = clamp(0.5 - domain_distance(body.place.xy), 0.0, 1.0);
    let alpha = 0.5 * near * near * share;
    let light = 0.16 * body.glow * far * far * far * share;
    // The light covers a little, so that many glows in one place do not add up to white.
    return vec4f(to_target(body.color * 0.72, alpha) + to_target(body.color, light), min(alpha + 0.8 * light, 1.0));
}
