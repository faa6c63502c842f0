// Sites along one axis of a box: one per spacing, stretched to fit a whole number; layers outside at half-spacing
// offsets.
#pragma once

#include <stdint.h>

typedef struct WeirAxis {
    double min, max, pitch, spacing;
    long sites; // inside; numbers below 0 and from here on are outside
} WeirAxis;

WeirAxis weir_axis_make(double min, double max, double spacing);
double weir_axis_site(const WeirAxis *axis, long k);
