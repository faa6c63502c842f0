// smooth: the surface without the spheres that it is made of. Each pass fits a line to the depths along a row or column
// around a pixel and takes its value there (local linear regression): slopes stay as they are and edges do not bend,
// however one-sided the neighbours are. Depth is near / z, in which planes are linear on the screen. What is not a
// continuation of the surface is left out (narrow range: Truong and Yuksel, "A narrow-range filter for screen-space
// fluid rendering", I3D 2018). The kernel's width follows the particles' size on the screen.
// in:  frame, depth (negative: a side of the domain, which stays), shares of the pixel (water, a side of the domain)
// out: the same; instance 2 k smooths along rows, 2 k + 1 along columns, the last two do both

@group(2) @binding(0) var before: texture_2d<f32>;

struct Pass {
    @builtin(position) place: vec4f,
    @location(0) @interpolate(flat) number: u32,
}

const taps = 9;              // to each side
const clean_passes = 6u;     // from this number on
const widest = 64.0;         // pixels
const outline_width = 0.75;  // of the kernel that rounds the outline, spacings

@vertex
fn smooth_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) number: u32) -> Pass {
    let place = vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
    return Pass(place, number);
}

fn load(pixel: vec2i) -> vec2f {
    let last = vec2i(frame.size) - 1;
    return textureLoad(before, clamp(pixel, vec2i(0), last), 0).xy;
}

fn spacing_in_pixels(depth: f32) -> f32 {
    return frame.spacing * depth / (frame.near * frame.pixel_size);
}

// Sums of a weighted fit of a line.
struct Fit { s0: f32, s1: f32, s2: f32, t0: f32, t1: f32 }

fn add(fit: ptr<function, Fit>, x: f32, value: f32, weight: f32) {
    (*fit).s0 += weight;
    (*fit).s1 += weight * x;
    (*fit).s2 += weight * x * x;
    (*fit).t0 += weight * value;
    (*fit).t1 += weight * x * value;
}

// The line's value at 0. Steep lines through few points are held back, which would swing (ridge regression).
fn value_of(fit: Fit) -> f32 {
    let s2 = fit.s2 + 0.03 * fit.s0;
    return (s2 * fit.t0 - fit.s1 * fit.t1) / (fit.s0 * s2 - fit.s1 * fit.s1);
}

// Largest jump that goes on with a surface, as a difference of depths near `depth`. Where particles are as small as
// pixels a surface seen at a flat angle jumps by more than a spacing from one pixel to the next.
fn jump_limit(depth: f32) -> f32 {
    let size = max(frame.spacing, 4.0 * frame.pixel_size * frame.near / depth);
    return 5.0 * size * depth * depth / frame.near;
}

fn belongs(jump: f32, limit: f32) -> f32 {
    return 1.0 - smoothstep(0.55, 1.0, abs(jump) / limit);
}

// Depth at a pixel from its row or column, reaching `reach` pixels.
fn smoothed(pixel: vec2i, axis: vec2i, middle: f32, reach: f32) -> f32 {
    let stride = max(reach / f32(taps), 1.0);
    let limit = jump_limit(middle);
    var fit = Fit(1.0, 0.0, 0.0, middle, 0.0);
    for (var side = -1; side <= 1; side += 2) {
        var last = middle;
        var slope = 0.0;
        for (var k = 1; k <= taps; k++) {
            let x = round(f32(k) * stride);
            if x > reach { break; }
            let depth = load(pixel + axis * side * i32(x)).x;
            let jump = depth - last;
            let share = belongs(min(abs(jump), abs(jump - slope)), limit);
            if depth <= 0.0 || share <= 0.0 { continue; }
            slope = clamp(jump, -2.0 * limit, 2.0 * limit);
            last = depth;
            let part = x / reach;
            add(&fit, f32(side) * part, depth, share * (1.0 - part * part) * (1.0 - part * part));
        }
    }
    return clamp(value_of(fit), middle - 2.0 * limit, middle + 2.0 * limit);
}

