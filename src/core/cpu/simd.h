// Vectors of floats as wide as the target has them, with AVX-512 also half as wide (dispatch.c), on compiler vector types
// (gcc, clang). Only operations that IEEE 754 rounds exactly: a lane gives the same bits at any width, so the width is free
// to differ between targets.
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512VL__)
enum { WEIR_LANES = 8 };
#define WEIR_SIMD_NAME "AVX-512, 8 lanes"
#elif defined(__AVX512F__)
enum { WEIR_LANES = 16 };
#define WEIR_SIMD_NAME "AVX-512"
#elif defined(__AVX2__)
enum { WEIR_LANES = 8 };
#define WEIR_SIMD_NAME "AVX2"
#elif defined(__SSE2__)
enum { WEIR_LANES = 4 };
#define WEIR_SIMD_NAME "SSE2"
#elif defined(__wasm_simd128__)
enum { WEIR_LANES = 4 };
#define WEIR_SIMD_NAME "wasm SIMD"
#elif defined(__ARM_NEON)
enum { WEIR_LANES = 4 };
#define WEIR_SIMD_NAME "NEON"
#else
enum { WEIR_LANES = 4 };
#define WEIR_SIMD_NAME "no SIMD"
#endif

typedef float WeirLanes __attribute__((vector_size(4 * WEIR_LANES)));
typedef int32_t WeirMask __attribute__((vector_size(4 * WEIR_LANES)));

