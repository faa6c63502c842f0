// The pair passes of wcsph have the same bits for every instruction set that this processor runs, in every dimension and
// with every kernel, beside walls, and where a crowd has more candidates than `forces` keeps bits for.
#include <stdlib.h>

#include "common/build.h"
#include "core/cpu/wcsph.h"

extern const WeirWcsphPasses weir_wcsph_passes_base;
#if defined(__x86_64__)
extern const WeirWcsphPasses weir_wcsph_passes_avx2, weir_wcsph_passes_avx512, weir_wcsph_passes_avx512vl;
#endif

// Variants that this processor runs, the base first.
static int runnable_variants(const WeirWcsphPasses *variants[4])
{
    int count = 0;
    variants[count++] = &weir_wcsph_passes_base;
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) variants[count++] = &weir_wcsph_passes_avx2;
    if (__builtin_cpu_supports("avx512f")) variants[count++] = &weir_wcsph_passes_avx512;
    if (__builtin_cpu_supports("avx512vl")) variants[count++] = &weir_wcsph_passes_avx512vl;
#endif
    return count;
}

// The CPU's backend with one variant of the passes.
typedef struct OneVariant {
    WeirBackend backend;
    const WeirWcsphPasses *passes;
} OneVariant;

static WeirSolver *create_solver(const WeirBackend *backend, const WeirSolverSetup *setup, WeirStatus *status,
                                 WeirMessage *message)
{
    WeirSolver *solver = weir_cpu_backend()->create_solver(weir_cpu_backend(), setup, status, message);
    if (solver) ((WeirWcsph *)solver)->passes = ((const OneVariant *)backend)->passes;
    return solver;
}

static WeirScene *dam(uint32_t dimension, const char *kernel, double spacing)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    weir_test_choose(scene, "kernel", kernel);
    weir_scene_set_domain(scene, (double[3]){0, 0, 0}, (double[3]){1, 0.6, 0.3});
    weir_scene_add_box(scene, (double[3]){0, 0, 0}, (double[3]){0.5, 0.4, 0.3}, NULL);
    return scene;
}

static uint64_t hash_after(const WeirScene *scene, const WeirWcsphPasses *passes, bool crowd)
{
    OneVariant variant = {{.name = "cpu", .create_solver = create_solver}, passes};
    WeirSim *sim = weir_test_sim(scene, &variant.backend, 1);
    if (crowd) {
        size_t floats = (size_t)weir_sim_dimension(sim) * weir_sim_particle_count(sim);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION), *velocity = calloc(floats, sizeof(float));
        assert_non_null(velocity);
        size_t fluid = (size_t)weir_sim_dimension(sim) * weir_sim_fluid_slots(sim);
        for (size_t k = 0; k < fluid; ++k) position[k] = 0.1f + 0.1f * position[k];
        weir_test_set_state(sim, position, velocity);
        free(position);
        free(velocity);
    }
    weir_test_step(sim, crowd ? 1 : 20);
    uint64_t hash = weir_test_hash(sim);
    weir_sim_destroy(sim);
    return hash;
}

static void instruction_sets_agree(void **state)
{
    (void)state;
    static const char *const kernels[] = {"wendland", "cubic", "quintic"};
    const WeirWcsphPasses *variants[4];
    int count = runnable_variants(variants);
    for (int n = 0; n < 12; ++n) {
        double spacing =
            (n % 2 ? 0.05 : 0.02) * (n >= 6 ? 0.5 : 1); // a crowd of thousands within one support
        WeirScene *scene = dam(2 + n % 2, kernels[n / 2 % 3], spacing);
        uint64_t hash = hash_after(scene, variants[0], n >= 6);
        for (int v = 1; v < count; ++v) {
            if (hash_after(scene, variants[v], n >= 6) == hash) continue;
            fail_msg("%s differs from %s: %uD, kernel %s%s", variants[v]->simd, variants[0]->simd, 2 + n % 2,
                     kernels[n / 2 % 3], n >= 6 ? ", crowd" : "");
        }
        weir_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(instruction_sets_agree)};
    return cmocka_run_group_tests_name("wcsph_simd", tests, NULL, NULL);
}
