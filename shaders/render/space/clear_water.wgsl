// clear_water: the water over the scene behind it: reflection of the room, refraction, absorption on the way through,
// the lamp's highlight.
// in:  frame, light, surface (smoothed), thickness, the scene's depth, colours and occlusion
// out: sRGB, every pixel; alpha 0 where compose is to smooth an edge

@group(2) @binding(2) var surface: texture_2d<f32>;
@group(2) @binding(3) var thickness_map: texture_2d<f32>;
@group(2) @binding(4) var depths: texture_depth_multisampled_2d;
@group(2) @binding(5) var samples: texture_multisampled_2d<f32>;
@group(2) @binding(6) var colors: texture_2d<f32>;
@group(2) @binding(7) var occlusions: texture_2d<f32>;

const refraction = 0.752; // 1 / 1.33
const sample_count = 4;
const mirror_steps = 24;
const least_mirrored = 0.035; // of the light: below, nobody sees what of the scene is in it

@vertex
fn clear_water_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// A direction of the world in view space.
fn to_eye(direction: vec3f) -> vec3f {
    return vec3f(dot(direction, frame.right.xyz), dot(direction, frame.up.xyz), dot(direction, frame.ahead.xyz));
}

fn scene_ahead(pixel: vec2u) -> f32 {
    return frame.near / max(textureLoad(depths, pixel, 0), 1e-6);
}

fn nearest_pixel(place: vec2f) -> vec2u {
    return vec2u(clamp(place, vec2f(0.0), frame.size - 1.0));
}

// The scene without water, sRGB.
fn scene_color(pixel: vec2u) -> vec3f {
    let color = textureLoad(colors, pixel, 0).rgb;
    return darkened(color, occlusion_at(occlusions, pixel, scene_ahead(pixel)));
}

// Linear light, between four pixels.
fn scene_between(place: vec2f) -> vec3f {
    let last = frame.size - 1.0;
    let at = clamp(place - 0.5, vec2f(0.0), last);
    let corner = vec2u(at);
    let next = min(corner + 1u, vec2u(last));
    let part = fract(at);
    let above = mix(textureLoad(colors, corner, 0).rgb, textureLoad(colors, vec2u(next.x, corner.y), 0).rgb, part.x);
    let below = mix(textureLoad(colors, vec2u(corner.x, next.y), 0).rgb, textureLoad(colors, next, 0).rgb, part.x);
    let near = nearest_pixel(place);
    return to_linear(darkened(mix(above, below, part.y), occlusion_at(occlusions, near, scene_ahead(near))));
}

fn thickness_texel(at: vec2u) -> vec2f {
    let sums = textureLoad(thickness_map, at, 0);
    return vec2f(sums.x + sums.y + sums.z, sums.w);
}

// Of water and of foam, m.
fn thickness_at(place: vec2f) -> vec2f {
    let last = vec2f(textureDimensions(thickness_map)) - 1.0;
    let at = clamp(0.5 * place - 0.5, vec2f(0.0), last);
    let corner = vec2u(at);
    let next = min(corner + 1u, vec2u(last));
    let part = fract(at);
    let above = mix(thickness_texel(corner), thickness_texel(vec2u(next.x, corner.y)), part.x);
    let below = mix(thickness_texel(vec2u(corner.x, next.y)), thickness_texel(next), part.x);
    return mix(above, below, part.y);
}

fn surface_at(pixel: vec2i) -> vec2f {
    return textureLoad(surface, clamp(pixel, vec2i(0), vec2i(frame.size) - 1), 0).xy;
}

// From the pixel before or after, whichever is less of a jump: no normals across an edge.
fn derivative(pixel: vec2i, axis: vec2i, middle: vec3f, depth: f32) -> vec3f {
    let one = surface_at(pixel + axis).x;
    let other = surface_at(pixel - axis).x;
    let jump_one = select(1e9, abs(one - depth), one > 0.0);
    let jump_other = select(1e9, abs(other - depth), other > 0.0);
    let place = vec2f(pixel) + 0.5;
    if min(jump_one, jump_other) > 1e8 { return pixel_ray(place + vec2f(axis)) * middle.z - middle; }
    if jump_one <= jump_other { return pixel_ray(place + vec2f(axis)) * (frame.near / one) - middle; }
    return middle - pixel_ray(place - vec2f(axis)) * (frame.near / other);
}

