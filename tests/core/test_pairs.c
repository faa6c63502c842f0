// The pair passes have the same bits for every instruction set and every way to cut the particles into
// pieces; the pool hands out every item exactly once.
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/cpu/pairs.h"
#include "core/cpu/pool.h"
#include "core/grid.h"

extern const WeirPairPasses weir_pair_passes_base;
#if defined(__x86_64__)
extern const WeirPairPasses weir_pair_passes_avx2, weir_pair_passes_avx512, weir_pair_passes_avx512vl;
#endif

// Variants that this processor runs, the base first.
static int runnable_variants(const WeirPairPasses *variants[4])
{
    int count = 0;
    variants[count++] = &weir_pair_passes_base;
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) variants[count++] = &weir_pair_passes_avx2;
    if (__builtin_cpu_supports("avx512f")) variants[count++] = &weir_pair_passes_avx512;
    if (__builtin_cpu_supports("avx512vl")) variants[count++] = &weir_pair_passes_avx512vl;
#endif
    return count;
}

enum { COUNT = 1237, PADDED = COUNT + WEIR_PAIRS_PADDING, RESULTS = 6 };

typedef struct Fixture {
    WeirParameters parameters;
    WeirConstants constants;
    float particles[4][PADDED]; // x, y, vx, vy, sorted by cell
    uint32_t *cell_start;
} Fixture;

typedef struct Results {
    float values[RESULTS][PADDED];
} Results;

static int compare_cells(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// A dense clump, a thin spray and an empty part, so that vectors are cut at all lengths.
static Fixture *make_fixture(uint32_t kernels, uint32_t search)
{
    static float drawn[4][COUNT];
    static uint64_t keys[COUNT];
    Fixture *fixture = calloc(1, sizeof *fixture);
    assert_non_null(fixture);
    weir_parameters_default(&fixture->parameters);
    fixture->parameters.kernels = kernels;
    fixture->parameters.search = search;
    fixture->parameters.particle_spacing = 0.02f;
    fixture->parameters.support_radius = 0.053f;
    fixture->parameters.negative_pressure = 0.3f;
    WeirScene *scene = weir_scene_create();
    assert_non_null(scene);
    assert_int_equal(weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){2, 1, 0}), WEIR_OK);
    weir_constants_make(&fixture->constants, scene, &fixture->parameters, COUNT, NULL);
    weir_scene_destroy(scene);
    const WeirConstants *constants = &fixture->constants;
    fixture->cell_start = calloc((size_t)constants->cell_count + 1, sizeof(uint32_t));
    assert_non_null(fixture->cell_start);
    WeirRandom random = {.state = 77};
    for (uint32_t i = 0; i < COUNT; ++i) {
        double size = i % 3 ? 0.4 : 1;
        drawn[0][i] = (float)weir_random_range(&random, 0, 1.6 * size);
        drawn[1][i] = (float)weir_random_range(&random, 0, size);
        drawn[2][i] = (float)weir_random_range(&random, -2, 2);
        drawn[3][i] = (float)weir_random_range(&random, -2, 2);
        uint32_t cell = weir_grid_cell_at(constants, drawn[0][i], drawn[1][i]);
        ++fixture->cell_start[cell + 1];
        keys[i] = (uint64_t)cell << 32 | i;
    }
    for (uint32_t cell = 0; cell < constants->cell_count; ++cell)
        fixture->cell_start[cell + 1] += fixture->cell_start[cell];
    qsort(keys, COUNT, sizeof keys[0], compare_cells);
    for (uint32_t k = 0; k < COUNT; ++k)
        for (int field = 0; field < 4; ++field)
            fixture->particles[field][k] = drawn[field][(uint32_t)keys[k]];
    return fixture;
}

