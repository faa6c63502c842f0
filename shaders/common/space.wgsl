// Three dimensions: what particles are made of. common/plane.wgsl is the same in two.
alias Vector = vec3f;
alias Place = vec3i;
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
    let distance = row_distance((*walk).place.z, layer.x, constants.cell_layers);
    return distance * distance;
}

// liquid.wgsl
fn wrap_z(to: Place) -> Place {
    return vec3i(to.xy, wrap(to.z, constants.period_z));
}

fn short_way_z(way: Place) -> Place {
    return vec3i(way.xy, short_way(way.z, constants.period_z));
}
