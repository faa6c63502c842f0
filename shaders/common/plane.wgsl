// Two dimensions: what particles are made of. common/space.wgsl is the same in three.
alias Vector = vec2f;
alias Place = vec2i;
alias Axes = vec2<bool>;
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

// 0 along axes that are not periodic.
fn periods() -> Place {
    return Place(vec2u(constants.period_x, constants.period_y));
}

// drift.wgsl
fn periodic_axes() -> Axes {
    return Axes(PERIODIC_X, PERIODIC_Y);
}

fn nearest_z(way: Place) -> Place {
    return way;
}

// neighbors.wgsl: an entry is j - i + 32768, so what is added to j.
fn entry_shift(i: u32, first: u32, layer: u32) -> u32 {
    return 32768u - i;
}

fn run_fits(i: u32, first: u32, layer: u32, begin: u32, end: u32) -> bool {
    return i32(begin) - i32(i) >= -32768 && i32(end) - i32(i) < 32768;
}

// i's own: it adds nothing.
fn own_entry(i: u32, header: vec4u) -> u32 {
    return 32768u;
}

// What is to be added to entries.
fn list_bases(start: u32, i: u32, header: vec4u) -> u32 {
    return start + i - 32768u;
}

fn listed(base: u32, entry: u32) -> u32 {
    return base + entry;
}

// forces.wgsl: of two particles, quanta; and one more, so that it can be divided by.
fn distance_squared(offset: Vector) -> f32 {
    return fma(offset.x, offset.x, fma(offset.y, offset.y, 1.0));
}
