// clear_water: the water over the scene behind it: reflection of the sky and of the sun, refraction, absorption and shafts
// of light on the way through, the floor mirrored in the walls, foam.
// The view is bent at the surface; from there rays are followed in the world to the floor, the sides and the forms of walls
// and bodies.
// in:  frame, light, forms, solid_state, corners, surface (smoothed), thickness, the scene's depth, colours and occlusion
// out: sRGB, every pixel; alpha 0 where compose is to smooth edges: in the water, where one ray per pixel makes steps

@group(2) @binding(3) var surface: texture_2d<f32>;
@group(2) @binding(4) var thickness_map: texture_2d<f32>;
@group(2) @binding(5) var depths: texture_depth_multisampled_2d;
@group(2) @binding(6) var samples: texture_multisampled_2d<f32>;
@group(2) @binding(7) var colors: texture_2d<f32>;
@group(2) @binding(8) var occlusions: texture_2d<f32>;

const sample_count = 4;
const least_mirrored_within = 0.25;
const shaft_steps = 4;
const scattering = 0.26; // of light in the water, as absorption is told
const least_mirrored = 0.035; // of the light: below, nobody sees what of the scene is in it

@vertex
fn clear_water_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

fn scene_ahead(pixel: vec2u) -> f32 {
    return frame.near / max(textureLoad(depths, pixel, 0), 1e-6);
}

