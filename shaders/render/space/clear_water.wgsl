// clear_water: the water over the scene behind it: reflection of the sky and of the sun, refraction, absorption and shafts
// of light on the way through, the floor mirrored in the walls, foam.
// in:  frame, light, surface (smoothed), thickness, the scene's depth, colours and occlusion
// out: sRGB, every pixel; alpha 0 where compose is to smooth an edge

@group(2) @binding(3) var surface: texture_2d<f32>;
@group(2) @binding(4) var thickness_map: texture_2d<f32>;
@group(2) @binding(5) var depths: texture_depth_multisampled_2d;
@group(2) @binding(6) var samples: texture_multisampled_2d<f32>;
@group(2) @binding(7) var colors: texture_2d<f32>;
@group(2) @binding(8) var occlusions: texture_2d<f32>;

const sample_count = 4;
const mirror_steps = 24;
const least_mirrored_within = 0.25;
const shaft_steps = 4;
const scattering = 0.26; // of light in the water, as absorption is told
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

// The same between four pixels, not darkened.
fn scene_undarkened(place: vec2f) -> vec3f {
    let last = frame.size - 1.0;
    let at = clamp(place - 0.5, vec2f(0.0), last);
    let corner = vec2u(at);
    let next = min(corner + 1u, vec2u(last));
    let part = fract(at);
    let above = mix(textureLoad(colors, corner, 0).rgb, textureLoad(colors, vec2u(next.x, corner.y), 0).rgb, part.x);
    let below = mix(textureLoad(colors, vec2u(corner.x, next.y), 0).rgb, textureLoad(colors, next, 0).rgb, part.x);
    return mix(above, below, part.y);
}

// Linear light, between four pixels.
fn scene_between(place: vec2f) -> vec3f {
    let near = nearest_pixel(place);
    return to_linear(darkened(scene_undarkened(place), occlusion_at(occlusions, near, scene_ahead(near))));
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
    // Where the surface goes on to both sides its mean slope: the lesser of two turns it to the eye.
    if max(jump_one, jump_other) < 1.5 * frame.spacing * depth * depth / frame.near {
        let ahead = pixel_ray(place + vec2f(axis)) * (frame.near / one);
        return 0.5 * (ahead - pixel_ray(place - vec2f(axis)) * (frame.near / other));
    }
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

// Light that comes through the water, linear, and its way in there, m.
struct Through {
    light: vec3f,
    way: f32,
}

// Share of light that water mirrors to itself at a wall of glass with air behind it: all of it at flat angles (and more
// at steep ones than real glass, whose 0.08 would leave plain blue there).
fn mirrored_within(cosine: f32) -> f32 {
    let beyond = 1.0 - (1.0 - cosine * cosine) / (into_water * into_water);
    let outside = sqrt(max(beyond, 0.0));
    return select(1.0, least_mirrored_within + (1.0 - least_mirrored_within) * pow(1.0 - outside, 5.0), beyond > 0.0);
}

// Where a ray in the water leaves the domain, all in the world.
struct Leaving {
    way: f32,    // m
    share: f32,  // how sure it is that the water goes on until there
    normal: vec3f,
    rest: f32,   // mirrored at a side, from there to the floor
}

fn leaving(point: vec3f, bent: vec3f) -> Leaving {
    let sides = select(frame.domain_min.xyz, frame.domain_max.xyz, bent > vec3f(0.0)) - point;
    let ways = max(sides / select(vec3f(1e-6), bent, abs(bent) > vec3f(1e-6)), vec3f(0.0));
    let way = min(min(ways.x, ways.z), ways.y);
    var normal = vec3f(0.0, 1.0, 0.0);
    if ways.y > way { normal = select(vec3f(0.0, 0.0, 1.0), vec3f(1.0, 0.0, 0.0), ways.x < ways.z); }
    var under = 0.0; // the surface, how much of the way
    for (var k = 1; k <= 5; k++) {
        let place = point + bent * (way * f32(k) / 5.0);
        let depth = near_water_height(place) - (place.y - frame.domain_min.y);
        under += 0.2 * smoothstep(-1.5, 0.5, depth / frame.spacing);
    }
    let share = smoothstep(0.30, 0.80, under);
    return Leaving(way, share, normal, ways.y - way);
}

// At the floor the ray ends. At a side there is what `beyond` shows, and in it the floor as in a mirror.
fn seen_at_side(point: vec3f, bent: vec3f, leaves: Leaving, beyond: Through) -> Through {
    let at_floor = leaves.normal.y > 0.5;
    let share = leaves.share * select(mirrored_within(abs(dot(bent, leaves.normal))), 1.0, at_floor);
    if share < 0.02 { return beyond; }
    let back = reflect(bent, leaves.normal);
    let foot = point + bent * leaves.way + back * leaves.rest;
    // Not the floor's outermost pixels, which are half something else.
    let edge = vec3f(max(0.3 * frame.spacing, 2.5 * frame.pixel_size * length(point - frame.eye.xyz)));
    let way = leaves.way + leaves.rest;
    // The mean over what a pixel sees of the floor, long where it comes flat, or its tiles would make a moire.
    let stretch = back * (frame.pixel_size * (length(point - frame.eye.xyz) + way) / (3.0 * max(-back.y, 0.05)));
    var sum = vec3f(0.0);
    for (var k = -1; k <= 1; k++) {
        let place = clamp(foot + f32(k) * stretch, frame.domain_min.xyz + edge, frame.domain_max.xyz - edge);
        let view = to_view(vec3f(place.x, frame.domain_min.y, place.z));
        if view.z < frame.near { return beyond; }
        sum += scene_undarkened(view_to_pixel(view));
    }
    let mirrored = to_linear(sum / 3.0) * water_left(way);
    return Through(mix(beyond.light, mirrored, share), mix(beyond.way, way, share));
}

// Whether what the scene shows at a pixel lies in the domain, or is its floor.
fn found_in_domain(pixel: vec2f) -> bool {
    let at = nearest_pixel(pixel);
    let point = frame.eye.xyz + to_world(pixel_ray(pixel) * scene_ahead(at));
    let margin = vec3f(0.02, 1.0, 0.02) * frame.spacing;
    return all(point > frame.domain_min.xyz - margin) && all(point < frame.domain_max.xyz + margin);
}

// What is seen through the water. The ray is bent into the water, goes on for its thickness, and leaves it parallel to the
// way it came; where a thing lies in the water the ray ends there. All in view space.
fn seen_through(point: vec3f, ray: vec3f, bent: vec3f, straight: f32, place: vec2f) -> Through {
    let in_world = frame.eye.xyz + to_world(point);
    // What goes up meets the surface from below, which throws it down.
    var within = to_world(bent);
    within.y = -max(abs(within.y), 0.05);
    let leaves = leaving(in_world, within);
    let thickness = mix(straight, max(straight, leaves.way), leaves.share);
    var way = straight;
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
    let through = Through(scene_between(found) * water_left(way), way);
    if found_in_domain(found) { return through; }
    return seen_at_side(in_world, within, leaves, through);
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
            if !found_in_domain(found) { break; } // the floor around is no part of the mirrored sky
            let edge = min(found, frame.size - found) / (0.08 * frame.size);
            return vec4f(scene_between(found), clamp(min(edge.x, edge.y), 0.0, 1.0));
        }
        before = way;
        way += step;
        if way > reach { break; }
    }
    return vec4f(0.0);
}

