// Semi-implicit Euler, tool, walls and health. A particle that is not finite goes back to its old position with no
// velocity, so that nothing can ever be indexed by it.
//
// in:  sorted_position, sorted_velocity, sorted_id, acceleration, health.step
// out: position, velocity, id, health
@group(0) @binding(BINDING_sorted_position) var<storage, read> sorted_position: array<vec2f>;
@group(0) @binding(BINDING_sorted_velocity) var<storage, read> sorted_velocity: array<vec2f>;
@group(0) @binding(BINDING_sorted_id) var<storage, read> sorted_id: array<u32>;
@group(0) @binding(BINDING_acceleration) var<storage, read> acceleration: array<vec2f>;
@group(0) @binding(BINDING_position) var<storage, read_write> position: array<vec2f>;
@group(0) @binding(BINDING_velocity) var<storage, read_write> velocity: array<vec2f>;
@group(0) @binding(BINDING_id) var<storage, read_write> id: array<u32>;
@group(0) @binding(BINDING_health) var<storage, read_write> health: Health;

// WeirToolKind
const TOOL_NONE = 0u;
const TOOL_PUSH = 1u;
const TOOL_PULL = 2u;
const TOOL_STIR = 3u;

fn tool_acceleration(at: vec2f, speed: vec2f) -> vec2f {
    let offset = at - constants.tool_position.xy;
    let distance = length(offset);
    if constants.tool_kind == TOOL_NONE || distance >= constants.tool_radius {
        return vec2f(0.0);
    }
    let strength = constants.tool_strength * (1.0 - distance / constants.tool_radius);
    if constants.tool_kind == TOOL_STIR {
        return strength * (constants.tool_velocity.xy - speed);
    }
    let outward = offset * (strength / max(distance, 1e-15));
    return select(outward, -outward, constants.tool_kind == TOOL_PULL);
}

// Position x and velocity y along one axis after the walls at `low` and `high`.
fn reflect_walls(x: f32, v: f32, low: f32, high: f32) -> vec2f {
    var moved = vec2f(x, v);
    if moved.x < low {
        moved.x = low + parameters.restitution * (low - moved.x);
        moved.y = select(moved.y, -parameters.restitution * moved.y, moved.y < 0.0);
    }
    if moved.x > high {
        moved.x = high - parameters.restitution * (moved.x - high);
        moved.y = select(moved.y, -parameters.restitution * moved.y, moved.y > 0.0);
    }
    return vec2f(clamp(moved.x, low, high), moved.y);
}

// Tests the exponent's bits: WGSL compilers may assume that no value is infinite or NaN. Beyond 1e37 the next
// arithmetic would overflow.
fn is_sound(speed_squared: f32) -> bool {
    return (bitcast<u32>(speed_squared) & 0x7f800000u) != 0x7f800000u && speed_squared <= 1e37;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn integrate(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
             @builtin(local_invocation_index) local: u32) {
    let i = thread_index(workgroup, workgroups, local);
    if i >= constants.particle_count {
        return;
    }
    let old = sorted_position[i];
    let old_velocity = sorted_velocity[i];
    var v = old_velocity + parameters.time_step * (acceleration[i] + tool_acceleration(old, old_velocity));
    let speed_squared = dot(v, v);
    let sound = is_sound(speed_squared);
    if !sound || speed_squared > constants.speed_limit * constants.speed_limit {
        atomicAdd(&health.bad_particles, 1u);
        atomicMin(&health.first_bad_step, health.step);
    }
    v = select(vec2f(0.0), v, sound);
    let x = old + parameters.time_step * v;
    let along_x = reflect_walls(x.x, v.x, constants.domain_min.x, constants.domain_max.x);
    let along_y = reflect_walls(x.y, v.y, constants.domain_min.y, constants.domain_max.y);
    position[i] = vec2f(along_x.x, along_y.x);
    velocity[i] = vec2f(along_x.y, along_y.y);
    id[i] = sorted_id[i];
}
