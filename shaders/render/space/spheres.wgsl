// spheres: every particle of fluid, walls and bodies, or of water the drops that fly free, a shaded sphere, cut exactly by its ray in perspective.
// in:  frame, color_maps, particles, shown, shadow map
// out: sRGB, alpha the share of the pixel that is covered; depth

struct Sphere {
    @builtin(position) place: vec4f,
    @location(0) ray: vec3f,                          // view space, through the fragment
    @location(1) @interpolate(flat) center: vec4f,    // view space; radius
    @location(2) @interpolate(flat) color: vec4f,     // linear; how glossy
    @location(3) @interpolate(flat) light: f32,       // share of the light that arrives
    @location(4) @interpolate(flat) streak: vec4f,
}

// Light that arrives at a particle through the fluid between it and the light.
fn arriving_light(point: vec3f, radius: f32) -> f32 {
    let light = to_light(point);
    let texel = light_texel(light);
    var sum = 0.0;
    for (var k = 0u; k < 5u; k++) {
        let step = select(vec2f(0.0), (vec2f(f32(k & 1u), f32((k >> 1u) & 1u)) - 0.5) * 5.0, k < 4u);
        let at = clamp(texel + step, vec2f(0.0), vec2f(shadow_size - 1.0));
        let first = textureLoad(shadow_map, vec2u(at), 0);
        sum += exp(-frame.absorption * max((light.z - first) * frame.light_range - 1.5 * radius, 0.0));
    }
    return mix(0.30, 1.0, sum / 5.0);
}

@vertex
fn spheres_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) number: u32) -> Sphere {
    let particle = shown[number];
    var sphere: Sphere;
    sphere.place = vec4f(2.0, 2.0, 2.0, 1.0); // outside of the picture
    let kind = particle_kind(particle);
    if kind == HIDDEN { return sphere; }
    let drop = kind == FLUID && frame.water != 0u;
    if drop && drop_share(particle) < 0.05 { return sphere; } // of the surface
    let point = particle_position(particle);
    let center = to_view(point);
    var size = select(frame.solid_radius, frame.sphere_radius, kind == FLUID);
    if drop { size = drop_radius * frame.spacing * drop_share(particle); }
    if center.z - size < frame.near { return sphere; }
    let pixel = frame.pixel_size * length(center);
    let radius = max(size, 0.55 * pixel);
    sphere.streak = vec4f(1.0, 0.0, 0.0, 1.0);
    if drop { sphere.streak = streak(particle); }
    let across = streak_radius(radius, sphere.streak);
    sphere.ray = sphere_corner(center, across * sphere.streak.w, pixel, vertex);
    sphere.place = project(sphere.ray);
    sphere.center = vec4f(center, across);
    sphere.color = vec4f(to_linear(particle_color(particle, kind)), select(0.25, 1.0, kind == FLUID));
    if drop { sphere.color.a = of_drop; }
    sphere.light = arriving_light(point, size);
    return sphere;
}

const of_drop = 2.0; // its gloss

// Linear light of a drop of water: a ball of glass, in which what lies behind it is upside down, and a mirror at its rim.
fn drop_color(normal: vec3f, view: vec3f, light: f32) -> vec3f {
    let within = refract(-view, normal, 0.752);
    let behind = refract(within, 2.0 * dot(within, normal) * within - normal, 1.33);
    let lens = vec3f(0.16, 0.24, 0.28) + 0.7 * surroundings(behind);
    let shine = pow(max(dot(normal, normalize(sun + view)), 0.0), 90.0);
    let fresnel = 0.02 + 0.98 * pow(1.0 - clamp(dot(normal, view), 0.0, 1.0), 5.0);
    return lens * mix(0.6, 1.0, light) + fresnel * surroundings(reflect(-view, normal)) + 0.9 * shine * light;
}

struct Seen {
    @location(0) color: vec4f,
    @builtin(frag_depth) depth: f32,
}

@fragment
fn spheres_fragment(sphere: Sphere) -> Seen {
    let center = sphere.center.xyz;
    let radius = sphere.center.w;
    let ray = normalize(sphere.ray);
    let hit = hit_streak(ray, center, radius, sphere.streak);
    let pixel = frame.pixel_size * hit.along;
    let coverage = clamp((radius - hit.miss) / pixel + 0.5, 0.0, 1.0);
    if coverage <= 0.0 { discard; }
    let place = ray * (hit.along - hit.half);
    let normal = normalize(to_world(squeezed(squeezed(place - center, sphere.streak), sphere.streak)));
    var seen: Seen;
    var color: vec3f;
    if sphere.color.a == of_drop {
        color = drop_color(normal, -to_world(ray), sphere.light);
    } else {
        color = shade(sphere.color.rgb, sphere.color.a, normal, -to_world(ray), vec3f(sphere.light));
    }
    seen.color = vec4f(exposed(color), coverage);
    seen.depth = frame.near / place.z;
    return seen;
}
