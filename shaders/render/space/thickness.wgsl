// thickness: how much water lies before what is behind it, at half the picture's resolution.
// in:  frame, particles, the scene's depth
// out: m: water, the sum of three channels, and foam; added up

@group(2) @binding(0) var depths: texture_depth_multisampled_2d;

struct Blob {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f,                  // from the centre, radii
    @location(1) @interpolate(flat) peak: vec4f, // m
    @location(2) @interpolate(flat) look: vec2f, // m ahead; of the bubbles
}

@vertex
fn thickness_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Blob {
    var blob: Blob;
    blob.place = vec4f(2.0, 2.0, 2.0, 1.0);
    if particle_kind(particle) != FLUID { return blob; }
    let center = to_view(particle_position(particle));
    if center.z - frame.spacing < frame.near { return blob; }
    let radius = max(thickness_radius * frame.spacing * body_share(particle), 3.0 * frame.pixel_size * center.z);
    let corner = square_corner(vertex);
    blob.place = project(center + vec3f(corner * radius, 0.0));
    blob.offset = corner;
    let peak = blob_peak(radius, radius);
    blob.peak = vec4f(spread_out(particle % 3u, peak).xyz, peak * foam_share(particle));
    blob.look = vec2f(center.z, f32(particle % 4096u));
    return blob;
}

// How much foam there is at a place of a particle: round bubbles of many sizes, about 1 in the mean.
fn bubbles(offset: vec2f, particle: f32) -> f32 {
    let turn = vec2f(cos(particle), sin(particle));
    let place = 3.4 * vec2f(dot(offset, turn), offset.x * turn.y - offset.y * turn.x) + 64.0;
    let cell = vec2u(floor(place)) + vec2u(u32(particle), 0u);
    let size = 0.12 + 0.36 * pixel_noise(cell);
    let middle = 0.5 + (0.5 - size) * (2.0 * vec2f(pixel_noise(cell + 4096u), pixel_noise(cell + 8192u)) - 1.0);
    return 0.60 + 3.6 * (1.0 - smoothstep(0.5 * size, size, length(fract(place) - middle)));
}

@fragment
fn thickness_fragment(blob: Blob) -> @location(0) vec4f {
    let pixel = min(2.0 * blob.place.xy, frame.size - 0.5);
    let behind = frame.near / max(textureLoad(depths, vec2u(pixel), 0), 1e-6);
    let before = clamp((behind - blob.look.x) / frame.spacing + 0.5, 0.0, 1.0);
    // Foam keeps to its particle, narrower than the water, and consists of bubbles: else it looks like wool.
    let share = blob_share(blob.offset);
    return blob.peak * vec4f(vec3f(share), 1.8 * share * share * bubbles(blob.offset, blob.look.y)) * before;
}
