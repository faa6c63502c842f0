// Acceleration from pressure, viscosity and body forces, with the kick: new velocities; shifting velocity; drho/dt; the
// fluid's force on the particles of free bodies. The largest speed and acceleration of the fluid. Of fluid also the
// second half of the step's move and the first half of the next one's (common/finish.wgsl).
//
// Distances are summed in quanta, and what scales a whole sum is applied at its end. Formulas: docs/wcsph.md.
//
// With ONE_PASS it is the whole step: the clock moves on here (common/start.wgsl), pressure at walls is found pair by pair, and
// solids see the fluid for the next step's friction. Otherwise walls, or time_step, comes before.
// With FORCES_READ, for pass forces_read: kicked is acceleration and pressure, and of fluid nothing else changes.
//
// in:  coordinate, motion, cell_start, neighbor_list, solid_state, control
// out: coordinate, motion: the other working copy, or the state if that is to be sorted or no step follows; step_end.
//      kicked, of particles of free bodies: force of contact, and how much that would move, kg; its second copy: force of the
//      fluid, and how much of it is around, kg. control: maxima, and the next step's clock
const OWN_CLOCK = FORCES_READ || ONE_PASS;

// Of a step: which of the clocks and maxima are its own.
var<private> turn: u32;

// What sums need they find here, and what comes after them by now(): a compiler that saw the same value before and after would keep
// it in a register meanwhile, and those are scarce.
fn reading_start() -> u32 {
    if FORCES_READ {
        return side_start(control.clock.side); // a read is between two steps
    }
    if ONE_PASS {
        return side_start(control.clocks[turn].last_side);
    }
    return side_start(control.clock.last_side);
}

fn step_dt() -> f32 {
    if ONE_PASS && !FORCES_READ {
        return control.clocks[turn].dt;
    }
    return control.clock.dt;
}

@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;

struct Sums {
    pressure: Vector,   // of p_j: see summed_pressure()
    gradient: Vector,   // of 1
    viscous: Vector,    // of (v . x) / r^2 x, between fluid
    laminar: Vector,    // of v, between fluid
    friction: Vector,   // of v, between fluid and no-slip solids
    clustering: Vector, // of (W / kernel_factor)^4
    surface: f32,
    filling: f32,       // of W
    divergence: f32,    // of v . x, where the particles are at the end of the step
    laplacian: f32,     // of (1 - r / R) (p_j - p_i), between fluid
    moment: Vector,     // of (1 - r / R) x, between fluid
    solid_square: f32,  // square of the least distance of fluid and a solid, quanta
}

fn no_sums() -> Sums {
    var sums: Sums;
    sums.solid_square = 1e30;
    return sums;
}

// Spray forgets tension, and density follows the real volume: docs/wcsph.md.
const FULL_SUPPORT = 0.98; // shares of the surface number in the bulk
const VOLUME_TIME = 1000.0; // h / c0
const SPRAY_LIMIT = 0.5;    // shares of the surface number in the bulk
const RAGGED_LIMIT = 0.75;
const RAGGED_TIME = 10.0;   // h / c0
const CROWDED_LIMIT = 1.1;  // of the lattice's filling
const CROWDED_TIME = 10.0;  // h / c0

// 1 if friction acts on it.
fn sticks(group: u32) -> f32 {
    if SLIP_SOLIDS && is_solid(group) {
        return f32(solid_table[min(group - GROUP_SOLID, SOLID_COUNT - 1u)].no_slip);
    }
    return 1.0;
}

// The particle that neighbours act on.
struct Own {
    velocity: Vector,
    solid: bool, // one of a solid, on which only fluid acts
    stick: f32,
    inverse_density: f32,
    pressure: f32,
    excess: f32, // that stands for it in a linear equation of state
    second_half: f32, // quanta per m/s: how far a velocity moves a particle in the second half of the step;
    second_half_in_supports: f32, // 3/2 of that, in supports
}

// Whether forces on solid particles are asked for.
const ON_SOLIDS = HAS_SOLIDS && (FREE_SOLIDS || FORCES_READ);

fn own_of(own: vec4i, own_motion: vec4f) -> Own {
    let second_half = 0.5 * step_dt() * constants.inverse_quantum;
    return Own(vector_of(own_motion), ON_SOLIDS && is_solid(u32(own.w)), sticks(u32(own.w)),
               1.0 / (parameters.rest_density + own_motion.w), summed_pressure(own_motion.w, true), linear_excess(own_motion.w),
               second_half, 1.5 * second_half * constants.inverse_support);
}

