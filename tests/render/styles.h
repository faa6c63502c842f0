// What pictures of water have to do in 2D as in 3D.
#pragma once

#include "weir/weir_render.h"

// One renderer, both styles and several sizes in turn: textures and pipelines come and go, and the picture stays.
void weir_test_styles_and_sizes(WeirGpu *gpu, WeirSim *sim, WeirView (*view_of)(WeirFluidStyle));
