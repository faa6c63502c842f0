// flat_solids: walls and bodies in 2D as the shapes that they are, with a bevelled edge and a shade on what is around.
// in:  frame, shapes, solid_state, edges
// out: premultiplied colour
// One instance per shape; the fragment measures its distance from the shape's edge in the solid's own axes.

// WeirFlatShape (src/render/flat_shape.h), in three vectors: bounds; kind, solid, first and number of its edges; width
// of the wall around it or 0, whether it moves.
@group(1) @binding(0) var<storage, read> shapes: array<vec4f>;
@group(2) @binding(0) var<uniform> edges: array<vec4f, 2048>; // both ends of each, m from the reference point

const BOX = 1u; // WeirShapeKind; else a polygon
const BALL = 2u;
const shade_width = 9.0; // times frame.line_scale

struct Patch {
    @builtin(position) place: vec4f,
    @location(0) local: vec2f, // from the reference point in the solid's axes, m
    @location(1) @interpolate(flat) bounds: vec4f,
    @location(2) @interpolate(flat) shape: vec4u, // kind, first edge, number of edges, 1 if it moves
    @location(3) @interpolate(flat) color: vec3f,
    @location(4) @interpolate(flat) turn: vec3f, // cosine, sine; width of the wall around it, m
}

@vertex
fn flat_solids_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) index: u32) -> Patch {
    let about = bitcast<vec4u>(shapes[3u * index + 1u]);
    let more = shapes[3u * index + 2u];
    var patch_now: Patch;
    patch_now.bounds = shapes[3u * index];
    patch_now.shape = vec4u(about.x, about.zw, bitcast<u32>(more.y));
    patch_now.color = solid_color(about.y);
    let state = solid_state[about.y];
    patch_now.turn = vec3f(rotate(state.orientation, vec3f(1.0, 0.0, 0.0)).xy, more.x);
    let reach = more.x + (shade_width * frame.line_scale + 1.0) / frame.pixels_per_meter;
    let half_size = 0.5 * (patch_now.bounds.zw - patch_now.bounds.xy) + reach;
    patch_now.local = 0.5 * (patch_now.bounds.xy + patch_now.bounds.zw) + square_corner(vertex) * half_size;
    let point = state.position.xyz + rotate(state.orientation, vec3f(patch_now.local, 0.0));
    patch_now.place = to_clip(to_pixels(point.xy));
    return patch_now;
}

// Signed distance from the edge, negative inside, and the direction in which it grows.
fn from_box(place: vec2f, half_size: vec2f) -> vec3f {
    let beyond = abs(place) - half_size;
    let side = select(vec2f(-1.0), vec2f(1.0), place >= vec2f(0.0));
    if all(beyond > vec2f(0.0)) {
        let distance = length(beyond);
        return vec3f(distance, side * beyond / distance);
    }
    if beyond.x > beyond.y { return vec3f(beyond.x, side.x, 0.0); }
    return vec3f(beyond.y, 0.0, side.y);
}

fn from_ball(place: vec2f, radius: f32) -> vec3f {
    let away = length(place);
    return vec3f(away - radius, place / max(away, 1e-9));
}

// The nearest edge tells how far; how many edges lie to the right tells on which side.
fn from_polygon(place: vec2f, first: u32, count: u32) -> vec3f {
    var nearest = vec2f(1e9);
    var inside = false;
    for (var k = first; k < first + count; k++) {
        let start = edges[k].xy;
        let way = edges[k].zw - start;
        let offset = place - start;
        let along = clamp(dot(offset, way) / dot(way, way), 0.0, 1.0);
        let away = offset - along * way;
        if dot(away, away) < dot(nearest, nearest) { nearest = away; }
        if (offset.y < 0.0) != (offset.y < way.y) && offset.x < way.x * offset.y / way.y { inside = !inside; }
    }
    let distance = length(nearest);
    let sign = select(1.0, -1.0, inside);
    return vec3f(sign * distance, sign * nearest / max(distance, 1e-9));
}

fn from_edge(found: Patch) -> vec3f {
    let place = found.local - 0.5 * (found.bounds.xy + found.bounds.zw);
    let half_size = 0.5 * (found.bounds.zw - found.bounds.xy);
    if found.shape.x == BOX { return from_box(place, half_size); }
    if found.shape.x == BALL { return from_ball(place, half_size.x); }
    return from_polygon(found.local, found.shape.y, found.shape.z);
}

// Darker in two quarters of what is round, which shows how it turns.
fn mark(found: Patch) -> f32 {
    if found.shape.x != BALL || found.shape.w == 0u { return 1.0; }
    let place = (found.local - 0.5 * (found.bounds.xy + found.bounds.zw)) * frame.pixels_per_meter;
    let half_plane = clamp(place + 0.5, vec2f(0.0), vec2f(1.0));
    return mix(1.0, 0.86, half_plane.x + half_plane.y - 2.0 * half_plane.x * half_plane.y);
}

@fragment
fn flat_solids_fragment(found: Patch) -> @location(0) vec4f {
    let edge = from_edge(found);
    let turn = found.turn.xy;
    var outward = vec2f(turn.x * edge.y - turn.y * edge.z, turn.y * edge.y + turn.x * edge.z);
    var distance = edge.x * frame.pixels_per_meter;
    let band = found.turn.z * frame.pixels_per_meter;
    var thick = 0.5 * min(found.bounds.z - found.bounds.x, found.bounds.w - found.bounds.y) * frame.pixels_per_meter;
    if band > 0.0 { // the wall is around the shape
        let inner = distance < 0.5 * band;
        distance = select(distance - band, -distance, inner);
        outward = select(outward, -outward, inner);
        thick = 0.5 * band;
    }
    var cover = clamp(0.5 - distance, 0.0, 1.0);
    if found.shape.w == 0u { cover *= clamp(0.5 - domain_distance(found.place.xy), 0.0, 1.0); }

    // Light from above left.
    let bevel_width = clamp(0.3 * thick, 1.0, 7.0 * frame.line_scale);
    let bevel = 1.0 - smoothstep(0.0, 1.0, -distance / bevel_width);
    let lit = dot(outward, normalize(vec2f(-0.5, 0.9)));
    let rim = clamp(1.0 + (distance + 0.5) / (1.2 * frame.line_scale), 0.0, 1.0);
    // Its middle is a little darker than its edge.
    let core = 1.0 - exp(min(distance, 0.0) / (28.0 * frame.line_scale));
    var color = found.color * mark(found) * (1.0 - 0.16 * core);
    color *= 1.0 + bevel * (0.24 * lit - 0.06) - rim * (0.22 - 0.12 * lit);
    let away = clamp(1.0 - distance / (shade_width * frame.line_scale), 0.0, 1.0);
    let shade = 0.34 * away * away * away;
    return vec4f(to_target(clamp(color, vec3f(0.0), vec3f(1.0))) * cover, cover + shade * (1.0 - cover));
}
