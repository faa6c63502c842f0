// field: what lies around each point of the picture: kernel-weighted sums over the particles.
// in:  frame, particles
// out: sums over fluid and solids: weight, weight * way to the particle in field radii; over the fluid: weight;
//      weight * place on the colour map
// The weights of a filled plane sum to 1. Walls and bodies count, so that the water has no surface at them.

struct Blob {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f, // from the centre, radii, y down
    @location(1) @interpolate(flat) peak: vec3f, // of the weight; of the fluid's; of the value
}

@vertex
fn field_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Blob {
    var blob: Blob;
    let group = particle_group(particle);
    if group == group_empty {
        blob.place = vec4f(2.0, 2.0, 2.0, 1.0); // outside of the picture
        return blob;
    }
    let spread = frame.field_radius / (frame.spacing * frame.pixels_per_meter);
    let peak = 3.0 / (3.14159265 * spread * spread); // (1 - r^2)^2 integrates to pi / 3
    let is_fluid = group == 0u || group >= group_inlet;
    blob.offset = square_corner(vertex);
    let pixel = to_pixels(particle_position(particle).xy) + blob.offset * frame.field_radius;
    blob.place = to_clip(field_pixel(pixel));
    blob.peak = peak * vec3f(1.0, 0.0, 0.0);
    if is_fluid { blob.peak = peak * vec3f(1.0, 1.0, color_value(particle)); }
    return blob;
}

// The last texels of a field reach beyond the picture where its size is odd.
fn field_pixel(pixel: vec2f) -> vec2f {
    let texel = f32(frame.field_texel);
    return pixel * frame.size / (ceil(frame.size / texel) * texel);
}

struct Sums {
    @location(0) around: vec4f,
    @location(1) value: f32,
}

@fragment
fn field_fragment(blob: Blob) -> Sums {
    let inside = max(1.0 - dot(blob.offset, blob.offset), 0.0);
    let share = inside * inside;
    let weight = share * blob.peak.x;
    return Sums(vec4f(weight, -weight * blob.offset, share * blob.peak.y), share * blob.peak.z);
}
