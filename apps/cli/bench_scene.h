// The scenes that `weir bench` measures, with any number of particles.
#pragma once

#include "weir/weir.h"

typedef enum WeirBenchCase {
    WEIR_BENCH_ARTICLE, // the tutorial's parameters; every particle has about 130 neighbours
    WEIR_BENCH_N20, // support radius of 2.5 spacings: about 20 neighbours, for comparisons with other codes
} WeirBenchCase;

// A block of exactly `count` particles at rest in the lower left corner of a tank, about to fall apart (a dam
// break). NULL if memory runs out; otherwise weir_scene_check() has the last word.
WeirScene *weir_bench_scene(WeirBenchCase bench_case, uint32_t count);
