// The scenes that `weir bench` measures, with any number of particles.
#pragma once

#include "weir/weir.h"

typedef enum WeirBenchKind {
    // mueller
    WEIR_BENCH_ARTICLE, // the tutorial's parameters; every particle has about 130 neighbours
    WEIR_BENCH_N20, // support radius of 2.5 spacings: about 20 neighbours, for comparisons with other codes
    // wcsph
    WEIR_BENCH_BLOCK,      // a block that floats in space, without walls
    WEIR_BENCH_DAM,        // a column about to collapse, in a tank of wall particles
    WEIR_BENCH_COMPRESSED, // a block pressed to three times its density
    WEIR_BENCH_SPLASH,     // the same when it has hit the other side
    WEIR_BENCH_POOL,       // at rest in such a tank, with a free surface
    WEIR_BENCH_BOX,        // a closed box of wall particles, full, stirred by vortices at Mach 0.1
    WEIR_BENCH_CALM, // the same at Mach 0.033: a step moves no particle by more than a hundredth of the support
    WEIR_BENCH_CORNER,   // a block in 1 % of its domain
    WEIR_BENCH_FAR,      // a block, and one fast particle 30 of its sides away along each axis
    WEIR_BENCH_THIN,     // a sheet (3D: a rod) 1000 times as long as high
    WEIR_BENCH_EMITTERS, // a pool under one emitter per 1000 particles, at most as many as a scene may have
} WeirBenchKind;

typedef struct WeirBenchCase {
    const char *name;
    WeirBenchKind kind;
    uint32_t dimension;
    double support; // in spacings; 0: the default of wcsph
} WeirBenchCase;

// Names of all cases, separated by '|'.
#define WEIR_BENCH_CASES                                                                                     \
    "article|n20|block_2d|block_3d|dam_2d|dam_3d|splash_2d|splash_3d|pool_2d|pool_3d|box_2d|box_3d|"         \
    "calm_2d|calm_3d|box_2d_n45|box_3d_n111|box_3d_n165|corner_2d|corner_3d|far_2d|far_3d|thin_2d|thin_3d|"  \
    "emitters_2d|emitters_3d|compressed_2d|compressed_3d"

// NULL if there is none of that name.
const WeirBenchCase *weir_bench_case(const char *name);
bool weir_bench_is_wcsph(const WeirBenchCase *bench_case);
// True if every batch of steps starts from the same fluid, for the fluid changes at once; otherwise they follow one another.
bool weir_bench_starts_anew(const WeirBenchCase *bench_case);
// True if the fluid calms down, so that what is measured depends on the steps before.
bool weir_bench_is_stirred(const WeirBenchCase *bench_case);
// A block of exactly `count` particles (wcsph: about as many). NULL if memory runs out; otherwise weir_scene_check()
// has the last word.
WeirScene *weir_bench_scene(const WeirBenchCase *bench_case, uint32_t count);
// From the scene's start to what is measured: vortices, compression, the splash.
WeirStatus weir_bench_prepare(const WeirBenchCase *bench_case, WeirSim *sim);
