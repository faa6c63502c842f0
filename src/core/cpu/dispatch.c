// Chooses the variant of the pair passes for the processor at hand.
#include "core/cpu/pairs.h"
#include "core/cpu/wcsph_pairs.h"

extern const WeirPairPasses weir_pair_passes_base;
extern const WeirWcsphPasses weir_wcsph_passes_base;

#if defined(WEIR_PAIRS_AVX2)
extern const WeirPairPasses weir_pair_passes_avx2, weir_pair_passes_avx512;
extern const WeirWcsphPasses weir_wcsph_passes_avx2, weir_wcsph_passes_avx512;

const WeirPairPasses *weir_pair_passes(void)
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f")) return &weir_pair_passes_avx512;
    if (__builtin_cpu_supports("avx2")) return &weir_pair_passes_avx2;
    return &weir_pair_passes_base;
}

const WeirWcsphPasses *weir_wcsph_passes(void)
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f")) return &weir_wcsph_passes_avx512;
    if (__builtin_cpu_supports("avx2")) return &weir_wcsph_passes_avx2;
    return &weir_wcsph_passes_base;
}
#else
const WeirPairPasses *weir_pair_passes(void)
{
    return &weir_pair_passes_base;
}

const WeirWcsphPasses *weir_wcsph_passes(void)
{
    return &weir_wcsph_passes_base;
}
#endif
