// Shared by the effects of a picture in 3D: the camera, the light, the look of the surroundings. View space: x to the
// right, y up, z ahead, m. Depth is near / z: 1 at the near plane, 0 infinitely far.

fn to_view(point: vec3f) -> vec3f {
    let offset = point - frame.eye.xyz;
    return vec3f(dot(offset, frame.right.xyz), dot(offset, frame.up.xyz), dot(offset, frame.ahead.xyz));
}

fn to_world(direction: vec3f) -> vec3f {
    return frame.right.xyz * direction.x + frame.up.xyz * direction.y + frame.ahead.xyz * direction.z;
}

fn project(view: vec3f) -> vec4f {
    return vec4f(frame.projection.xy * view.xy + frame.projection.zw * view.z, frame.near, view.z);
}

// Pixel of a point in view space.
fn view_to_pixel(view: vec3f) -> vec2f {
    let clip = project(view);
    return (clip.xy / clip.w * vec2f(0.5, -0.5) + 0.5) * frame.size;
}

// Point of view space seen at a pixel, at z = 1.
fn pixel_ray(pixel: vec2f) -> vec3f {
    let clip = (pixel / frame.size * 2.0 - 1.0) * vec2f(1.0, -1.0);
    return vec3f((clip - frame.projection.zw) / frame.projection.xy, 1.0);
}

// Where a ray from the eye enters the domain and leaves it, in lengths of `direction` (of the world).
fn domain_span(direction: vec3f) -> vec2f {
    let way = select(direction, vec3f(1e-9), abs(direction) < vec3f(1e-9));
    let one = (frame.domain_min.xyz - frame.eye.xyz) / way;
    let other = (frame.domain_max.xyz - frame.eye.xyz) / way;
    let enter = min(one, other);
    let leave = max(one, other);
    return vec2f(max(max(enter.x, enter.y), enter.z), min(min(leave.x, leave.y), leave.z));
}

// A point in the shadow map: clip x and y, depth 0 to 1.
fn to_light(point: vec3f) -> vec3f {
    let place = vec4f(point, 1.0);
    return vec3f(dot(frame.light_rows[0], place), dot(frame.light_rows[1], place), dot(frame.light_rows[2], place));
}

const shadow_size = 1024.0; // texels; WEIR_SHADOW_SIZE

fn light_texel(light: vec3f) -> vec2f {
    return (light.xy * vec2f(0.5, -0.5) + 0.5) * shadow_size;
}

const sun = vec3f(-0.3496, 0.8591, 0.3737); // towards the light; frame.c: light_direction
const sunlight = vec3f(1.38, 1.24, 1.06);    // linear light of a white surface that faces it

// Linear light as a picture shows it: what is too bright for it comes near to white slowly.
fn tempered(light: vec3f) -> vec3f {
    let over = max(light - 0.5, vec3f(0.0));
    return min(light, vec3f(0.5)) + 0.5 * (1.0 - exp(-2.0 * over));
}

fn exposed(light: vec3f) -> vec3f {
    return to_srgb(tempered(light));
}

// Noise without steps, 0 to 1, one bump per unit.
fn smooth_noise(place: vec2f) -> f32 {
    let corner = floor(place);
    let part = fract(place);
    let share = part * part * (3.0 - 2.0 * part);
    let cell = vec2u(vec2i(corner) + 32768);
    let low = mix(pixel_noise(cell), pixel_noise(cell + vec2u(1u, 0u)), share.x);
    let high = mix(pixel_noise(cell + vec2u(0u, 1u)), pixel_noise(cell + 1u), share.x);
    return mix(low, high, share.y);
}

const glow_side = vec2f(-0.50, -0.866); // of the horizon, x and z

// Linear light of the sky, `direction` upwards: an evening, deep blue above and golden at one side of the horizon, with
// thin clouds.
fn sky(direction: vec3f) -> vec3f {
    let height = max(direction.y, 0.0);
    let flat = direction.xz * inverseSqrt(max(dot(direction.xz, direction.xz), 1e-6));
    let side = 0.5 + 0.5 * dot(flat, glow_side);
    let glow = side * side * side;
    var light = mix(vec3f(0.026, 0.072, 0.185), mix(vec3f(0.125, 0.25, 0.46), vec3f(0.25, 0.36, 0.50), glow), exp(-3.6 * height));
    light += vec3f(0.62, 0.33, 0.16) * (0.06 + 0.94 * glow) * exp(-7.0 * height);
    // Clouds on a ceiling, long across the glow; far ones melt into the haze.
    let place = direction.xz / (height + 0.10);
    let along = vec2f(dot(place, vec2f(-glow_side.y, glow_side.x)), 2.6 * dot(place, glow_side));
    let cloud = 0.62 * smooth_noise(0.75 * along + 7.3) + 0.38 * smooth_noise(1.9 * along + 3.1);
    light += mix(vec3f(0.19, 0.24, 0.34), vec3f(0.72, 0.44, 0.30), glow * exp(-3.0 * height))
        * (smoothstep(0.48, 0.85, cloud) * smoothstep(0.02, 0.22, height));
    let from_sun = max(dot(direction, sun), 0.0);
    return light + sunlight * (0.30 * pow(from_sun, 14.0) + 2.4 * smoothstep(0.978, 0.992, from_sun));
}

const floor_tone = vec3f(0.038, 0.056, 0.086); // of the light on it

// The floor's share of the light that comes from the sky as from a polished stone, seen along `direction`; far off it melts
// into the sky.
fn floor_gloss(direction: vec3f) -> f32 {
    let flat = 1.0 - clamp(-direction.y, 0.0, 1.0);
    return 0.012 + 0.45 * pow(flat, 48.0) + 0.538 * pow(flat, 200.0);
}

// Linear light of what lies around, in a direction: the sky, the floor far away.
fn surroundings(direction: vec3f) -> vec3f {
    let up = vec3f(direction.x, abs(direction.y), direction.z);
    let light = sky(up);
    if direction.y >= 0.0 { return light; }
    return mix(floor_tone * 0.8, light, floor_gloss(direction));
}
