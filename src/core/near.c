#include "core/near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void weir_near_start(WeirNear *near, uint32_t dimension, double cell)
{
    *near = (WeirNear){.cell = cell, .points.dimension = dimension};
}

void weir_near_end(WeirNear *near)
{
    weir_points_free(&near->points);
    free(near->head);
    free(near->next);
    *near = (WeirNear){0};
}

static uint32_t bucket_of(const WeirNear *near, const int64_t cell[3])
{
    uint64_t hash = (uint64_t)cell[0] * 0x9e3779b97f4a7c15u ^ (uint64_t)cell[1] * 0xc2b2ae3d27d4eb4fu ^
                    (uint64_t)cell[2] * 0x165667b19e3779f9u;
    return (uint32_t)(hash >> 29) & near->mask;
}

static void cell_of(const WeirNear *near, const double *point, int64_t cell[3])
{
    for (uint32_t axis = 0; axis < 3; ++axis)
        cell[axis] = axis < near->points.dimension ? (int64_t)floor(point[axis] / near->cell) : 0;
}

static void link_point(WeirNear *near, uint64_t index)
{
    int64_t cell[3];
    cell_of(near, &near->points.data[index * near->points.dimension], cell);
    uint32_t *head = &near->head[bucket_of(near, cell)];
    near->next[index] = *head;
    *head = (uint32_t)index + 1;
}

// Twice the buckets; all points linked anew.
static void grow(WeirNear *near)
{
    uint64_t size = near->next_capacity ? 2 * near->next_capacity : 1024;
    uint32_t *next = realloc(near->next, size * sizeof *next), *head = calloc(size, sizeof *head);
    if (next) near->next = next;
    if (!next || !head) {
        free(head);
        near->points.failed = true;
        return;
    }
    free(near->head);
    near->head = head;
    near->next_capacity = size;
    near->mask = (uint32_t)(size - 1);
    for (uint64_t n = 0; n < near->points.count; ++n) link_point(near, n);
}

void weir_near_add(WeirNear *near, const double *point)
{
    if (near->points.count == near->next_capacity) grow(near);
    if (near->points.failed) return;
    weir_points_add(&near->points, point);
    if (!near->points.failed) link_point(near, near->points.count - 1);
}

static bool is_in_bucket(const WeirNear *near, const int64_t cell[3], const double *point, double radius)
{
    size_t dimension = near->points.dimension;
    for (uint32_t n = near->head[bucket_of(near, cell)]; n; n = near->next[n - 1]) {
        const double *other = &near->points.data[(n - 1) * dimension];
        double distance2 = 0.0;
        for (size_t axis = 0; axis < dimension; ++axis)
            distance2 += (other[axis] - point[axis]) * (other[axis] - point[axis]);
        if (distance2 < radius * radius) return true;
    }
    return false;
}

bool weir_near_within(const WeirNear *near, const double *point, double radius)
{
    if (near->points.count == 0) return false;
    int64_t low[3] = {0}, high[3] = {0}, cell[3];
    for (uint32_t axis = 0; axis < near->points.dimension; ++axis) {
        low[axis] = (int64_t)floor((point[axis] - radius) / near->cell);
        high[axis] = (int64_t)floor((point[axis] + radius) / near->cell);
    }
    for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
        for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1]) {
            for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
                if (is_in_bucket(near, cell, point, radius)) return true;
            }
        }
    }
    return false;
}
