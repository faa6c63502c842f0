// Shared by the effects that darken hollows: what the occlusion pass has found.

// The mean over a block of 4 x 4 of those pixels that are as far `ahead`.
fn occlusion_at(occlusions: texture_2d<f32>, pixel: vec2u, ahead: f32) -> f32 {
    let last = vec2i(textureDimensions(occlusions)) - 1;
    let corner = vec2i(pixel / 2u) - select(vec2i(2), vec2i(1), (pixel & vec2u(1u)) == vec2u(1u));
    var sum = 0.0;
    var weight = 1e-4;
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let found = textureLoad(occlusions, clamp(corner + vec2i(x, y), vec2i(0), last), 0).xy;
            let share = clamp(1.5 - abs(found.y - ahead) / frame.occlusion_radius, 0.0, 1.0);
            sum += share * found.x;
            weight += share;
        }
    }
    return sum / weight;
}

// Hollows keep some colour: light that came through the fluid.
fn darkened(color: vec3f, occlusion: f32) -> vec3f {
    return color * mix(vec3f(1.0), vec3f(0.30, 0.36, 0.46), occlusion);
}
