#include "core/diagnostics.h"
#include "core/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint64_t hash_word(uint64_t hash, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return (hash ^ bits) * 0x100000001b3u;
}

uint64_t weir_state_hash(const WeirState *state)
{
    uint64_t hash = 0xcbf29ce484222325u;
    size_t dimension = state->dimension;
    for (size_t i = 0; i < state->count; ++i) {
        for (size_t axis = 0; axis < dimension; ++axis)
            hash = hash_word(hash, state->position[dimension * i + axis]);
        for (size_t axis = 0; axis < dimension; ++axis)
            hash = hash_word(hash, state->velocity[dimension * i + axis]);
    }
    return hash;
}

// Free fluid: not wall, body, empty slot, or on its way out of an emitter.
static bool is_fluid(const WeirState *state, size_t i)
{
    return !state->group || state->group[i] == WEIR_GROUP_FLUID;
}

// Of the domain's lowest corner along gravity.
static double lowest_place(const WeirParameters *parameters, const WeirConstants *constants, uint32_t axis)
{
    return parameters->gravity[axis] < 0.0f ? constants->domain_min[axis] : constants->domain_max[axis];
}

float weir_domain_slack(const WeirParameters *parameters, const WeirConstants *constants)
{
    return constants->coordinate_bits > 0 ? 0.5f * parameters->particle_spacing : 0.0f;
}

static bool is_lost(const WeirParameters *parameters, const WeirConstants *constants, const float *position,
                    const float *velocity, uint32_t dimension)
{
    float slack = weir_domain_slack(parameters, constants);
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        // Written so that NaN counts as lost.
        if (!(position[axis] >= constants->domain_min[axis] - slack &&
              position[axis] <= constants->domain_max[axis] + slack)) {
            return true;
        }
        if (!isfinite(velocity[axis])) return true;
    }
    return false;
}

// ---- Neighbours ----

// Particles by cell of one support radius, as lists of indices in a hash table: it needs no bounds.
typedef struct CellTable {
    uint32_t *head, *next; // index + 1, 0 ends a list
    uint64_t *key;         // of each particle's cell
    uint32_t mask;
    uint32_t dimension;
    double radius, origin[3], period[3]; // period 0: none
    int64_t periods[3];                  // in cells, of the stretched cells below
    double cell[3];                      // sizes; a whole number of them makes a period
} CellTable;

static void cell_of(const CellTable *table, const float *position, int64_t cell[3])
{
    for (uint32_t axis = 0; axis < 3; ++axis) {
        double place =
            axis < table->dimension ? (position[axis] - table->origin[axis]) / table->cell[axis] : 0;
        cell[axis] = fabs(place) < 1e15 ? (int64_t)floor(place) : 0;
        if (table->periods[axis]) {
            cell[axis] %= table->periods[axis];
            if (cell[axis] < 0) cell[axis] += table->periods[axis];
        }
    }
}

// Cells with one key are 2^21 cells apart: no particle has both around it.
static uint64_t key_of(const int64_t cell[3])
{
    const uint64_t most = (1u << 21) - 1;
    return ((uint64_t)cell[0] & most) | ((uint64_t)cell[1] & most) << 21 | ((uint64_t)cell[2] & most) << 42;
}

static uint32_t bucket_of(const CellTable *table, uint64_t key)
{
    return (uint32_t)(key * 0x9e3779b97f4a7c15u >> 32) & table->mask;
}

static bool is_near(const CellTable *table, const float *a, const float *b)
{
    float sum = 0.0f, radius = (float)table->radius;
    for (uint32_t axis = 0; axis < table->dimension; ++axis) {
        float d = a[axis] - b[axis];
        float period = (float)table->period[axis];
        if (period > 0.0f) d -= period * rintf(d / period);
        sum += d * d;
    }
    return sum < radius * radius;
}

static uint64_t count_in_cell(const CellTable *table, const WeirState *state, const int64_t cell[3],
                              uint32_t i)
{
    uint64_t count = 0, key = key_of(cell);
    size_t dimension = table->dimension;
    for (uint32_t j = table->head[bucket_of(table, key)]; j; j = table->next[j - 1]) {
        if (table->key[j - 1] != key || j - 1 == i) continue;
        count += is_near(table, &state->position[dimension * i], &state->position[dimension * (j - 1)]);
    }
    return count;
}

static uint64_t neighbors_of(const CellTable *table, const WeirState *state, uint32_t i)
{
    int64_t center[3], cell[3];
    uint64_t count = 0;
    cell_of(table, &state->position[(size_t)table->dimension * i], center);
    int reach_z = table->dimension == 3 ? 1 : 0;
    for (int z = -reach_z; z <= reach_z; ++z) {
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                const int step[3] = {x, y, z};
                bool is_new = true; // two cells to a period are one another's neighbours on both sides
                for (int axis = 0; axis < 3; ++axis) {
                    int64_t period = table->periods[axis];
                    if (period > 0 && period < 3 && step[axis] + 1 >= period) is_new = false;
                    cell[axis] = center[axis] + step[axis];
                    if (period > 0) cell[axis] = (cell[axis] + period) % period;
                }
                if (is_new) count += count_in_cell(table, state, cell, i);
            }
        }
    }
    return count;
}

