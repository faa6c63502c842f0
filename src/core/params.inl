// Every parameter of Weir, once. Include with the macros below defined; each include expands the whole list.
//
//   WEIR_VECTOR(name, unit, x, y, z, minimum, maximum, method, live, help)   float[4] in C, vec4f in WGSL (w unused)
//   WEIR_NUMBER(name, unit, default, minimum, maximum, method, live, help)  float in C, f32 in WGSL
//   WEIR_CHOICE(name, names, default, method, live, help)                   uint32_t in C, u32 in WGSL: an index
//
// Vectors come first and numbers before choices, so that C and WGSL lay the struct out alike (parameters.h).
// `method`: "mueller" or "wcsph" if only that method reads it, "" for both.
// `live`: 1 if it may change while a simulation runs, 0 if it takes effect at the next start.

WEIR_VECTOR(gravity, "m/s^2", 0.0, -9.81, 0.0, -1000.0, 1000.0, "", 1, "Acceleration that acts on all fluid.")
WEIR_NUMBER(particle_spacing, "m", 0.01, 1e-5, 10.0, "", 0,
            "Distance between neighbouring particles of the resting lattice; sets the particle mass.")
WEIR_NUMBER(support_radius, "m", 0.025, 0.0, 100.0, "", 0,
            "Radius beyond which two particles do not act on each other. 0 (wcsph only): 4 spacings in 2D, 3 in 3D.")
WEIR_NUMBER(rest_density, "kg/m^3", 1000.0, 1e-3, 1e5, "", 0, "Density rho0 of the fluid at zero pressure.")
WEIR_NUMBER(gas_constant, "m^2/s^2", 2000.0, 0.0, 1e7, "mueller", 1,
            "Stiffness k in p = k (rho - rho0); its square root is the speed of sound.")
WEIR_NUMBER(viscosity, "Pa s", 0.1, 0.0, 1e4, "", 1, "Dynamic viscosity mu.")
WEIR_NUMBER(negative_pressure, "1", 0.0, 0.0, 1.0, "mueller", 1,
            "Share of a negative pressure that is kept: 0 clamps tension to zero, 1 keeps it all.")
WEIR_NUMBER(restitution, "1", 0.5, 0.0, 1.0, "mueller", 1,
            "Share of the normal speed that a particle keeps when a wall reflects it.")
WEIR_NUMBER(sound_speed, "m/s", 0.0, 0.0, 1e5, "wcsph", 0,
            "Speed of sound c0. 0: ten times the largest speed that the scene can reach.")
WEIR_NUMBER(expected_speed, "m/s", 0.0, 0.0, 1e4, "wcsph", 0,
            "Largest speed expected, for the speed of sound. 0: estimated from the scene.")
WEIR_NUMBER(artificial_viscosity, "1", 0.01, 0.0, 10.0, "wcsph", 1,
            "Strength alpha of Monaghan's artificial viscosity between fluid particles.")
WEIR_NUMBER(density_diffusion, "1", 0.15, 0.0, 1.0, "wcsph", 1,
            "Strength delta of the density diffusion (Fourtakas et al. 2019).")
WEIR_NUMBER(shifting, "1", 2.0, 0.0, 20.0, "wcsph", 1,
            "Strength of the particle shifting inside the fluid, 1 as in Sun et al. 2017; 0: none.")
WEIR_NUMBER(background_pressure, "Pa", 0.0, 0.0, 1e9, "wcsph", 1,
            "Added to every pressure; keeps a closed or periodic fluid without free surface from tension.")
WEIR_NUMBER(central_force, "1/s^2", 0.0, 0.0, 1e6, "wcsph", 1,
            "Omega^2 of an acceleration -Omega^2 x towards the middle of the domain.")
WEIR_NUMBER(courant, "1", 0.6, 0.01, 0.68, "wcsph", 1,
            "Courant number of the adaptive time step; above 0.69 sound grows without bound.")
WEIR_NUMBER(time_step, "s", 0.0003, 1e-7, 0.1, "", 1,
            "Simulated time of one step; wcsph reads it only if stepping is fixed.")
WEIR_NUMBER(time_scale, "1", 1.0, 0.01, 10.0, "", 1, "Simulated seconds per wall second that a live run aims at.")
WEIR_CHOICE(kernels, "consistent|tutorial", 0, "mueller", 1,
            "consistent: spiky kernel for density and pressure; tutorial: poly6 density with spiky pressure, "
            "which creates energy.")
WEIR_CHOICE(search, "grid|all_pairs", 0, "mueller", 1,
            "Neighbour search: counting sort into a uniform grid, or every particle against every other one.")
WEIR_CHOICE(kernel, "wendland|cubic|quintic", 0, "wcsph", 0,
            "Smoothing kernel: Wendland C2 (support 2h), cubic spline (2h) or quintic spline (3h).")
WEIR_CHOICE(equation_of_state, "linear|tait", 0, "wcsph", 0,
            "linear: p = c0^2 (rho - rho0); tait: p = rho0 c0^2 / 7 ((rho / rho0)^7 - 1).")
WEIR_CHOICE(tension_control, "off|on", 0, "wcsph", 1,
            "on: inside the fluid a negative pressure acts by its difference, so that tension opens no voids, "
            "at the price of exact momentum (Sun et al. 2018).")
WEIR_CHOICE(wall_function, "off|on", 1, "wcsph", 1,
            "on: at no-slip walls friction is that of a turbulent boundary layer where the flow along them is too fast for its "
            "layer to be resolved (Werner, Wengle 1993); off: always that of laminar flow.")
WEIR_CHOICE(stepping, "adaptive|fixed", 0, "wcsph", 1,
            "adaptive: each step as long as force, sound and viscosity allow; fixed: time_step.")

#undef WEIR_VECTOR
#undef WEIR_NUMBER
#undef WEIR_CHOICE
