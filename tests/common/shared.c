#include "common/shared.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/check.h"

extern const WeirSharedGroup weir_shared_lattice, weir_shared_neighbors, weir_shared_conservation,
    weir_shared_motion, weir_shared_walls, weir_shared_trouble, weir_shared_diagnostics,
    weir_shared_lifecycle, weir_shared_tools, weir_shared_terms, weir_shared_flow, weir_shared_rigid,
    weir_shared_emitters, weir_shared_probes;

static const WeirSharedGroup *const groups[] = {
    &weir_shared_lattice, &weir_shared_neighbors, &weir_shared_conservation, &weir_shared_motion,
    &weir_shared_walls,   &weir_shared_trouble,   &weir_shared_diagnostics,  &weir_shared_lifecycle,
    &weir_shared_tools,   &weir_shared_terms,     &weir_shared_flow,         &weir_shared_emitters,
    &weir_shared_probes,  &weir_shared_rigid,
};
enum { GROUP_COUNT = sizeof groups / sizeof groups[0] };

typedef struct BoundTest {
    const WeirSharedTest *test;
    const WeirBackend *backend;
} BoundTest;

static void run_bound(void **state)
{
    const BoundTest *bound = *state;
    bound->test->run(bound->backend);
}

static int run_group(const WeirSharedGroup *group, const WeirBackend *backend)
{
    struct CMUnitTest *tests = calloc(group->count, sizeof *tests);
    BoundTest *bound = calloc(group->count, sizeof *bound);
    int failed = 1;
    if (tests && bound) {
        for (size_t n = 0; n < group->count; ++n) {
            bound[n] = (BoundTest){&group->tests[n], backend};
            tests[n] = (struct CMUnitTest){
                .name = group->tests[n].name, .test_func = run_bound, .initial_state = &bound[n]};
        }
        failed = _cmocka_run_group_tests(group->name, tests, group->count, NULL, NULL);
    }
    free(bound);
    free(tests);
    return failed;
}

int weir_shared_main(int argc, char **argv, const WeirBackend *backend)
{
    int failed = 0;
    for (int a = 1; a < argc; ++a) {
        bool found = false;
        for (int g = 0; g < GROUP_COUNT; ++g) {
            if (strcmp(argv[a], groups[g]->name) != 0) continue;
            failed += run_group(groups[g], backend);
            found = true;
        }
        if (!found) {
            fprintf(stderr, "%s: no such group of tests\n", argv[a]);
            return 1;
        }
    }
    for (int g = 0; argc < 2 && g < GROUP_COUNT; ++g) failed += run_group(groups[g], backend);
    return failed;
}
