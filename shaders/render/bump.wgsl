// Shared by the effects that sum up particles in 2D: each adds a bump whose weights, where particles fill the plane, sum to 1.

struct Bump {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f, // from the centre, radii, y down
    @location(1) @interpolate(flat) peak: f32,
    @location(2) @interpolate(flat) value: f32,
}

fn no_bump() -> Bump {
    var bump: Bump;
    bump.place = vec4f(2.0, 2.0, 2.0, 1.0); // outside of the picture
    return bump;
}

fn bump_corner(vertex: u32, particle: u32, value: f32) -> Bump {
    let spread = frame.field_radius / (frame.spacing * frame.pixels_per_meter);
    var bump: Bump;
    bump.offset = square_corner(vertex);
    bump.peak = 3.0 / (3.14159265 * spread * spread); // (1 - r^2)^2 integrates to pi / 3
    bump.value = value;
    let pixel = to_pixels(particle_position(particle).xy) + bump.offset * frame.field_radius;
    // The last texels of a field reach beyond the picture where its size is odd.
    let texel = f32(frame.field_texel);
    bump.place = to_clip(pixel * frame.size / (ceil(frame.size / texel) * texel));
    return bump;
}

// Weight, weight * way to the particle in field radii, weight * value.
fn bump_sums(bump: Bump) -> vec4f {
    let inside = max(1.0 - dot(bump.offset, bump.offset), 0.0);
    return bump.peak * inside * inside * vec4f(1.0, -bump.offset, bump.value);
}
