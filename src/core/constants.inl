// What the passes need beside the parameters, once; derived from scene and parameters by weir_constants_make().
//
//   WEIR_CONSTANT_VECTOR(name, help)   float[4] in C, vec4f in WGSL
//   WEIR_CONSTANT_NUMBER(name, help)   float in C, f32 in WGSL
//   WEIR_CONSTANT_COUNT(name, help)    uint32_t in C, u32 in WGSL

WEIR_CONSTANT_VECTOR(domain_min, "lowest corner of the domain, m")
WEIR_CONSTANT_VECTOR(domain_max, "highest corner of the domain, m")
WEIR_CONSTANT_VECTOR(tool_position, "m")
WEIR_CONSTANT_VECTOR(tool_velocity, "m/s")
WEIR_CONSTANT_NUMBER(tool_radius, "m")
WEIR_CONSTANT_NUMBER(tool_strength, "m/s^2 for push and pull, 1/s for stir")
WEIR_CONSTANT_NUMBER(particle_mass, "kg (per metre of depth in 2D)")
WEIR_CONSTANT_NUMBER(density_factor, "mass * normalisation of the density kernel")
WEIR_CONSTANT_NUMBER(pressure_factor, "mass * normalisation of the pressure kernel's gradient, positive")
WEIR_CONSTANT_NUMBER(viscosity_factor, "mass * viscosity * normalisation of the viscosity Laplacian")
WEIR_CONSTANT_NUMBER(inverse_cell_width, "1/m, cells along x")
WEIR_CONSTANT_NUMBER(inverse_cell_height, "1/m, cells along y")
WEIR_CONSTANT_NUMBER(search_radius, "support radius and a little more, so that rounding loses no neighbour")
WEIR_CONSTANT_NUMBER(speed_limit, "m/s; a faster particle crosses half a support radius per step: blow-up")
WEIR_CONSTANT_COUNT(tool_kind, "WeirToolKind")
WEIR_CONSTANT_COUNT(particle_count, "particles")
WEIR_CONSTANT_COUNT(cell_columns, "cells along x")
WEIR_CONSTANT_COUNT(cell_rows, "cells along y")
WEIR_CONSTANT_COUNT(cell_count, "cell_columns * cell_rows")
WEIR_CONSTANT_COUNT(dimension, "2")

#undef WEIR_CONSTANT_VECTOR
#undef WEIR_CONSTANT_NUMBER
#undef WEIR_CONSTANT_COUNT
