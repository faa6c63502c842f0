// Every parameter of Weir, once. Include with the macros below defined; each include expands the whole list.
//
//   WEIR_VECTOR(name, unit, x, y, z, minimum, maximum, live, help)       float[4] in C, vec4f in WGSL (w unused)
//   WEIR_NUMBER(name, unit, default, minimum, maximum, live, help)      float in C, f32 in WGSL
//   WEIR_CHOICE(name, names, default, live, help)                       uint32_t in C, u32 in WGSL: an index
//
// Vectors come first and numbers before choices, so that C and WGSL lay the struct out alike (parameters.h).
// `live`: 1 if it may change while a simulation runs, 0 if it takes effect at the next start.

WEIR_VECTOR(gravity, "m/s^2", 0.0, -9.81, 0.0, -1000.0, 1000.0, 1, "Acceleration that acts on all fluid.")
WEIR_NUMBER(particle_spacing, "m", 0.01, 1e-5, 10.0, 0,
            "Distance between neighbouring particles of the resting lattice; sets the particle mass.")
WEIR_NUMBER(support_radius, "m", 0.025, 2e-5, 100.0, 0,
            "Radius h beyond which two particles do not act on each other.")
WEIR_NUMBER(rest_density, "kg/m^3", 1000.0, 1e-3, 1e5, 0, "Density rho0 of the fluid at zero pressure.")
WEIR_NUMBER(gas_constant, "m^2/s^2", 2000.0, 0.0, 1e7, 1,
            "Stiffness k in p = k (rho - rho0); its square root is the speed of sound.")
WEIR_NUMBER(viscosity, "Pa s", 0.1, 0.0, 1e4, 1, "Dynamic viscosity mu.")
WEIR_NUMBER(negative_pressure, "1", 0.0, 0.0, 1.0, 1,
            "Share of a negative pressure that is kept: 0 clamps tension to zero, 1 keeps it all.")
WEIR_NUMBER(restitution, "1", 0.5, 0.0, 1.0, 1,
            "Share of the normal speed that a particle keeps when a wall reflects it.")
WEIR_NUMBER(time_step, "s", 0.0003, 1e-7, 0.1, 1, "Simulated time of one step.")
WEIR_NUMBER(time_scale, "1", 1.0, 0.01, 10.0, 1, "Simulated seconds per wall second that a live run aims at.")
WEIR_CHOICE(kernels, "consistent|tutorial", 0, 1,
            "consistent: spiky kernel for density and pressure; tutorial: poly6 density with spiky pressure, "
            "which creates energy.")
WEIR_CHOICE(search, "grid|all_pairs", 0, 1,
            "Neighbour search: counting sort into a uniform grid, or every particle against every other one.")

#undef WEIR_VECTOR
#undef WEIR_NUMBER
#undef WEIR_CHOICE
