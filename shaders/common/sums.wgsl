// Sums over free fluid (weir_sum_fluid() in src/core/diagnostics.c): a workgroup's share of the particles, always in the same
// order. The host adds the workgroups' up.

// WeirGpuSums in src/gpu/sums.h.
struct FluidSums {
    place: vec3f, // m, from the domain's lowest corner along gravity
    density_error: f32,
    velocity: vec3f,
    speed2: f32,
    speed2_max: f32,
    density_error_max: f32,
    particles: f32,
    lost: f32,
}
@group(0) @binding(BINDING_fluid_sums) var<storage, read_write> fluid_sums: array<FluidSums>;

var<workgroup> partial: array<FluidSums, WORKGROUP_SIZE>;

fn joined(a: FluidSums, b: FluidSums) -> FluidSums {
    return FluidSums(a.place + b.place, a.density_error + b.density_error, a.velocity + b.velocity,
                     a.speed2 + b.speed2, max(a.speed2_max, b.speed2_max),
                     max(a.density_error_max, b.density_error_max), a.particles + b.particles, a.lost + b.lost);
}

// weir_domain_slack()
fn is_lost(place: vec3f, velocity: vec3f) -> bool {
    let slack = select(0.0, 0.5 * parameters.particle_spacing, constants.coordinate_bits > 0u);
    for (var axis = 0u; axis < constants.dimension; axis++) {
        let inside = place[axis] >= constants.domain_min[axis] - slack &&
                     place[axis] <= constants.domain_max[axis] + slack;
        // Of a speed that is not finite the exponent's bits tell: compilers may assume that there is none.
        if !inside || (bitcast<u32>(velocity[axis]) & 0x7f800000u) == 0x7f800000u {
            return true;
        }
    }
    return false;
}

// Of one particle; `error` is its density over the rest density, less 1. Third components are 0 in 2D.
fn sums_of(place: vec3f, velocity: vec3f, error: f32) -> FluidSums {
    let lowest = select(constants.domain_max.xyz, constants.domain_min.xyz, parameters.gravity.xyz < vec3f(0.0));
    let speed2 = dot(velocity, velocity);
    let compression = max(error, 0.0);
    return FluidSums(place - lowest, compression, velocity, speed2, speed2, compression, 1.0,
                     select(0.0, 1.0, is_lost(place, velocity)));
}

// Of a workgroup's share; all its threads call it. A pass brings own_sums(), those of one particle.
fn leave_sums(workgroup: vec3u, workgroups: vec3u, local: u32) {
    let group = workgroup_index(workgroup, workgroups);
    let share = particle_share(group, workgroups);
    var sums = FluidSums();
    for (var i = share.x + local; i < share.y; i += WORKGROUP_SIZE) {
        sums = joined(sums, own_sums(i));
    }
    partial[local] = sums;
    for (var half = WORKGROUP_SIZE / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if local < half {
            partial[local] = joined(partial[local], partial[local + half]);
        }
    }
    if local == 0u {
        fluid_sums[group] = partial[0];
    }
}
