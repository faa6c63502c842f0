// What a particle of `wcsph` is (src/core/world.h), where the simulation stands, and the state of walls and bodies.
const GROUP_FLUID = 0u;
const GROUP_SOLID = 1u;          // + index of the solid
const GROUP_INLET = 0x40000000u; // + index of the emitter
const GROUP_EMPTY = 0x7FFFFFFFu;

fn is_solid(group: u32) -> bool {
    return group - GROUP_SOLID < GROUP_INLET - GROUP_SOLID;
}

// One of the copies' (particle_at()).
struct Particle {
    coordinate: vec4i, // place in quanta, group
    motion: vec4f,     // velocity, m/s; density less rest density, kg/m^3
}

// Free fluid, and an inlet's.
fn is_fluid(group: u32) -> bool {
    return group == GROUP_FLUID || (group >= GROUP_INLET && group != GROUP_EMPTY);
}

// WeirWcsphClock in src/gpu/wcsph.h: where the simulation stands, and the next step. Times are 64-bit counts of 2^-42 s, low
// word first: adding is exact.
struct Clock {
    steps_left: u32,
    running: u32,           // 1: a step follows;
    stepping: u32,          // 1: and one is under way in pass forces
    steps: u32,
    time: vec2u,            // at the end of the last step, or of the one under way;
    began: vec2u,           // at its begin
    dt: f32,                // s, of the last step, or of the one under way
    next_dt: f32,           // s, of the step after it; 0: it is not taken yet
    free_dt: f32,           // the same, if nothing shortens it
    max_speed: f32,         // m/s, of the fluid in the step before
    // Order and lists (common/neighbors.wgsl). Ways are sums of the steps' largest, in quanta, and may wrap around.
    side: u32,              // of the working copies, that sorts write and the next step reads;
    last_side: u32,         // that the last step read, or the one under way: it writes the other one
    sorting: u32,           // 1: the particles are sorted before the next step;
    listing: u32,           // 1: lists are made anew before it, and so they are after a sort
    stale: u32,             // 1: and so they are at the next chance;
    worn: u32,              // 1: and then the particles are sorted too, if it is one for that
    travelled: u32,         // up to that step's kick
    next_allowance: u32,
    noting: u32,            // which of the maxima it notes
    left: f32,              // s, from its end to `until`
    // Of the step under way, for all of its particles.
    flow_speed: f32,        // m/s, by which shifting goes
    due_excess: f32,        // kg/m^3, that flow and weight may cause
    diffusion: f32,         // s, delta h / c0 as far as it is stable
    unused: u32,
}

// What the threads of a step note together.
struct Maxima {
    speed2_bits: u32,       // largest squares of speed and acceleration, as bits: those of floats >= 0 have their order
    acceleration2_bits: u32,
    excess_bits: u32,       // largest amount of excess density
    finish2_bits: u32,      // squares of the longest ways since the kick, quanta: in the second half of the step's move,
    drift2_bits: u32,       // and in the first half of the next one's. Each by itself, for between them a call may end
    bad: u32,               // 1: it went wrong
    unused: array<u32, 26>, // a line of the caches for each
}

// From its square's bits to a way in whole quanta, not less; what is absurd is cut.
fn way_length(bits: u32) -> u32 {
    return select(0u, u32(min(ceil(sqrt(bitcast<f32>(bits))), 1e8)) + 1u, bits > 0u);
}

// No particle has come farther since the kick.
fn way_of(last: Maxima) -> u32 {
    return way_length(last.finish2_bits) + way_length(last.drift2_bits);
}

// WeirWcsphControl. No pass reads what another thread of it writes: steps take turns with three clocks and maxima. Pass forces finds its
// step prepared in its clock, prepares the next one's, and tells all other passes by `clock`; of the maxima it reads those of
// the step before, notes its own, and clears the next one's.
//
// What many threads add to while others read the rest lies apart: a line of the caches for each.
struct Control {
    until: vec2u,           // written by the host for a batch of steps: no step passes it;
    steps_asked: u32,       // and how many steps it may take
    restored: u32,          // 1: after a blow-up the last good state was put back
    starting: u32,          // 1: forces_read takes the maxima of a new state
    emitted: u32,
    solid_speed: f32,       // m/s, no particle of a solid moves faster; without surface_velocity
    bad_id: u32,            // of the particle in bad_slot
    bad_place: vec4i,       // its coordinate
    next_due: vec2u,        // time at which emitters may have a layer next
    sorted_at: u32,         // way when the particles were sorted;
    listed_at: u32,         // and when lists were made,
    allowance: u32,         // which may miss neighbours after so much more of it
    clock: Clock,
    unused: array<u32, 20>, // what follows begins at 256 bytes
    clocks: array<Clock, 3>,
    unused_too: array<u32, 18>, // at 640
    maxima: array<Maxima, 3>,
    bad_particles: u32,
    bad_step: u32,          // 0xffffffff: none
    bad_slot: u32,          // of the bad particles the first in the order of cells
    drained: u32,
    lost: u32,
}