// Light of the sun and the sky that the water itself throws back on the ray's way in it, in shafts where the waves gather it.
fn scattered(point: vec3f, bent: vec3f, way: f32) -> vec3f {
    let part = way / f32(shaft_steps);
    let clear = scattering * frame.absorption;
    var sum = vec3f(0.0);
    for (var k = 0; k < shaft_steps; k++) {
        let passed = (f32(k) + 0.5) * part;
        sum += sunlight_at(point + bent * passed) * exp(-clear * passed) * water_left(passed);
    }
    return vec3f(0.02, 0.27, 0.46) * sum * (1.0 - exp(-clear * part));
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
    let bent = refract(direction, normal, into_water);
    let thickness = thickness_at(place);
    let through = seen_through(middle, ray, to_eye(bent), thickness.x, place);
    let lit = lit_roughly(point);
    var light = through.light + scattered(point, bent, through.way) * mix(0.7, 1.0, lit);
    let foam = 1.0 - exp(-0.95 * thickness.y / frame.spacing);
    let white = vec3f(0.94, 0.98, 1.00) * (0.60 + 0.55 * max(dot(normal, sun), 0.0)) * mix(0.6, 1.0, lit);
    light = mix(light, white, 0.94 * foam);
    let fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    var mirrored = reflect(direction, normal);
    // What the surface mirrors downwards meets the water once more and leaves it upwards: no dark specks at flat angles.
    if depth > 0.0 { mirrored.y = abs(mirrored.y); }
    var image = surroundings(mirrored);
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
    let water = exposed(water_color(place.xy, found.x));
    if open < sample_count { return vec4f(over_samples(pixel, water, cover, abs(found.x)), 1.0); }
    var color = water;
    if cover < 1.0 { color = mix(scene_color(pixel), water, cover); }
    return vec4f(color, select(1.0, 0.0, breaks_off(vec2i(pixel), found.x)));
}
