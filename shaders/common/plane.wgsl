// Two dimensions: what particles are made of. common/space.wgsl is the same in three.
alias Vector = vec2f;
alias Place = vec2i;
const DIMENSION = 2u;

fn vector_of(v: vec4f) -> Vector {
    return v.xy;
}

fn place_of(coordinate: vec4i) -> Place {
    return coordinate.xy;
}

fn wide(v: Vector) -> vec3f {
    return vec3f(v, 0.0);
}

fn wide_place(p: Place) -> vec3i {
    return vec3i(p, 0);
}

// cells.wgsl: the square of the distance to a layer of cells; there is but one.
fn deeper(walk: ptr<function, Walk>, layer: vec2i) -> f32 {
    return 0.0;
}

// liquid.wgsl
fn wrap_z(to: Place) -> Place {
    return to;
}

fn short_way_z(way: Place) -> Place {
    return way;
}

fn nearest_z(way: Place) -> Place {
    return way;
}

// neighbors.wgsl: an entry is j - i in 16 bits.
const NO_ENTRY = 0xffffffffu;

fn entry_of(i: u32, header: vec4u, layer: u32, j: u32) -> u32 {
    let way = i32(j) - i32(i);
    return select(NO_ENTRY, u32(way) & 0xffffu, way == ((way << 16u) >> 16u));
}

fn listed(i: u32, header: vec4u, entry: u32) -> u32 {
    return u32(i32(i) + (i32(entry << 16u) >> 16u));
}
