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

// Linear light of the surroundings in a direction: a soft box of light above, dark blue below.
fn surroundings(direction: vec3f) -> vec3f {
    let height = direction.y;
    let sky = mix(vec3f(0.06, 0.10, 0.18), vec3f(0.42, 0.56, 0.78), smoothstep(-0.1, 0.95, height));
    let box = smoothstep(0.72, 0.95, height) * vec3f(0.75, 0.78, 0.80);
    return select(sky + box, vec3f(0.030, 0.042, 0.065) * (1.0 + max(height, -1.0)), height < -0.1);
}

// Behind everything, sRGB: a dark room with a glow at the height of the horizon.
fn backdrop(pixel: vec2f) -> vec3f {
    let uv = pixel / frame.size;
    let from_middle = (uv - vec2f(0.5, 0.46)) * vec2f(1.0, 1.15);
    let glow = exp(-4.2 * dot(from_middle, from_middle));
    return mix(vec3f(0.020, 0.028, 0.052), vec3f(0.086, 0.128, 0.205), glow);
}
