#include "core/cpu/cells.h"

#include <stdlib.h>

enum { CHUNK = 512, SCAN_BLOCK = 8192 };

static uint32_t scan_blocks(uint32_t cells)
{
    return (cells + SCAN_BLOCK - 1) / SCAN_BLOCK;
}

bool weir_cells_make(WeirCells *cells, uint32_t particles)
{
    cells->cell = calloc(particles, sizeof *cells->cell);
    cells->rank = calloc(particles, sizeof *cells->rank);
    cells->slot = calloc(particles, sizeof *cells->slot);
    return cells->cell && cells->rank && cells->slot;
}

void weir_cells_free(WeirCells *cells)
{
    free(cells->cell);
    free(cells->rank);
    free(cells->slot);
    free(cells->cell_count);
    free(cells->cell_start);
    free(cells->block_sum);
}

bool weir_cells_reserve(WeirCells *cells, uint32_t cell_count)
{
    if (cell_count <= cells->capacity) return true;
    atomic_uint *counts = calloc(cell_count, sizeof *counts);
    uint32_t *start = calloc((size_t)cell_count + 1, sizeof *start);
    uint32_t *block_sum = calloc(scan_blocks(cell_count), sizeof *block_sum);
    if (!counts || !start || !block_sum) {
        free(counts);
        free(start);
        free(block_sum);
        return false;
    }
    free(cells->cell_count);
    free(cells->cell_start);
    free(cells->block_sum);
    cells->cell_count = counts;
    cells->cell_start = start;
    cells->block_sum = block_sum;
    cells->capacity = cell_count;
    return true;
}

// Adds `particles` to a cell and returns how many it held. A plain addition is several times faster
// than an atomic.
static inline uint32_t add_to_cell(atomic_uint *counter, uint32_t particles, bool alone)
{
    if (!alone) return atomic_fetch_add_explicit(counter, particles, memory_order_relaxed);
    uint32_t before = atomic_load_explicit(counter, memory_order_relaxed);
    atomic_store_explicit(counter, before + particles, memory_order_relaxed);
    return before;
}

void weir_cells_count(WeirCells *cells, uint32_t begin, uint32_t end, bool alone)
{
    const uint32_t *cell = cells->cell;
    // The last step left most of a cell's particles side by side: they are added together.
    for (uint32_t i = begin, last; i < end; i = last) {
        for (last = i + 1; last < end && cell[last] == cell[i];) ++last;
        uint32_t before = add_to_cell(&cells->cell_count[cell[i]], last - i, alone);
        for (uint32_t k = i; k < last; ++k) cells->rank[k] = before + (k - i);
    }
}

typedef struct Scan {
    WeirCells *cells;
    uint32_t cell_count;
} Scan;

static void sum_block(void *context, uint32_t begin, uint32_t end)
{
    const Scan *scan = context;
    for (uint32_t block = begin; block < end; ++block) {
        uint32_t first = block * SCAN_BLOCK, last = first + SCAN_BLOCK, sum = 0;
        if (last > scan->cell_count) last = scan->cell_count;
        for (uint32_t cell = first; cell < last; ++cell) {
            sum += atomic_load_explicit(&scan->cells->cell_count[cell], memory_order_relaxed);
        }
        scan->cells->block_sum[block] = sum;
    }
}

// Of cells [first, last), the first of which starts at `sum`. Returns where the one after them starts.
static uint32_t start_cells(WeirCells *cells, uint32_t first, uint32_t last, uint32_t sum)
{
    for (uint32_t cell = first; cell < last; ++cell) {
        atomic_uint *counter = &cells->cell_count[cell];
        cells->cell_start[cell] = sum;
        sum += atomic_load_explicit(counter, memory_order_relaxed);
        atomic_store_explicit(counter, 0, memory_order_relaxed);
    }
    return sum;
}

static void start_block(void *context, uint32_t begin, uint32_t end)
{
    const Scan *scan = context;
    for (uint32_t block = begin; block < end; ++block) {
        uint32_t first = block * SCAN_BLOCK, last = first + SCAN_BLOCK;
        if (last > scan->cell_count) last = scan->cell_count;
        start_cells(scan->cells, first, last, scan->cells->block_sum[block]);
    }
}

void weir_cells_scan(WeirCells *cells, WeirPool *pool, uint32_t cell_count)
{
    if (weir_pool_threads(pool) == 1) {
        cells->cell_start[cell_count] = start_cells(cells, 0, cell_count, 0);
        return;
    }
    Scan scan = {cells, cell_count};
    uint32_t blocks = scan_blocks(cell_count), sum = 0;
    weir_pool_run(pool, blocks, 1, sum_block, &scan);
    for (uint32_t block = 0; block < blocks; ++block) {
        uint32_t particles = cells->block_sum[block];
        cells->block_sum[block] = sum;
        sum += particles;
    }
    cells->cell_start[cell_count] = sum;
    weir_pool_run(pool, blocks, 1, start_block, &scan);
}

static void place_chunk(void *context, uint32_t begin, uint32_t end)
{
    WeirCells *cells = context;
    for (uint32_t i = begin; i < end; ++i)
        cells->slot[cells->cell_start[cells->cell[i]] + cells->rank[i]] = i;
}

void weir_cells_place(WeirCells *cells, WeirPool *pool, uint32_t particles)
{
    weir_pool_run(pool, particles, CHUNK, place_chunk, cells);
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

// Insertion beats any other sort for the few particles of a cell; a crowded one (a blow-up) must not take
// n^2.
void weir_cells_order(WeirCells *cells, const uint32_t *id, uint32_t begin, uint32_t end)
{
    uint32_t *slot = cells->slot;
    if (end - begin > 64) {
        uint64_t *keys = malloc((end - begin) * sizeof *keys);
        if (keys) {
            for (uint32_t k = begin; k < end; ++k) keys[k - begin] = (uint64_t)id[slot[k]] << 32 | slot[k];
            qsort(keys, end - begin, sizeof *keys, compare_keys);
            for (uint32_t k = begin; k < end; ++k) slot[k] = (uint32_t)keys[k - begin];
            free(keys);
            return;
        }
    }
    for (uint32_t k = begin + 1; k < end; ++k) {
        uint32_t particle = slot[k], place = k;
        for (; place > begin && id[slot[place - 1]] > id[particle]; --place) slot[place] = slot[place - 1];
        slot[place] = particle;
    }
}
