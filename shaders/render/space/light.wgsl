// Shared by the effects that light reaches: what the shadow map says, and the water that the light came through.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shade_map: texture_2d<f32>; // length of light's way through water, m

const sun = vec3f(-0.3496, 0.8591, 0.3737); // towards the light; frame.c: light_direction

// Share of the light that reaches a point: the mean over 6 x 6 texels, `stride` apart.
fn lit_share_within(point: vec3f, stride: f32) -> f32 {
    var light = to_light(point);
    light.z = min(light.z, 1.0); // beyond the map's depth lies nothing that casts
    let texel = light_texel(light);
    let corner = select(floor(texel - 2.5), texel - 2.5 * stride, stride > 1.0);
    var lit = 0.0;
    var weight = 0.0;
    for (var y = 0; y < 6; y++) {
        for (var x = 0; x < 6; x++) {
            let at = corner + stride * vec2f(f32(x), f32(y));
            let away = (at + select(0.5, 0.0, stride > 1.0) - texel) / (3.2 * stride);
            let share = max(1.0 - dot(away, away), 0.0);
            if any(at < vec2f(0.0)) || any(at >= vec2f(shadow_size)) {
                lit += share;
            } else {
                lit += share * f32(textureLoad(shadow_map, vec2u(at), 0) > light.z - 1e-3);
            }
            weight += share;
        }
    }
    return lit / max(weight, 1e-6);
}

// The same, softer on the pale floor under water, where texels would show.
fn lit_share(point: vec3f) -> f32 {
    let spacing = 0.5 * shadow_size * frame.spacing * length(frame.light_rows[0].xyz);
    return lit_share_within(point, select(1.0, max(0.35 * spacing, 1.0), frame.water != 0u));
}

// From four texels.
fn lit_roughly(point: vec3f) -> f32 {
    let light = to_light(point);
    let texel = clamp(light_texel(light), vec2f(2.0), vec2f(shadow_size - 2.0));
    var lit = 0.0;
    for (var k = 0u; k < 4u; k++) {
        let at = texel + 3.0 * (vec2f(f32(k & 1u), f32(k >> 1u)) - 0.5);
        lit += 0.25 * f32(textureLoad(shadow_map, vec2u(at), 0) > min(light.z, 1.0) - 1e-3);
    }
    return lit;
}

fn shade_texel(at: vec2f) -> f32 {
    let last = vec2f(textureDimensions(shade_map)) - 1.0;
    return dot(textureLoad(shade_map, vec2u(clamp(at, vec2f(0.0), last)), 0), vec4f(1.0));
}

// Way of the light through water to a point under all of it, between four texels.
fn shade_at(point: vec3f) -> f32 {
    let place = (to_light(point).xy * vec2f(0.5, -0.5) + 0.5) * vec2f(textureDimensions(shade_map)) - 0.5;
    let corner = floor(place);
    let part = place - corner;
    let above = mix(shade_texel(corner), shade_texel(corner + vec2f(1.0, 0.0)), part.x);
    let below = mix(shade_texel(corner + vec2f(0.0, 1.0)), shade_texel(corner + 1.0), part.x);
    return mix(above, below, part.y);
}
