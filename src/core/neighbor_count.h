// How many neighbours and candidates the particles have, from a sample of them.
#pragma once

#include "core/solver.h"

// Means over at most `most` fluid particles, spread evenly over their ids. Costs one pass over all particles. Domains
// without periodic axes only. WEIR_ERROR_MEMORY if memory runs out.
WeirStatus weir_count_neighbors(const WeirState *state, const WeirParameters *parameters,
                                const WeirConstants *constants, uint32_t most, WeirNeighborCount *found);
