// A tank of water in 3D that tests draw off-screen and judge by its pixels.
#pragma once

#include "picture.h"

enum { SIZE = 160 }; // of the pictures

// A tank of 1 m, four tenths full.
WeirScene *pool_scene(void);
// The same on the CPU, which takes the scene, with a body of half water's density if it has one.
WeirSim *pool_of(WeirScene *scene, bool with_body);
// With a box that lies half in the water.
WeirSim *pool(bool with_body);
// From +z and above.
WeirView view_of(WeirFluidStyle style);
// The pixel that shows a point of the tank.
const uint8_t *pixel_at(const WeirImage *image, const WeirView *view, float x, float y, float z);
// A pool of a lattice of particles, 1 m long and wide and 0.4 m deep with waves of that share of its depth; none: no water.
void upload_waves(WeirGpu *gpu, WeirSim *sim, float waves, bool none, WeirGpuParticles *particles);
void draw_waves(WeirGpu *gpu, WeirSim *sim, float waves, bool none, const WeirView *view, uint32_t effects,
                WeirImage *image);
// Linear light of a channel, before it was exposed (space.wgsl).
double light_of(uint8_t value);
