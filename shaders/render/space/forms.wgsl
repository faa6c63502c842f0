// Shared by the effects that follow rays: the shapes of walls and bodies, where the solver has them now, met by a ray.

// WeirForm (src/render/shape.h).
struct Form {
    middle: vec3f, // from the solid's reference point, m
    reach: f32,    // from there
    size: vec3f,   // half of a box; of a cylinder radius and half length; a ball's radius
    kind: u32,     // WeirShapeKind
    axis: vec3f,   // of a cylinder
    solid: u32,
    across: vec3f,
    first: u32,    // corners of a mesh
    last: u32,
}
@group(1) @binding(2) var<storage, read> forms: array<Form>; // one of reach 0 where there are none

const BOX = 1u;
const BALL = 2u;
const CYLINDER = 3u;
const dark_tone = 0.80; // shape.c

// Where a ray meets a solid. A ray that begins within one meets it at once.
struct Meeting {
    way: f32, // m
    normal: vec3f,
    tone: f32,    // of its colour; 0: it meets none
    solid: u32,
    veiled: bool, // it passes a mesh of too many triangles to be asked
}

// From where to where a ray is within a convex form, in the form's own axes, and the normal where it enters.
struct Span {
    enter: f32,
    leave: f32,
    normal: vec3f,
    tone: f32,
}

fn no_span() -> Span {
    return Span(1e9, -1e9, vec3f(0.0), 1.0);
}

// No component is zero, so that one can divide by it.
fn divisor(v: vec3f) -> vec3f {
    return select(v, vec3f(1e-6), abs(v) < vec3f(1e-6));
}

fn box_span(start: vec3f, ray: vec3f, size: vec3f) -> Span {
    let inverse = 1.0 / divisor(ray);
    let near = -start * inverse - abs(inverse) * size;
    let far = -start * inverse + abs(inverse) * size;
    let enter = max(max(near.x, near.y), near.z);
    let normal = -sign(ray) * vec3f(near >= vec3f(enter));
    return Span(enter, min(min(far.x, far.y), far.z), normal, 1.0);
}

// Of eight sectors around an axis, in turn positive and negative.
fn sector(place: vec2f) -> f32 {
    return place.x * place.y * (place.x * place.x - place.y * place.y);
}

fn ball_span(start: vec3f, ray: vec3f, radius: f32) -> Span {
    let along = -dot(start, ray);
    let square = radius * radius - dot(start, start) + along * along;
    if square < 0.0 { return no_span(); }
    let half = sqrt(square);
    let place = start + ray * (along - half);
    let tone = select(1.0, dark_tone, sector(place.xz) * place.y < 0.0);
    return Span(along - half, along + half, place / radius, tone);
}

// Its axis is y.
fn cylinder_span(start: vec3f, ray: vec3f, radius: f32, half_length: f32) -> Span {
    let a = max(dot(ray.xz, ray.xz), 1e-9);
    let b = -dot(start.xz, ray.xz) / a;
    let square = b * b - (dot(start.xz, start.xz) - radius * radius) / a;
    if square < 0.0 { return no_span(); }
    let half = sqrt(square);
    let slope = divisor(ray).y;
    let end = -start.y / slope - half_length / abs(slope);
    let enter = max(b - half, end);
    let place = start + ray * enter;
    var normal = vec3f(place.x, 0.0, place.z) / radius;
    if end > b - half { normal = vec3f(0.0, -sign(ray.y), 0.0); }
    let leave = min(b + half, -start.y / slope + half_length / abs(slope));
    return Span(enter, leave, normal, select(1.0, dark_tone, sector(place.xz) < 0.0));
}

// After Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997): of all triangles.
fn mesh_span(start: vec3f, ray: vec3f, first: u32, last: u32) -> Span {
    var found = no_span();
    for (var k = first; k < last; k += 3u) {
        let corner = corners[2u * k].xyz;
        let one = corners[2u * k + 2u].xyz - corner;
        let other = corners[2u * k + 4u].xyz - corner;
        let across = cross(ray, other);
        let scale = 1.0 / dot(one, across);
        let offset = start - corner;
        let u = scale * dot(offset, across);
        let turned = cross(offset, one);
        let v = scale * dot(ray, turned);
        let way = scale * dot(other, turned);
        if !(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && way > 0.0 && way < found.enter) { continue; }
        let normals = mat3x3f(corners[2u * k + 1u].xyz, corners[2u * k + 3u].xyz, corners[2u * k + 5u].xyz);
        found = Span(way, way, normals * vec3f(1.0 - u - v, u, v), 1.0);
    }
    return found;
}

fn form_span(k: u32, start: vec3f, ray: vec3f) -> Span {
    let from_middle = start - forms[k].middle;
    switch forms[k].kind {
        case BOX: { return box_span(from_middle, ray, forms[k].size); }
        case BALL: { return ball_span(from_middle, ray, forms[k].size.x); }
        case CYLINDER: {
            let across = forms[k].across;
            let axis = forms[k].axis;
            let axes = mat3x3f(across, axis, cross(axis, across));
            var span = cylinder_span(from_middle * axes, ray * axes, forms[k].size.x, forms[k].size.y);
            span.normal = axes * span.normal;
            return span;
        }
        default: { return mesh_span(start, ray, forms[k].first, forms[k].last); }
    }
}

// What a ray meets, the normal in the solid's own axes, if form `k` is there too, whose solid's reference point is at -`offset` from the ray's start.
fn nearer(before: Meeting, k: u32, solid: u32, offset: vec3f, ray: vec3f) -> Meeting {
    var met = before;
    if forms[k].kind > CYLINDER && forms[k].last == 0u {
        met.veiled = true;
        return met;
    }
    let back = solid_state[solid].orientation * vec4f(-1.0, -1.0, -1.0, 1.0);
    let span = form_span(k, rotate(back, offset), rotate(back, ray));
    let way = max(span.enter, 0.0);
    if span.leave < way || way >= met.way { return met; }
    met.way = way;
    met.normal = span.normal;
    met.tone = span.tone;
    met.solid = solid;
    return met;
}

// The first solid that a ray meets before `farthest`; if none, `way` is that.
fn meet_solids(start: vec3f, ray: vec3f, farthest: f32) -> Meeting {
    var met = Meeting(farthest, vec3f(0.0), 0.0, 0u, false);
    for (var k = 0u; k < arrayLength(&forms); k++) {
        let solid = forms[k].solid;
        let reach = forms[k].reach;
        let offset = start - solid_state[solid].position.xyz;
        let along = -dot(offset, ray);
        let away = offset + along * ray;
        if dot(away, away) < reach * reach && along > -reach && along < met.way + reach {
            met = nearer(met, k, solid, offset, ray);
        }
    }
    met.normal = rotate(solid_state[met.solid].orientation, met.normal);
    return met;
}
