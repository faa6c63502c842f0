// Groups of neighbouring particles, one per lane of a vector, and the runs of candidates that hold all their
// neighbours. Coordinates in quanta (grid.h).
//
//   candidates j ->  . . . . . . . . . . . .      one run per row of cells in reach, trimmed to the chord;
//   lanes i          [ i0 i1 i2 ... ]             across a periodic border a run belongs to an image of the domain
//
// A lane meets its candidates in one order whatever the group: below the domain's image, inside, above; each by
// sorted place.
#pragma once

#include "core/cpu/simd.h"
#include "core/grid.h"

#include <math.h>

enum { WEIR_MAX_RUNS = 128 };

typedef struct WeirRun {
    uint32_t begin, end;
    int32_t shift[3]; // to add to a candidate's coordinates
} WeirRun;

typedef struct WeirBounds {
    int32_t low[3], high[3];
} WeirBounds;

typedef struct WeirLaneGroup {
    uint32_t lanes, run_count;
    WeirBounds bounds; // of the lanes
    WeirRun run[WEIR_MAX_RUNS];
} WeirLaneGroup;

typedef struct WeirSegment {
    int32_t low, high; // coordinates, ends included
    int32_t shift;
} WeirSegment;

// Splits [low, high] where a periodic axis wraps. Returns the number of segments, at most 3.
static inline uint32_t weir_segments(int32_t low, int32_t high, uint32_t period, WeirSegment segment[3])
{
    int32_t p = (int32_t)period;
    if (p == 0) {
        segment[0] = (WeirSegment){low, high, 0};
        return 1;
    }
    uint32_t count = 0;
    if (low < 0) segment[count++] = (WeirSegment){low + p, p - 1, -p};
    segment[count++] = (WeirSegment){low < 0 ? 0 : low, high < p ? high : p - 1, 0};
    if (high >= p) segment[count++] = (WeirSegment){0, high - p, p};
    return count;
}

// Square of the distance from [low, high] to the row of cells that starts at row << shift, in quanta; row 0 also holds
// all below it.
static inline int64_t weir_row_distance2(int64_t low, int64_t high, uint32_t row, uint32_t shift)
{
    int64_t begin = (int64_t)row << shift, end = begin + ((int64_t)1 << shift);
    int64_t distance = 0;
    if (low > end) distance = low - end;
    if (row > 0 && begin > high) distance = begin - high;
    return distance * distance;
}

static inline void weir_add_run(const uint32_t *start, uint32_t first, uint32_t end, const int32_t shift[3],
                                WeirLaneGroup *group)
{
    WeirRun run = {start[first], start[end], {shift[0], shift[1], shift[2]}};
    if (run.begin < run.end && group->run_count < WEIR_MAX_RUNS) group->run[group->run_count++] = run;
}

// `count` columns of a row from `first` on: one run; two where the grid is folded between them.
static inline void weir_add_columns(const uint32_t *start, uint32_t first, uint32_t count, uint32_t columns,
                                    const int32_t shift[3], WeirLaneGroup *group)
{
    if (first + count > columns) {
        first = count < columns ? first % columns : 0;
        if (count > columns) count = columns;
        if (first + count > columns) {
            weir_add_run(start, first, columns, shift, group);
            count -= columns - first;
            first = 0;
        }
    }
    weir_add_run(start, first, first + count, shift, group);
}

// The runs of one row of cells; `chord2`: square of what is left of the support beyond the distance to the row.
static inline void weir_add_runs(const WeirConstants *constants, const uint32_t *start, double chord2,
                                 int32_t row_shift, int32_t layer_shift, WeirLaneGroup *group)
{
    int32_t reach = (int32_t)sqrt(chord2) + 1;
    WeirSegment column[3];
    uint32_t columns = weir_segments(group->bounds.low[0] - reach, group->bounds.high[0] + reach,
                                     constants->period_x, column);
    for (uint32_t n = 0; n < columns; ++n) {
        uint32_t first = weir_grid_line(column[n].low, constants->column_shift);
        uint32_t last = weir_grid_line(column[n].high, constants->column_shift);
        const int32_t shift[3] = {column[n].shift, row_shift, layer_shift};
        weir_add_columns(start, first, last - first + 1, constants->cell_columns, shift, group);
    }
}

