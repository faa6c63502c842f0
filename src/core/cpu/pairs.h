// The two passes that visit pairs of particles, density and forces: compiled once per instruction set
// (pairs.c) and chosen when a solver is made. All variants give the same bits.
#pragma once

#include "core/parameters.h"

// What the pair passes read and write. Particles are sorted by cell; every array has WEIR_PAIRS_PADDING
// floats more than particles, so that a vector may be read at the last one.
enum { WEIR_PAIRS_PADDING = 16 };
typedef struct WeirPairData {
    const WeirParameters *parameters;
    const WeirConstants *constants;
    const uint32_t *cell_start; // cell_count + 1
    const float *x, *y;         // m
    const float *vx, *vy;       // m/s
    float *density;             // kg/m^3
    float *pressure;            // Pa
    float *pressure_term;       // pressure as the force sum adds it: p / rho^2, or p for the tutorial's form
    float *inverse_density;     // m^3/kg
    float *ax, *ay;             // m/s^2
} WeirPairData;

typedef struct WeirPairPasses {
    const char *simd;
    // Each handles particles [begin, end) and writes nothing else.
    void (*density)(const WeirPairData *data, uint32_t begin, uint32_t end);
    void (*forces)(const WeirPairData *data, uint32_t begin, uint32_t end);
} WeirPairPasses;

// The fastest that this processor runs, for particles with about so many neighbours.
const WeirPairPasses *weir_pair_passes(double neighbors);