fn added(a: Sums, b: Sums) -> Sums {
    return Sums(a.pressure + b.pressure, a.gradient + b.gradient, a.viscous + b.viscous, a.laminar + b.laminar,
                a.friction + b.friction, a.clustering + b.clustering, a.surface + b.surface, a.filling + b.filling,
                a.divergence + b.divergence, a.laplacian + b.laplacian, a.moment + b.moment,
                min(a.solid_square, b.solid_square));
}

var<workgroup> moved: u32; // way since lists were made

fn way_since_lists() -> u32 {
    if OWN_CLOCK {
        return moved;
    }
    return control.clock.travelled - control.listed_at;
}

// Where the equation of state is linear, the excess density is summed for the pressure, until with_pressure(): an instruction
// less per pair. (Walks in 3D took 6 % longer by it, at 170 neighbours on an H100.)
const SUMS_EXCESS = !TAIT && (LISTS || DIMENSION == 2u);

fn summed_pressure(excess: f32, fluid: bool) -> f32 {
    if SUMS_EXCESS {
        return excess;
    }
    return select(linear_pressure(excess), pressure_of(excess), fluid);
}

fn with_pressure(summed: Sums) -> Sums {
    var sums = summed;
    if SUMS_EXCESS {
        let stiffness = constants.sound_speed * constants.sound_speed;
        sums.pressure = stiffness * sums.pressure + parameters.background_pressure * sums.gradient;
        sums.laplacian *= stiffness;
    }
    return sums;
}

// Each neighbour of a solid's particle finds the pressure there by itself.
const WALLS_BY_PAIR = HAS_SOLIDS && ONE_PASS;

// What in a linear equation of state gives the same pressure.
fn linear_excess(excess: f32) -> f32 {
    if TAIT {
        let stiffness = constants.sound_speed * constants.sound_speed;
        return (pressure_of(excess) - parameters.background_pressure) / stiffness;
    }
    return excess;
}

// A solid that stays where it is, as one fluid particle sees it at `offset` = fluid - solid: that particle's pressure and the
// weight of the fluid between them, as linear_excess(). It never pulls. docs/wcsph.md, "Walls".
fn wall_excess(excess: f32, offset: Vector) -> f32 {
    let stiffness = constants.sound_speed * constants.sound_speed;
    let fall = (parameters.rest_density * constants.quantum / stiffness) * vector_of(parameters.gravity);
    return max(excess - dot(fall, offset), -parameters.background_pressure / stiffness);
}

// Of a neighbour, asked of every pair that may not be of fluid: without emitters and drains all others are fluid.
fn is_solid_neighbor(group: u32) -> bool {
    if EMITTER_COUNT == 0u && !CAN_EMPTY {
        return group != GROUP_FLUID;
    }
    return is_solid(group);
}

// A particle that was counted as its own neighbour so many times too often. A solid's was not.
fn take_itself(sums: ptr<function, Sums>, own: Own, times: f32) {
    if ON_SOLIDS && own.solid {
        return;
    }
    (*sums).filling -= times * kernel_shape(1.0) * own.inverse_density;
}

