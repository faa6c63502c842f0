#include "core/cpu/arrays.h"
#include "core/cpu/pairs.h"

#include <stdlib.h>

// `arrays` arrays of `floats` each in one zeroed block; NULL if memory runs out.
static float *make_block(size_t arrays, size_t floats)
{
    return calloc(arrays * floats, sizeof(float));
}

bool weir_particle_arrays_make(WeirParticleArrays *arrays, uint32_t count)
{
    size_t size = (size_t)count + WEIR_PAIRS_PADDING;
    arrays->x = make_block(4, size);
    arrays->id = calloc(size, sizeof *arrays->id);
    if (!arrays->x || !arrays->id) return false;
    arrays->y = arrays->x + size;
    arrays->vx = arrays->y + size;
    arrays->vy = arrays->vx + size;
    return true;
}

bool weir_sum_arrays_make(WeirSumArrays *arrays, uint32_t count)
{
    size_t size = (size_t)count + WEIR_PAIRS_PADDING;
    arrays->density = make_block(6, size);
    if (!arrays->density) return false;
    arrays->pressure = arrays->density + size;
    arrays->pressure_term = arrays->pressure + size;
    arrays->inverse_density = arrays->pressure_term + size;
    arrays->ax = arrays->inverse_density + size;
    arrays->ay = arrays->ax + size;
    return true;
}

bool weir_host_arrays_make(WeirHostArrays *arrays, uint32_t count)
{
    size_t size = count;
    arrays->position = make_block(8, size);
    if (!arrays->position) return false;
    arrays->velocity = arrays->position + 2 * size;
    arrays->acceleration = arrays->velocity + 2 * size;
    arrays->density = arrays->acceleration + 2 * size;
    arrays->pressure = arrays->density + size;
    return true;
}

void weir_particle_arrays_free(WeirParticleArrays *arrays)
{
    free(arrays->x);
    free(arrays->id);
}

void weir_sum_arrays_free(WeirSumArrays *arrays)
{
    free(arrays->density);
}

void weir_host_arrays_free(WeirHostArrays *arrays)
{
    free(arrays->position);
}

WeirState weir_host_state(const WeirHostArrays *arrays, uint32_t count, uint64_t step)
{
    return (WeirState){
        .count = count,
        .dimension = 2,
        .step = step,
        .position = arrays->position,
        .velocity = arrays->velocity,
        .acceleration = arrays->acceleration,
        .density = arrays->density,
        .pressure = arrays->pressure,
        .time = -1.0,
    };
}
