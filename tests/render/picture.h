// Pictures that tests judge by their pixels.
#pragma once

#include "image.h"
#include "render/renderer.h"

enum { WEIR_ALL_EFFECTS = (1 << WEIR_EFFECTS) - 1 };

// Draws into a new picture, with a renderer of its own that draws these effects alone, and reads it. Fails the test if that fails.
void weir_test_picture(WeirGpu *gpu, const WeirSim *sim, const WeirGpuParticles *particles,
                       const WeirView *view, uint32_t effects, uint32_t size, WeirImage *image);
// Of two pixels, of their three channels together.
int weir_test_difference(const uint8_t *a, const uint8_t *b);