// The kernel is 0 beyond the support. `sure_fluid`: the neighbour cannot be a solid's.
fn add_pair(sums: ptr<function, Sums>, own: Own, other: Particle, offset: Vector, sure_fluid: bool) {
    let neighbor = other.motion;
    let group = u32(other.coordinate.w);
    let solid = ON_SOLIDS && own.solid;
    let fluid = !HAS_SOLIDS || sure_fluid || !is_solid_neighbor(group);
    let acts = !(solid && !fluid) && !(CAN_EMPTY && group == GROUP_EMPTY);
    let r_squared = distance_squared(offset);
    let inverse_r = inverseSqrt(r_squared);
    let q = within_support(r_squared * inverse_r);
    var excess = neighbor.w;
    if WALLS_BY_PAIR && !solid {
        excess = select(wall_excess(own.excess, offset), excess, fluid);
    }
    var inverse_density = select(0.0, 1.0 / (parameters.rest_density + excess), acts);
    var pressure = summed_pressure(excess, fluid);
    if WALLS_BY_PAIR && solid {
        // Here and in pressure_of_solid() what stands for the own values is this pair's.
        let wall = wall_excess(linear_excess(excess), -offset);
        inverse_density /= (parameters.rest_density + wall) * own.inverse_density;
        pressure += summed_pressure(wall, false);
    }
    let slope = kernel_slope(q) * inverse_density;
    let both_fluid = select(0.0, slope, fluid && !solid);
    let relative = own.velocity - vector_of(neighbor);
    var velocity = relative;
    if !fluid {
        velocity = own.velocity - displacing_velocity(group, place_of(other.coordinate));
    }
    let approach = dot(velocity, offset);
    if VISCOUS {
        (*sums).viscous += (both_fluid * approach * (inverse_r * inverse_r)) * offset;
    }
    if LAMINAR {
        (*sums).laminar += both_fluid * relative;
    }
    (*sums).gradient += slope * offset;
    (*sums).pressure += (slope * pressure) * offset;
    if HAS_SOLIDS && acts && fluid == solid {
        if FRICTION {
            (*sums).friction += (slope * own.stick * sticks(group)) * relative;
        }
        (*sums).solid_square = min((*sums).solid_square, r_squared);
    }
    let shape = kernel_shape(q);
    (*sums).filling += shape * inverse_density;
    if SHIFTING {
        (*sums).clustering += (slope * power4(shape)) * offset;
    }
    (*sums).surface += slope * r_squared;
    if FORCES_READ {
        return;
    }
    // What it does to the density, if it is within the support in the middle of the step: the rate belongs to the places at
    // the step's end, between two densities.
    let end_approach = approach + own.second_half * dot(velocity, velocity);
    let growth = approach + end_approach; // of r^2, over second_half
    (*sums).divergence += slope_at_end(own, q, r_squared, inverse_r, growth) * inverse_density * end_approach;
    let weight = select(0.0, q * inverse_density, fluid);
    (*sums).laplacian += weight * (pressure - own.pressure);
    (*sums).moment += weight * offset;
}

// kernel_slope() where the step ends; of Wendland's kernel, q^3, to first order, which saves a root.
fn slope_at_end(own: Own, q: f32, r_squared: f32, inverse_r: f32, growth: f32) -> f32 {
    if KERNEL == KERNEL_CUBIC || KERNEL == KERNEL_QUINTIC {
        let end = within_support(sqrt(max(r_squared + own.second_half * growth, 0.0)));
        return select(0.0, kernel_slope(end), q > 0.0);
    }
    return q * q * saturate(q - own.second_half_in_supports * inverse_r * growth);
}

// How far the barrier may act, quanta, or 0: few particles come so close to a solid, or approach it so fast, that they need that
// search, for which their warp waits. `speed2`: square of a speed; none of the fluid that may be near is faster.
fn barrier_reach(sums: Sums, speed2: f32) -> f32 {
    let solid_speed = select(0.0, control.solid_speed, MOVING_SOLIDS) + FASTEST_SURFACE;
    let calm = max(BRAKE_LIMIT * constants.sound_speed - solid_speed, 0.0);
    let reach = quanta_of_spacings(select(BARRIER_RANGE, BRAKE_RANGE, speed2 > calm * calm));
    return select(0.0, reach, HAS_SOLIDS && sums.solid_square < reach * reach);
}

// By pressure. `own_pressure` as it enters the sum.
fn pressure_acceleration(sums: Sums, excess: f32, own_pressure: f32) -> Vector {
    let scale = constants.particle_mass * constants.gradient_factor / (parameters.rest_density + excess);
    return -constants.quantum * scale * (sums.pressure + own_pressure * sums.gradient);
}

// By viscosity. `inside`: of fluid whose support is full.
fn viscous_acceleration(sums: Sums, excess: f32, inside: bool) -> Vector {
    let scale = constants.particle_mass * constants.gradient_factor / (parameters.rest_density + excess);
    var sum = Vector();
    if VISCOUS {
        sum += select(constants.viscosity_factor, constants.artificial_factor, inside) * sums.viscous;
    }
    if LAMINAR {
        sum += select(0.0, constants.laminar_factor, inside) * sums.laminar;
    }
    if FRICTION {
        sum += constants.friction_factor * sums.friction;
    }
    return scale * sum;
}

// WeirToolKind
const TOOL_NONE = 0u;
const TOOL_PULL = 2u;
const TOOL_STIR = 3u;

fn body_forces(at: Vector, velocity: Vector) -> Vector {
    let sum = vector_of(parameters.gravity)
        - parameters.central_force * (at - vector_of(constants.center));
    if constants.tool_kind == TOOL_NONE {
        return sum;
    }
    let offset = at - vector_of(constants.tool_position);
    let distance = length(offset);
    if distance >= constants.tool_radius {
        return sum;
    }
    let strength = constants.tool_strength * (1.0 - distance / constants.tool_radius);
    if constants.tool_kind == TOOL_STIR {
        return sum + strength * (vector_of(constants.tool_velocity) - velocity);
    }
    let outward = offset * (strength / max(distance, 1e-15));
    return sum + select(outward, -outward, constants.tool_kind == TOOL_PULL);
}

