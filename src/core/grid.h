// The uniform grid of the neighbour search, shared by CPU and GPU through WeirConstants.
//
//   row r:  | | | | |x| | | | |     cells are one search radius high and a quarter as wide; rows are
//           |<-- run of cells -->|   stored one after the other, so that the neighbours of a particle
//                                    lie in three contiguous runs
//
// A counting sort of the whole particle data (count, scan, scatter) puts each cell's particles side by side,
// in order of their ids, so that sums have one order whatever the thread count.
#pragma once

#include "core/scene.h"

// Cells per search radius along x: finer cells trim the runs (measured: docs/performance/tries.md).
enum { WEIR_CELLS_PER_RADIUS = 4 };

// Derives all constants from a scene and its resolved parameters; first_solid and solid_count are the caller's.
void weir_constants_make(WeirConstants *constants, const WeirScene *scene, const WeirParameters *parameters,
                         uint32_t particle_count, const WeirTool *tool);

// Period along an axis, quanta; 0: it is not periodic.
static inline uint32_t weir_period(const WeirConstants *constants, uint32_t axis)
{
    return axis == 0 ? constants->period_x : axis == 1 ? constants->period_y : constants->period_z;
}

// `wcsph`: a place in metres as whole quanta from `origin`; along a periodic axis that of its image in the domain, along others cut at
// 2e9, farther than the domain reaches.
int32_t weir_coordinate_of(const WeirConstants *constants, double place, uint32_t axis);

// A line is a column, row or layer of cells. Where the domain has more lines than the grid, it is folded: lines that lie
// the grid's count apart share their cells. So what is far away may be a candidate, but never a neighbour, and memory
// is bound to the particles wherever they are.
static inline uint32_t weir_grid_fold(uint32_t line, uint32_t count)
{
    return line < count ? line : line % count;
}

// Folded grids have at least so many columns, and rows and layers: more than any search spans.
enum { WEIR_LEAST_COLUMNS = 64, WEIR_LEAST_ROWS = 8 };

// Does the domain have more columns than the grid?
static inline bool weir_grid_folds_columns(const WeirConstants *constants)
{
    return constants->domain_columns > constants->cell_columns;
}

// `mueller`: line of a coordinate, clamped into the domain.
static inline uint32_t weir_grid_clamp(float line, uint32_t count)
{
    // NaN compares false and lands in line 0.
    if (!(line > 0.0f)) return 0;
    return line < (float)count ? (uint32_t)line : count - 1;
}

static inline uint32_t weir_grid_column(const WeirConstants *constants, float x)
{
    return weir_grid_clamp((x - constants->domain_min[0]) * constants->inverse_cell_width,
                           constants->domain_columns);
}

static inline uint32_t weir_grid_row(const WeirConstants *constants, float y)
{
    return weir_grid_clamp((y - constants->domain_min[1]) * constants->inverse_cell_height,
                           constants->domain_rows);
}

static inline uint32_t weir_grid_cell_at(const WeirConstants *constants, float x, float y)
{
    uint32_t row = weir_grid_fold(weir_grid_row(constants, y), constants->cell_rows);
    return row * constants->cell_columns +
           weir_grid_fold(weir_grid_column(constants, x), constants->cell_columns);
}

// `wcsph`: positions are whole numbers of quanta (32-bit, from constants.origin), so that differences are exact
// however large the domain; cells are powers of two of them.
static inline uint32_t weir_grid_line(int32_t coordinate, uint32_t shift)
{
    return coordinate < 0 ? 0 : (uint32_t)coordinate >> shift;
}

static inline uint32_t weir_grid_cell(int32_t coordinate, uint32_t shift, uint32_t count)
{
    return weir_grid_fold(weir_grid_line(coordinate, shift), count);
}
