// The scenes that `weir bench` measures, with any number of particles.
#pragma once

#include "weir/weir.h"

typedef enum WeirBenchCase {
    WEIR_BENCH_ARTICLE, // the tutorial's parameters; every particle has about 130 neighbours
    WEIR_BENCH_N20, // support radius of 2.5 spacings: about 20 neighbours, for comparisons with other codes
    // wcsph with about 20 (2D) and 39 (3D) neighbours:
    WEIR_BENCH_BLOCK_2D, // a block that floats in space, without walls
    WEIR_BENCH_BLOCK_3D,
    WEIR_BENCH_DAM_2D, // a column about to collapse, in a tank of wall particles
    WEIR_BENCH_DAM_3D,
} WeirBenchCase;

// A block of exactly `count` particles (wcsph: about as many) at rest in the lower left corner of a tank, about to fall
// apart (a dam break). NULL if memory runs out; otherwise weir_scene_check() has the last word.
// Whether it is one of wcsph.
bool weir_bench_is_wcsph(WeirBenchCase bench_case);
WeirScene *weir_bench_scene(WeirBenchCase bench_case, uint32_t count);
