// Density and forces of `mueller` on the CPU.
//
// One vector holds WEIR_LANES particles i that are neighbours in the sorted order, so they share almost all
// their candidates j: each candidate is broadcast to all lanes.
//
//   candidates j ->  . . . . . . . . . . . .      3 runs, one per cell row (more where the grid is folded)
//   lanes i          [ i0 i1 i2 ... ]             one vector
//
// Every lane adds its candidates in the sorted order, and a candidate outside its support adds exactly 0. So
// the sum has the same bits for any number of lanes: SSE, AVX, AVX-512, NEON and WebAssembly agree. Formulas:
// docs/method.md. Mirrors shaders/solve/density.wgsl and forces.wgsl.
#include "core/cpu/pairs.h"
#include "core/cpu/simd.h"
#include "core/grid.h"

// Name of the variant that this compilation makes; the build compiles this file once per instruction set.
#ifndef WEIR_PAIR_PASSES
#define WEIR_PAIR_PASSES weir_pair_passes_base
#endif
extern const WeirPairPasses WEIR_PAIR_PASSES;

// Candidates that lie side by side.
typedef struct Run {
    uint32_t begin, end;
} Run;

// Lanes of one vector, and the runs that hold all their neighbours: one per row of cells, two where the grid is folded.
enum { MAX_RUNS = 16 };
typedef struct Group {
    uint32_t lanes, run_count;
    Run run[MAX_RUNS];
} Group;

static inline void add_run(Group *group, const uint32_t *start, uint32_t first, uint32_t end)
{
    Run run = {start[first], start[end]};
    if (run.begin < run.end && group->run_count < MAX_RUNS) group->run[group->run_count++] = run;
}

static void find_runs(const WeirPairData *data, float low_x, float high_x, float low_y, float high_y,
                      Group *group)
{
    const WeirConstants *constants = data->constants;
    float reach = constants->search_radius;
    uint32_t columns = constants->cell_columns, last_row = weir_grid_row(constants, high_y + reach);
    uint32_t first = weir_grid_column(constants, low_x - reach);
    uint32_t count = weir_grid_column(constants, high_x + reach) + 1 - first;
    if (count > columns) count = columns;
    first = weir_grid_fold(first, columns);
    for (uint32_t row = weir_grid_row(constants, low_y - reach); row <= last_row; ++row) {
        const uint32_t *start = data->cell_start + weir_grid_fold(row, constants->cell_rows) * columns;
        uint32_t inside = first + count <= columns ? count : columns - first;
        add_run(group, start, first, first + inside);
        if (inside < count) add_run(group, start, 0, count - inside);
    }
}

// Takes particles from `begin` on, as long as they share a row and lie close enough that one run of
// candidates serves them all.
static void make_group(const WeirPairData *data, uint32_t begin, uint32_t end, Group *group)
{
    const WeirConstants *constants = data->constants;
    group->lanes = 1;
    group->run_count = 0;
    uint32_t most = end - begin < WEIR_LANES ? end - begin : WEIR_LANES;
    if (data->parameters->search == WEIR_SEARCH_ALL_PAIRS) {
        group->lanes = most;
        group->run[group->run_count++] = (Run){0, constants->particle_count};
        return;
    }
    float widest = 3.0f * constants->search_radius;
    float low_x = data->x[begin], high_x = low_x, low_y = data->y[begin], high_y = low_y;
    uint32_t row = weir_grid_row(constants, low_y);
    while (group->lanes < most) {
        float x = data->x[begin + group->lanes], y = data->y[begin + group->lanes];
        if (weir_grid_row(constants, y) != row || x - low_x > widest || high_x - x > widest) break;
        low_x = x < low_x ? x : low_x;
        high_x = x > high_x ? x : high_x;
        low_y = y < low_y ? y : low_y;
        high_y = y > high_y ? y : high_y;
        ++group->lanes;
    }
    find_runs(data, low_x, high_x, low_y, high_y, group);
}

// sum_j (h - r)^3, or sum_j (h^2 - r^2)^3 for the tutorial's kernel.
static inline __attribute__((always_inline)) WeirLanes sum_density(const WeirPairData *data,
                                                                   const Group *group, uint32_t begin,
                                                                   bool tutorial)
{
    const float *restrict x = data->x, *restrict y = data->y;
    float h = data->parameters->support_radius;
    WeirLanes xi = weir_lanes_load(x + begin), yi = weir_lanes_load(y + begin);
    WeirLanes support = weir_lanes_fill(tutorial ? h * h : h), zero = {0}, sum = {0};
    for (uint32_t n = 0; n < group->run_count; ++n) {
        Run run = group->run[n];
        for (uint32_t j = run.begin; j < run.end; ++j) {
            WeirLanes dx = xi - x[j], dy = yi - y[j];
            WeirLanes r2 = dx * dx + dy * dy;
            WeirLanes q = weir_lanes_max(support - (tutorial ? r2 : weir_lanes_sqrt(r2)), zero);
            sum += q * q * q;
        }
    }
    return sum;
}

