// caustics: sunlight that the water's surface bends, caught on the floor: each photon starts on a point of the surface with
// the light of its cell, is refracted there, absorbed on its way, and adds its light where it meets the floor. Sums keep the
// energy, which the ratio of areas (Wallace, "WebGL Water", 2011) keeps too. Photon maps in the light's view: Shah,
// Konttinen, Pattanaik, "Caustics mapping", IEEE TVCG 13 (2007).
// in:  frame, height
// out: sunlight of three colours, 1 where nothing bends it, added up

@group(2) @binding(0) var height_map: texture_2d<f32>;

struct Photon {
    @builtin(position) place: vec4f,
    @location(0) offset: vec2f, // from the middle, in cells
    @location(1) @interpolate(flat) light: vec3f,
}

const least_spread = 0.5;
const most_spread = 3.0;

// Beyond the sides the surface goes on as it is there: light comes in through the glass.
fn height_at(cell: vec2i) -> f32 {
    let at = clamp(cell, vec2i(0), vec2i(textureDimensions(height_map)) - 1);
    return textureLoad(height_map, at, 0).x;
}

struct Landing {
    foot: vec2f, // on the floor, m from the domain's low corner
    light: vec3f,
}

fn height_size() -> vec2f {
    return vec2f(textureDimensions(height_map));
}

fn cell_size() -> vec2f {
    return (frame.domain_max.xz - frame.domain_min.xz) / height_size();
}

// Where the light through a cell of the surface meets the floor.
fn landing(cell: vec2i) -> Landing {
    let height = height_at(cell);
    let rise = vec2f(height_at(cell + vec2i(1, 0)) - height_at(cell - vec2i(1, 0)),
                     height_at(cell + vec2i(0, 1)) - height_at(cell - vec2i(0, 1)));
    // Water stands level along the walls, where the sums know its height least.
    let from_wall = (0.5 * height_size() - abs(vec2f(cell) + 0.5 - 0.5 * height_size())) * cell_size();
    let slope = rise / (2.0 * cell_size()) * clamp(from_wall / (2.4 * frame.spacing) - 0.5, vec2f(0.0), vec2f(1.0));
    let normal = normalize(vec3f(-slope.x, 1.0, -slope.y));
    let ray = refract(-sun, normal, into_water);
    let way = height / max(-ray.y, 0.2);
    let facing = max(dot(sun, normal), 0.0) / (normal.y * sun.y);
    return Landing((vec2f(cell) + 0.5) * cell_size() + ray.xz * way, facing * water_left(way));
}

// A symmetric matrix whose eigenvalues keep to what the map can hold, as xx, xy, yy; and 1 / its determinant.
fn held(xx: f32, xy: f32, yy: f32) -> vec4f {
    let mean = 0.5 * (xx + yy);
    let half = 0.5 * (xx - yy);
    let spread = max(sqrt(half * half + xy * xy), 1e-6);
    let one = clamp(abs(mean + spread), least_spread, most_spread);
    let other = clamp(abs(mean - spread), least_spread, most_spread);
    let middle = 0.5 * (one + other);
    let turn = 0.5 * (one - other) / spread;
    return vec4f(middle + turn * half, turn * xy, middle - turn * half, 1.0 / (one * other));
}

@vertex
fn caustics_vertex(@builtin(vertex_index) vertex: u32, @builtin(instance_index) number: u32) -> Photon {
    let count = vec2u(frame.photon_columns, frame.photon_rows);
    let more = vec2i(count) - vec2i(height_size());
    // Towards the sun there are more cells than the floor has.
    let cell = vec2i(vec2u(number % count.x, number / count.x)) - select(vec2i(0), more, sun.xz < vec2f(0.0));
    let size = cell_size();
    let here = landing(cell);
    // The photon is as wide as its cell has become: how its neighbours' feet lie tells (ray differentials).
    let by_x = (landing(cell + vec2i(1, 0)).foot - landing(cell - vec2i(1, 0)).foot) / (2.0 * size.x);
    let by_y = (landing(cell + vec2i(0, 1)).foot - landing(cell - vec2i(0, 1)).foot) / (2.0 * size.y);
    let shape = held(by_x.x, 0.5 * (by_x.y + by_y.x), by_y.y);
    var photon: Photon;
    photon.offset = 1.5 * square_corner(vertex);
    photon.light = here.light * shape.w;
    let reach = photon.offset * size;
    let foot = here.foot + vec2f(dot(shape.xy, reach), dot(shape.yz, reach));
    let place = foot / (size * height_size()) * 2.0 - 1.0;
    photon.place = vec4f(place * vec2f(1.0, -1.0), 0.5, 1.0);
    return photon;
}

// Quadratic B-spline: photons that lie one cell apart add up to 1 everywhere.
fn spline(x: vec2f) -> vec2f {
    let t = abs(x);
    let edge = max(1.5 - t, vec2f(0.0));
    return select(0.5 * edge * edge, 0.75 - t * t, t < vec2f(0.5));
}

@fragment
fn caustics_fragment(photon: Photon) -> @location(0) vec4f {
    let share = spline(photon.offset);
    return vec4f(photon.light * (share.x * share.y), 1.0);
}
