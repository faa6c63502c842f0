// The method once more, in double precision and as plain as possible: every particle against every other one.
// It shares no line with src/ and is what solvers are judged by. Formulas: docs/method.md.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "core/parameters.h"

typedef struct WeirReference {
    uint32_t count;
    double *density, *pressure;
    double *acceleration;       // x, y per particle
    uint32_t *neighbors;        // other particles nearer than the support radius
    double *acceleration_scale; // sum of the sizes of all terms: rounding errors are a small share of it
} WeirReference;

// Kernels of the plane; h is the support radius.
double weir_reference_poly6(double r, double h);
double weir_reference_spiky(double r, double h);
double weir_reference_spiky_slope(double r, double h); // dW/dr
double weir_reference_laplacian(double r, double h);
// Mass that gives an endless square lattice the rest density.
double weir_reference_mass(const WeirParameters *parameters);
// Internal energy per particle mass of p = k (rho - rho0) clamped at 0: the integral of p / rho^2.
double weir_reference_internal_energy(double density, const WeirParameters *parameters);

// `reference` is filled with new arrays; weir_reference_free() frees them.
void weir_reference_evaluate(WeirReference *reference, const WeirParameters *parameters, uint32_t count,
                             const float *position, const float *velocity);
void weir_reference_free(WeirReference *reference);
