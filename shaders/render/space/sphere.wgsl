// Shared by the effects that draw particles as spheres, each cut out of a square by the fragment's own ray: exact in
// perspective.

// Corner of a square across the line of sight that holds the outline of a sphere and `margin` more, in view space.
fn sphere_corner(center: vec3f, radius: f32, margin: f32, vertex: u32) -> vec3f {
    let distance = length(center);
    let toward = center / distance;
    let across = normalize(cross(toward, vec3f(0.0, 1.0, 0.0)));
    let reach = radius * inverseSqrt(max(1.0 - radius * radius / (distance * distance), 1e-3)) + margin;
    let corner = square_corner(vertex) * reach;
    return center + across * corner.x + cross(across, toward) * corner.y;
}

struct Hit {
    along: f32, // of the ray to the point nearest to the centre
    miss: f32,  // of the ray from the centre
    half: f32,  // length of the ray inside of the sphere, halved; 0 outside
}

// Torn water flies in streaks: the way along which a particle is drawn longer, as a unit vector of view space, and how many
// times as long as it is wide.
fn streak(particle: u32) -> vec4f {
    let velocity = particle_velocity(particle);
    let speed = length(velocity);
    let torn = 1.0 - smoothstep(0.20, 0.50, crowd[particle].x);
    let longer = 1.0 + 1.4 * torn * smoothstep(0.005, 0.06, speed / frame.sound_speed);
    let along = velocity / max(speed, 1e-6);
    return vec4f(dot(along, frame.right.xyz), dot(along, frame.up.xyz), dot(along, frame.ahead.xyz), longer);
}

// `streak`: a direction, and how many times as long as wide it is that way. Squeezed to a sphere of the same width:
fn squeezed(way: vec3f, streak: vec4f) -> vec3f {
    return way + streak.xyz * (dot(way, streak.xyz) * (1.0 / streak.w - 1.0));
}

// Across, for the same volume.
fn streak_radius(radius: f32, streak: vec4f) -> f32 {
    return radius * pow(streak.w, -0.3333333);
}

// `ray` has length 1; `miss` is that of the sphere.
fn hit_streak(ray: vec3f, center: vec3f, radius: f32, streak: vec4f) -> Hit {
    if streak.w == 1.0 { // most are round
        let along = dot(ray, center);
        let miss = length(center - ray * along);
        return Hit(along, miss, sqrt(max(radius * radius - miss * miss, 0.0)));
    }
    let way = squeezed(ray, streak);
    let middle = squeezed(center, streak);
    let along = dot(way, middle) / dot(way, way);
    let miss = length(middle - way * along);
    return Hit(along, miss, sqrt(max(radius * radius - miss * miss, 0.0)) / length(way));
}
