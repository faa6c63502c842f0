// ground: the floor under the domain, with a fine grid and the shadow of the fluid; it fades into the backdrop.
// in:  frame, shadow map
// out: premultiplied sRGB

@group(2) @binding(0) var shadow_map: texture_depth_2d;

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

// Share of the light that reaches a point: the mean over 6 x 6 texels.
fn lit_share(point: vec3f) -> f32 {
    var light = to_light(point);
    light.z = min(light.z, 1.0); // beyond the map's depth lies nothing that casts
    let texel = light_texel(light);
    let corner = floor(texel - 2.5);
    var lit = 0.0;
    var weight = 0.0;
    for (var y = 0; y < 6; y++) {
        for (var x = 0; x < 6; x++) {
            let at = corner + vec2f(f32(x), f32(y));
            let away = (at + 0.5 - texel) / 3.2;
            let share = max(1.0 - dot(away, away), 0.0);
            if any(at < vec2f(0.0)) || any(at >= vec2f(shadow_size)) {
                lit += share;
            } else {
                lit += share * f32(textureLoad(shadow_map, vec2u(at), 0) > light.z - 1e-3);
            }
            weight += share;
        }
    }
    return lit / max(weight, 1e-6);
}

// Coverage of lines `spacing` apart, whose width is about a pixel.
fn grid_lines(point: vec2f, spacing: f32) -> f32 {
    let place = point / spacing;
    let width = fwidth(place);
    let away = abs(fract(place + 0.5) - 0.5) / max(width, vec2f(1e-6));
    let line = clamp(1.0 - away, vec2f(0.0), vec2f(1.0)) * clamp(0.5 / width - 1.0, vec2f(0.0), vec2f(1.0));
    return max(line.x, line.y);
}

@fragment
fn ground_fragment(ground: Ground) -> @location(0) vec4f {
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
    let color = (vec3f(0.0065, 0.0100, 0.0180) + lamp * vec3f(0.019, 0.028, 0.044) + inside * vec3f(0.007, 0.012, 0.019)) * lit
        + 0.085 * lines * vec3f(1.0, 1.5, 2.2) * mix(0.5, 1.0, lit) * lamp;
    let alpha = (1.0 - smoothstep(0.25, 0.95, from_middle)) * f32(frame.eye.y > ground.point.y);
    return vec4f(to_srgb(color) * alpha, alpha);
}
