// Chooses the variant of what is compiled once per instruction set for the processor at hand.
#include "core/cpu/pairs.h"
#include "core/cpu/wcsph.h"

extern const WeirPairPasses weir_pair_passes_base;
extern const WeirWcsphPasses weir_wcsph_passes_base;
extern const WeirWcsphMotion weir_wcsph_motion_base;

#if defined(WEIR_SIMD_AVX2)
extern const WeirPairPasses weir_pair_passes_avx2, weir_pair_passes_avx512, weir_pair_passes_avx512vl;
extern const WeirWcsphPasses weir_wcsph_passes_avx2, weir_wcsph_passes_avx512, weir_wcsph_passes_avx512vl;
extern const WeirWcsphMotion weir_wcsph_motion_avx2, weir_wcsph_motion_avx512, weir_wcsph_motion_avx512vl;

// Eight lanes' particles lie closer together than sixteen's, and have fewer candidates that only some of them see: below so many
// neighbours they are faster (docs/performance/tries.md).
static double few_neighbors(uint32_t dimension)
{
    return dimension == 3 ? 64.0 : 32.0;
}

#define WIDEST(name)                                                                                         \
    (__builtin_cpu_init(), __builtin_cpu_supports("avx512f") ? &name##_avx512                                \
                           : __builtin_cpu_supports("avx2")  ? &name##_avx2                                  \
                                                             : &name##_base)
#define BEST(name, dimension, neighbors)                                                                     \
    ((neighbors) < few_neighbors(dimension) && (__builtin_cpu_init(), __builtin_cpu_supports("avx512vl"))    \
         ? &name##_avx512vl                                                                                  \
         : WIDEST(name))
#else
#define WIDEST(name)                     &name##_base
#define BEST(name, dimension, neighbors) ((void)(dimension), (void)(neighbors), &name##_base)
#endif

const WeirPairPasses *weir_pair_passes(double neighbors)
{
    return BEST(weir_pair_passes, 2, neighbors);
}

const WeirWcsphPasses *weir_wcsph_passes(uint32_t dimension, double neighbors)
{
    return BEST(weir_wcsph_passes, dimension, neighbors);
}

const WeirWcsphMotion *weir_wcsph_motion(uint32_t dimension, double neighbors)
{
    return BEST(weir_wcsph_motion, dimension, neighbors);
}
