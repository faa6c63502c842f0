// calm: the water's height without the bumps of single particles, which would bend light more than its waves do.
// in:  frame, height's sums (instance 0), what instance 0 made of them (instance 1)
// out: height above the domain's bottom, m, 0 where there is no water: along rows, then along columns too

@group(2) @binding(0) var before: texture_2d<f32>;

struct Pass {
    @builtin(position) place: vec4f,
    @location(0) @interpolate(flat) number: u32,
}

const calm_width = 0.8; // standard deviation of the kernel, spacings
const calm_taps = 16;   // to each side

@vertex
fn calm_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) number: u32) -> Pass {
    let place = vec4f(f32(vertex & 1u) * 4.0 - 1.0, f32(vertex >> 1u) * 4.0 - 1.0, 0.0, 1.0);
    return Pass(place, number);
}

fn height_before(texel: vec2i, number: u32) -> f32 {
    let found = textureLoad(before, clamp(texel, vec2i(0), vec2i(textureDimensions(before)) - 1), 0);
    return select(found.x, decoded_height(found), number == 0u);
}

@fragment
fn calm_fragment(draw: Pass) -> @location(0) vec4f {
    let texel = vec2i(draw.place.xy);
    let middle = height_before(texel, draw.number);
    if middle <= 0.0 { return vec4f(0.0); }
    let axis = select(vec2i(1, 0), vec2i(0, 1), draw.number == 1u);
    let side = frame.domain_max.xz - frame.domain_min.xz;
    let size = textureDimensions(before);
    let width = max(calm_width * frame.spacing * f32(select(size.x, size.y, draw.number == 1u)) / select(side.x, side.y, draw.number == 1u), 1.0);
    // Wide kernels in steps: the sums are smooth already.
    let stride = max(i32(2.5 * width / f32(calm_taps) + 0.5), 1);
    var sum = middle;
    var weight = 1.0;
    for (var k = 1; k <= calm_taps; k++) {
        let x = f32(k * stride) / width;
        if x > 2.5 { break; }
        let share = exp(-0.5 * x * x);
        for (var sign = -1; sign <= 1; sign += 2) {
            let found = height_before(texel + axis * (sign * k * stride), draw.number);
            sum += select(0.0, share * found, found > 0.0);
            weight += select(0.0, share, found > 0.0);
        }
    }
    return vec4f(sum / weight, 0.0, 0.0, 1.0);
}
