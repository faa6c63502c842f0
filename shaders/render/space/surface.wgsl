// surface: where the eye meets the fluid first, as a union of spheres. The domain's sides cut it off like glass.
// in:  frame, particles, shown
// out: depth, negative where it is a side of the domain; shares of the pixel: water, such a side

struct Ball {
    @builtin(position) place: vec4f,
    @location(0) ray: vec3f,                       // view space, through the fragment
    @location(1) @interpolate(flat) center: vec4f, // view space; radius
    @location(2) @interpolate(flat) streak: vec4f,
}

@vertex
fn surface_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) number: u32) -> Ball {
    let particle = shown[number];
    var ball: Ball;
    ball.place = vec4f(2.0, 2.0, 2.0, 1.0); // outside of the picture
    if particle_kind(particle) != FLUID { return ball; }
    let center = to_view(particle_position(particle));
    let drop = drop_share(particle);
    if drop > 0.98 { return ball; } // spheres draws it
    let radius = max(surface_radius * frame.spacing * body_share(particle) * (1.0 - 0.5 * drop), 1.2 * frame.pixel_size * center.z);
    if center.z - 2.0 * radius < frame.near { return ball; }
    ball.streak = streak(particle);
    let across = streak_radius(radius, ball.streak);
    ball.ray = sphere_corner(center, across * ball.streak.w, 0.0, vertex);
    ball.place = project(ball.ray);
    ball.center = vec4f(center, across);
    return ball;
}

struct Found {
    @location(0) depth: vec4f,
    @builtin(frag_depth) test: f32,
}

@fragment
fn surface_fragment(ball: Ball) -> Found {
    let ray = normalize(ball.ray);
    let hit = hit_streak(ray, ball.center.xyz, ball.center.w, ball.streak);
    if hit.miss >= ball.center.w { discard; }
    let span = domain_span(to_world(ray));
    var first = hit.along - hit.half;
    if span.x > hit.along + hit.half || span.y < first { discard; }
    // Near enough to the side through which the eye looks in the water touches it.
    let touches = first - span.x < 0.45 * frame.spacing;
    first = max(select(first, span.x, touches), 0.0);
    let depth = frame.near / max(first * ray.z, frame.near);
    var found: Found;
    found.depth = vec4f(select(depth, -depth, touches), pack_shares(vec2f(1.0, f32(touches))), 0.0, 1.0);
    found.test = depth;
    return found;
}
