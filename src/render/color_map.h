// The colour maps as the shaders get them.
#pragma once

#include "weir/weir_render.h"

enum {
    WEIR_COLOR_MAPS = 4,    // values of WeirColorBy
    WEIR_COLOR_STEPS = 256, // colours of one map; weir_color_map() and the shaders take the nearest one
};

// All maps one after the other, each colour as red | green << 8 | blue << 16.
void weir_color_map_words(uint32_t words[WEIR_COLOR_MAPS * WEIR_COLOR_STEPS]);
