// Test bodies that hold for every backend, in groups. They use the public API and core/sim.h only, and small
// particle counts, so that a software GPU takes seconds.
//
//   int main(int argc, char **argv) { return weir_shared_main(argc, argv, weir_cpu_backend()); }
#pragma once

#include "weir/weir.h"

typedef struct WeirSharedTest {
    const char *name;
    void (*run)(const WeirBackend *backend);
} WeirSharedTest;

typedef struct WeirSharedGroup {
    const char *name;
    const WeirSharedTest *tests;
    size_t count;
} WeirSharedGroup;

// Runs the groups named on the command line, all if none is named. Returns the number of failed tests, or 1
// for an unknown group.
int weir_shared_main(int argc, char **argv, const WeirBackend *backend);

#define WEIR_SHARED_TEST(function) {#function, function}
#define WEIR_SHARED_GROUP(name, tests)                                                                       \
    const WeirSharedGroup weir_shared_##name = {#name, tests, sizeof tests / sizeof tests[0]}
