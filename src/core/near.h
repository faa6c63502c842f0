// Points in a hash table by cell: is there one nearer than a radius?
#pragma once

#include "core/world_build.h"

typedef struct WeirNear {
    WeirPoints points;
    uint32_t *head, *next; // index + 1, 0 ends a list
    uint64_t next_capacity;
    uint32_t mask;
    double cell; // size; the largest radius that may be asked for
} WeirNear;

void weir_near_start(WeirNear *near, uint32_t dimension, double cell);
void weir_near_end(WeirNear *near);
// near->points.failed tells that memory ran out.
void weir_near_add(WeirNear *near, const double *point);
// Is there a point closer than `radius`, at most the cell size?
bool weir_near_within(const WeirNear *near, const double *point, double radius);
