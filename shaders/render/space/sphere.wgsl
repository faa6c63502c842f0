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

// `ray` has length 1.
fn hit_sphere(ray: vec3f, center: vec3f, radius: f32) -> Hit {
    let along = dot(ray, center);
    let miss = length(center - ray * along);
    return Hit(along, miss, sqrt(max(radius * radius - miss * miss, 0.0)));
}
