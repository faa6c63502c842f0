// Named lists of cases: `weir bench --suite NAME`.
#pragma once

#include "bench_scene.h"

typedef struct WeirBenchItem {
    const char *name; // of a WeirBenchCase
    uint32_t count;   // particles of fluid
    int against;      // item whose time per particle is 1 in the column "relative"; negative: none
} WeirBenchItem;

typedef struct WeirBenchSuite {
    const char *name, *help;
    const WeirBenchItem *items;
    size_t item_count;
} WeirBenchSuite;

// Names of all suites, separated by '|'.
#define WEIR_BENCH_SUITES "quick|step|calm|scaling|nasty|default"

// NULL if there is none of that name.
const WeirBenchSuite *weir_bench_suite(const char *name);
