// A sampled particle enters itself in every row of cells in its reach, with the columns that the grid search visits
// there (trimmed to the chord); then all particles pass by and look into their own row. So the cost is one pass, and
// the memory that of the sample.
#include "core/neighbor_count.h"
#include "core/grid.h"

#include <math.h>
#include <stdlib.h>

enum { TABLE_SIZE = 1 << 16 };

// The grid of either method, in metres.
typedef struct Rows {
    uint32_t dimension, cells[3], lines[3]; // lines: `mueller`, of the domain
    double origin[3], inverse_cell[3], radius;
    bool quanta; // wcsph
} Rows;

// Columns first to last of one row, as particle `i` visits them.
typedef struct Visit {
    uint32_t i, row, first, last, next; // next: index + 1 of the next one in the bucket, 0 ends it
} Visit;

typedef struct Sample {
    Rows rows;
    const WeirState *state;
    uint32_t *head; // index + 1 of a bucket's first visit
    Visit *visits;
    size_t visit_count, visit_capacity;
    uint64_t neighbors, candidates;
} Sample;

static Rows make_rows(const WeirParameters *parameters, const WeirConstants *constants)
{
    bool quanta = constants->coordinate_bits > 0;
    Rows rows = {.dimension = constants->dimension,
                 .cells = {constants->cell_columns, constants->cell_rows, constants->cell_layers},
                 .lines = {constants->domain_columns, constants->domain_rows, 1},
                 .radius = parameters->support_radius,
                 .quanta = quanta};
    const double inverse[3] = {constants->inverse_cell_width, constants->inverse_cell_height, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
        uint32_t shift = axis == 0 ? constants->column_shift : constants->row_shift;
        rows.origin[axis] = quanta ? constants->origin[axis] : constants->domain_min[axis];
        rows.inverse_cell[axis] =
            quanta ? (double)constants->inverse_quantum / (double)(1u << shift) : inverse[axis];
    }
    return rows;
}

// Column, row or layer of a place, before the grid is folded (grid.h).
static uint32_t line_at(const Rows *rows, int axis, double place)
{
    double line = (place - rows->origin[axis]) * rows->inverse_cell[axis];
    if (!rows->quanta) return weir_grid_clamp((float)line, rows->lines[axis]);
    return line > 0.0 ? (uint32_t)fmin(line, 4e9) : 0;
}

// Distance of a place from cell `cell` along an axis.
static double distance_to(const Rows *rows, int axis, uint32_t cell, double place)
{
    double at = (place - rows->origin[axis]) * rows->inverse_cell[axis];
    return fmax(0.0, fmax(cell - at, at - cell - 1.0)) / rows->inverse_cell[axis];
}

static uint32_t bucket_of(uint32_t row)
{
    return (row * 2654435761u) >> 16;
}

static bool add_visit(Sample *sample, const Visit *visit)
{
    if (sample->visit_count == sample->visit_capacity) {
        size_t capacity = sample->visit_capacity ? 2 * sample->visit_capacity : 4096;
        Visit *larger = realloc(sample->visits, capacity * sizeof *larger);
        if (!larger) return false;
        sample->visits = larger;
        sample->visit_capacity = capacity;
    }
    uint32_t *head = &sample->head[bucket_of(visit->row)];
    Visit *own = &sample->visits[sample->visit_count++];
    *own = *visit;
    own->next = *head;
    *head = (uint32_t)sample->visit_count;
    return true;
}

// The columns of a row in reach: one visit, or two where the grid is folded between them.
static bool add_columns(Sample *sample, uint32_t i, uint32_t row, double x, double chord)
{
    const Rows *rows = &sample->rows;
    uint32_t columns = rows->cells[0], first = line_at(rows, 0, x - chord);
    uint32_t count = line_at(rows, 0, x + chord) - first + 1;
    if (count >= columns) return add_visit(sample, &(Visit){i, row, 0, columns - 1, 0});
    first = weir_grid_fold(first, columns);
    uint32_t end = first + count;
    if (end <= columns) return add_visit(sample, &(Visit){i, row, first, end - 1, 0});
    return add_visit(sample, &(Visit){i, row, first, columns - 1, 0}) &&
           add_visit(sample, &(Visit){i, row, 0, end - columns - 1, 0});
}