// Particle shifting (Sun et al. 2017) of a particle inside the fluid, and in w what it does to the density (2019):
// drho/dt / rho.
fn shift_of(sums: Sums) -> vec4f {
    let flow_speed = now().flow_speed;
    let most = 0.25 * flow_speed;
    let gradient = constants.particle_mass * constants.gradient_factor * constants.quantum;
    let factor = -parameters.shifting * 4.0 * constants.smoothing_length * flow_speed
        * gradient;
    let u = factor * (sums.gradient + constants.clustering_factor * sums.clustering);
    let speed = length(u);
    let shift = u * select(1.0, most / max(speed, 1e-30), speed > most);
    return vec4f(wide(shift), 2.0 * gradient * dot(shift, sums.gradient));
}

// What shifting (`rate`) and the volume that particles fill do to the density, and the return of spray to its rest density.
fn shift_rate_of(sums: Sums, excess: f32, surface: f32, rate: f32) -> f32 {
    let acoustic = constants.acoustic_rate;
    let pace = acoustic / (parameters.rest_density + excess);
    if surface < SPRAY_LIMIT * f32(DIMENSION) && excess < 0.0 {
        return -excess * pace;
    }
    let due = now().due_excess;
    let undue = excess - clamp(excess, -due, due);
    let ragged = select(0.0, undue * pace * (1.0 / RAGGED_TIME), surface < RAGGED_LIMIT * f32(DIMENSION));
    let filling = constants.particle_mass * constants.kernel_factor * sums.filling;
    let is_full = surface * constants.lattice_filling >= FULL_SUPPORT * f32(DIMENSION) * filling;
    let crowd = max(filling - CROWDED_LIMIT * constants.lattice_filling, 0.0) * acoustic * (1.0 / CROWDED_TIME);
    return rate - ragged + crowd + select(0.0, (filling - constants.lattice_filling) * acoustic * (1.0 / VOLUME_TIME), is_full);
}

// drho/dt for the velocities after the kick, without a second sweep: what the pressure's acceleration `push` is about to add to
// the divergence is the Laplacian of the pressure. The same operator diffuses the density. docs/wcsph.md, "Continuity".
// `shift_rate`: what shifting and the like add, drho/dt / rho.
fn rate_of(sums: Sums, excess: f32, push: Vector, shift_rate: f32) -> f32 {
    let dt = now().dt;
    let rho = parameters.rest_density + excess;
    let compress = constants.particle_mass * constants.gradient_factor * constants.quantum;
    let diffusion = now().diffusion;
    // p_j - p_i less what the gradient of the pressure makes of their distance, which one side alone would keep
    let slant = dot(sums.moment, diffusion * parameters.rest_density * vector_of(parameters.gravity) - dt * rho * push);
    let spread = (dt + diffusion) * sums.laplacian + constants.quantum * slant;
    let pull = dt * parameters.central_force * f32(DIMENSION);
    return rho * (compress * sums.divergence + shift_rate + pull) + constants.laplacian_factor * spread;
}

// As it enters the sum.
fn pressure_of_solid(excess: f32) -> f32 {
    if WALLS_BY_PAIR {
        return select(0.0, parameters.background_pressure, SUMS_EXCESS); // the rest is in each pair's
    }
    return linear_pressure(excess);
}

// And in w the share of its support that fluid fills.
fn acceleration_of_solid(i: u32, own: vec4i, own_motion: vec4f, local: u32, opening: Opening) -> vec4f {
    let sums = with_pressure(all_sums(i, place_of(own), own_of(own, own_motion), local, opening));
    var acceleration = pressure_acceleration(sums, own_motion.w, pressure_of_solid(own_motion.w))
        + viscous_acceleration(sums, own_motion.w, false);
    // A read may come before the maximum is known, and what an emitter has just made is not in it.
    let speed = select(now().max_speed, constants.sound_speed, FORCES_READ || EMITTER_COUNT > 0u);
    let reach = barrier_reach(sums, speed * speed);
    if reach > 0.0 {
        acceleration += barrier_of(own, own_motion, reach);
    }
    return vec4f(wide(acceleration), constants.particle_mass * constants.kernel_factor * sums.filling);
}

