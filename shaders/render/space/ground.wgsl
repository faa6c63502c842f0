// ground: the floor under the domain, with a fine grid and the shadow of the fluid; it fades into the backdrop.
// in:  frame, shadow map
// out: premultiplied sRGB

struct Ground {
    @builtin(position) place: vec4f,
    @location(0) point: vec3f, // m
}

const ground_reach = 2.6; // times the domain's larger side, from its middle

fn ground_extent() -> f32 {
    let side = frame.domain_max.xyz - frame.domain_min.xyz;
    return ground_reach * max(side.x, side.z);
}

@vertex
fn ground_vertex(@builtin(vertex_index) vertex: u32) -> Ground {
    let corner = square_corner(vertex) * ground_extent();
    let middle = 0.5 * (frame.domain_min.xyz + frame.domain_max.xyz);
    // Just below the spheres that lie on the domain's bottom.
    let height = frame.domain_min.y - 0.25 * frame.sphere_radius;
    var ground: Ground;
    ground.point = vec3f(middle.x + corner.x, height, middle.z + corner.y);
    ground.place = project(to_view(ground.point));
    return ground;
}

// Coverage of lines `spacing` apart, whose width is about a pixel.
fn grid_lines(point: vec2f, spacing: f32) -> f32 {
    let place = point / spacing;
    let width = fwidth(place);
    let away = abs(fract(place + 0.5) - 0.5) / max(width, vec2f(1e-6));
    let line = clamp(1.0 - away, vec2f(0.0), vec2f(1.0)) * clamp(0.5 / width - 1.0, vec2f(0.0), vec2f(1.0));
    return max(line.x, line.y);
}

// How much the waves above gather the light at a point of the floor, 1 without waves: rays bend by a quarter of the
// surface's slope, so their density follows from its curvature.
fn focus(point: vec3f) -> f32 {
    let texel = 2.0 / (length(frame.light_rows[0].xyz) * f32(textureDimensions(shade_map).x));
    let step = max(3.5 * frame.spacing, 12.0 * texel);
    let middle = shade_at(point);
    var sum = 0.0;
    for (var k = 0u; k < 8u; k++) {
        let angle = 0.78539816 * f32(k);
        sum += shade_at(point + vec3f(cos(angle), 0.0, sin(angle)) * step);
    }
    let curvature = (0.5 * sum - 4.0 * middle) / (step * step);
    // Not where the water ends at a side of the domain: that is no wave.
    let inside = min(point.xz - frame.domain_min.xz, frame.domain_max.xz - point.xz) / (6.0 * frame.spacing);
    let share = smoothstep(0.2, 1.0, min(inside.x, inside.y));
    return mix(1.0, clamp(1.0 / max(1.0 + 0.22 * middle * curvature, 0.3), 0.7, 1.8), share);
}

// Under water a floor of pale stone, which shows how the water bends and colours what is behind it.
fn pale_floor(point: vec3f, lamp: f32, inside: f32, lines: f32, lit: f32) -> vec3f {
    let spot = lamp * lamp;
    let stone = vec3f(0.008, 0.013, 0.023) + spot * vec3f(0.060, 0.082, 0.110) + inside * vec3f(0.235, 0.310, 0.360);
    return stone * (1.0 - 1.6 * lines) * lit * water_left(0.7 * shade_at(point)) * focus(point);
}

@fragment
fn ground_fragment(ground: Ground) -> @location(0) vec4f {
    if frame.eye.y < ground.point.y { discard; } // from below one looks through it
    let side = frame.domain_max.xz - frame.domain_min.xz;
    let middle = 0.5 * (frame.domain_min.xz + frame.domain_max.xz);
    // A grid of round lengths, some ten lines along the longer side.
    let decade = pow(10.0, floor(log(max(side.x, side.y)) / log(10.0) - 0.3));
    let lines = 0.22 * grid_lines(ground.point.xz - frame.domain_min.xz, decade)
        + 0.09 * grid_lines(ground.point.xz - frame.domain_min.xz, 0.2 * decade);
    let from_middle = length(ground.point.xz - middle) / ground_extent();
    let outside = abs(ground.point.xz - middle) - 0.5 * side;
    let inside = 1.0 - smoothstep(-0.004, 0.004, max(outside.x, outside.y) / max(side.x, side.y));
    let lamp = exp(-16.0 * from_middle * from_middle);
    let lit = mix(0.34, 1.0, lit_share(ground.point));
    var color = (vec3f(0.0065, 0.0100, 0.0180) + lamp * vec3f(0.019, 0.028, 0.044) + inside * vec3f(0.007, 0.012, 0.019)) * lit
        + 0.085 * lines * vec3f(1.0, 1.5, 2.2) * mix(0.5, 1.0, lit) * lamp;
    if frame.water != 0u { color = pale_floor(ground.point, lamp, inside, lines, lit); }
    let alpha = 1.0 - smoothstep(0.25, 0.95, from_middle);
    return vec4f(to_srgb(color) * alpha, alpha);
}