// Of the side of the domain that the ray enters through.
fn side_normal(direction: vec3f, point: vec3f) -> vec3f {
    let low = abs(point - frame.domain_min.xyz);
    let high = abs(point - frame.domain_max.xyz);
    let away = min(low, high) - select(vec3f(0.0), vec3f(1e-4), abs(direction) > vec3f(1e-3));
    var axis = vec3f(1.0, 0.0, 0.0);
    if away.y < min(away.x, away.z) { axis = vec3f(0.0, 1.0, 0.0); }
    if away.z < min(away.x, away.y) { axis = vec3f(0.0, 0.0, 1.0); }
    return axis * -sign(dot(axis, direction));
}

// What is seen through the water, linear light. The ray is bent into the water, goes on for its thickness, and leaves
// it parallel to the way it came; where a thing lies in the water the ray ends there.
fn seen_through(point: vec3f, ray: vec3f, bent: vec3f, thickness: f32, place: vec2f) -> vec4f {
    var way = thickness;
    let steep = max(bent.z, 0.2);
    for (var k = 0; k < 3; k++) {
        let inside = point + bent * way;
        let ahead = scene_ahead(nearest_pixel(view_to_pixel(inside)));
        if ahead < point.z { // that stands before the water
            way = thickness;
            break;
        }
        way = clamp(way + 0.8 * (ahead - inside.z) / steep, 0.0, thickness);
    }
    var end = point + bent * way;
    let behind = scene_ahead(nearest_pixel(view_to_pixel(end)));
    let rest = min(behind - end.z, 40.0 * thickness + frame.spacing);
    if rest > 0.0 {
        end += ray * (rest / ray.z);
        way = min(way + rest, thickness); // no thing was there: the water goes on
    }
    var found = view_to_pixel(end);
    // Nothing that stands before the water is seen in it.
    if scene_ahead(nearest_pixel(found)) < point.z { found = place; }
    return vec4f(scene_between(found), way);
}

// Linear light of the room that the water reflects: a dark hall with a soft box above and tall panels of light around.
fn room(direction: vec3f) -> vec3f {
    let height = direction.y;
    var light = mix(vec3f(0.018, 0.028, 0.045), vec3f(0.30, 0.43, 0.60), smoothstep(-0.12, 0.10, height));
    light = mix(light, vec3f(0.13, 0.20, 0.32), smoothstep(0.12, 0.75, height));
    let place = direction.xz / max(height, 0.05);
    let box = abs(place - vec2f(-0.40, 0.43)) - vec2f(0.62, 0.42);
    light += vec3f(2.1, 2.2, 2.3) * (1.0 - smoothstep(-0.12, 0.16, max(box.x, box.y))) * smoothstep(0.2, 0.5, height);
    let around = 2.5 * atan2(direction.x, direction.z) / 3.14159265;
    let panel = abs(fract(around + 0.15) - 0.5) - 0.20;
    light += vec3f(0.85, 0.98, 1.10) * (1.0 - smoothstep(-0.06, 0.09, panel)) * smoothstep(0.06, 0.22, height)
        * (1.0 - smoothstep(0.45, 0.72, height));
    return light;
}

// Where a ray that is before the scene at `before` and behind it at `after` meets it: halved, or steps would show.
fn meeting(point: vec3f, ray: vec3f, before: f32, after: f32) -> f32 {
    var low = before;
    var high = after;
    for (var k = 0; k < 4; k++) {
        let half = 0.5 * (low + high);
        let place = point + ray * half;
        if place.z > scene_ahead(nearest_pixel(view_to_pixel(place))) { high = half; } else { low = half; }
    }
    return high;
}

// The scene that is seen in the water as in a mirror, with the share of the light that comes from it: steps along the
// ray until it is behind something.
fn mirrored_scene(point: vec3f, mirrored: vec3f) -> vec4f {
    let reach = length(frame.domain_max.xyz - frame.domain_min.xyz);
    var way = 1.5 * frame.spacing;
    var before = 0.0;
    for (var k = 0; k < mirror_steps; k++) {
        let place = point + mirrored * way;
        if place.z < frame.near { break; }
        let pixel = view_to_pixel(place);
        if any(pixel < vec2f(0.0)) || any(pixel >= frame.size) { break; }
        let behind = place.z - scene_ahead(vec2u(pixel));
        let step = max(0.12 * way, 1.2 * frame.spacing);
        if behind > 0.0 && behind < 2.0 * step + 2.0 * frame.spacing {
            let found = view_to_pixel(point + mirrored * meeting(point, mirrored, before, way));
            let edge = min(found, frame.size - found) / (0.08 * frame.size);
            return vec4f(scene_between(found), clamp(min(edge.x, edge.y), 0.0, 1.0));
        }
        before = way;
        way += step;
        if way > reach { break; }
    }
    return vec4f(0.0);
}