fn wants_force(group: u32) -> bool {
    return FORCES_READ || (FREE_SOLIDS && solid_table[group - GROUP_SOLID].kind == SOLID_FREE);
}

// The workgroup's largest squares, as bits: one atomic operation per workgroup on the device's memory, not one per
// particle on the same place. What is not finite is a matter for health.
var<workgroup> speed2_most: atomic<u32>; // wgpu-native does not zero them
var<workgroup> acceleration2_most: atomic<u32>;

fn take_speed(square: f32) {
    let bits = bitcast<u32>(square);
    if bits > atomicLoad(&speed2_most) && is_finite(square) {
        atomicMax(&speed2_most, bits);
    }
}

fn take_acceleration(square: f32) {
    let bits = bitcast<u32>(square);
    if bits > atomicLoad(&acceleration2_most) && is_finite(square) {
        atomicMax(&acceleration2_most, bits);
    }
}

fn clear_maxima() {
    atomicStore(&speed2_most, 0u);
    atomicStore(&acceleration2_most, 0u);
    clear_finish();
}

fn publish_maxima() {
    atomicMax(&control.maxima[now().noting].speed2_bits, atomicLoad(&speed2_most));
    atomicMax(&control.maxima[now().noting].acceleration2_bits, atomicLoad(&acceleration2_most));
    if FORCES_READ {
        atomicMax(&control.maxima[now().noting].excess_bits, atomicLoad(&excess_most));
    }
}

fn forces_on_fluid(i: u32, own: vec4i, own_motion: vec4f, local: u32, opening: Opening) {
    let sums = with_pressure(all_sums(i, place_of(own), own_of(own, own_motion), local, opening));
    let full = -constants.particle_mass * constants.gradient_factor * constants.quantum * constants.quantum;
    let surface = full * sums.surface;
    let inside = surface >= 0.95 * f32(DIMENSION);
    let pressure = pressure_of(own_motion.w);
    let acts = select(pressure, -pressure, TENSION_CONTROL && inside && pressure < 0.0);
    let velocity = vector_of(own_motion);
    let push = pressure_acceleration(sums, own_motion.w, acts);
    var acceleration = push + viscous_acceleration(sums, own_motion.w, inside)
        + body_forces(position_of(place_of(own)), velocity);
    let reach = barrier_reach(sums, dot(velocity, velocity));
    if reach > 0.0 {
        acceleration += barrier_of(own, own_motion, reach);
    }
    let free = u32(own.w) == GROUP_FLUID; // an inlet's particles keep their velocity
    if FORCES_READ {
        set_kicked(i, vec4f(wide(acceleration), pressure));
        if control.starting == 1u {
            take_speed(dot(velocity, velocity));
            take_acceleration(dot(acceleration, acceleration));
            take_excess(own_motion.w);
        }
        return;
    }
    let new_velocity = velocity + select(0.0, now().dt, free) * acceleration;
    var shift = vec4f(0.0);
    if SHIFTING && inside {
        shift = shift_of(sums);
    }
    shift.w = rate_of(sums, own_motion.w, push, shift_rate_of(sums, own_motion.w, surface, shift.w));
    take_speed(dot(new_velocity, new_velocity));
    if free {
        take_acceleration(dot(acceleration, acceleration));
    }
    if now().next_dt == 0.0 {
        step_end.density_rate[i] = shift.w;
    }
    finish_fluid(i, own, vec4f(wide(new_velocity), own_motion.w), shift);
}

// With ONE_PASS the clock moves on in each workgroup by itself, which costs less than a dispatch before this one. One of all
// threads tells other passes, and prepares the next step.
fn start_clock(tells: bool) {
    if FORCES_READ {
        clock = control.clock;
        let last = maxima_of_step(clock.noting);
        clock.last_side = clock.side;
        clock.travelled += way_of(last);
    } else if ONE_PASS {
        clock = begun(turn, turn);
        if tells {
            tell_clock(clock);
            control.clocks[next_turn(turn)] = prepared(clock);
        }
    } else if tells && control.clock.stepping == 1u {
        control.clocks[0] = prepared(control.clock);
    }
    if OWN_CLOCK {
        moved = clock.travelled - control.listed_at;
    }
}

fn slot_of(item: u32) -> u32 {
    if FLUID_FIRST {
        return cell_start[fluid_first_at(item)];
    }
    return item;
}

// A lone thread's particle and the head of its list are on their way while the clock moves on.
const EARLY = LANES == 1u && !FORCES_READ;

struct Taken {
    coordinate: vec4i,
    motion: vec4f,
    opening: Opening,
}