static void run_variant(Fixture *fixture, const WeirPairPasses *passes, uint32_t chunk, Results *results)
{
    memset(results, 0, sizeof *results);
    WeirPairData data = {
        .parameters = &fixture->parameters,
        .constants = &fixture->constants,
        .cell_start = fixture->cell_start,
        .x = fixture->particles[0],
        .y = fixture->particles[1],
        .vx = fixture->particles[2],
        .vy = fixture->particles[3],
        .density = results->values[0],
        .pressure = results->values[1],
        .pressure_term = results->values[2],
        .inverse_density = results->values[3],
        .ax = results->values[4],
        .ay = results->values[5],
    };
    for (uint32_t begin = 0; begin < COUNT; begin += chunk)
        passes->density(&data, begin, begin + chunk < COUNT ? begin + chunk : COUNT);
    for (uint32_t begin = 0; begin < COUNT; begin += chunk)
        passes->forces(&data, begin, begin + chunk < COUNT ? begin + chunk : COUNT);
}

static void check_variants(uint32_t kernels, uint32_t search)
{
    static const uint32_t chunks[] = {COUNT, 512, 7, 1};
    static Results first, other;
    const WeirPairPasses *variants[4];
    int count = runnable_variants(variants);
    Fixture *fixture = make_fixture(kernels, search);
    run_variant(fixture, variants[0], COUNT, &first);
    for (int i = 0; i < COUNT; ++i) assert_true(first.values[0][i] > 0);
    for (int variant = 0; variant < count; ++variant) {
        for (size_t n = 0; n < sizeof chunks / sizeof chunks[0]; ++n) {
            run_variant(fixture, variants[variant], chunks[n], &other);
            for (int result = 0; result < RESULTS; ++result) {
                if (memcmp(first.values[result], other.values[result], COUNT * sizeof(float)) != 0)
                    fail_msg("%s, pieces of %u, result %d differs from %s", variants[variant]->simd,
                             (unsigned)chunks[n], result, variants[0]->simd);
                // Nothing is written past the particles.
                for (int k = COUNT; k < PADDED; ++k) CHECK_NEAR(other.values[result][k], 0, 0);
            }
        }
    }
    free(fixture->cell_start);
    free(fixture);
}

static void every_instruction_set_has_the_same_bits(void **state)
{
    (void)state;
    check_variants(WEIR_KERNELS_CONSISTENT, WEIR_SEARCH_GRID);
    check_variants(WEIR_KERNELS_TUTORIAL, WEIR_SEARCH_GRID);
    check_variants(WEIR_KERNELS_CONSISTENT, WEIR_SEARCH_ALL_PAIRS);
    check_variants(WEIR_KERNELS_TUTORIAL, WEIR_SEARCH_ALL_PAIRS);
}

// ---- Pool ----

enum { MOST_ITEMS = 5000 };

typedef struct Visits {
    atomic_uint count[MOST_ITEMS];
    uint32_t chunk;
} Visits;

static void visit(void *context, uint32_t begin, uint32_t end)
{
    Visits *visits = context;
    if (end <= begin || end - begin > visits->chunk) return; // seen as missing visits
    for (uint32_t i = begin; i < end; ++i) atomic_fetch_add(&visits->count[i], 1);
}

static void pool_visits_every_item_once(void **state)
{
    (void)state;
    static const uint32_t threads[] = {1, 2, 3, 7, 16}, items[] = {0, 1, 2, 63, 64, 65, 512, MOST_ITEMS},
                          chunks[] = {1, 64, 512, 100000};
    static Visits visits;
    for (int t = 0; t < 5; ++t) {
        WeirPool *pool = weir_pool_create(threads[t]);
        assert_non_null(pool);
        for (int repeat = 0; repeat < 20; ++repeat) {
            uint32_t count = items[repeat % 8];
            memset(&visits, 0, sizeof visits);
            uint32_t chunk = chunks[repeat % 4];
            visits.chunk = threads[t] == 1 ? MOST_ITEMS : chunk; // one thread has nobody to share with
            weir_pool_run(pool, count, chunk, visit, &visits);
            for (uint32_t i = 0; i < MOST_ITEMS; ++i) assert_int_equal(visits.count[i], i < count);
        }
        weir_pool_destroy(pool);
    }
    weir_pool_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_has_the_same_bits),
        cmocka_unit_test(pool_visits_every_item_once),
    };
    return cmocka_run_group_tests_name("pairs", tests, NULL, NULL);
}
