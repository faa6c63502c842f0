// The CPU solver's particle data: one array per quantity, so that a vector loads neighbours in memory.
#pragma once

#include "core/solver.h"

// Position, velocity and id. One allocation; arrays are padded so that a vector may be read at the
// last particle.
typedef struct WeirParticleArrays {
    float *x, *y, *vx, *vy;
    uint32_t *id;
} WeirParticleArrays;

// What the pair passes sum, in the order of the sorted particles.
typedef struct WeirSumArrays {
    float *density, *pressure, *pressure_term, *inverse_density;
    float *ax, *ay;
} WeirSumArrays;

// Arrays of WeirState.
typedef struct WeirHostArrays {
    float *position, *velocity, *acceleration, *density, *pressure;
} WeirHostArrays;

// False if memory runs out; the arrays are zero.
bool weir_particle_arrays_make(WeirParticleArrays *arrays, uint32_t count);
bool weir_sum_arrays_make(WeirSumArrays *arrays, uint32_t count);
bool weir_host_arrays_make(WeirHostArrays *arrays, uint32_t count);
void weir_particle_arrays_free(WeirParticleArrays *arrays);
void weir_sum_arrays_free(WeirSumArrays *arrays);
void weir_host_arrays_free(WeirHostArrays *arrays);
WeirState weir_host_state(const WeirHostArrays *arrays, uint32_t count, uint64_t step);

static inline void weir_particle_copy(const WeirParticleArrays *to, uint32_t to_index,
                                      const WeirParticleArrays *from, uint32_t from_index)
{
    to->x[to_index] = from->x[from_index];
    to->y[to_index] = from->y[from_index];
    to->vx[to_index] = from->vx[from_index];
    to->vy[to_index] = from->vy[from_index];
    to->id[to_index] = from->id[from_index];
}