fn taken(i: u32) -> Taken {
    return Taken(coordinate_at(reading_start() + i), motion_at(reading_start() + i), opening_of(i, 0u));
}

// Solids see the fluid here, for the next step: friction finds them with the velocity of one step ago. Their threads are those of
// the last workgroups.
const SEES_FLUID = WALLS_BY_PAIR && FRICTION && !FORCES_READ;

fn first_seeing_group() -> u32 {
    return (LANES * constants.particle_count + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE;
}

// `thread`: of those that see.
fn see_fluid(thread: u32, local: u32) {
    let particle = constants.first_solid + thread / LANES;
    let works = particle < constants.particle_count && now().stepping == 1u;
    var i = 0u;
    if works {
        i = cell_start[fluid_first_at(particle)];
    }
    seen_leave_shares(works, i, thread % LANES, local);
    if works && thread % LANES == 0u {
        let own = coordinate_at(reading_start() + i);
        let velocity = solid_table[u32(own.w) - GROUP_SOLID].surface_velocity.xyz;
        let seen = seen_fluid_motion(i, own, velocity, vec3f(0.0), local);
        leave_fixed(i, own, seen);
        if !is_leaving() {
            set_motion(side_start(now().side) + i, seen);
        }
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn forces(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
          @builtin(local_invocation_index) local: u32) {
    turn = workgroups.x % 3u;
    let thread = thread_index(workgroup, workgroups, local);
    var own = Taken();
    var i = 0u;
    if EARLY {
        i = slot_of(min(thread, constants.particle_count - 1u));
        own = taken(i);
    }
    if local == 0u {
        clear_maxima();
        start_clock(thread == 0u);
    }
    workgroupBarrier();
    if SEES_FLUID && workgroup_index(workgroup, workgroups) >= first_seeing_group() {
        see_fluid(thread - WORKGROUP_SIZE * first_seeing_group(), local);
        return;
    }
    var runs = now().stepping == 1u;
    if FORCES_READ {
        runs = clock.running == 1u && is_well(atomicLoad(&control.bad_step), control.restored);
    }
    let works = thread / LANES < constants.particle_count && runs;
    if works && !EARLY {
        i = slot_of(thread / LANES);
    }
    leave_shares(works, i, thread % LANES, local);
    if works && thread % LANES == 0u {
        if !EARLY {
            own = taken(i);
        }
        forces_on(i, own, local);
    }
    workgroupBarrier();
    if local == 0u && atomicLoad(&speed2_most) + atomicLoad(&acceleration2_most) > 0u {
        publish_maxima();
    }
    if !FORCES_READ && local == 0u {
        publish_finish();
    }
}

fn share_of(i: u32, lane: u32) -> Sums {
    let opening = opening_of(i, lane);
    let own = coordinate_at(reading_start() + i);
    let group = u32(own.w);
    if group == GROUP_EMPTY || (HAS_SOLIDS && is_solid(group) && !wants_force(group)) {
        return no_sums();
    }
    return sum_pairs(i, place_of(own), own_of(own, motion_at(reading_start() + i)), lane, opening);
}

// By the particle's first thread, the workgroup's thread `local`.
fn forces_on(i: u32, it: Taken, local: u32) {
    let own = it.coordinate;
    let own_motion = it.motion;
    if is_fluid(u32(own.w)) {
        forces_on_fluid(i, own, own_motion, local, it.opening);
    } else if HAS_SOLIDS && is_solid(u32(own.w)) {
        forces_on_solid(i, own, own_motion, local, it.opening);
    } else if FORCES_READ {
        set_kicked(i, vec4f(0.0));
    } else {
        leave(i, own, vec4f(0.0));
    }
}

fn forces_on_solid(i: u32, own: vec4i, own_motion: vec4f, local: u32, opening: Opening) {
    if !MOVING_SOLIDS && !FORCES_READ {
        if !SEES_FLUID {
            leave_fixed(i, own, own_motion);
        }
        return;
    }
    if !wants_force(u32(own.w)) {
        return;
    }
    let acceleration = acceleration_of_solid(i, own, own_motion, local, opening);
    if FORCES_READ {
        set_kicked(i, vec4f(acceleration.xyz, linear_pressure(own_motion.w)));
        return;
    }
    var contact = vec4f();
    if may_touch(opening.header.x) {
        contact = contact_force(own);
    }
    set_kicked(i, contact);
    set_kicked(constants.particle_count + i, constants.particle_mass * acceleration);
}
