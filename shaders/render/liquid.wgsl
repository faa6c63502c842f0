// liquid: the fluid as one body of water, from the field.
// in:  frame, color_maps, field of the fluid, field of solids
// out: premultiplied colour
// A point is in the water if the mean of the particles around it is near (after Zhu and Bridson, "Animating sand as a
// fluid", SIGGRAPH 2005): a lonely particle is a drop of its own size, many have a smooth surface.

@group(2) @binding(0) var field: texture_2d<f32>;
@group(2) @binding(1) var solid_field: texture_2d<f32>;

@vertex
fn liquid_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// What lies around a pixel: weight and mean way, of fluid and of solids; place of the fluid on the colour map, weighted.
struct Around {
    fluid: vec4f,
    solid: vec4f,
}

fn texel_at(corner: vec2i) -> vec2i {
    return clamp(corner, vec2i(0), vec2i(textureDimensions(field)) - 1);
}

// Between four texels.
fn read_fields(pixel: vec2f) -> Around {
    let place = pixel / f32(frame.field_texel) - 0.5;
    let part = place - floor(place);
    let a = texel_at(vec2i(floor(place)));
    let b = texel_at(vec2i(floor(place)) + 1);
    let c = vec2i(b.x, a.y);
    let d = vec2i(a.x, b.y);
    return Around(mix(mix(textureLoad(field, a, 0), textureLoad(field, c, 0), part.x),
                      mix(textureLoad(field, d, 0), textureLoad(field, b, 0), part.x), part.y),
                  mix(mix(textureLoad(solid_field, a, 0), textureLoad(solid_field, c, 0), part.x),
                      mix(textureLoad(solid_field, d, 0), textureLoad(solid_field, b, 0), part.x), part.y));
}

fn sum_of(a: Around, b: Around) -> Around {
    return Around(a.fluid + b.fluid, a.solid + b.solid);
}

// Where the field goes on beyond a periodic side: pixel there, and 1; else 0, 0.
fn beyond(pixel: f32, low: f32, high: f32) -> vec2f {
    if pixel < low + frame.field_radius { return vec2f(pixel + high - low, 1.0); }
    if pixel > high - frame.field_radius { return vec2f(pixel - high + low, 1.0); }
    return vec2f(0.0);
}

// The sums over a solid half plane whose edge is so many radii away, towards `way`; the mean is doubled, for particles of
// mueller lie in rows there that keep away from each other.
fn half_plane(distance: f32, way: vec2f) -> vec4f {
    let d = max(distance, 0.0);
    if d >= 1.0 { return vec4f(0.0); }
    let near = 1.0 - d;
    let inside = 1.0 - d * d;
    return vec4f(0.5 * near * near * sqrt(near), 0.291 * inside * inside * inside * sqrt(inside) * way, 0.0);
}

fn around(pixel: vec2f) -> Around {
    var found = read_fields(pixel);
    if frame.fold == 0u { return found; }
    let low = to_pixels(vec2f(frame.domain_min.x, frame.domain_max.y));
    let high = to_pixels(vec2f(frame.domain_max.x, frame.domain_min.y));
    if (frame.fold & 15u) != 0u {
        let to_low = (pixel - low) / frame.field_radius;
        let to_high = (high - pixel) / frame.field_radius;
        if (frame.fold & 1u) != 0u { found.solid += half_plane(to_low.x, vec2f(-1.0, 0.0)); }
        if (frame.fold & 2u) != 0u { found.solid += half_plane(to_high.x, vec2f(1.0, 0.0)); }
        if (frame.fold & 4u) != 0u { found.solid += half_plane(to_high.y, vec2f(0.0, 1.0)); }
        if (frame.fold & 8u) != 0u { found.solid += half_plane(to_low.y, vec2f(0.0, -1.0)); }
    }
    let x = select(vec2f(0.0), beyond(pixel.x, low.x, high.x), (frame.fold & 16u) != 0u);
    let y = select(vec2f(0.0), beyond(pixel.y, low.y, high.y), (frame.fold & 32u) != 0u);
    if x.y > 0.0 { found = sum_of(found, read_fields(vec2f(x.x, pixel.y))); }
    if y.y > 0.0 { found = sum_of(found, read_fields(vec2f(pixel.x, y.x))); }
    if x.y > 0.0 && y.y > 0.0 { found = sum_of(found, read_fields(vec2f(x.x, y.x))); }
    return found;
}

// How far within the water, in field radii, as long as that is little: 0 at its surface, `deep` in its middle. A plane
// half full has its surface where the mean is 0.291 radii away. Less than a particle's `own` weight is a gap between others.
const deep = 0.291;
fn within(found: Around, own: f32) -> f32 {
    var mean = found.fluid.yz / max(found.fluid.x, 1e-4);
    // Beside a solid the fluid is on one side only, and yet has no surface there: the solid's part of the mean would be
    // as far on its other side.
    let room = max(1.0 - found.solid.x, 0.1);
    let lacking = length(found.solid.yz);
    if lacking > 1e-4 {
        let away = -found.solid.yz / lacking;
        mean -= away * clamp(dot(mean, away), 0.0, lacking / room);
    }
    return deep - length(mean) - 0.5 * max(1.0 - found.fluid.x / (own * room), 0.0);
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
    // Most pixels have no fluid around them.
    let nearest = textureLoad(field, texel_at(vec2i(pixel / f32(frame.field_texel))), 0);
    if nearest.x == 0.0 && frame.fold < 16u { return vec4f(0.0); }
    let in_domain = clamp(0.5 - domain_distance(pixel), 0.0, 1.0);
    let here = around(pixel);
    if here.fluid.x < 1e-3 || in_domain == 0.0 { return vec4f(0.0); }
    let spacing = frame.spacing * frame.pixels_per_meter;
    let spread = frame.field_radius / spacing;
    let own = 0.8 / (spread * spread); // of a particle's weight at its rim; field.wgsl: peak
    let level = within(here, own);
    var slope = vec2f(0.0); // hardly anything in the middle of the water
    if level < 0.8 * deep { slope = slope_of(pixel, own); }
    let steep = max(length(slope), 0.15 / frame.field_radius);
    // Particles smaller than a pixel are spread farther than they are large: a few of them are a mist.
    let full = mix(0.45, 0.6 * own, smoothstep(0.5, 1.2, spacing));
    let alpha = clamp(0.5 + level / steep, 0.0, 1.0) * min(here.fluid.x / full, 1.0) * in_domain;

    let t = clamp(here.fluid.w / here.fluid.x, 0.0, 1.0);
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
    let glow = 0.5 * smoothstep(0.45, 1.0, t) * min(here.fluid.x, 0.5) * in_domain * (1.0 - alpha);
    return vec4f(to_target(clamp(color, vec3f(0.0), vec3f(1.0))) * alpha + to_target(base) * glow, alpha);
}