// The same for passes in which all particles write at once.
struct SharedMaxima {
    speed2_bits: atomic<u32>,
    acceleration2_bits: atomic<u32>,
    excess_bits: atomic<u32>,
    finish2_bits: atomic<u32>,
    drift2_bits: atomic<u32>,
    bad: atomic<u32>,
    unused: array<u32, 26>,
}
struct SharedControl {
    until: vec2u,
    steps_asked: u32,
    restored: u32,
    starting: u32,
    emitted: u32,
    solid_speed: f32,
    bad_id: u32,
    bad_place: vec4i,
    next_due: vec2u,
    sorted_at: u32,
    listed_at: u32,
    allowance: u32,
    clock: Clock,
    unused: array<u32, 20>,
    clocks: array<Clock, 3>,
    unused_too: array<u32, 18>,
    maxima: array<SharedMaxima, 3>,
    bad_particles: atomic<u32>,
    bad_step: atomic<u32>,
    bad_slot: atomic<u32>,
    drained: atomic<u32>,
    lost: atomic<u32>,
}

// What a step leaves besides the particles.
struct StepEnd {
    sort_groups: array<vec4u, 2u * SORT_SIZES>, // sizes of the dispatches of the next sort, then those that they have if there is one
    density_rate: array<f32>,                   // of a batch's last step, for the next one's pass drift
}

// WeirSolid: what of a wall or body stays.
struct Solid {
    kind: u32,
    no_slip: u32,
    first: u32,
    count: u32,
    motion_first: u32,
    motion_count: u32,
    motion_repeats: u32,
    mass: f32,
    surface_velocity: vec4f,
    freedom: vec4f,
    angular_freedom: vec4f,
    inverse_inertia: array<vec4f, 3>,
    position: vec4f,
    velocity: vec4f,
    angular_velocity: vec4f,
}
const SOLID_FIXED = 0u;
const SOLID_DRIVEN = 1u;
const SOLID_FREE = 2u;

// WeirSolidState. Three per solid in `solid_state`: NOW where its particles are; NEW as pass solids leaves it in the middle
// of the step, with new velocities; SAVED as NOW was before that.
struct SolidState {
    position: vec4f,
    orientation: vec4f,
    velocity: vec4f,
    angular_velocity: vec4f,
    acceleration: vec4f,
    angular_acceleration: vec4f,
    force: vec4f,
    torque: vec4f,
    rest: vec4f,
}
const NOW = 0u;
const NEW = SOLID_COUNT;
const SAVED = 2u * SOLID_COUNT;

// A particle of a wall or body, by id: where it was at the start, m from its solid's reference point, and its slot.
struct SolidParticle {
    start: vec3f,
    slot: u32,
}

// WeirEmitter and WeirDrain. Before the drains stand the boxes around groups of them.
struct Emitter {
    point_first: u32,
    point_count: u32,
    speed: f32,
    start: f32,
    stop: f32,
    unused_x: f32,
    unused_y: f32,
    unused_z: f32,
    direction: vec4f,
    center: vec4f,
}
struct Drain {
    low: vec4f,
    high: vec4f,
}

@group(0) @binding(BINDING_solid_table) var<uniform> solid_table: array<Solid, SOLID_COUNT>;
@group(0) @binding(BINDING_emitters) var<uniform> emitters: array<Emitter, EMITTERS>;
@group(0) @binding(BINDING_drains) var<uniform> drains: array<Drain, DRAINS>;

// Of control: nothing may run over the last good state.
fn is_well(bad_step: u32, restored: u32) -> bool {
    return bad_step == 0xffffffffu || restored == 1u;
}

// Where in `coordinate` and `motion` a working copy of the particles begins; before both lies the state between calls.
fn side_start(side: u32) -> u32 {
    return (1u + side) * constants.particle_count;
}

// Tests the exponent's bits: WGSL compilers may assume that no value is infinite or NaN.
fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}