static uint32_t row_of(const Rows *rows, uint32_t row, uint32_t layer)
{
    return weir_grid_fold(layer, rows->cells[2]) * rows->cells[1] + weir_grid_fold(row, rows->cells[1]);
}

static bool add_particle(Sample *sample, uint32_t i)
{
    const Rows *rows = &sample->rows;
    const float *place = &sample->state->position[(size_t)rows->dimension * i];
    bool deep = rows->dimension == 3;
    double z = deep ? place[2] : 0.0, r = rows->radius;
    uint32_t layer = deep ? line_at(rows, 2, z - r) : 0, last_layer = deep ? line_at(rows, 2, z + r) : 0;
    for (; layer <= last_layer; ++layer) {
        double dz = deep ? distance_to(rows, 2, layer, z) : 0.0;
        uint32_t last_row = line_at(rows, 1, place[1] + r);
        for (uint32_t row = line_at(rows, 1, place[1] - r); row <= last_row; ++row) {
            double dy = distance_to(rows, 1, row, place[1]), chord2 = r * r - dy * dy - dz * dz;
            if (chord2 <= 0.0) continue;
            if (!add_columns(sample, i, row_of(rows, row, layer), place[0], sqrt(chord2))) return false;
        }
    }
    return true;
}

static void pass_by(Sample *sample, uint32_t j)
{
    const Rows *rows = &sample->rows;
    uint32_t dimension = rows->dimension;
    const float *place = &sample->state->position[(size_t)dimension * j];
    uint32_t layer = dimension == 3 ? line_at(rows, 2, place[2]) : 0;
    uint32_t row = row_of(rows, line_at(rows, 1, place[1]), layer);
    uint32_t next = sample->head[bucket_of(row)];
    uint32_t column = next ? weir_grid_fold(line_at(rows, 0, place[0]), rows->cells[0]) : 0;
    while (next) {
        const Visit *visit = &sample->visits[next - 1];
        next = visit->next;
        if (visit->row != row || column < visit->first || column > visit->last || visit->i == j) continue;
        const float *other = &sample->state->position[(size_t)dimension * visit->i];
        double distance2 = 0.0;
        for (uint32_t axis = 0; axis < dimension; ++axis) {
            double d = (double)place[axis] - other[axis];
            distance2 += d * d;
        }
        ++sample->candidates;
        sample->neighbors += distance2 < rows->radius * rows->radius;
    }
}

static uint32_t group_of(const WeirState *state, uint32_t i)
{
    return state->group ? state->group[i] : WEIR_GROUP_FLUID;
}

WeirStatus weir_count_neighbors(const WeirState *state, const WeirParameters *parameters,
                                const WeirConstants *constants, uint32_t most, WeirNeighborCount *found)
{
    Sample sample = {.rows = make_rows(parameters, constants), .state = state};
    sample.head = calloc(TABLE_SIZE, sizeof *sample.head);
    uint32_t fluid = 0, seen = 0, taken = 0;
    bool good = sample.head != NULL;
    for (uint32_t i = 0; i < state->count; ++i) fluid += group_of(state, i) == WEIR_GROUP_FLUID;
    uint32_t stride = fluid > most ? (fluid + most - 1) / most : 1;
    for (uint32_t i = 0; good && i < state->count; ++i) {
        if (group_of(state, i) != WEIR_GROUP_FLUID || seen++ % stride != 0) continue;
        good = add_particle(&sample, i);
        ++taken;
    }
    for (uint32_t j = 0; good && j < state->count; ++j)
        if (group_of(state, j) != WEIR_GROUP_EMPTY) pass_by(&sample, j);
    *found = (WeirNeighborCount){.particles = taken,
                                 .neighbors = taken > 0 ? (double)sample.neighbors / taken : 0.0,
                                 .candidates = taken > 0 ? (double)sample.candidates / taken : 0.0};
    free(sample.head);
    free(sample.visits);
    return good ? WEIR_OK : WEIR_ERROR_MEMORY;
}
