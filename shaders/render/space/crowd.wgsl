// Shared by the passes that count particles: the grid, two spacings wide. A domain with more cells than there are is
// folded onto them.

@group(2) @binding(0) var<storage, read_write> cells: array<atomic<i32>>; // 4 each: particles, their motion
@group(2) @binding(1) var<storage, read_write> crowd: array<vec2f>; // per particle: how many others, how much else they move
@group(2) @binding(2) var<storage, read_write> shown: array<u32>;  // numbers of those that can be seen
@group(2) @binding(3) var<storage, read_write> draw: array<atomic<u32>, 4>; // [1]: how many

const row_length = 65535u * 256u; // invocations of one row of workgroups; crowd.c
const cell_unit = 256.0;          // of a particle, in a cell
const motion_unit = 16384.0;      // of a particle at the speed of sound
const particles_per_cell = 8.0;   // where the fluid is

// Of a particle, in cells.
fn cell_place(particle: u32) -> vec3f {
    return max((particle_position(particle) - frame.domain_min.xyz) / (2.0 * frame.spacing) + 1.0, vec3f(0.0));
}

fn corner_offset(corner: u32) -> vec3u {
    return vec3u(corner & 1u, (corner >> 1u) & 1u, corner >> 2u);
}

fn cell_index(place: vec3f, corner: u32) -> u32 {
    let size = vec3u(ceil((frame.domain_max.xyz - frame.domain_min.xyz) / (2.0 * frame.spacing))) + 3u;
    let cell = vec3u(place) + corner_offset(corner);
    return 4u * ((cell.x + size.x * (cell.y + size.y * cell.z)) % (arrayLength(&cells) / 4u));
}

// Share of a particle that a cell's corner gets: linear along each axis.
fn corner_share(place: vec3f, corner: u32) -> f32 {
    let share = select(1.0 - fract(place), fract(place), corner_offset(corner) == vec3u(1u));
    return share.x * share.y * share.z;
}