// Equation of state p = k (rho - rho0), a negative pressure scaled by negative_pressure.
static void finish_density(const WeirPairData *data, uint32_t i, float sum)
{
    const WeirParameters *parameters = data->parameters;
    float density = data->constants->density_factor * sum;
    float pressure = parameters->gas_constant * (density - parameters->rest_density);
    if (pressure < 0.0f) pressure *= parameters->negative_pressure;
    float inverse = 1.0f / density;
    data->density[i] = density;
    data->pressure[i] = pressure;
    data->inverse_density[i] = inverse;
    data->pressure_term[i] =
        parameters->kernels == WEIR_KERNELS_TUTORIAL ? pressure : pressure * inverse * inverse;
}

static void density(const WeirPairData *data, uint32_t begin, uint32_t end)
{
    bool tutorial = data->parameters->kernels == WEIR_KERNELS_TUTORIAL;
    for (uint32_t i = begin; i < end;) {
        Group group;
        make_group(data, i, end, &group);
        WeirLanes sum = tutorial ? sum_density(data, &group, i, true) : sum_density(data, &group, i, false);
        for (uint32_t lane = 0; lane < group.lanes; ++lane) finish_density(data, i + lane, sum[lane]);
        i += group.lanes;
    }
}

// The sums of the force pass: pressure (along x_i - x_j) and viscosity (along v_j - v_i).
typedef struct Force {
    WeirLanes pressure_x, pressure_y, viscosity_x, viscosity_y;
} Force;

// consistent: sum_j (p_i/rho_i^2 + p_j/rho_j^2) (h-r)^2 (x_i-x_j)/r
// tutorial:   sum_j (p_i + p_j)/rho_j           (h-r)^2 (x_i-x_j)/r
// viscosity:  sum_j (v_j - v_i)/rho_j (h-r)
static inline __attribute__((always_inline)) Force sum_forces(const WeirPairData *data, const Group *group,
                                                              uint32_t begin, bool tutorial)
{
    const float *restrict x = data->x, *restrict y = data->y, *restrict vx = data->vx,
                          *restrict vy = data->vy;
    const float *restrict term = data->pressure_term, *restrict inverse_density = data->inverse_density;
    WeirLanes xi = weir_lanes_load(x + begin), yi = weir_lanes_load(y + begin);
    WeirLanes vxi = weir_lanes_load(vx + begin), vyi = weir_lanes_load(vy + begin);
    WeirLanes term_i = weir_lanes_load(term + begin);
    float support = data->parameters->support_radius;
    WeirLanes h = weir_lanes_fill(support), support2 = weir_lanes_fill(support * support), zero = {0};
    WeirLanes tiny = weir_lanes_fill(1e-24f); // m^2: keeps r = 0 from a division by zero; the force is 0 then
    Force force = {{0}, {0}, {0}, {0}};
    for (uint32_t n = 0; n < group->run_count; ++n) {
        Run run = group->run[n];
        for (uint32_t j = run.begin; j < run.end; ++j) {
            WeirLanes dx = xi - x[j], dy = yi - y[j];
            WeirLanes r2 = dx * dx + dy * dy;
            if (!weir_lanes_any_below(r2, support2)) continue; // it would add 0 to every lane
            WeirLanes r = weir_lanes_sqrt(weir_lanes_max(r2, tiny));
            WeirLanes q = weir_lanes_max(h - r, zero);
            WeirLanes pressure = (term_i + term[j]) * (q * q / r);
            WeirLanes viscosity = q * inverse_density[j];
            if (tutorial) pressure *= inverse_density[j];
            force.pressure_x += pressure * dx;
            force.pressure_y += pressure * dy;
            force.viscosity_x += viscosity * (vx[j] - vxi);
            force.viscosity_y += viscosity * (vy[j] - vyi);
        }
    }
    return force;
}

static void finish_forces(const WeirPairData *data, uint32_t i, const Force *force, uint32_t lane,
                          bool tutorial)
{
    float inverse = data->inverse_density[i];
    float pressure = data->constants->pressure_factor;
    if (tutorial) pressure *= 0.5f * inverse;
    float viscosity = data->constants->viscosity_factor * inverse;
    const float *gravity = data->parameters->gravity;
    data->ax[i] = pressure * force->pressure_x[lane] + viscosity * force->viscosity_x[lane] + gravity[0];
    data->ay[i] = pressure * force->pressure_y[lane] + viscosity * force->viscosity_y[lane] + gravity[1];
}

static void forces(const WeirPairData *data, uint32_t begin, uint32_t end)
{
    bool tutorial = data->parameters->kernels == WEIR_KERNELS_TUTORIAL;
    for (uint32_t i = begin; i < end;) {
        Group group;
        make_group(data, i, end, &group);
        Force force = tutorial ? sum_forces(data, &group, i, true) : sum_forces(data, &group, i, false);
        for (uint32_t lane = 0; lane < group.lanes; ++lane)
            finish_forces(data, i + lane, &force, lane, tutorial);
        i += group.lanes;
    }
}

const WeirPairPasses WEIR_PAIR_PASSES = {WEIR_SIMD_NAME, density, forces};
