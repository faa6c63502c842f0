// spheres: every particle of fluid, walls and bodies, or of water the drops that fly free, a shaded sphere, cut exactly by its ray in perspective.
// in:  frame, color_maps, particles, shadow map
// out: sRGB, alpha the share of the pixel that is covered; depth

struct Sphere {
    @builtin(position) place: vec4f,
    @location(0) ray: vec3f,                          // view space, through the fragment
    @location(1) @interpolate(flat) center: vec4f,    // view space; radius
    @location(2) @interpolate(flat) color: vec4f,     // linear; how glossy
    @location(3) @interpolate(flat) light: f32,       // share of the light that arrives
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
fn spheres_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) particle: u32) -> Sphere {
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
    sphere.ray = sphere_corner(center, radius, pixel, vertex);
    sphere.place = project(sphere.ray);
    sphere.center = vec4f(center, radius);
    sphere.color = vec4f(to_linear(particle_color(particle, kind)), select(0.25, 1.0, kind == FLUID));
    if drop { sphere.color = vec4f(0.62, 0.74, 0.82, 1.6); }
    sphere.light = arriving_light(point, size);
    return sphere;
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
    let hit = hit_sphere(ray, center, radius);
    let pixel = frame.pixel_size * hit.along;
    let coverage = clamp((radius - hit.miss) / pixel + 0.5, 0.0, 1.0);
    if coverage <= 0.0 { discard; }
    let place = ray * (hit.along - hit.half);
    let normal = normalize(to_world(place - center));
    var seen: Seen;
    let color = shade(sphere.color.rgb, sphere.color.a, normal, -to_world(ray), sphere.light);
    seen.color = vec4f(to_srgb(color), coverage);
    seen.depth = frame.near / place.z;
    return seen;
}
