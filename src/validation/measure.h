// What several cases measure from a state, in double precision.
#pragma once

#include "validation/validation.h"

// Is particle `i` fluid (an emitter's layer included)?
bool weir_sample_is_fluid(const WeirSample *sample, size_t i);
// Component of a particle's vector; 0 beyond the dimension.
double weir_sample_position(const WeirSample *sample, size_t i, uint32_t axis);
double weir_sample_velocity(const WeirSample *sample, size_t i, uint32_t axis);

// Sums over the fluid.
typedef struct WeirFluidSums {
    uint32_t count;
    double mass;              // kg (per metre of depth in 2D)
    double center[3];         // mean position, m
    double spread[3];         // variance of the position per axis, m^2
    double min[3], max[3];    // extent of the particles' centres, m
    double momentum[3];       // kg m/s
    double speed_momentum;    // sum of m |v|, kg m/s
    double angular_momentum;  // about z through the origin, kg m^2/s
    double kinetic_energy;    // J
    double elastic_energy;    // J, of compression with the linear equation of state
    double potential_energy;  // J, of gravity, from the origin, and of the central force
    double max_speed;         // m/s
    double density_deviation; // mean |rho / rho0 - 1|
} WeirFluidSums;
WeirFluidSums weir_fluid_sums(const WeirSample *sample);

// Probes without a scene's piece (probe.h).
double weir_measure_height(const WeirSample *sample, double x, double z);
// Depth of all water over and under (x, 0, z), m: its volume, spread by the kernel of one dimension less, per area. What a wire
// gauge measures, or a column of cells: air between water does not count. (Height: the highest water.)
double weir_measure_depth(const WeirSample *sample, double x, double z);
double weir_measure_pressure(const WeirSample *sample, const double point[3]);

// Velocity at a point by the weighted least-squares plane through the fluid's velocities around it: exact for linear
// fields even beside a wall, where the probe's mean over one side is off by the slope. NaN where there is too little fluid.
void weir_measure_linear_velocity(const WeirSample *sample, const double point[3], double velocity[3]);

// Share of the fluid's particles in the largest group whose members are linked by gaps below `link`, m. NaN if memory
// runs out or there is no fluid.
double weir_largest_cluster(const WeirSample *sample, double link);

// Slope of the least-squares line through (x, y).
double weir_fitted_slope(const double *x, const double *y, uint32_t count);
// Mean of y over the curve's points with x in [from, to]; NaN if there are none.
double weir_curve_mean(const WeirValidation *v, uint32_t curve, double from, double to);
double weir_curve_max(const WeirValidation *v, uint32_t curve, double from, double to);
