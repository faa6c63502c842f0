// Shared by the effects in 3D that draw walls and bodies as shapes: their corners, where the solver has them now.

// WeirCorner (src/render/shape.h), in two vectors: place from the reference point, solid; normal, tone.
@group(1) @binding(0) var<storage, read> corners: array<vec4f>;

struct Corner {
    point: vec3f, // m
    normal: vec3f,
    solid: u32,
    tone: f32,
}

fn corner_now(index: u32) -> Corner {
    let place = corners[2u * index];
    let look = corners[2u * index + 1u];
    let solid = bitcast<u32>(place.w);
    let q = solid_state[solid].orientation;
    return Corner(solid_state[solid].position.xyz + rotate(q, place.xyz), rotate(q, look.xyz), solid, look.w);
}
