// One measured row of `weir bench`.
#pragma once

#include "bench_scene.h"

enum { WEIR_BENCH_PASSES = 32 };

typedef struct WeirBenchRow {
    char scene[64], backend[8], device[128], search[32];
    uint32_t particles; // fluid
    uint32_t all;       // walls and empty slots too
    uint32_t threads, repetitions;
    double mean_neighbors, candidates;
    double ms_per_step; // median over the repetitions
    double spread;      // (slowest - fastest) / median
    double particle_steps_per_second, pairs_per_second;
    double bytes_per_particle; // of all particles: on the device, or what the process allocated
    double time_step, real_time_factor, frames_per_second;
    double relative; // time per fluid particle over that of the suite's reference row; NaN: none
    WeirPassTime passes[WEIR_BENCH_PASSES];
    uint32_t pass_count;
} WeirBenchRow;

typedef struct WeirBenchEffort {
    double seconds;       // for the repetitions of a row
    uint32_t repetitions; // at least; a step that alone takes longer than `seconds` is measured once
} WeirBenchEffort;

// Measures the scene. `bench_case` NULL: a scene file. On failure a message goes to standard error.
WeirStatus weir_bench_measure(const WeirScene *scene, const WeirBenchCase *bench_case,
                              const WeirSimOptions *options, const WeirBenchEffort *effort,
                              WeirBenchRow *row);
