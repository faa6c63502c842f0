// shade: how much water lies between the light and the floor.
// in:  frame, particles
// out: way of the light through the water, m: the sum of the channels, added up

struct Blob {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f, // from the centre, radii
    @location(1) @interpolate(flat) peak: vec4f, // m
}

@vertex
fn shade_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Blob {
    var blob: Blob;
    blob.place = vec4f(2.0, 2.0, 2.0, 1.0);
    if particle_kind(particle) != FLUID { return blob; }
    let light = to_light(particle_position(particle));
    let scale = vec2f(length(frame.light_rows[0].xyz), length(frame.light_rows[1].xyz)); // clip units per metre
    let radius = max(2.2 * frame.spacing * scale, vec2f(4.5 * 2.0 / 512.0));
    blob.place = vec4f(light.xy + square_corner(vertex) * radius, 0.5, 1.0);
    blob.offset = square_corner(vertex);
    blob.peak = spread_out(particle, blob_peak(radius.x / scale.x, radius.y / scale.y));
    return blob;
}

@fragment
fn shade_fragment(blob: Blob) -> @location(0) vec4f {
    return blob.peak * blob_share(blob.offset);
}
