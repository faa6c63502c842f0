// occlusion: how much of the surroundings a pixel's surface cannot see, at half the picture's resolution. Of two
// opposite points on the screen, both the same way from the middle, a flat surface has one as much nearer as the other
// is farther, whatever its slope; where both are nearer the surface is hollow (Loos, Sloan, "Volumetric obscurance",
// I3D 2010: paired samples).
// in:  frame, depth
// out: occlusion 0 to 1, distance ahead in m

@group(2) @binding(0) var depths: texture_depth_multisampled_2d;

const pairs = 7u;

@vertex
fn occlusion_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

// Distance ahead at a pixel; very far where nothing is.
fn ahead_at(pixel: vec2f) -> f32 {
    let inside = clamp(pixel, vec2f(0.0), frame.size - 1.0);
    return frame.near / max(textureLoad(depths, vec2u(inside), 0), 1e-6);
}

@fragment
fn occlusion_fragment(@builtin(position) place: vec4f) -> @location(0) vec4f {
    let pixel = min(2.0 * place.xy, frame.size - 0.5);
    let middle = ahead_at(pixel);
    let reach = clamp(frame.occlusion_radius / (frame.pixel_size * middle), 3.0, 0.25 * frame.size.y);
    if middle > 0.99e6 * frame.near { return vec4f(0.0, middle, 0.0, 1.0); }
    // Each pixel of a 4 x 4 block looks in other directions; the last pass takes the mean of such a block.
    let cell = vec2u(place.xy) & vec2u(3u);
    let turn = f32((cell.x * 4u + cell.y) ^ ((cell.x * 7u) & 3u)) / 16.0;
    var sum = 0.0;
    for (var k = 0u; k < pairs; k++) {
        let part = (f32(k) + turn) / f32(pairs);
        let angle = 3.14159265 * (1.6180340 * f32(k) + turn);
        let offset = vec2f(cos(angle), sin(angle)) * reach * mix(0.12, 1.0, part);
        let scale = 1.0 / (frame.occlusion_radius * mix(0.3, 1.0, part));
        let one = (middle - ahead_at(pixel + offset)) * scale;
        let other = (middle - ahead_at(pixel - offset)) * scale;
        // A point far in front is another thing: its own opposite stands for it.
        let near_one = select(clamp(one, -1.0, 1.0), -clamp(other, -1.0, 1.0), one > 3.0);
        let near_other = select(clamp(other, -1.0, 1.0), -clamp(one, -1.0, 1.0), other > 3.0);
        sum += clamp(near_one + near_other, 0.0, 1.0);
    }
    return vec4f(clamp(1.3 * sum / f32(pairs), 0.0, 1.0), middle, 0.0, 1.0);
}
