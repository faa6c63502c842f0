// What a particle is, and its colour. Groups: src/core/world.h.

const FLUID = 0u;
const WALL = 1u;
const BODY = 2u;
const HIDDEN = 3u;

const group_inlet = 0x40000000u;
const group_empty = 0x7fffffffu;

// A wall that is not drawn.
fn is_hidden(group: u32) -> bool {
    let solid = group - 1u;
    return solid < 128u && ((frame.hidden[solid / 32u] >> (solid % 32u)) & 1u) != 0u;
}

fn particle_kind(particle: u32) -> u32 {
    let group = particle_group(particle);
    if group == group_empty { return HIDDEN; }
    if group == 0u || group >= group_inlet { return FLUID; }
    if frame.shapes != 0u { return HIDDEN; } // solids.wgsl draws it
    if is_hidden(group) { return HIDDEN; }
    return select(WALL, BODY, group - 1u >= frame.first_body);
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

// sRGB.
fn particle_color(particle: u32, kind: u32) -> vec3f {
    if kind == FLUID { return color_map(color_value(particle)); }
    return solid_color(particle_group(particle) - 1u);
}