// Linear light of the water at a pixel.
fn water_color(place: vec2f, depth: f32) -> vec3f {
    let pixel = vec2i(place);
    let middle = pixel_ray(place) * (frame.near / abs(depth));
    let ray = normalize(middle);
    let direction = to_world(ray);
    let point = frame.eye.xyz + to_world(middle);
    var normal: vec3f;
    if depth < 0.0 {
        normal = side_normal(direction, point);
    } else {
        let across = derivative(pixel, vec2i(1, 0), middle, depth);
        let down = derivative(pixel, vec2i(0, 1), middle, depth);
        normal = normalize(to_world(cross(across, down)));
        if dot(normal, direction) > 0.0 { normal = -normal; }
    }
    let facing = clamp(-dot(normal, direction), 0.0, 1.0);
    let bent = refract(direction, normal, refraction);
    let thickness = thickness_at(place);
    let through = seen_through(middle, ray, to_eye(bent), thickness.x, place);
    let lit = lit_roughly(point);
    let left = water_left(through.w);
    let haze = 1.0 - exp(-0.75 * frame.absorption * through.w);
    let glow = vec3f(0.004, 0.145, 0.235) * mix(0.80, 1.0, lit);
    var light = mix(through.rgb * left, glow, haze);
    let foam = 1.0 - exp(-0.75 * thickness.y / frame.spacing);
    let white = vec3f(0.66, 0.84, 0.94) * (0.60 + 0.50 * max(dot(normal, sun), 0.0)) * mix(0.7, 1.0, lit);
    light = mix(light, white, 0.70 * foam);
    let fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    var mirrored = reflect(direction, normal);
    // What a lying surface mirrors downwards meets the water once more and leaves it upwards: no dark specks at flat angles.
    mirrored.y = mix(mirrored.y, abs(mirrored.y), smoothstep(0.4, 0.8, normal.y));
    var image = room(mirrored);
    if depth > 0.0 && fresnel > least_mirrored {
        let seen = mirrored_scene(middle, to_eye(mirrored));
        image = mix(image, seen.rgb, seen.a);
    }
    light = mix(light, image, fresnel * (1.0 - 0.7 * foam));
    let shine = pow(max(dot(mirrored, sun), 0.0), 900.0);
    return light + lit * vec3f(6.0, 5.7, 5.2) * shine * (0.05 + fresnel);
}

// Whether the surface breaks off beside a pixel: where it ends, at a wave before another one, at a side of the domain.
fn breaks_off(pixel: vec2i, depth: f32) -> bool {
    let limit = 0.6 * frame.spacing * depth * depth / frame.near;
    for (var k = 0u; k < 4u; k++) {
        let step = select(vec2i(0, 1), vec2i(1, 0), k < 2u) * select(-1, 1, (k & 1u) == 1u);
        let other = surface_at(pixel + step).x;
        if sign(other) != sign(depth) || abs(other - depth) > limit { return true; }
    }
    return false;
}

// Water over the samples of a pixel that have nothing before it.
fn over_samples(pixel: vec2u, water: vec3f, cover: f32, depth: f32) -> vec3f {
    var sum = vec3f(0.0);
    for (var k = 0; k < sample_count; k++) {
        let open = textureLoad(depths, pixel, k) < depth;
        sum += mix(textureLoad(samples, pixel, k).rgb, water, select(0.0, cover, open));
    }
    return sum / f32(sample_count);
}

@fragment
fn clear_water_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(place.xy);
    let found = surface_at(vec2i(pixel));
    let sharp = 0.9 * frame.spacing * abs(found.x) / (frame.near * frame.pixel_size);
    let cover = clamp((unpack_shares(found.y).x - 0.5) * max(sharp, 1.0) + 0.5, 0.0, 1.0);
    if found.x == 0.0 || cover <= 0.0 { return vec4f(scene_color(pixel), 1.0); }
    var open = 0;
    for (var k = 0; k < sample_count; k++) { open += i32(textureLoad(depths, pixel, k) < abs(found.x)); }
    if open == 0 { return vec4f(scene_color(pixel), 1.0); }
    let water = min(to_srgb(water_color(place.xy, found.x)), vec3f(1.0));
    if open < sample_count { return vec4f(over_samples(pixel, water, cover, abs(found.x)), 1.0); }
    var color = water;
    if cover < 1.0 { color = mix(scene_color(pixel), water, cover); }
    return vec4f(color, select(1.0, 0.0, breaks_off(vec2i(pixel), found.x)));
}
