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

// Its four texels around a pixel, and how far between them that is.
struct Between {
    corner: vec2i,
    part: vec2f,
}

fn between(pixel: vec2f) -> Between {
    let place = pixel / f32(frame.field_texel) - 0.5;
    return Between(vec2i(floor(place)), place - floor(place));
}

fn texel_at(corner: vec2i) -> vec2i {
    return clamp(corner, vec2i(0), vec2i(textureDimensions(field)) - 1);
}

fn read_field(pixel: vec2f) -> vec4f {
    let at = between(pixel);
    let above = mix(textureLoad(field, texel_at(at.corner), 0), textureLoad(field, texel_at(at.corner + vec2i(1, 0)), 0), at.part.x);
    let below = mix(textureLoad(field, texel_at(at.corner + vec2i(0, 1)), 0), textureLoad(field, texel_at(at.corner + 1), 0), at.part.x);
    return mix(above, below, at.part.y);
}

fn read_value(pixel: vec2f) -> f32 {
    let at = between(pixel);
    let above = mix(textureLoad(values, texel_at(at.corner), 0).x, textureLoad(values, texel_at(at.corner + vec2i(1, 0)), 0).x, at.part.x);
    let below = mix(textureLoad(values, texel_at(at.corner + vec2i(0, 1)), 0).x, textureLoad(values, texel_at(at.corner + 1), 0).x, at.part.x);
    return mix(above, below, at.part.y);
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
    // Particles stop somewhere between the side and half a spacing before it.
    let first = low - 0.5 * frame.border;
    let last = high + 0.5 * frame.border;
    if (bits & 1u) != 0u && pixel < first + reach { return vec2f(2.0 * first - pixel, 1.0); }
    if (bits & 2u) != 0u && pixel > last - reach { return vec2f(2.0 * last - pixel, 1.0); }
    return vec2f(0.0);
}

// Where else the water around a pixel is, along x and along y.
struct Folds {
    x: vec2f,
    y: vec2f,
}

fn folds_of(pixel: vec2f) -> Folds {
    if frame.fold == 0u { return Folds(vec2f(0.0), vec2f(0.0)); }
    let low = to_pixels(frame.domain_min.xy);
    let high = to_pixels(frame.domain_max.xy);
    // Down is the other way.
    let sides = ((frame.fold >> 3u) & 1u) | ((frame.fold >> 1u) & 2u);
    return Folds(beyond(pixel.x, low.x, high.x, frame.fold & 3u, (frame.fold & 16u) != 0u),
                 beyond(pixel.y, high.y, low.y, sides, (frame.fold & 32u) != 0u));
}

// The sums: weight, way to the particles, weight of the fluid.
fn around(pixel: vec2f) -> vec4f {
    var sums = read_field(pixel);
    let folds = folds_of(pixel);
    let flip = select(vec2f(1.0), vec2f(-1.0), vec2f(folds.x.y, folds.y.y) == vec2f(1.0));
    if folds.x.y > 0.0 { sums += read_field(vec2f(folds.x.x, pixel.y)) * vec4f(1.0, flip.x, 1.0, 1.0); }
    if folds.y.y > 0.0 { sums += read_field(vec2f(pixel.x, folds.y.x)) * vec4f(1.0, 1.0, flip.y, 1.0); }
    if folds.x.y > 0.0 && folds.y.y > 0.0 { sums += read_field(vec2f(folds.x.x, folds.y.x)) * vec4f(1.0, flip, 1.0); }
    return sums;
}

// Weighted sum of places on the colour map.
fn value_around(pixel: vec2f) -> f32 {
    var value = read_value(pixel);
    let folds = folds_of(pixel);
    if folds.x.y > 0.0 { value += read_value(vec2f(folds.x.x, pixel.y)); }
    if folds.y.y > 0.0 { value += read_value(vec2f(pixel.x, folds.y.x)); }
    if folds.x.y > 0.0 && folds.y.y > 0.0 { value += read_value(vec2f(folds.x.x, folds.y.x)); }
    return value;
}

// How far within the water, in field radii, as long as that is little: 0 at its surface, `deep` in its middle. A plane
// half full has its surface where the mean is 0.291 radii away. Less than a particle's own weight is a gap between others.
const deep = 0.291;
fn within(sums: vec4f, own: f32) -> f32 {
    return deep - length(sums.yz) / max(sums.x, 1e-4) - 0.5 * max(1.0 - sums.w / own, 0.0);
}

// Upwards in `within`, per pixel.
fn slope_of(pixel: vec2f, own: f32) -> vec2f {
    let step = f32(frame.field_texel);
    let right = within(around(pixel + vec2f(step, 0.0)), own);
    let left = within(around(pixel - vec2f(step, 0.0)), own);
    let below = within(around(pixel + vec2f(0.0, step)), own);
    let above = within(around(pixel - vec2f(0.0, step)), own);
    return 0.5 / step * vec2f(right - left, below - above);
}

@fragment
fn liquid_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = place.xy;
    let here = around(pixel);
    let in_domain = clamp(0.5 - domain_distance(pixel), 0.0, 1.0);
    if here.w < 1e-3 || in_domain == 0.0 { return vec4f(0.0); }
    let spacing = frame.spacing * frame.pixels_per_meter;
    let spread = frame.field_radius / spacing;
    let own = 0.8 / (spread * spread); // of a particle's weight at its rim; field.wgsl: peak
    let level = within(here, own);
    var slope = vec2f(0.0); // hardly anything in the middle of the water
    if level < 0.8 * deep { slope = slope_of(pixel, own); }
    let steep = max(length(slope), 0.15 / frame.field_radius);
    // Particles smaller than a pixel are spread farther than they are large: a few of them are a mist.
    let full = mix(0.45, 0.6 * own, smoothstep(0.5, 1.2, spacing));
    let alpha = clamp(0.5 + level / steep, 0.0, 1.0) * min(here.w / full, 1.0) * in_domain;

    let t = clamp(value_around(pixel) / here.w, 0.0, 1.0);
    let base = color_map(t);
    // Light falls in from above, and is brightest at the surface that faces it.
    let top = to_pixels(frame.domain_max.xy).y;
    let bottom = to_pixels(frame.domain_min.xy).y;
    let depth = clamp((pixel.y - top) / max(bottom - top, 1.0), 0.0, 1.0);
    let pale = smoothstep(0.3, 0.7, dot(base, vec3f(0.30, 0.59, 0.11))); // stays so
    var color = base * mix(mix(1.08, 0.86, depth), 1.0, pale);
    let rim = clamp(1.0 - level / deep, 0.0, 1.0);
    let up_the_map = select(min(t + 0.2, 1.0), t, frame.color_by == 2u); // a diverging map has no "up"
    color = mix(color, color_map(up_the_map), 0.6 * smoothstep(0.3, 1.0, rim));
    let facing = max(dot(-slope, normalize(vec2f(-0.4, -0.9))) / max(length(slope), 1e-6), 0.0);
    let line = 1.0 - smoothstep(0.8, 2.6, level / (steep * frame.line_scale));
    color += vec3f(0.22, 0.25, 0.27) * line * (0.35 + 0.65 * facing);
    // What is fast glows, beyond the surface too.
    let glow = 0.5 * smoothstep(0.45, 1.0, t) * min(here.w, 0.5) * in_domain * (1.0 - alpha);
    return vec4f(to_target(clamp(color, vec3f(0.0), vec3f(1.0))) * alpha + to_target(base) * glow, alpha);
}
