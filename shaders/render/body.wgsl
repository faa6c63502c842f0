// body: soft wide discs under the particles, which join to one body of water; fast ones glow.
// in:  frame, color_maps, position, velocity, flow
// out: premultiplied colour; light of the glow is added (it covers nothing)

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
    let radius = frame.body_radius * (1.0 + 0.8 * body.glow);
    body.place = to_clip(to_pixels(position[particle]) + corner * radius);
    body.offset = corner;
    body.color = color_map(t);
    return body;
}

@fragment
fn body_fragment(body: Body) -> @location(0) vec4f {
    let inside = max(1.0 - dot(body.offset, body.offset), 0.0);
    let falloff = inside * inside;
    let alpha = 0.42 * falloff * (1.0 - 0.6 * body.glow);
    let light = 0.10 * body.glow * falloff;
    return vec4f(to_target(body.color * 0.55, alpha) + to_target(body.color, light), alpha);
}
