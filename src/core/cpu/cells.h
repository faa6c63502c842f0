// The counting sort of both CPU solvers: where each particle goes so that those of a cell lie side by side, in
// order of their ids. Sums over neighbours then have one order, whatever the number of threads.
//
//   count: cell[i], rank[i], particles per cell  ->  scan: cell_start  ->  place: slot[k] = particle at sorted place k
#pragma once

#include "core/cpu/pool.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct WeirCells {
    uint32_t *cell; // of each particle; the caller fills it
    uint32_t *rank; // place of each particle among those counted into its cell, in any order
    uint32_t *slot; // sorted place -> particle
    atomic_uint *cell_count;
    uint32_t *cell_start; // cell_count + 1
    uint32_t *block_sum;  // of scan
    uint32_t capacity;    // cells
} WeirCells;

// False if memory runs out.
bool weir_cells_make(WeirCells *cells, uint32_t particles);
void weir_cells_free(WeirCells *cells);
// Room for `cell_count` cells; false, with everything as it was, if memory runs out.
bool weir_cells_reserve(WeirCells *cells, uint32_t cell_count);

// Counts particles [begin, end), whose cell[] is set; `alone`: no other thread counts.
void weir_cells_count(WeirCells *cells, uint32_t begin, uint32_t end, bool alone);
// Exclusive prefix sum of the counts: cell_start; clears the counts for the next step.
void weir_cells_scan(WeirCells *cells, WeirPool *pool, uint32_t cell_count);
// Fills slot, in any order inside a cell.
void weir_cells_place(WeirCells *cells, WeirPool *pool, uint32_t particles);
// Puts the particles of sorted places [begin, end), one cell, in order of id.
void weir_cells_order(WeirCells *cells, const uint32_t *id, uint32_t begin, uint32_t end);
