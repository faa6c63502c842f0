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
