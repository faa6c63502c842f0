// liquid: the fluid as one body of water, from the field.
// in:  frame, color_maps, field, values
// out: premultiplied colour
// A point is in the water if the mean of the particles around it is near (after Zhu and Bridson, "Animating sand as a
// fluid", SIGGRAPH 2005): a lonely particle is a drop of its own size, many have a smooth surface.

@group(2) @binding(0) var field: texture_2d<f32>;
@group(2) @binding(1) var values: texture_2d<f32>;

@vertex
fn liquid_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

struct Around {
    sums: vec4f, // weight, way to the particles, weight of the fluid
    value: f32,
}

fn add(a: Around, b: Around, flip: vec2f) -> Around {
    return Around(a.sums + b.sums * vec4f(1.0, flip, 1.0), a.value + b.value);
}

// Between four texels.
fn read_field(pixel: vec2f) -> Around {
    let last = vec2i(textureDimensions(field)) - 1;
    let place = pixel / f32(frame.field_texel) - 0.5;
    let corner = vec2i(floor(place));
    let part = place - floor(place);
    var found = Around(vec4f(0.0), 0.0);
    for (var k = 0; k < 4; k++) {
        let next = vec2i(k & 1, k >> 1);
        let texel = clamp(corner + next, vec2i(0), last);
        let share = select(1.0 - part, part, next == vec2i(1));
        found.sums += share.x * share.y * textureLoad(field, texel, 0);
        found.value += share.x * share.y * textureLoad(values, texel, 0).x;
    }
    return found;
}

// Where the field goes on beyond the domain's sides along an axis: pixel there, and 1 if as a mirror, 2 if as it is; 0
// if there is nothing to add.
fn beyond(pixel: f32, low: f32, high: f32, bits: u32, is_periodic: bool) -> vec2f {
    let reach = frame.field_radius;
    if is_periodic {
        if pixel < low + reach { return vec2f(pixel + high - low, 2.0); }
        if pixel > high - reach { return vec2f(pixel - high + low, 2.0); }
        return vec2f(0.0);
    }
    if (bits & 1u) != 0u && pixel < low - frame.border + reach { return vec2f(2.0 * (low - frame.border) - pixel, 1.0); }
    if (bits & 2u) != 0u && pixel > high + frame.border - reach { return vec2f(2.0 * (high + frame.border) - pixel, 1.0); }
    return vec2f(0.0);
}

fn around(pixel: vec2f) -> Around {
    var found = read_field(pixel);
    if frame.fold == 0u { return found; }
    let low = to_pixels(frame.domain_min.xy);
    let high = to_pixels(frame.domain_max.xy);
    let x = beyond(pixel.x, low.x, high.x, frame.fold & 3u, (frame.fold & 16u) != 0u);
    // Down is the other way.
    let sides = ((frame.fold >> 3u) & 1u) | ((frame.fold >> 1u) & 2u);
    let y = beyond(pixel.y, high.y, low.y, sides, (frame.fold & 32u) != 0u);
    let flip = select(vec2f(1.0), vec2f(-1.0), vec2f(x.y, y.y) == vec2f(1.0));
    if x.y > 0.0 { found = add(found, read_field(vec2f(x.x, pixel.y)), vec2f(flip.x, 1.0)); }
    if y.y > 0.0 { found = add(found, read_field(vec2f(pixel.x, y.x)), vec2f(1.0, flip.y)); }
    if x.y > 0.0 && y.y > 0.0 { found = add(found, read_field(vec2f(x.x, y.x)), flip); }
    return found;
}

// How far within the water, in field radii, as long as that is little: 0 at its surface, `deep` in its middle. A plane
// half full has its surface where the mean is 0.291 radii away. Less than a particle's own weight is a gap between others.
const deep = 0.291;
fn within(sums: vec4f, own: f32) -> f32 {
    return deep - length(sums.yz) / max(sums.x, 1e-4) - 0.5 * max(1.0 - sums.w / own, 0.0);
}

@fragment
fn liquid_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = place.xy;
    let here = around(pixel);
    if here.sums.w < 1e-3 { return vec4f(0.0); }
    let spread = frame.field_radius / (frame.spacing * frame.pixels_per_meter);
    let own = 0.8 / (spread * spread); // of a particle's weight at its rim; field.wgsl: peak
    let level = within(here.sums, own);
    // Upwards in `level`, per pixel.
    let step = f32(frame.field_texel);
    let right = within(around(pixel + vec2f(step, 0.0)).sums, own);
    let left = within(around(pixel - vec2f(step, 0.0)).sums, own);
    let below = within(around(pixel + vec2f(0.0, step)).sums, own);
    let above = within(around(pixel - vec2f(0.0, step)).sums, own);
    let slope = 0.5 / step * vec2f(right - left, below - above);
    let steep = max(length(slope), 0.15 / frame.field_radius);
    // Small particles are spread farther than they are large: a few of them are a mist.
    let full = clamp(0.11 * (spread - 1.0), 0.11, 0.45);
    let in_domain = clamp(0.5 - domain_distance(pixel), 0.0, 1.0);
    let alpha = clamp(0.5 + level / steep, 0.0, 1.0) * min(here.sums.w / full, 1.0) * in_domain;

    let t = clamp(here.value / here.sums.w, 0.0, 1.0);
    // Light falls in from above, and is brightest at the surface that faces it.
    let top = to_pixels(frame.domain_max.xy).y;
    let bottom = to_pixels(frame.domain_min.xy).y;
    let depth = clamp((pixel.y - top) / max(bottom - top, 1.0), 0.0, 1.0);
    let base = color_map(t);
    var color = base * mix(mix(1.08, 0.84, depth), 1.0, base.r); // white stays white
    let rim = clamp(1.0 - level / deep, 0.0, 1.0);
    let facing = max(dot(-slope, normalize(vec2f(-0.4, -0.9))) / max(length(slope), 1e-6), 0.0);
    color = mix(color, color_map(min(t + 0.2, 1.0)), 0.6 * smoothstep(0.3, 1.0, rim));
    let line = 1.0 - smoothstep(0.8, 2.6, level / (steep * frame.line_scale));
    color += vec3f(0.22, 0.25, 0.27) * line * (0.35 + 0.65 * facing);
    // What is fast glows, beyond the surface too.
    let glow = 0.5 * smoothstep(0.45, 1.0, t) * min(here.sums.w, 0.5) * in_domain * (1.0 - alpha);
    return vec4f(to_target(clamp(color, vec3f(0.0), vec3f(1.0))) * alpha + to_target(color_map(t)) * glow, alpha);
}