// The runs of the rows in one layer of cells; `left2`: square of what is left of the support beyond the distance to it.
static inline void weir_add_layer(const WeirConstants *constants, const uint32_t *layer_start, int64_t left2,
                                  int32_t layer_shift, WeirLaneGroup *group)
{
    int32_t support = (int32_t)(1u << constants->coordinate_bits);
    int32_t low = group->bounds.low[1], high = group->bounds.high[1];
    WeirSegment segment[3];
    uint32_t segments = weir_segments(low - support, high + support, constants->period_y, segment);
    for (uint32_t n = 0; n < segments; ++n) {
        int32_t shift = segment[n].shift;
        uint32_t last = weir_grid_line(segment[n].high, constants->row_shift);
        uint32_t row = weir_grid_line(segment[n].low, constants->row_shift);
        for (; row <= last; ++row) {
            int64_t chord2 = left2 - weir_row_distance2((int64_t)low - shift, (int64_t)high - shift, row,
                                                        constants->row_shift);
            if (chord2 <= 0) continue;
            uint32_t folded = weir_grid_fold(row, constants->cell_rows);
            weir_add_runs(constants, layer_start + folded * constants->cell_columns, (double)chord2, shift,
                          layer_shift, group);
        }
    }
}

// Finds all runs of a group, which weir_take_lanes() made.
static inline void weir_find_runs(const WeirConstants *constants, const uint32_t *cell_start,
                                  WeirLaneGroup *group)
{
    int32_t support = (int32_t)(1u << constants->coordinate_bits);
    int64_t support2 = (int64_t)support * support;
    int32_t low = group->bounds.low[2], high = group->bounds.high[2];
    WeirSegment segment[3] = {{0, 0, 0}};
    uint32_t segments = 1;
    if (constants->dimension == 3)
        segments = weir_segments(low - support, high + support, constants->period_z, segment);
    group->run_count = 0;
    for (uint32_t n = 0; n < segments; ++n) {
        int32_t shift = segment[n].shift;
        uint32_t last = weir_grid_line(segment[n].high, constants->row_shift);
        uint32_t layer = weir_grid_line(segment[n].low, constants->row_shift);
        for (; layer <= last; ++layer) {
            int64_t left2 = support2 - weir_row_distance2((int64_t)low - shift, (int64_t)high - shift, layer,
                                                          constants->row_shift);
            uint32_t first_row = weir_grid_fold(layer, constants->cell_layers) * constants->cell_rows;
            if (left2 > 0)
                weir_add_layer(constants, cell_start + first_row * constants->cell_columns, left2, shift,
                               group);
        }
    }
}

// Takes up to `most` particles from `begin` on into the group. False if they lie too far apart for one set of runs: in a
// folded grid others share their row. `careful`: ends before the first such one instead.
static inline bool weir_gather_lanes(const WeirConstants *constants, const int32_t *const x[3],
                                     uint32_t begin, uint32_t most, bool careful, WeirLaneGroup *group)
{
    int32_t widest = (int32_t)(1u << constants->coordinate_bits) * 3;
    WeirBounds *bounds = &group->bounds;
    for (int axis = 0; axis < 3; ++axis) bounds->low[axis] = bounds->high[axis] = x[axis][begin];
    for (group->lanes = 1; group->lanes < most; ++group->lanes) {
        uint32_t i = begin + group->lanes;
        if (x[0][i] - bounds->low[0] > widest) break;
        for (uint32_t axis = 0; careful && axis < constants->dimension; ++axis) {
            int32_t way = x[axis][i] - x[axis][begin];
            if (way > widest || way < -widest) return true;
        }
        for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
            if (x[axis][i] < bounds->low[axis]) bounds->low[axis] = x[axis][i];
            if (x[axis][i] > bounds->high[axis]) bounds->high[axis] = x[axis][i];
        }
    }
    for (uint32_t axis = 0; axis < constants->dimension; ++axis)
        if (bounds->high[axis] - bounds->low[axis] > 2 * widest) return false;
    return true;
}

// Takes particles from `begin` on, as long as they share a row of cells and lie close enough that one set of runs serves
// them all.
static inline void weir_take_lanes(const WeirConstants *constants, const uint32_t *cell_start,
                                   const int32_t *const x[3], uint32_t begin, uint32_t end,
                                   WeirLaneGroup *group)
{
    uint32_t row = weir_grid_cell(x[1][begin], constants->row_shift, constants->cell_rows);
    uint32_t layer = weir_grid_cell(x[2][begin], constants->row_shift, constants->cell_layers);
    uint32_t row_end = cell_start[(layer * constants->cell_rows + row + 1) * constants->cell_columns];
    uint32_t most = (end < row_end ? end : row_end) - begin;
    if (most > WEIR_LANES) most = WEIR_LANES;
    if (!weir_gather_lanes(constants, x, begin, most, false, group))
        weir_gather_lanes(constants, x, begin, most, true, group);
}