// Last passes: what rows and columns did not agree on.
fn cleaned(pixel: vec2i, middle: f32, stride: i32) -> f32 {
    let limit = 0.5 * jump_limit(middle);
    var sum = 0.5 * middle;
    var weight = 0.5;
    for (var k = 13; k < 25; k++) { // half of 5 x 5, and what lies across
        let step = stride * (vec2i(k % 5, k / 5) - 2);
        // Both sides or none, so that slopes stay.
        let one = load(pixel + step).x;
        let other = load(pixel - step).x;
        if min(one, other) <= 0.0 { continue; }
        let share = belongs(one - middle, limit) * belongs(other - middle, limit) + 1e-3;
        sum += share * 0.5 * (one + other);
        weight += share;
    }
    return sum / weight;
}

// First passes: the share of water, rounded off, a depth where there was none, and no gaps between spheres through which
// the water behind them would show: they take the depth of what is nearer on both sides.
fn outlined(pixel: vec2i, axis: vec2i, middle: vec2f) -> vec2f {
    let center = to_view(0.5 * (frame.domain_min.xyz + frame.domain_max.xyz));
    let usual = frame.near / max(center.z, 2.0 * frame.near);
    let reach = clamp(outline_width * spacing_in_pixels(select(usual, abs(middle.x), middle.x != 0.0)), 1.0, 24.0);
    let stride = max(reach / 6.0, 1.0);
    var share = unpack_shares(middle.y);
    var weight = 1.0;
    var nearest = middle.x;
    let gap = select(1e9, middle.x + 0.5 * jump_limit(middle.x), middle.x > 0.0);
    var front_one = 0.0;
    var front_other = 0.0;
    for (var k = 1; k <= 6; k++) {
        let x = round(f32(k) * stride);
        if x > reach { break; }
        let part = x / (reach + 1.0);
        let w = (1.0 - part * part) * (1.0 - part * part);
        let one = load(pixel + axis * i32(x));
        let other = load(pixel - axis * i32(x));
        share += w * (unpack_shares(one.y) + unpack_shares(other.y));
        weight += 2.0 * w;
        if one.x > gap { front_one = max(front_one, one.x); }
        if other.x > gap { front_other = max(front_other, other.x); }
        if nearest == 0.0 { nearest = select(other.x, one.x, abs(one.x) > abs(other.x)); }
    }
    nearest = max(nearest, select(0.0, min(front_one, front_other), middle.x > 0.0));
    return vec2f(select(middle.x, nearest, middle.x >= 0.0), pack_shares(share / weight));
}

// Depth at a pixel that a side of the domain is to cover, so that the water's line on it is straight.
fn with_side(place: vec2f, middle: vec2f) -> f32 {
    if middle.x <= 0.0 || unpack_shares(middle.y).y < 0.3 { return middle.x; }
    let ahead = domain_span(to_world(pixel_ray(place))).x;
    return select(middle.x, -frame.near / ahead, ahead > frame.near);
}

@fragment
fn smooth_fragment(draw: Pass) -> @location(0) vec4f {
    let pixel = vec2i(draw.place.xy);
    let axis = select(vec2i(1, 0), vec2i(0, 1), (draw.number & 1u) == 1u);
    var middle = load(pixel);
    if draw.number < 2u { middle = outlined(pixel, axis, middle); }
    if draw.number == 1u { middle.x = with_side(draw.place.xy, middle); }
    if middle.x <= 0.0 { return vec4f(middle, 0.0, 1.0); }
    if draw.number >= clean_passes {
        let wide = i32(clamp(spacing_in_pixels(middle.x) / 10.0, 1.0, 3.0));
        return vec4f(cleaned(pixel, middle.x, select(wide, 1, draw.number > clean_passes)), middle.y, 0.0, 1.0);
    }
    let width = array(3.4, 2.4, 1.2)[min(draw.number >> 1u, 2u)];
    let reach = clamp(width * spacing_in_pixels(middle.x), 2.0, widest);
    return vec4f(smoothed(pixel, axis, middle.x, reach), middle.y, 0.0, 1.0);
}
