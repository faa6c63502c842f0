// height: the water's surface as seen from above, a smooth maximum of the particles' heights over each point of the floor.
// in:  frame, particles
// out: lens.wgsl: encoded_height, added up

struct Blob {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f,                  // from the centre, radii
    @location(1) @interpolate(flat) peak: vec4f,
    @location(2) @interpolate(flat) edge: vec4f, // of the domain: low x, low z, high x, high z from the centre, radii
}

@vertex
fn height_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Blob {
    var blob: Blob;
    blob.place = vec4f(2.0, 2.0, 2.0, 1.0);
    if particle_kind(particle) != FLUID { return blob; }
    let point = particle_position(particle);
    let whole = smoothstep(0.32, 0.58, crowd[particle].x); // torn water bends no light
    let share = whole * whole;
    if share <= 0.0 { return blob; }
    let side = frame.domain_max.xz - frame.domain_min.xz;
    let radius = max(vec2f(height_radius * frame.spacing), 3.0 * side / vec2f(f32(frame.height_columns), f32(frame.height_rows)));
    let place = on_floor(point) * 2.0 - 1.0;
    blob.offset = square_corner(vertex);
    blob.place = vec4f((place + 2.0 * blob.offset * radius / side) * vec2f(1.0, -1.0), 0.5, 1.0);
    let weight = share * blob_peak(radius.x, radius.y) / frame.spacing;
    blob.peak = weight * encoded_height(point.y - frame.domain_min.y);
    blob.edge = vec4f(frame.domain_min.xz - point.xz, frame.domain_max.xz - point.xz) / radius.xyxy;
    return blob;
}

// Share of a blob's line through its middle on the near side of a cut at `away` radii.
fn cut_share(away: vec2f) -> vec2f {
    let t = clamp(away, vec2f(-1.0), vec2f(1.0));
    let t2 = t * t;
    return 0.5 + 0.5 * t * (2.03125 - t2 * (1.71875 - t2 * (0.84375 - 0.15625 * t2)));
}

@fragment
fn height_fragment(blob: Blob) -> @location(0) vec4f {
    // Behind the domain's sides there is no fluid: what there is stands for it.
    let room = cut_share(blob.edge.zw - blob.offset) - cut_share(blob.edge.xy - blob.offset);
    return blob.peak * (blob_share(blob.offset) / max(room.x * room.y, 0.2));
}