// The scene without water, sRGB.
fn scene_color(pixel: vec2u) -> vec3f {
    let color = textureLoad(colors, pixel, 0).rgb;
    return darkened(color, occlusion_at(occlusions, pixel, scene_ahead(pixel)));
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

// From the pixel before or after, whichever is less of a jump: no normals across an edge. 1 where it
// goes on to both sides.
fn derivative(pixel: vec2i, axis: vec2i, middle: vec3f, depth: f32) -> vec4f {
    let one = surface_at(pixel + axis).x;
    let other = surface_at(pixel - axis).x;
    let jump_one = select(1e9, abs(one - depth), one > 0.0);
    let jump_other = select(1e9, abs(other - depth), other > 0.0);
    let place = vec2f(pixel) + 0.5;
    // Where the surface goes on to both sides its mean slope: the lesser of two turns it to the eye.
    if max(jump_one, jump_other) < 1.5 * frame.spacing * depth * depth / frame.near {
        let ahead = pixel_ray(place + vec2f(axis)) * (frame.near / one);
        return vec4f(0.5 * (ahead - pixel_ray(place - vec2f(axis)) * (frame.near / other)), 1.0);
    }
    if min(jump_one, jump_other) > 1e8 { return vec4f(pixel_ray(place + vec2f(axis)) * middle.z - middle, 0.0); }
    if jump_one <= jump_other { return vec4f(pixel_ray(place + vec2f(axis)) * (frame.near / one) - middle, 0.0); }
    return vec4f(middle - pixel_ray(place - vec2f(axis)) * (frame.near / other), 0.0);
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

const FLOOR = 0u; // or a solid
const SIDE = 1u;
const SURFACE = 2u; // from within

// What a ray in the domain comes to.
struct Target {
    met: Meeting,
    kind: u32,
}

// The water's normal from below.
fn normal_from_below(point: vec3f) -> vec3f {
    let step = vec2f(0.6 * frame.spacing, 0.0);
    let rise_x = water_height(point + step.xyy) - water_height(point - step.xyy);
    let rise_z = water_height(point + step.yyx) - water_height(point - step.yyx);
    return normalize(vec3f(rise_x, -2.0 * step.x, rise_z));
}

fn next_target(start: vec3f, ray: vec3f) -> Target {
    let low = vec3f(frame.domain_min.x, ground_height(), frame.domain_min.z);
    let sides = select(low, frame.domain_max.xyz, ray > vec3f(0.0)) - start;
    let ways = select(max(sides / divisor(ray), vec3f(0.0)), vec3f(1e9), abs(ray) < vec3f(1e-6));
    let way = min(min(ways.x, ways.z), ways.y);
    var end = Target(meet_solids(start, ray, way), select(SIDE, FLOOR, ways.y <= way && ray.y < 0.0));
    if end.met.way < way { end.kind = FLOOR; }
    if end.kind == SIDE {
        end.met.normal = -sign(ray) * select(vec3f(0.0, 0.0, 1.0), vec3f(1.0, 0.0, 0.0), ways.x < ways.z);
        if ways.y <= way { end.met.normal = vec3f(0.0, -1.0, 0.0); }
    }
    if ray.y <= 0.0 { return end; }
    let above = start.y - frame.domain_min.y;
    let guess = clamp((near_water_height(start) - above) / ray.y, 0.0, way);
    let rise = (water_height(start + ray * guess) - above) / ray.y;
    if rise < end.met.way && rise * ray.y > -frame.spacing {
        let rest = max(rise, 0.0);
        end = Target(Meeting(rest, normal_from_below(start + ray * rest), 0.0, 0u, end.met.veiled), SURFACE);
    }
    return end;
}

// How sure it is that a place is under water.
fn under_water(place: vec3f) -> f32 {
    let depth = near_water_height(place) - (place.y - frame.domain_min.y);
    return smoothstep(-1.5, 0.5, depth / frame.spacing);
}

// The same of all of a way.
fn all_under_water(start: vec3f, way: vec3f) -> f32 {
    let sum = under_water(start + 0.1 * way) + under_water(start + 0.3 * way) + under_water(start + 0.5 * way)
        + under_water(start + 0.7 * way) + under_water(start + 0.9 * way);
    return smoothstep(0.30, 0.80, 0.2 * sum);
}

fn met_color(met: Meeting) -> vec3f {
    return to_linear(solid_color(met.solid)) * met.tone;
}

// Linear light of a wall or body at a point.
fn solid_light(met: Meeting, point: vec3f) -> vec3f {
    return matte(met_color(met), met.normal, light_on_solid(point, met.normal));
}

// Linear light that comes along a ray: from the solid that it meets, else from the floor or the sky. `before`: its way from
// the eye to its start, m.
fn light_along(start: vec3f, ray: vec3f, met: Meeting, before: f32) -> vec3f {
    if met.tone > 0.0 { return solid_light(met, start + ray * met.way); }
    if ray.y > -1e-3 { return surroundings(ray); }
    let way = (ground_height() - start.y) / ray.y;
    let foot = start + ray * way;
    // What a pixel sees of the floor is long where it comes flat.
    let along = abs(ray.xz) / max(length(ray.xz), 1e-6);
    let width = frame.pixel_size * (before + way) * (along.yx - along / ray.y);
    let seen = floor_light(foot, ray, width, lit_share(foot));
    let light = tempered(seen.rgb); // or waves would gather more than the floor beside shows
    if seen.a >= 1.0 { return light; }
    return mix(surroundings(ray), light, seen.a);
}

// Whether a point, from the eye, lies in the domain, above its floor.
fn lies_in_domain(from_eye: vec3f) -> bool {
    let point = frame.eye.xyz + from_eye;
    let margin = vec3f(0.0, 0.05, 0.0) * frame.spacing;
    return all(point > frame.domain_min.xyz + margin) && all(point < frame.domain_max.xyz);
}

// What is seen through the water at a point of its surface. The ray is bent into the water and ends at a solid or at the
// floor; at a side, and at the surface from within, it is mirrored, and what is not goes on beyond. Where the water ends
// before that it leaves it parallel to the way it came.
fn seen_through(point: vec3f, direction: vec3f, bent: vec3f, straight: f32, pixel: vec2u) -> Through {
    let before = length(point - frame.eye.xyz);
    let first = next_target(point, bent);
    let end = first.met.way;
    let share = all_under_water(point, bent * end);
    let way = min(mix(straight, end, share), end);
    var through = Through(vec3f(0.0), 0.0);
    // Drops behind a thin sheet, and meshes that no ray meets, are what the scene shows straight behind.
    let thin = share < 0.5 && straight < 3.0 * frame.spacing;
    if (thin || first.met.veiled) && lies_in_domain(direction * (scene_ahead(pixel) / dot(direction, frame.ahead.xyz))) {
        return Through(to_linear(scene_color(pixel)) * water_left(straight), straight);
    }
    var mirrored = 0.0;
    if first.kind != FLOOR { mirrored = share * mirrored_within(abs(dot(bent, first.met.normal))); }
    let arrives = first.kind == FLOOR && share > 0.99;
    for (var k = 0; k < 2; k++) { // what goes on, what is mirrored
        let part = select(1.0 - mirrored, mirrored, k == 1);
        if part < 0.02 { continue; }
        var start = point;
        var ray = bent;
        var next = first;
        var passed = 0.0;
        if k == 1 {
            for (var n = 0; n < 2 && next.kind != FLOOR; n++) {
                start += ray * next.met.way;
                passed += next.met.way;
                ray = reflect(ray, next.met.normal);
                next = next_target(start, ray);
            }
        } else if !arrives {
            start += bent * way;
            passed = way;
            ray = direction;
            next.met = meet_solids(start, ray, 1e9);
        }
        let light = light_along(start, ray, next.met, before + passed);
        if k == 1 || arrives { passed += next.met.way; }
        through.light += part * light * water_left(passed);
        through.way += part * passed;
    }
    return through;
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
    let direction = to_world(normalize(middle));
    let point = frame.eye.xyz + to_world(middle);
    var normal: vec3f;
    var whole = true;
    if depth < 0.0 {
        normal = side_normal(direction, point);
    } else {
        let across = derivative(pixel, vec2i(1, 0), middle, depth);
        let down = derivative(pixel, vec2i(0, 1), middle, depth);
        normal = normalize(to_world(cross(across.xyz, down.xyz)));
        if dot(normal, direction) > 0.0 { normal = -normal; }
        whole = across.w * down.w > 0.0;
    }
    let facing = clamp(-dot(normal, direction), 0.0, 1.0);
    // At an edge the slope is hardly known: bent rays would end anywhere.
    let bent = select(direction, refract(direction, normal, into_water), whole);
    let thickness = thickness_at(place);
    let through = seen_through(point, direction, bent, thickness.x, vec2u(pixel));
    let lit = lit_roughly(point);
    var light = through.light + scattered(point, bent, through.way) * mix(0.7, 1.0, lit);
    let foam = 1.0 - exp(-0.95 * thickness.y / frame.spacing);
    let white = vec3f(0.94, 0.98, 1.00) * (0.60 + 0.55 * max(dot(normal, sun), 0.0)) * mix(0.6, 1.0, lit);
    light = mix(light, white, 0.94 * foam);
    let fresnel = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    var mirrored = reflect(direction, normal);
    // What the surface mirrors downwards meets the water once more and leaves it upwards: no dark specks at flat angles.
    if depth > 0.0 { mirrored.y = abs(mirrored.y); }
    var image: vec3f;
    var met = Meeting(0.0, vec3f(0.0), 0.0, 0u, false);
    if depth > 0.0 && fresnel > least_mirrored { met = meet_solids(point, mirrored, 1e9); }
    if met.tone > 0.0 { image = matte(met_color(met), met.normal, vec3f(1.0)); } else { image = surroundings(mirrored); }
    light = mix(light, image, fresnel * (1.0 - 0.7 * foam));
    let shine = pow(max(dot(mirrored, sun), 0.0), 900.0);
    return light + lit * vec3f(6.0, 5.7, 5.2) * shine * (0.05 + fresnel);
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
    return vec4f(color, 0.0);
}
