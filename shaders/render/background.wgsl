// background: deep dark gradient with a vignette, a little lighter inside the domain.
// in:  frame
// out: every pixel, opaque

@vertex
fn background_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn background_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let uv = place.xy / frame.size;
    let from_middle = (uv - 0.5) * 2.0;
    let vignette = 1.0 - 0.38 * smoothstep(0.3, 2.1, dot(from_middle, from_middle));
    let outside = mix(vec3f(0.031, 0.045, 0.078), vec3f(0.016, 0.023, 0.043), uv.y);

    // Inside, light falls in from above.
    let domain_top = to_pixels(frame.domain_max.xy).y;
    let domain_bottom = to_pixels(frame.domain_min.xy).y;
    let depth = clamp((place.y - domain_top) / max(domain_bottom - domain_top, 1.0), 0.0, 1.0);
    let inside = mix(vec3f(0.050, 0.082, 0.138), vec3f(0.020, 0.033, 0.066), sqrt(depth));

    let share = clamp(0.5 - domain_distance(place.xy), 0.0, 1.0);
    // Half a step of 8 bits of noise: without it the gradient shows bands.
    let noise = (pixel_noise(vec2u(place.xy)) - 0.5) / 255.0;
    return vec4f(to_target(mix(outside, inside, share) * vignette + noise), 1.0);
}
