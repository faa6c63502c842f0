// What the passes need beside the parameters, once; derived from scene and parameters by weir_constants_make().
//
//   WEIR_CONSTANT_VECTOR(name, help)   float[4] in C, vec4f in WGSL
//   WEIR_CONSTANT_NUMBER(name, help)   float in C, f32 in WGSL
//   WEIR_CONSTANT_COUNT(name, help)    uint32_t in C, u32 in WGSL

WEIR_CONSTANT_VECTOR(domain_min, "lowest corner of the domain, m")
WEIR_CONSTANT_VECTOR(domain_max, "highest corner of the domain, m")
WEIR_CONSTANT_VECTOR(tool_position, "m")
WEIR_CONSTANT_VECTOR(tool_velocity, "m/s")
WEIR_CONSTANT_VECTOR(origin, "wcsph: place of coordinate 0, m; coordinates count quanta from here")
WEIR_CONSTANT_VECTOR(center, "wcsph: middle of the domain, where central_force pulls to, m")
WEIR_CONSTANT_NUMBER(tool_radius, "m")
WEIR_CONSTANT_NUMBER(tool_strength, "m/s^2 for push and pull, 1/s for stir")
WEIR_CONSTANT_NUMBER(particle_mass, "kg (per metre of depth in 2D)")
WEIR_CONSTANT_NUMBER(density_factor, "mass * normalisation of the density kernel")
WEIR_CONSTANT_NUMBER(pressure_factor, "mass * normalisation of the pressure kernel's gradient, positive")
WEIR_CONSTANT_NUMBER(viscosity_factor, "mueller: mass * viscosity * normalisation of the viscosity Laplacian; wcsph: max(rho0 alpha h c0, 2 (d + 2) mu), Pa s")
WEIR_CONSTANT_NUMBER(inverse_cell_width, "1/m, cells along x")
WEIR_CONSTANT_NUMBER(inverse_cell_height, "1/m, cells along y")
WEIR_CONSTANT_NUMBER(search_radius, "support radius and a little more, so that rounding loses no neighbour")
WEIR_CONSTANT_NUMBER(speed_limit, "m/s; a faster particle is a blow-up: half a support radius per step (mueller), 4 c0 (wcsph)")
WEIR_CONSTANT_NUMBER(quantum, "wcsph: m per quantum, support_radius / 2^coordinate_bits")
WEIR_CONSTANT_NUMBER(inverse_quantum, "wcsph: quanta per m")
WEIR_CONSTANT_NUMBER(inverse_support, "wcsph: 2^-coordinate_bits, support radii per quantum")
WEIR_CONSTANT_NUMBER(smoothing_length, "wcsph: h, m: half of the support radius, a third of it for the quintic spline")
WEIR_CONSTANT_NUMBER(kernel_factor, "wcsph: normalisation of W, 1/m^d")
WEIR_CONSTANT_NUMBER(gradient_factor, "wcsph: normalisation of (dW/dr) / r, negative, 1/m^(d+2)")
WEIR_CONSTANT_NUMBER(spacing_value, "wcsph: W at one particle spacing / kernel_factor, for shifting")
WEIR_CONSTANT_NUMBER(lattice_filling, "wcsph: sum of V W over a lattice at rest")
WEIR_CONSTANT_NUMBER(sound_speed, "wcsph: c0, chosen from the scene if the parameter is 0, m/s")
WEIR_CONSTANT_NUMBER(artificial_factor, "wcsph: viscosity_factor if it is the artificial viscosity's, else 0, Pa s")
WEIR_CONSTANT_NUMBER(laminar_factor, "wcsph: friction_factor if laminar viscosity is the larger one, else 0, Pa s")
WEIR_CONSTANT_NUMBER(friction_factor, "wcsph: 2 mu, calibrated so that the Laplacian is exact on the lattice, Pa s")
WEIR_CONSTANT_COUNT(tool_kind, "WeirToolKind")
WEIR_CONSTANT_COUNT(particle_count, "particles")
WEIR_CONSTANT_COUNT(cell_columns, "cells along x")
WEIR_CONSTANT_COUNT(cell_rows, "cells along y")
WEIR_CONSTANT_COUNT(cell_layers, "cells along z; 1 in 2D")
WEIR_CONSTANT_COUNT(cell_count, "cell_columns * cell_rows * cell_layers")
WEIR_CONSTANT_COUNT(dimension, "2 or 3")
WEIR_CONSTANT_COUNT(coordinate_bits, "wcsph: log2 of the quanta per support radius")
WEIR_CONSTANT_COUNT(column_shift, "wcsph: cell column = coordinate x >> column_shift")
WEIR_CONSTANT_COUNT(row_shift, "wcsph: cell row and layer = coordinate y, z >> row_shift")
WEIR_CONSTANT_COUNT(period_x, "wcsph: quanta after which x repeats; 0: not periodic")
WEIR_CONSTANT_COUNT(period_y, "wcsph: the same for y")
WEIR_CONSTANT_COUNT(period_z, "wcsph: the same for z")
WEIR_CONSTANT_COUNT(open_sides, "wcsph: bit 2 axis + (0 low, 1 high) is set where a side has no wall")
WEIR_CONSTANT_COUNT(first_solid, "wcsph: ids from here on are wall and body particles")
WEIR_CONSTANT_COUNT(solid_count, "wcsph: walls and bodies")

#undef WEIR_CONSTANT_VECTOR
#undef WEIR_CONSTANT_NUMBER
#undef WEIR_CONSTANT_COUNT
