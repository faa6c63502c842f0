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
    for (size_t i = 0; i < state->count; ++i) {
        hash = hash_word(hash, state->position[2 * i]);
        hash = hash_word(hash, state->position[2 * i + 1]);
        hash = hash_word(hash, state->velocity[2 * i]);
        hash = hash_word(hash, state->velocity[2 * i + 1]);
    }
    return hash;
}

// Height above the domain's lowest point along gravity, times g: potential energy per mass.
static double potential(const WeirParameters *parameters, const WeirConstants *constants,
                        const float *position)
{
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        double gravity = parameters->gravity[axis];
        double lowest = gravity < 0.0 ? constants->domain_min[axis] : constants->domain_max[axis];
        sum -= gravity * (position[axis] - lowest);
    }
    return sum;
}

static bool is_lost(const WeirConstants *constants, const float *position, const float *velocity)
{
    for (int axis = 0; axis < 2; ++axis) {
        // Written so that NaN counts as lost.
        if (!(position[axis] >= constants->domain_min[axis] &&
              position[axis] <= constants->domain_max[axis])) {
            return true;
        }
        if (!isfinite(velocity[axis])) return true;
    }
    return false;
}

// Particles by cell, as indices: heads of lists, one per cell.
typedef struct CellLists {
    uint32_t *head, *next; // index + 1, 0 ends a list
} CellLists;

static uint64_t neighbors_of(const WeirState *state, const WeirConstants *constants, const CellLists *lists,
                             float support_radius, uint32_t i)
{
    float x = state->position[2 * i], y = state->position[2 * i + 1], reach = constants->search_radius;
    uint32_t first_row = weir_grid_row(constants, y - reach), last_row = weir_grid_row(constants, y + reach);
    uint32_t first = weir_grid_column(constants, x - reach), last = weir_grid_column(constants, x + reach);
    uint64_t neighbors = 0;
    for (uint32_t row = first_row; row <= last_row; ++row) {
        for (uint32_t column = first; column <= last; ++column) {
            for (uint32_t j = lists->head[row * constants->cell_columns + column]; j;
                 j = lists->next[j - 1]) {
                float dx = x - state->position[2 * (j - 1)], dy = y - state->position[2 * (j - 1) + 1];
                neighbors += j - 1 != i && dx * dx + dy * dy < support_radius * support_radius;
            }
        }
    }
    return neighbors;
}

static WeirStatus mean_neighbors(const WeirState *state, const WeirParameters *parameters,
                                 const WeirConstants *constants, double *mean)
{
    CellLists lists = {calloc(constants->cell_count, sizeof(uint32_t)),
                       malloc(state->count * sizeof(uint32_t))};
    uint64_t sum = 0;
    if (lists.head && lists.next) {
        for (uint32_t i = 0; i < state->count; ++i) {
            uint32_t cell = weir_grid_row(constants, state->position[2 * i + 1]) * constants->cell_columns +
                            weir_grid_column(constants, state->position[2 * i]);
            lists.next[i] = lists.head[cell];
            lists.head[cell] = i + 1;
        }
        for (uint32_t i = 0; i < state->count; ++i) {
            sum += neighbors_of(state, constants, &lists, parameters->support_radius, i);
        }
    }
    WeirStatus status = lists.head && lists.next ? WEIR_OK : WEIR_ERROR_MEMORY;
    free(lists.head);
    free(lists.next);
    *mean = (double)sum / state->count;
    return status;
}

WeirStatus weir_diagnose(const WeirState *state, const WeirParameters *parameters,
                         const WeirConstants *constants, bool count_neighbors, WeirDiagnostics *diagnostics)
{
    double mass = constants->particle_mass, rest_density = parameters->rest_density;
    double error_sum = 0.0, error_max = 0.0, kinetic = 0.0, height = 0.0, momentum[2] = {0.0, 0.0},
           speed2_max = 0.0;
    uint32_t lost = 0;
    for (size_t i = 0; i < state->count; ++i) {
        const float *position = &state->position[2 * i], *velocity = &state->velocity[2 * i];
        double vx = velocity[0], vy = velocity[1], speed2 = vx * vx + vy * vy;
        // Compression only: at a free surface the sum lacks neighbours, which is no error of volume.
        double error = fmax(0.0, state->density[i] / rest_density - 1.0);
        error_sum += error;
        error_max = fmax(error_max, error);
        kinetic += 0.5 * mass * speed2;
        height += mass * potential(parameters, constants, position);
        momentum[0] += mass * vx;
        momentum[1] += mass * vy;
        speed2_max = fmax(speed2_max, speed2);
        lost += is_lost(constants, position, velocity);
    }
    *diagnostics = (WeirDiagnostics){
        .density_error_mean = error_sum / state->count,
        .density_error_max = error_max,
        .kinetic_energy = kinetic,
        .potential_energy = height,
        .momentum = {momentum[0], momentum[1], 0.0},
        .max_speed = sqrt(speed2_max),
        .mean_neighbors = -1.0,
        .lost_particles = lost,
        .state_hash = weir_state_hash(state),
    };
    if (!count_neighbors) return WEIR_OK;
    return mean_neighbors(state, parameters, constants, &diagnostics->mean_neighbors);
}
