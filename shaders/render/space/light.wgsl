// Shared by the effects that light reaches: what the shadow map says, and the water that the light came through.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var height_map: texture_2d<f32>;   // calm.wgsl
@group(2) @binding(2) var caustics_map: texture_2d<f32>; // caustics.wgsl

// 1 where light of that depth in the map reaches a texel of it.
fn lit_texel(at: vec2f, depth: f32) -> f32 {
    if any(at < vec2f(0.0)) || any(at >= vec2f(shadow_size)) { return 1.0; }
    return f32(textureLoad(shadow_map, vec2u(at), 0) > depth - 1e-3);
}

// Share of the light that reaches a point: the mean over 6 x 6 texels, `stride` apart.
fn lit_share_within(point: vec3f, stride: f32) -> f32 {
    let light = to_light(point);
    let depth = min(light.z, 1.0); // beyond the map's depth lies nothing that casts
    let texel = light_texel(light);
    let corner = select(floor(texel - 2.5), texel - 2.5 * stride, stride > 1.0);
    if frame.water != 0u { // what casts then is large: where all of these agree, so do those between
        let far = vec2f(5.0 * stride, 0.0);
        let sum = lit_texel(corner, depth) + lit_texel(corner + far, depth) + lit_texel(corner + far.yx, depth)
            + lit_texel(corner + far.xx, depth) + lit_texel(corner + 0.5 * far.xx, depth);
        if sum == 0.0 || sum == 5.0 { return 0.2 * sum; }
    }
    var lit = 0.0;
    var weight = 0.0;
    for (var y = 0; y < 6; y++) {
        for (var x = 0; x < 6; x++) {
            let at = corner + stride * vec2f(f32(x), f32(y));
            let away = (at + select(0.5, 0.0, stride > 1.0) - texel) / (3.2 * stride);
            let share = max(1.0 - dot(away, away), 0.0);
            lit += share * lit_texel(at, depth);
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

fn texel_of(map: texture_2d<f32>, at: vec2f) -> vec4f {
    return textureLoad(map, vec2u(clamp(at, vec2f(0.0), vec2f(textureDimensions(map)) - 1.0)), 0);
}

// Of a map of the floor, between four texels.
fn above_floor(map: texture_2d<f32>, point: vec3f) -> vec4f {
    let place = on_floor(point) * vec2f(textureDimensions(map)) - 0.5;
    let corner = floor(place);
    let part = place - corner;
    let above = mix(texel_of(map, corner), texel_of(map, corner + vec2f(1.0, 0.0)), part.x);
    let below = mix(texel_of(map, corner + vec2f(0.0, 1.0)), texel_of(map, corner + 1.0), part.x);
    return mix(above, below, part.y);
}

// Height of the water's surface above the domain's bottom at a place, m; the nearest texel's.
fn near_water_height(point: vec3f) -> f32 {
    return texel_of(height_map, on_floor(point) * vec2f(textureDimensions(height_map))).x;
}

// The same between texels.
fn water_height(point: vec3f) -> f32 {
    return above_floor(height_map, point).x;
}

// Sunlight on the floor under the water, 1 where nothing has bent or absorbed it.
fn caustics_at(point: vec3f) -> vec3f {
    return above_floor(caustics_map, point).rgb;
}

// Share of the sunlight that arrives at a point above the floor, which the water over it bends and absorbs.
fn sunlight_at(point: vec3f) -> vec3f {
    let place = on_floor(point);
    if frame.water == 0u || any(place < vec2f(0.0)) || any(place > vec2f(1.0)) { return vec3f(1.0); }
    let height = point.y - frame.domain_min.y;
    let surface = near_water_height(point); // smooth enough for light
    if surface <= height { return vec3f(1.0); }
    let ray = sun_in_water();
    let rest = max(height, 0.0) / -ray.y; // to the floor, on which the waves have gathered the light most
    let gathered = min(caustics_at(point + ray * rest) / water_left(rest), vec3f(3.0));
    return mix(water_left((surface - height) / -ray.y), gathered, 1.0 - clamp(height / surface, 0.0, 1.0));
}
