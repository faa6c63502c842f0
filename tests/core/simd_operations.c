// What core/cpu/simd.h promises, lane by lane against plain C: compiled once per instruction set, as the pair passes are, with its
// function's name in WEIR_TEST_SIMD (test_simd.c calls them).
#include "core/cpu/simd.h"

#include <math.h>

#ifndef WEIR_TEST_SIMD
#define WEIR_TEST_SIMD weir_test_simd_base
#endif
const char *WEIR_TEST_SIMD(void);

static const float samples[] = {0.0f,       -0.0f, 1.0f,     -1.0f,     0.5f, -0.5f,  1.5f, 2.5f,  -2.5f,
                                8388607.5f, 1e30f, INFINITY, -INFINITY, NAN,  1e-40f, 7.3f, -0.3f, 3e9f};
enum { SAMPLES = sizeof samples / sizeof samples[0] };

// Lane k has sample `first + step k`.
static WeirLanes lanes_of(uint32_t first, uint32_t step)
{
    WeirLanes lanes;
    for (uint32_t lane = 0; lane < WEIR_LANES; ++lane) lanes[lane] = samples[(first + step * lane) % SAMPLES];
    return lanes;
}

static bool same_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

// Where an operand is NaN, or both are zeros, the second one is the result.
static const char *compare_pairs(WeirLanes a, WeirLanes b)
{
    WeirLanes largest = weir_lanes_max(a, b), least = weir_lanes_min(a, b);
    WeirLanes chosen = weir_lanes_select((WeirMask)(a < b), a, b);
    bool any = false;
    for (uint32_t lane = 0; lane < WEIR_LANES; ++lane) {
        float x = a[lane], y = b[lane];
        any |= x < y;
        if (!same_bits(largest[lane], x > y ? x : y)) return "weir_lanes_max";
        if (!same_bits(least[lane], x < y ? x : y)) return "weir_lanes_min";
        if (!same_bits(chosen[lane], x < y ? x : y)) return "weir_lanes_select";
    }
    return weir_lanes_any_below(a, b) == any ? NULL : "weir_lanes_any_below";
}

static const char *compare_single(WeirLanes a)
{
    WeirLanes size = weir_lanes_abs(a), root = weir_lanes_sqrt(size), whole = weir_lanes_round(a);
    for (uint32_t lane = 0; lane < WEIR_LANES; ++lane) {
        float x = a[lane];
        if (isnan(x)) continue;
        if (!same_bits(size[lane], fabsf(x))) return "weir_lanes_abs";
        if (!same_bits(root[lane], sqrtf(fabsf(x)))) return "weir_lanes_sqrt";
        if (!same_bits(whole[lane], rintf(x))) return "weir_lanes_round";
    }
    return NULL;
}

// Lane k is set where bit k is.
static const char *compare_masks(uint32_t bits)
{
    enum { BEFORE = 3, ROOM = WEIR_LANES + 2 * BEFORE };
    float values[ROOM];
    WeirMask mask;
    for (uint32_t k = 0; k < ROOM; ++k) values[k] = -1.0f;
    for (uint32_t lane = 0; lane < WEIR_LANES; ++lane) mask[lane] = bits >> lane & 1 ? -1 : 0;
    if (weir_mask_any(mask) != (bits != 0)) return "weir_mask_any";
    weir_lanes_store_where(values + BEFORE, weir_lanes_fill(2.0f), mask);
    for (uint32_t k = 0; k < ROOM; ++k) {
        bool set = k >= BEFORE && k < BEFORE + WEIR_LANES && bits >> (k - BEFORE) & 1;
        if (values[k] != (set ? 2.0f : -1.0f)) return "weir_lanes_store_where";
    }
    return NULL;
}

// The name of an operation that does not do what it should, or NULL.
const char *WEIR_TEST_SIMD(void)
{
    const char *wrong = NULL;
    for (uint32_t n = 0; n < SAMPLES && !wrong; ++n) {
        wrong = compare_single(lanes_of(n, 1));
        for (uint32_t step = 0; step < SAMPLES && !wrong; ++step)
            wrong = compare_pairs(lanes_of(n, 1), lanes_of(n + step, step));
    }
    for (uint32_t bits = 0; bits < 1u << WEIR_LANES && !wrong; ++bits) wrong = compare_masks(bits);
    for (uint32_t count = 0; count <= WEIR_LANES + 1 && !wrong; ++count) {
        WeirMask mask = weir_mask_first(count);
        for (uint32_t lane = 0; lane < WEIR_LANES; ++lane)
            if ((mask[lane] != 0) != (lane < count)) wrong = "weir_mask_first";
    }
    return wrong;
}
