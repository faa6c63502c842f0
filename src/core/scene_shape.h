// Shapes: where they are, what is inside.
#pragma once

#include "core/scene.h"

// Lowest and highest corner of what encloses the shape.
void weir_shape_bounds(const WeirShape *shape, uint32_t dimension, double low[3], double high[3]);
bool weir_shape_contains(const WeirShape *shape, uint32_t dimension, const double *point);
// What the shape lacks, "box.max"; NULL if it is complete.
const char *weir_shape_missing(const WeirShape *shape);
