// Three dimensions: what particles are made of. common/plane.wgsl is the same in two.
alias Vector = vec3f;
alias Place = vec3i;
alias Axes = vec3<bool>;
const DIMENSION = 3u;

fn vector_of(v: vec4f) -> Vector {
    return v.xyz;
}

fn place_of(coordinate: vec4i) -> Place {
    return coordinate.xyz;
}

fn wide(v: Vector) -> vec3f {
    return v;
}

fn wide_place(p: Place) -> vec3i {
    return p;
}

// cells.wgsl: puts the particle into the image of a layer of cells, and squares the distance to it.
fn deeper(walk: ptr<function, Walk>, layer: vec2i) -> f32 {
    (*walk).place.z -= layer.y * i32(constants.period_z);
    let distance = row_distance((*walk).place.z, layer.x, LAYER_HEIGHT);
    return distance * distance;
}

// liquid.wgsl
fn wrap_z(to: Place) -> Place {
    return vec3i(to.xy, wrap(to.z, constants.period_z));
}

// 0 along axes that are not periodic.
fn periods() -> Place {
    return Place(vec3u(constants.period_x, constants.period_y, constants.period_z));
}

// drift.wgsl
fn periodic_axes() -> Axes {
    return Axes(PERIODIC_X, PERIODIC_Y, PERIODIC_Z);
}

fn nearest_z(way: Place) -> Place {
    return vec3i(way.xy, near_image(way.z, constants.period_z));
}

// neighbors.wgsl: an entry is the layer in two bits, and in 14 how far j lies behind the layer's first candidate, so what
// is added to j.
fn entry_shift(i: u32, first: u32, layer: u32) -> u32 {
    return (layer << 14u) - first;
}

fn run_fits(i: u32, first: u32, layer: u32, begin: u32, end: u32) -> bool {
    return layer < 3u && begin >= first && end - first <= 16384u;
}

// i's own: it adds nothing. 0xffff: none of the layers reaches so far.
fn own_entry(i: u32, header: vec4u) -> u32 {
    return select(select(select(0xffffu, 0x8000u | (i - header.w), i - header.w < 16384u),
                         0x4000u | (i - header.z), i - header.z < 16384u),
                  i - header.y, i - header.y < 16384u);
}

// What is to be added to the entries of each layer.
fn list_bases(start: u32, i: u32, header: vec4u) -> vec3u {
    return header.yzw + vec3u(start, start - 16384u, start - 32768u);
}

fn listed(bases: vec3u, entry: u32) -> u32 {
    return select(select(bases.y, bases.x, entry < 16384u), bases.z, entry >= 32768u) + entry;
}

// forces.wgsl: of two particles, quanta; and one more, so that it can be divided by.
fn distance_squared(offset: Vector) -> f32 {
    return fma(offset.x, offset.x, fma(offset.y, offset.y, fma(offset.z, offset.z, 1.0)));
}
