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
    uint32_t dimension, cells[3];
    double origin[3], inverse_cell[3], radius;
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
                 .radius = parameters->support_radius};
    const double inverse[3] = {constants->inverse_cell_width, constants->inverse_cell_height, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
        uint32_t shift = axis == 0 ? constants->column_shift : constants->row_shift;
        rows.origin[axis] = quanta ? constants->origin[axis] : constants->domain_min[axis];
        rows.inverse_cell[axis] =
            quanta ? (double)constants->inverse_quantum / (double)(1u << shift) : inverse[axis];
    }
    return rows;
}

static uint32_t cell_at(const Rows *rows, int axis, double place)
{
    return weir_grid_clamp((float)((place - rows->origin[axis]) * rows->inverse_cell[axis]),
                           rows->cells[axis]);
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

static bool add_visit(Sample *sample, uint32_t i, uint32_t row, double x, double chord)
{
    if (sample->visit_count == sample->visit_capacity) {
        size_t capacity = sample->visit_capacity ? 2 * sample->visit_capacity : 4096;
        Visit *larger = realloc(sample->visits, capacity * sizeof *larger);
        if (!larger) return false;
        sample->visits = larger;
        sample->visit_capacity = capacity;
    }
    uint32_t *head = &sample->head[bucket_of(row)];
    sample->visits[sample->visit_count] =
        (Visit){i, row, cell_at(&sample->rows, 0, x - chord), cell_at(&sample->rows, 0, x + chord), *head};
    *head = (uint32_t)++sample->visit_count;
    return true;
}

static bool add_particle(Sample *sample, uint32_t i)
{
    const Rows *rows = &sample->rows;
    const float *place = &sample->state->position[(size_t)rows->dimension * i];
    bool deep = rows->dimension == 3;
    double z = deep ? place[2] : 0.0, r = rows->radius;
    uint32_t layer = deep ? cell_at(rows, 2, z - r) : 0, last_layer = deep ? cell_at(rows, 2, z + r) : 0;
    for (; layer <= last_layer; ++layer) {
        double dz = deep ? distance_to(rows, 2, layer, z) : 0.0;
        uint32_t last_row = cell_at(rows, 1, place[1] + r);
        for (uint32_t row = cell_at(rows, 1, place[1] - r); row <= last_row; ++row) {
            double dy = distance_to(rows, 1, row, place[1]), chord2 = r * r - dy * dy - dz * dz;
            if (chord2 <= 0.0) continue;
            if (!add_visit(sample, i, layer * rows->cells[1] + row, place[0], sqrt(chord2))) return false;
        }
    }
    return true;
}

static void pass_by(Sample *sample, uint32_t j)
{
    const Rows *rows = &sample->rows;
    uint32_t dimension = rows->dimension;
    const float *place = &sample->state->position[(size_t)dimension * j];
    uint32_t layer = dimension == 3 ? cell_at(rows, 2, place[2]) : 0;
    uint32_t row = layer * rows->cells[1] + cell_at(rows, 1, place[1]);
    uint32_t next = sample->head[bucket_of(row)];
    uint32_t column = next ? cell_at(rows, 0, place[0]) : 0;
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
