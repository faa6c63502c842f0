// Shared by the effects that draw the fluid as water: its optics, and how large it draws a particle. After Green,
// "Screen space fluid rendering with curvature flow", I3D 2009 (depth, thickness, smoothing, shading) with the narrow
// range filter's view of edges by Truong and Yuksel, I3D 2018.

@group(1) @binding(3) var<storage, read> crowd: array<vec2f>; // crowd_gather

// How much of a particle is a drop of its own, flying free: 0 to 1.
fn drop_share(particle: u32) -> f32 {
    return 1.0 - smoothstep(0.10, 0.34, crowd[particle].x);
}

// Torn water is drawn thinner, or it would look like balls.
fn body_share(particle: u32) -> f32 {
    return mix(0.55, 1.0, smoothstep(0.12, 0.45, crowd[particle].x));
}

// How much of it is white with air: where water that is torn moves against itself. A sheet that moves as one stays clear.
fn foam_share(particle: u32) -> f32 {
    let torn = 1.0 - smoothstep(0.25, 0.60, crowd[particle].x);
    return torn * smoothstep(0.010, 0.040, crowd[particle].y);
}

const surface_radius = 1.0;   // of the spheres whose union is smoothed, spacings
const drop_radius = 0.28;     // of drops that fly free, spacings
const thickness_radius = 1.7; // of the blobs that are summed up, spacings

// A blob that is summed up falls off with (1 - r^2)^2, which integrates to pi / 3 over a disc of radius 1. Its height in the
// middle, m, if it holds one particle's volume over an ellipse of the radii a and b, m.
fn blob_peak(a: f32, b: f32) -> f32 {
    return 3.0 * frame.spacing * frame.spacing * frame.spacing / (3.14159265 * a * b);
}

// `offset`: from the middle, radii.
fn blob_share(offset: vec2f) -> f32 {
    let inside = max(1.0 - dot(offset, offset), 0.0);
    return inside * inside;
}

// What a particle adds to a sum in half precision: each to one of the channels, so that many small parts are not lost.
fn spread_out(particle: u32, part: f32) -> vec4f {
    return select(vec4f(0.0), vec4f(part), vec4u(particle % 4u) == vec4u(0u, 1u, 2u, 3u));
}

// Two shares of 0 to 1 in one number.
fn pack_shares(shares: vec2f) -> f32 {
    return floor(shares.y * 1000.0 + 0.5) * 2.0 + shares.x;
}
fn unpack_shares(packed: f32) -> vec2f {
    let second = floor(packed * 0.5);
    return vec2f(packed - 2.0 * second, second / 1000.0);
}
