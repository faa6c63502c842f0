// The colour maps: control points in OKLab, straight lines between them, so that equal steps of the value
// look like equal steps of the colour (B. Ottosson, "A perceptual color space for image processing", 2020).
#include "render/color_map.h"

#include <math.h>

enum { POINTS = 8 };

// Lightness, green-red, blue-yellow. Every point and every colour between two of them lies inside sRGB.
static const float control_points[WEIR_COLOR_MAPS][POINTS][3] = {
    // Speed: water at rest is deep blue, then cyan, then white foam.
    [WEIR_COLOR_SPEED] = {{0.360f, -0.0131f, -0.1243f},
                          {0.460f, -0.0296f, -0.1522f},
                          {0.570f, -0.0513f, -0.1410f},
                          {0.680f, -0.0800f, -0.1024f},
                          {0.790f, -0.0975f, -0.0609f},
                          {0.890f, -0.0799f, -0.0291f},
                          {0.950f, -0.0433f, -0.0124f},
                          {0.995f, -0.0048f, -0.0014f}},
    // Density: violet, blue, green, yellow.
    [WEIR_COLOR_DENSITY] = {{0.400f, 0.0412f, -0.1020f},
                            {0.460f, 0.0103f, -0.1176f},
                            {0.540f, -0.0423f, -0.0906f},
                            {0.620f, -0.0865f, -0.0315f},
                            {0.710f, -0.1141f, 0.0371f},
                            {0.800f, -0.1004f, 0.1115f},
                            {0.880f, -0.0697f, 0.1495f},
                            {0.940f, -0.0413f, 0.1442f}},
    // Density error: diverging, dark in the middle, which belongs at zero; cyan is too thin, orange
    // too dense.
    [WEIR_COLOR_DENSITY_ERROR] = {{0.900f, -0.0680f, -0.0317f},
                                  {0.760f, -0.0817f, -0.0736f},
                                  {0.600f, -0.0516f, -0.0971f},
                                  {0.420f, -0.0070f, -0.0495f},
                                  {0.420f, 0.0470f, 0.0171f},
                                  {0.600f, 0.1024f, 0.0800f},
                                  {0.760f, 0.0715f, 0.1145f},
                                  {0.900f, 0.0105f, 0.0995f}},
    // Pressure: indigo, magenta, orange, pale yellow.
    [WEIR_COLOR_PRESSURE] = {{0.380f, 0.0331f, -0.1154f},
                             {0.440f, 0.0844f, -0.1300f},
                             {0.520f, 0.1559f, -0.0794f},
                             {0.600f, 0.1773f, 0.0155f},
                             {0.690f, 0.1374f, 0.0858f},
                             {0.780f, 0.0699f, 0.1119f},
                             {0.880f, 0.0146f, 0.1040f},
                             {0.960f, -0.0084f, 0.0594f}},
};

// One channel of linear light as an sRGB byte (IEC 61966-2-1).
static uint8_t srgb_byte(float linear)
{
    float x = fminf(fmaxf(linear, 0.0f), 1.0f);
    float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    return (uint8_t)(encoded * 255.0f + 0.5f);
}

static void oklab_to_srgb(const float lab[3], uint8_t rgb[3])
{
    float l = lab[0] + 0.3963377774f * lab[1] + 0.2158037573f * lab[2];
    float m = lab[0] - 0.1055613458f * lab[1] - 0.0638541728f * lab[2];
    float s = lab[0] - 0.0894841775f * lab[1] - 1.2914855480f * lab[2];
    l = l * l * l;
    m = m * m * m;
    s = s * s * s;
    rgb[0] = srgb_byte(4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s);
    rgb[1] = srgb_byte(-1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s);
    rgb[2] = srgb_byte(-0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s);
}

static void color_of_step(WeirColorBy color_by, uint32_t step, uint8_t rgb[3])
{
    float place = (float)step * (float)(POINTS - 1) / (float)(WEIR_COLOR_STEPS - 1);
    uint32_t index = (uint32_t)place;
    if (index > POINTS - 2) index = POINTS - 2;
    float share = place - (float)index, lab[3];
    const float *from = control_points[color_by][index], *to = control_points[color_by][index + 1];
    for (int k = 0; k < 3; k++) lab[k] = from[k] + share * (to[k] - from[k]);
    oklab_to_srgb(lab, rgb);
}

void weir_color_map(WeirColorBy color_by, float t, uint8_t rgb[3])
{
    float inside = t > 0.0f ? fminf(t, 1.0f) : 0.0f; // NaN gives the map's start
    uint32_t map = (uint32_t)color_by < WEIR_COLOR_MAPS ? (uint32_t)color_by : WEIR_COLOR_SPEED;
    color_of_step((WeirColorBy)map, (uint32_t)(inside * (WEIR_COLOR_STEPS - 1) + 0.5f), rgb);
}

void weir_color_map_words(uint32_t words[WEIR_COLOR_MAPS * WEIR_COLOR_STEPS])
{
    for (uint32_t map = 0; map < WEIR_COLOR_MAPS; map++) {
        for (uint32_t step = 0; step < WEIR_COLOR_STEPS; step++) {
            uint8_t rgb[3];
            color_of_step((WeirColorBy)map, step, rgb);
            words[map * WEIR_COLOR_STEPS + step] =
                (uint32_t)rgb[0] | (uint32_t)rgb[1] << 8 | (uint32_t)rgb[2] << 16;
        }
    }
}
