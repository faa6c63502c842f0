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

// Distance from [low, high] to the cell row that holds coordinates from row << shift, in quanta; edge rows reach to
// infinity, since coordinates outside the grid are clamped into them.
static inline double weir_row_distance(int32_t low, int32_t high, uint32_t row, uint32_t shift, uint32_t rows)
{
    double begin = row == 0 ? -2e9 : (double)row * (double)(1u << shift);
    double end = row + 1 == rows ? 4e9 : ((double)row + 1.0) * (double)(1u << shift);
    double above = (double)low - end, below = begin - (double)high, distance = above > below ? above : below;
    return distance > 0.0 ? distance : 0.0; // fmax() would be a call
}

static inline void weir_add_runs(const WeirConstants *constants, const uint32_t *cell_start,
                                 WeirLaneGroup *group, const WeirSegment *row_segment, uint32_t row,
                                 const WeirSegment *layer_segment, uint32_t layer)
{
    const WeirBounds *bounds = &group->bounds;
    double support = (double)(1u << constants->coordinate_bits);
    double dy = weir_row_distance(bounds->low[1] - row_segment->shift, bounds->high[1] - row_segment->shift,
                                  row, constants->row_shift, constants->cell_rows);
    double dz =
        weir_row_distance(bounds->low[2] - layer_segment->shift, bounds->high[2] - layer_segment->shift,
                          layer, constants->row_shift, constants->cell_layers);
    double chord2 = support * support - dy * dy - dz * dz;
    if (chord2 <= 0.0) return;
    int32_t reach = (int32_t)sqrt(chord2) + 1;
    WeirSegment column[3];
    uint32_t columns =
        weir_segments(bounds->low[0] - reach, bounds->high[0] + reach, constants->period_x, column);
    const uint32_t *start = cell_start + (layer * constants->cell_rows + row) * constants->cell_columns;
    for (uint32_t n = 0; n < columns; ++n) {
        uint32_t first = weir_grid_cell(column[n].low, constants->column_shift, constants->cell_columns);
        uint32_t last = weir_grid_cell(column[n].high, constants->column_shift, constants->cell_columns);
        WeirRun run = {
            start[first], start[last + 1], {column[n].shift, row_segment->shift, layer_segment->shift}};
        if (run.begin < run.end && group->run_count < WEIR_MAX_RUNS) group->run[group->run_count++] = run;
    }
}

static inline void weir_find_runs(const WeirConstants *constants, const uint32_t *cell_start,
                                  WeirLaneGroup *group)
{
    const WeirBounds *bounds = &group->bounds;
    int32_t support = (int32_t)(1u << constants->coordinate_bits);
    WeirSegment rows[3], layers[3] = {{0, 0, 0}};
    uint32_t row_segments =
        weir_segments(bounds->low[1] - support, bounds->high[1] + support, constants->period_y, rows);
    uint32_t layer_segments = 1;
    if (constants->dimension == 3) {
        layer_segments =
            weir_segments(bounds->low[2] - support, bounds->high[2] + support, constants->period_z, layers);
    }
    group->run_count = 0;
    for (uint32_t a = 0; a < layer_segments; ++a) {
        uint32_t last_layer = weir_grid_cell(layers[a].high, constants->row_shift, constants->cell_layers);
        uint32_t layer = weir_grid_cell(layers[a].low, constants->row_shift, constants->cell_layers);
        for (; layer <= last_layer; ++layer) {
            for (uint32_t b = 0; b < row_segments; ++b) {
                uint32_t last_row = weir_grid_cell(rows[b].high, constants->row_shift, constants->cell_rows);
                uint32_t row = weir_grid_cell(rows[b].low, constants->row_shift, constants->cell_rows);
                for (; row <= last_row; ++row)
                    weir_add_runs(constants, cell_start, group, &rows[b], row, &layers[a], layer);
            }
        }
    }
}

// Takes particles from `begin` on, as long as they share a row and lie close enough that one set of runs serves
// them all. The runs are found by weir_find_runs().
static inline void weir_take_lanes(const WeirConstants *constants, const int32_t *const x[3], uint32_t begin,
                                   uint32_t end, WeirLaneGroup *group)
{
    uint32_t most = end - begin < WEIR_LANES ? end - begin : WEIR_LANES;
    int32_t widest = (int32_t)(1u << constants->coordinate_bits) * 3;
    WeirBounds *bounds = &group->bounds;
    for (int axis = 0; axis < 3; ++axis) bounds->low[axis] = bounds->high[axis] = x[axis][begin];
    uint32_t row = weir_grid_cell(x[1][begin], constants->row_shift, constants->cell_rows);
    uint32_t layer = weir_grid_cell(x[2][begin], constants->row_shift, constants->cell_layers);
    for (group->lanes = 1; group->lanes < most; ++group->lanes) {
        uint32_t i = begin + group->lanes;
        if (weir_grid_cell(x[1][i], constants->row_shift, constants->cell_rows) != row ||
            weir_grid_cell(x[2][i], constants->row_shift, constants->cell_layers) != layer ||
            x[0][i] - bounds->low[0] > widest) {
            break;
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (x[axis][i] < bounds->low[axis]) bounds->low[axis] = x[axis][i];
            if (x[axis][i] > bounds->high[axis]) bounds->high[axis] = x[axis][i];
        }
    }
}
