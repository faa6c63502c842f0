// What a particle is, and its colour. Groups: src/core/world.h.

const FLUID = 0u;
const WALL = 1u;
const BODY = 2u;
const HIDDEN = 3u;

const group_inlet = 0x40000000u;
const group_empty = 0x7fffffffu;

fn particle_kind(particle: u32) -> u32 {
    let group = particle_group(particle);
    if group == group_empty { return HIDDEN; }
    if group == 0u || group >= group_inlet { return FLUID; }
    let solid = group - 1u;
    if solid < 128u && ((frame.hidden[solid / 32u] >> (solid % 32u)) & 1u) != 0u { return HIDDEN; }
    return select(WALL, BODY, solid >= frame.first_body);
}

// Place of a particle on the colour map, 0 to 1.
fn color_value(particle: u32) -> f32 {
    var value: f32;
    switch frame.color_by {
        case 0u: { value = particle_speed(particle); }
        case 1u: { value = particle_density(particle); }
        case 2u: { value = (particle_density(particle) - frame.rest_density) / frame.rest_density; }
        default: { value = particle_pressure(particle); }
    }
    return clamp((value - frame.color_min) * frame.color_scale, 0.0, 1.0);
}

const wall_color = vec3f(0.34, 0.40, 0.50);

// sRGB. Bodies take warm colours in turn, which no colour map has beside each other.
fn particle_color(particle: u32, kind: u32) -> vec3f {
    if kind == FLUID { return color_map(color_value(particle)); }
    if kind == WALL { return wall_color; }
    switch (particle_group(particle) - 1u - frame.first_body) % 4u {
        case 0u: { return vec3f(0.93, 0.66, 0.36); }
        case 1u: { return vec3f(0.88, 0.47, 0.38); }
        case 2u: { return vec3f(0.60, 0.72, 0.46); }
        default: { return vec3f(0.78, 0.55, 0.70); }
    }
}