// Beside these, per target: weir_lanes_sqrt, weir_lanes_max, weir_lanes_min, weir_mask_any (is a lane set?) and weir_lanes_any_below
// (a < b in at least one lane). weir_lanes_store_where stores the lanes whose mask is set.
static inline WeirLanes weir_lanes_load(const float *values)
{
    WeirLanes lanes;
    memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

static inline WeirLanes weir_lanes_fill(float value)
{
    return value - (WeirLanes){0};
}

static inline WeirMask weir_mask_load(const int32_t *values)
{
    WeirMask mask;
    memcpy(&mask, values, sizeof mask);
    return mask;
}

static inline void weir_lanes_store(float *values, WeirLanes a)
{
    memcpy(values, &a, sizeof a);
}

static inline void weir_mask_store(int32_t *values, WeirMask a)
{
    memcpy(values, &a, sizeof a);
}

// Lanes below `count` set.
static inline WeirMask weir_mask_first(uint32_t count)
{
    static const int32_t set[32] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    return weir_mask_load(set + 16 - (count < WEIR_LANES ? count : WEIR_LANES));
}

static inline WeirLanes weir_lanes_abs(WeirLanes a)
{
    return (WeirLanes)((WeirMask)a & 0x7FFFFFFF);
}

// To the nearest whole number, ties to even: adding 2^23 leaves no place for a fraction.
static inline WeirLanes weir_lanes_round(WeirLanes a)
{
    const WeirLanes large = weir_lanes_fill(8388608.0f), size = weir_lanes_abs(a);
    WeirLanes rounded = (size + large) - large;
    WeirMask fraction = (WeirMask)(size < large), sign = (WeirMask)a & ~0x7FFFFFFF;
    return (WeirLanes)((((WeirMask)rounded & fraction) | ((WeirMask)size & ~fraction)) | sign);
}

// a where the mask is set, b elsewhere.
static inline WeirLanes weir_lanes_select(WeirMask mask, WeirLanes a, WeirLanes b)
{
    return (WeirLanes)((mask & (WeirMask)a) | (~mask & (WeirMask)b));
}

#if defined(__AVX512F__) && !defined(__AVX512VL__)
#include <immintrin.h>
static inline WeirLanes weir_lanes_sqrt(WeirLanes a)
{
    return (WeirLanes)_mm512_sqrt_ps((__m512)a);
}
static inline WeirLanes weir_lanes_max(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)_mm512_max_ps((__m512)a, (__m512)b);
}
static inline WeirLanes weir_lanes_min(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)_mm512_min_ps((__m512)a, (__m512)b);
}
static inline bool weir_mask_any(WeirMask mask)
{
    return _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask) != 0;
}
static inline bool weir_lanes_any_below(WeirLanes a, WeirLanes b)
{
    return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ) != 0;
}
static inline void weir_lanes_store_where(float *values, WeirLanes a, WeirMask mask)
{
    __mmask16 set = _mm512_test_epi32_mask((__m512i)mask, (__m512i)mask);
    _mm512_mask_storeu_ps(values, set, (__m512)a);
}
#elif defined(__AVX2__)
#include <immintrin.h>
static inline WeirLanes weir_lanes_sqrt(WeirLanes a)
{
    return (WeirLanes)_mm256_sqrt_ps((__m256)a);
}
static inline WeirLanes weir_lanes_max(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)_mm256_max_ps((__m256)a, (__m256)b);
}
static inline WeirLanes weir_lanes_min(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)_mm256_min_ps((__m256)a, (__m256)b);
}
#if defined(__AVX512VL__)
static inline bool weir_mask_any(WeirMask mask)
{
    return _mm256_test_epi32_mask((__m256i)mask, (__m256i)mask) != 0;
}
static inline bool weir_lanes_any_below(WeirLanes a, WeirLanes b)
{
    return _mm256_cmp_ps_mask((__m256)a, (__m256)b, _CMP_LT_OQ) != 0;
}
static inline void weir_lanes_store_where(float *values, WeirLanes a, WeirMask mask)
{
    _mm256_mask_storeu_ps(values, _mm256_test_epi32_mask((__m256i)mask, (__m256i)mask), (__m256)a);
}
#else
static inline bool weir_mask_any(WeirMask mask)
{
    return !_mm256_testz_si256((__m256i)mask, (__m256i)mask);
}
static inline bool weir_lanes_any_below(WeirLanes a, WeirLanes b)
{
    return _mm256_movemask_ps(_mm256_cmp_ps((__m256)a, (__m256)b, _CMP_LT_OQ)) != 0;
}
static inline void weir_lanes_store_where(float *values, WeirLanes a, WeirMask mask)
{
    _mm256_maskstore_ps(values, (__m256i)mask, (__m256)a);
}
#endif
#elif defined(__SSE2__)
#include <emmintrin.h>
static inline WeirLanes weir_lanes_sqrt(WeirLanes a)
{
    return (WeirLanes)_mm_sqrt_ps((__m128)a);
}
static inline WeirLanes weir_lanes_max(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)_mm_max_ps((__m128)a, (__m128)b);
}
static inline WeirLanes weir_lanes_min(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)_mm_min_ps((__m128)a, (__m128)b);
}
static inline bool weir_mask_any(WeirMask mask)
{
    return _mm_movemask_epi8(_mm_cmpeq_epi32((__m128i)mask, _mm_setzero_si128())) != 0xFFFF;
}
static inline bool weir_lanes_any_below(WeirLanes a, WeirLanes b)
{
    return _mm_movemask_ps(_mm_cmplt_ps((__m128)a, (__m128)b)) != 0;
}
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
static inline WeirLanes weir_lanes_sqrt(WeirLanes a)
{
    return (WeirLanes)wasm_f32x4_sqrt((v128_t)a);
}
static inline WeirLanes weir_lanes_max(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
static inline WeirLanes weir_lanes_min(WeirLanes a, WeirLanes b)
{
    return (WeirLanes)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
static inline bool weir_mask_any(WeirMask mask)
{
    return wasm_v128_any_true((v128_t)mask);
}
static inline bool weir_lanes_any_below(WeirLanes a, WeirLanes b)
{
    return wasm_v128_any_true(wasm_f32x4_lt((v128_t)a, (v128_t)b));
}
#else
#include <math.h>
static inline WeirLanes weir_lanes_sqrt(WeirLanes a)
{
    for (int lane = 0; lane < WEIR_LANES; ++lane) a[lane] = sqrtf(a[lane]);
    return a;
}
// a where a > b, else b: also for NaN, as the instructions above do.
static inline WeirLanes weir_lanes_max(WeirLanes a, WeirLanes b)
{
    WeirMask greater = (WeirMask)(a > b);
    return (WeirLanes)((greater & (WeirMask)a) | (~greater & (WeirMask)b));
}
static inline WeirLanes weir_lanes_min(WeirLanes a, WeirLanes b)
{
    WeirMask less = (WeirMask)(a < b);
    return (WeirLanes)((less & (WeirMask)a) | (~less & (WeirMask)b));
}
static inline bool weir_mask_any(WeirMask mask)
{
    int32_t any = 0;
    for (int lane = 0; lane < WEIR_LANES; ++lane) any |= mask[lane];
    return any != 0;
}
static inline bool weir_lanes_any_below(WeirLanes a, WeirLanes b)
{
    return weir_mask_any((WeirMask)(a < b));
}
#endif

// Lanes whose mask is not set may be another thread's: they are not even written back. (wasm has one thread. Lane by lane,
// compilers work `a` out once per lane, in the branches.)
#if defined(__wasm_simd128__)
static inline void weir_lanes_store_where(float *values, WeirLanes a, WeirMask mask)
{
    weir_lanes_store(values, weir_lanes_select(mask, a, weir_lanes_load(values)));
}
#elif !defined(__AVX2__)
static inline void weir_lanes_store_where(float *values, WeirLanes a, WeirMask mask)
{
    if (!weir_mask_any(~mask)) {
        weir_lanes_store(values, a);
        return;
    }
    for (int lane = 0; lane < WEIR_LANES; ++lane) {
        if (mask[lane]) values[lane] = a[lane];
    }
}
#endif
