// Shared by the effects that show the floor: pale tiles in the domain under the light that the water bends, dark stone
// around it.

const pool_rim = 0.003;  // of the domain's larger side: the tiles reach so far beyond the domain
const ground_reach = 2.6; // times the domain's larger side, from its middle

fn ground_extent() -> f32 {
    let side = frame.domain_max.xyz - frame.domain_min.xyz;
    return ground_reach * max(side.x, side.z);
}

// Just below the spheres that lie on the domain's bottom.
fn ground_height() -> f32 {
    return frame.domain_min.y - 0.25 * frame.sphere_radius;
}

// Integral of a row of lines from 0 on: one per unit, each `width` wide.
fn lines_until(place: vec2f, width: f32) -> vec2f {
    return floor(place) * width + min(fract(place), vec2f(width));
}

// Share of a pixel that the joints of square tiles cover, `width` of a tile wide: exact along each axis, so that they fade
// to their mean far off.
fn joints(place: vec2f, width: f32, pixel: vec2f) -> f32 {
    let low = place + 0.5 * width;
    let share = (lines_until(low + 0.5 * pixel, width) - lines_until(low - 0.5 * pixel, width)) / pixel;
    return 1.0 - (1.0 - share.x) * (1.0 - share.y);
}

// What makes one tile differ from the next, -1 to 1; nothing where tiles are smaller than a pixel.
fn tile_variation(place: vec2f, pixel: vec2f) -> f32 {
    let tile = vec2u(vec2i(floor(place)) + 32768);
    return (2.0 * pixel_noise(tile) - 1.0) * clamp(1.5 - 3.0 * max(pixel.x, pixel.y), 0.0, 1.0);
}

// Light's way to a point of the floor beside the domain through the water in it.
fn way_through_water(point: vec3f) -> f32 {
    let one = (frame.domain_min.xyz - point) / sun;
    let other = (frame.domain_max.xyz - point) / sun;
    let near = min(one, other);
    let far = max(one, other);
    let enter = max(max(near.x, near.z), 0.0);
    let leave = min(min(far.x, far.z), far.y);
    if leave <= enter { return 0.0; }
    let part = (leave - enter) / 6.0;
    var way = 0.0;
    for (var k = 0; k < 6; k++) {
        let place = point + sun * (enter + (f32(k) + 0.5) * part);
        let below = water_height(place) - (place.y - frame.domain_min.y);
        way += part * clamp(below / (part * sun.y) + 0.5, 0.0, 1.0);
    }
    return way;
}

// Sunlight and skylight that reach the floor in the domain, through the water there.
fn light_in_pool(point: vec3f, lit: f32) -> vec3f {
    let sky_light = vec3f(0.33, 0.42, 0.52);
    if frame.water == 0u { return sunlight * sun.y * lit + sky_light; }
    let inside = clamp(point, frame.domain_min.xyz, frame.domain_max.xyz);
    return sunlight * sun.y * lit * caustics_at(inside) + sky_light * water_left(1.2 * water_height(inside));
}

// Linear light of a point of the floor, and how much of it is left before the backdrop. `width`: of what a pixel sees of
// it along x and z, m; `lit`: share of the light that reaches it.
fn floor_light(point: vec3f, direction: vec3f, width: vec2f, lit: f32) -> vec4f {
    let side = frame.domain_max.xz - frame.domain_min.xz;
    let middle = 0.5 * (frame.domain_min.xz + frame.domain_max.xz);
    // Tiles of round lengths, some fifteen along the longer side; two and a half times as large outside.
    let decade = pow(10.0, floor(log(max(side.x, side.y)) / log(10.0) - 0.3));
    let place = (point.xz - frame.domain_min.xz) / (0.2 * decade);
    let pixel = max(width / (0.2 * decade), vec2f(1e-4));
    let from_middle = length(point.xz - middle) / ground_extent();
    let around = abs(point.xz - middle) - 0.5 * side;
    let away = max(around.x, around.y) / max(side.x, side.y);
    var color: vec3f;
    if away < pool_rim {
        let tile = vec3f(0.43, 0.50, 0.53) * (1.0 + 0.12 * tile_variation(place, pixel));
        color = mix(tile, vec3f(0.24, 0.30, 0.33), joints(place, 0.03, pixel)) * light_in_pool(point, lit);
    } else {
        let stone = vec3f(0.100, 0.135, 0.185) * (1.0 + 0.13 * tile_variation(0.4 * place, 0.4 * pixel));
        let lamp = exp(-14.0 * from_middle * from_middle);
        var light = sunlight * sun.y * mix(0.25, 1.0, lamp) * lit;
        if frame.water != 0u { light *= water_left(way_through_water(point)); }
        light += vec3f(0.20, 0.25, 0.32) * (1.0 - 0.45 * exp(-60.0 * away));
        color = stone * (1.0 - 0.45 * joints(0.4 * place, 0.014, 0.4 * pixel)) * light;
        let gloss = floor_gloss(direction);
        if gloss > 0.016 { color += gloss * sky(reflect(direction, vec3f(0.0, 1.0, 0.0))); } // close by, steep: none
    }
    return vec4f(color, 1.0 - smoothstep(0.25, 0.95, from_middle));
}
