// The physics of a particle and of a pair, shared by the grid and the all_pairs passes. `flow` is velocity in xy,
// density in z, pressure in w. Formulas: docs/method.md; the CPU's: src/core/cpu/mueller.c.

// Density and pressure p = k (rho - rho0) from the kernel sum; the kept share of tension is a parameter.
fn flow_of(velocity: vec2f, kernel_sum: f32) -> vec4f {
    let density = constants.density_factor * kernel_sum;
    var pressure = parameters.gas_constant * (density - parameters.rest_density);
    if pressure < 0.0 {
        pressure *= parameters.negative_pressure;
    }
    return vec4f(velocity, density, pressure);
}

// The particle whose sums are made.
struct Own {
    velocity: vec2f,
    inverse_density: f32,
    pressure_term: f32,
}

fn own_of(flow: vec4f) -> Own {
    let inverse_density = 1.0 / flow.z;
    if TUTORIAL_KERNELS {
        return Own(flow.xy, inverse_density, flow.w);
    }
    return Own(flow.xy, inverse_density, flow.w * inverse_density * inverse_density);
}

struct PairSums {
    pressure: vec2f,
    viscosity: vec2f,
}

// Adds neighbour j. No division at r = 0: there the offset is 0 and so is the pressure term.
//   consistent: (p_i / rho_i^2 + p_j / rho_j^2) (h - r)^2 (x_i - x_j) / r
//   tutorial:   (p_i + p_j) / rho_j             (h - r)^2 (x_i - x_j) / r
//   viscosity:  (v_j - v_i) / rho_j (h - r)
fn add_pair(sums: ptr<function, PairSums>, own: Own, other: vec4f, offset: vec2f, r_squared: f32) {
    let inverse_r = inverseSqrt(max(r_squared, TINY));
    let q = parameters.support_radius - r_squared * inverse_r;
    let inverse_density = 1.0 / other.z;
    let weight = q * q * inverse_r;
    var term: f32;
    if TUTORIAL_KERNELS {
        term = (own.pressure_term + other.w) * inverse_density;
    } else {
        term = own.pressure_term + other.w * inverse_density * inverse_density;
    }
    (*sums).pressure += (term * weight) * offset;
    (*sums).viscosity += (q * inverse_density) * (other.xy - own.velocity);
}

fn acceleration_of(sums: PairSums, own: Own) -> vec2f {
    var pressure_factor = constants.pressure_factor;
    if TUTORIAL_KERNELS {
        pressure_factor *= 0.5 * own.inverse_density;
    }
    return pressure_factor * sums.pressure + (constants.viscosity_factor * own.inverse_density) * sums.viscosity
        + parameters.gravity.xy;
}

// m^2: keeps r = 0 from a division by zero.
const TINY = 1e-24;

// What integrate found, and the number of the step that runs now.
struct Health {
    bad_particles: atomic<u32>,
    first_bad_step: atomic<u32>,
    step: u32,
}
