#include "bench_suite.h"

#include <string.h>

#define K 1000u
#define M 1000000u

// A minute on two cores.
static const WeirBenchItem quick[] = {
    {"article", 32768, -1},   {"box_2d", 100 * K, -1},  {"box_3d", 100 * K, -1},
    {"splash_2d", 30 * K, 1}, {"splash_3d", 30 * K, 2},
};

// The targets of docs/performance.md but for `scaling`.
static const WeirBenchItem step[] = {
    {"box_2d", 32768, -1},   {"box_2d", 100 * K, -1},    {"box_2d", 1 * M, -1}, {"box_2d", 4 * M, -1},
    {"box_3d", 100 * K, -1}, {"box_3d", 1 * M, -1},      {"box_3d", 4 * M, -1}, {"box_3d_n165", 1 * M, -1},
    {"pool_2d", 1 * M, 2},   {"splash_2d", 1 * M, 2},    {"pool_3d", 1 * M, 5}, {"splash_3d", 1 * M, 5},
    {"article", 32768, -1},  {"box_3d_n165", 4 * M, -1},
};

// The boxes of `step`, whose fluid moves no farther in a step than the prototype of docs/performance.md allows.
static const WeirBenchItem calm[] = {
    {"calm_2d", 32768, -1},   {"calm_2d", 100 * K, -1}, {"calm_2d", 1 * M, -1}, {"calm_2d", 4 * M, -1},
    {"calm_3d", 100 * K, -1}, {"calm_3d", 1 * M, -1},   {"calm_3d", 4 * M, -1},
};

// What does not fit is left out.
static const WeirBenchItem scaling[] = {
    {"box_3d", 1 * M, -1}, {"box_3d", 4 * M, 0},  {"box_3d", 16 * M, 0},
    {"box_3d", 32 * M, 0}, {"box_3d", 64 * M, 0}, {"box_3d", 100 * M, 0},
};

static const WeirBenchItem nasty[] = {
    {"block_2d", 100 * K, -1}, {"corner_2d", 100 * K, 0},   {"far_2d", 100 * K, 0},
    {"thin_2d", 100 * K, 0},   {"emitters_2d", 100 * K, 0}, {"compressed_2d", 100 * K, 0},
    {"block_3d", 100 * K, -1}, {"corner_3d", 100 * K, 6},   {"far_3d", 100 * K, 6},
    {"thin_3d", 100 * K, 6},   {"emitters_3d", 100 * K, 6}, {"compressed_3d", 100 * K, 6},
    {"block_2d", 1 * M, -1},   {"emitters_2d", 1 * M, 12}, // 1,000 of them
    {"block_3d", 1 * M, -1},   {"emitters_3d", 1 * M, 14},
};

static const WeirBenchItem defaults[] = {
    {"box_2d_n45", 100 * K, -1},
    {"box_2d_n45", 1 * M, -1},
    {"box_3d_n111", 100 * K, -1},
    {"box_3d_n111", 1 * M, -1},
};

#define SUITE(name, help, items) {name, help, items, sizeof items / sizeof items[0]}
static const WeirBenchSuite suites[] = {
    SUITE("quick", "a minute on two cores", quick),
    SUITE("step", "the targets of docs/performance.md", step),
    SUITE("calm", "the same boxes, stirred slowly", calm),
    SUITE("scaling", "3D, 1 M to 100 M particles, as many as fit", scaling),
    SUITE("nasty", "what a neighbour search may trip over", nasty),
    SUITE("default", "boxes at the default supports", defaults),
};

const WeirBenchSuite *weir_bench_suite(const char *name)
{
    for (size_t n = 0; n < sizeof suites / sizeof suites[0]; ++n)
        if (strcmp(suites[n].name, name) == 0) return &suites[n];
    return NULL;
}
