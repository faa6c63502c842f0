// Chooses the variant of what is compiled once per instruction set for the processor at hand.
#include "core/cpu/pairs.h"
#include "core/cpu/wcsph.h"

extern const WeirPairPasses weir_pair_passes_base;
extern const WeirWcsphPasses weir_wcsph_passes_base;
extern const WeirWcsphMotion weir_wcsph_motion_base;

#if defined(WEIR_SIMD_AVX2)
extern const WeirPairPasses weir_pair_passes_avx2, weir_pair_passes_avx512;
extern const WeirWcsphPasses weir_wcsph_passes_avx2, weir_wcsph_passes_avx512;
extern const WeirWcsphMotion weir_wcsph_motion_avx2, weir_wcsph_motion_avx512;

#define WIDEST(name)                                                                                         \
    (__builtin_cpu_init(), __builtin_cpu_supports("avx512f") ? &name##_avx512                                \
                           : __builtin_cpu_supports("avx2")  ? &name##_avx2                                  \
                                                             : &name##_base)
#else
#define WIDEST(name) &name##_base
#endif

const WeirPairPasses *weir_pair_passes(void)
{
    return WIDEST(weir_pair_passes);
}

const WeirWcsphPasses *weir_wcsph_passes(void)
{
    return WIDEST(weir_wcsph_passes);
}

const WeirWcsphMotion *weir_wcsph_motion(void)
{
    return WIDEST(weir_wcsph_motion);
}