static void start_table(CellTable *table, const WeirParameters *parameters, const WeirConstants *constants)
{
    table->dimension = constants->dimension;
    table->radius = parameters->support_radius;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        table->origin[axis] = constants->domain_min[axis];
        table->cell[axis] = table->radius * 1.0001; // rounding loses no neighbour
        if (!weir_period(constants, axis)) continue;
        table->period[axis] = (double)constants->domain_max[axis] - constants->domain_min[axis];
        table->periods[axis] = (int64_t)fmax(1.0, floor(table->period[axis] / table->cell[axis]));
        table->cell[axis] = table->period[axis] / (double)table->periods[axis];
    }
}

// Mean over the fluid of all other particles inside the support: fluid and solid.
static WeirStatus mean_neighbors(const WeirState *state, const WeirParameters *parameters,
                                 const WeirConstants *constants, double *mean)
{
    CellTable table = {.mask = 1023};
    while (table.mask < state->count && table.mask < 0x7FFFFFFFu) table.mask = 2 * table.mask + 1;
    start_table(&table, parameters, constants);
    table.head = calloc((size_t)table.mask + 1, sizeof(uint32_t));
    table.next = malloc(state->count * sizeof *table.next);
    table.key = malloc(state->count * sizeof *table.key);
    bool made = table.head && table.next && table.key;
    uint64_t sum = 0, fluid = 0;
    if (made) {
        for (uint32_t i = 0; i < state->count; ++i) {
            if (state->group && state->group[i] == WEIR_GROUP_EMPTY) continue;
            int64_t cell[3];
            cell_of(&table, &state->position[(size_t)table.dimension * i], cell);
            table.key[i] = key_of(cell);
            uint32_t *head = &table.head[bucket_of(&table, table.key[i])];
            table.next[i] = *head;
            *head = i + 1;
        }
        for (uint32_t i = 0; i < state->count; ++i) {
            if (!is_fluid(state, i)) continue;
            sum += neighbors_of(&table, state, i);
            ++fluid;
        }
    }
    free(table.head);
    free(table.next);
    free(table.key);
    *mean = fluid > 0 ? (double)sum / (double)fluid : 0.0;
    return made ? WEIR_OK : WEIR_ERROR_MEMORY;
}

// ---- Sums ----

void weir_sum_fluid(const WeirState *state, const WeirParameters *parameters, const WeirConstants *constants,
                    WeirDiagnosticSums *sums)
{
    uint32_t dimension = state->dimension;
    *sums = (WeirDiagnosticSums){.step = state->step, .time = state->time};
    for (size_t i = 0; i < state->count; ++i) {
        if (!is_fluid(state, i)) continue;
        const float *position = &state->position[dimension * i], *velocity = &state->velocity[dimension * i];
        double speed2 = 0.0;
        for (uint32_t axis = 0; axis < dimension; ++axis) {
            speed2 += (double)velocity[axis] * velocity[axis];
            sums->velocity[axis] += velocity[axis];
            sums->place[axis] += position[axis] - lowest_place(parameters, constants, axis);
        }
        // Compression only: at a free surface the sum lacks neighbours, which is no error of volume.
        double error = fmax(0.0, state->density[i] / (double)parameters->rest_density - 1.0);
        sums->density_error += error;
        sums->density_error_max = fmax(sums->density_error_max, error);
        sums->speed2 += speed2;
        sums->speed2_max = fmax(sums->speed2_max, speed2);
        sums->lost += is_lost(parameters, constants, position, velocity, dimension);
        ++sums->particles;
    }
}

void weir_diagnose_sums(const WeirDiagnosticSums *sums, const WeirParameters *parameters,
                        const WeirConstants *constants, WeirDiagnostics *diagnostics)
{
    double mass = constants->particle_mass;
    *diagnostics = (WeirDiagnostics){
        .density_error_mean = sums->particles > 0 ? sums->density_error / (double)sums->particles : 0.0,
        .density_error_max = sums->density_error_max,
        .kinetic_energy = 0.5 * mass * sums->speed2,
        .max_speed = sqrt(sums->speed2_max),
        .mean_neighbors = -1.0,
        .lost_particles = (uint32_t)sums->lost,
    };
    for (uint32_t axis = 0; axis < constants->dimension; ++axis) {
        diagnostics->momentum[axis] = mass * sums->velocity[axis];
        // Height above the lowest corner, times g.
        diagnostics->potential_energy -= mass * (double)parameters->gravity[axis] * sums->place[axis];
    }
}

WeirStatus weir_diagnose(const WeirState *state, const WeirParameters *parameters,
                         const WeirConstants *constants, uint32_t flags, WeirDiagnostics *diagnostics)
{
    WeirDiagnosticSums sums;
    weir_sum_fluid(state, parameters, constants, &sums);
    weir_diagnose_sums(&sums, parameters, constants, diagnostics);
    if (flags & WEIR_DIAGNOSE_HASH) diagnostics->state_hash = weir_state_hash(state);
    if (!(flags & WEIR_DIAGNOSE_NEIGHBORS)) return WEIR_OK;
    return mean_neighbors(state, parameters, constants, &diagnostics->mean_neighbors);
}
