// The passes of `wcsph` that visit pairs of particles: compiled once per instruction set (wcsph_pairs.c) and chosen
// when a solver is made. All variants give the same bits.
#pragma once

#include "core/parameters.h"

// What the pair passes read and write, in the order of the sorted particles; every array has WEIR_PAIRS_PADDING
// elements more than particles. Vectors have three arrays; the third is 0 in 2D.
typedef struct WeirWcsphData {
    const WeirParameters *parameters;
    const WeirConstants *constants;
    const uint32_t *cell_start;
    float flow_speed;    // m/s, the fluid's largest, at most c0 / 10 and what shifting stands
    float due_excess;    // kg/m^3, the most that weight and motion alone give fluid near a surface
    float dt;            // s, of this step; 0 where only the forces are wanted
    float second_half;   // quanta per m/s: how far a velocity moves a particle in the second half of the step
    bool walls_by_pair;  // each neighbour of a solid's particle finds the pressure there by itself
    const int32_t *x[3]; // coordinates, quanta
    const float *velocity[3]; // m/s, at the start of the step
    float *is_fluid;          // 1 fluid, 0 solid
    float *stick;             // 1 fluid and no-slip solids, 0 free-slip solids
    float *barrier;           // of solids: weir_solid_barrier(); of fluid 1
    float *needs_force;       // solids: 1 if the force on the particle is wanted
    float *excess; // density less rest density, kg/m^3; of solids: of the pressure that walls extrapolates
    float *inverse_density;  // m^3/kg
    float *pressure;         // Pa
    float *seen_velocity[3]; // as `forces` sees it: of solids what friction takes, mirrored or more
    float *new_velocity
        [3]; // m/s; of solids: their own, without what their surface slides, for `forces`; of fluid: after the kick
    float *acceleration[3]; // m/s^2; of solids: force of the fluid on the particle over the particle mass
    float *shift[3];        // shifting velocity, m/s
    float *rate;            // drho/dt, kg/(m^3 s)
    float *weight;          // walls: sum of W, 0 without fluid in reach
    float *
        wetted; // forces: share of the support of a solid's particle that fluid fills, where its force is wanted
    float *extrapolated[3]; // walls: sum_j rho_j x_wj W / sum W, kg/m^2
} WeirWcsphData;

typedef struct WeirWcsphPasses {
    const char *simd;
    // Each handles particles [begin, end) and writes nothing else.
    void (*walls)(const WeirWcsphData *data, uint32_t begin, uint32_t end);
    void (*forces)(const WeirWcsphData *data, uint32_t begin, uint32_t end);
} WeirWcsphPasses;

// The fastest that this processor runs, for particles with about so many neighbours.
const WeirWcsphPasses *weir_wcsph_passes(uint32_t dimension, double neighbors);
