// The colour maps by themselves: lightness, range, and what the shaders get.
#include <math.h>

#include "common/check.h"
#include "render/color_map.h"

static double linear(uint8_t byte)
{
    double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

// CIE L* of sRGB bytes: another measure of lightness than the OKLab that the maps are made with.
static double lightness(const uint8_t rgb[3])
{
    double y = 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
    return y > 0.008856 ? 116 * cbrt(y) - 16 : 903.3 * y;
}

static double lightness_at(WeirColorBy color_by, double t)
{
    uint8_t rgb[3];
    weir_color_map(color_by, (float)t, rgb);
    return lightness(rgb);
}

// Lightness never falls by more than the rounding to bytes makes it, and rises over each eighth of the map.
static void check_rises(WeirColorBy color_by, double from, double to)
{
    for (int step = 1; step <= 128; step++) {
        double before = lightness_at(color_by, from + (to - from) * (step - 1) / 128);
        double after = lightness_at(color_by, from + (to - from) * step / 128);
        CHECK_AT_MOST(before, after + 0.35);
    }
    for (int part = 1; part <= 8; part++) {
        double before = lightness_at(color_by, from + (to - from) * (part - 1) / 8);
        double after = lightness_at(color_by, from + (to - from) * part / 8);
        CHECK_AT_MOST(before + 1.0, after);
    }
}

static void sequential_maps_rise_in_lightness(void **state)
{
    (void)state;
    check_rises(WEIR_COLOR_SPEED, 0, 1);
    check_rises(WEIR_COLOR_DENSITY, 0, 1);
    check_rises(WEIR_COLOR_PRESSURE, 0, 1);
}

static void diverging_map_rises_to_both_sides(void **state)
{
    (void)state;
    check_rises(WEIR_COLOR_DENSITY_ERROR, 0.56, 1);
    check_rises(WEIR_COLOR_DENSITY_ERROR, 0.44, 0);
    uint8_t low[3], high[3];
    weir_color_map(WEIR_COLOR_DENSITY_ERROR, 0, low);
    weir_color_map(WEIR_COLOR_DENSITY_ERROR, 1, high);
    assert_true(low[2] > low[0] && high[0] > high[2]); // cool and warm
    CHECK_NEAR(lightness(low), lightness(high), 4);
}

static void values_beyond_the_ends_are_clamped(void **state)
{
    (void)state;
    for (int map = 0; map < WEIR_COLOR_MAPS; map++) {
        uint8_t start[3], end[3], rgb[3];
        weir_color_map((WeirColorBy)map, 0, start);
        weir_color_map((WeirColorBy)map, 1, end);
        weir_color_map((WeirColorBy)map, -3, rgb);
        assert_memory_equal(rgb, start, 3);
        weir_color_map((WeirColorBy)map, NAN, rgb);
        assert_memory_equal(rgb, start, 3);
        weir_color_map((WeirColorBy)map, INFINITY, rgb);
        assert_memory_equal(rgb, end, 3);
    }
}

static void shader_words_are_the_same_colors(void **state)
{
    (void)state;
    uint32_t words[WEIR_COLOR_MAPS * WEIR_COLOR_STEPS];
    weir_color_map_words(words);
    for (uint32_t k = 0; k < WEIR_COLOR_MAPS * WEIR_COLOR_STEPS; k++) {
        uint8_t rgb[3];
        weir_color_map((WeirColorBy)(k / WEIR_COLOR_STEPS), (float)(k % WEIR_COLOR_STEPS) / 255.0f, rgb);
        assert_int_equal(words[k], rgb[0] | rgb[1] << 8 | rgb[2] << 16);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sequential_maps_rise_in_lightness),
        cmocka_unit_test(diverging_map_rises_to_both_sides),
        cmocka_unit_test(values_beyond_the_ends_are_clamped),
        cmocka_unit_test(shader_words_are_the_same_colors),
    };
    return cmocka_run_group_tests_name("render: colour maps", tests, NULL, NULL);
}
