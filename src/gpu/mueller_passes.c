// The passes and buffers of `mueller`.
#include "core/grid.h"
#include "gpu/mueller.h"
#include "gpu/parallelism.h"
#include "gpu/sums.h"

#include <stdio.h>

#define SHADER(name) extern const char weir_wgsl_##name[];
SHADER(common_uniforms)
SHADER(common_index)
SHADER(common_grid)
SHADER(common_kernels)
SHADER(common_fluid)
SHADER(common_sums)
SHADER(solve_always)
SHADER(solve_count)
SHADER(solve_scan_reduce)
SHADER(solve_scan_write)
SHADER(solve_scatter)
SHADER(solve_density)
SHADER(solve_forces)
SHADER(solve_density_all_pairs)
SHADER(solve_forces_all_pairs)
SHADER(solve_integrate)
SHADER(solve_diagnose)

static const WeirBufferInfo buffers[WEIR_MUELLER_BUFFER_TOTAL] = {
    [WEIR_MUELLER_parameters] = {"parameters", "buffer parameters", true, false, NULL, NULL},
    [WEIR_MUELLER_constants] = {"constants", "buffer constants", true, false, NULL, NULL},
#define WEIR_BUFFER(name, per_particle, per_cell)                                                            \
    [WEIR_MUELLER_##name] = {#name, "buffer " #name, false, false, NULL, NULL},
    WEIR_MUELLER_BUFFERS
#undef WEIR_BUFFER
};

void weir_mueller_sizes(const WeirConstants *constants, WeirBufferSize sizes[WEIR_MUELLER_BUFFER_TOTAL])
{
    uint64_t count = constants->particle_count, cells = weir_padded_cells(constants->cell_count);
#define WEIR_BUFFER(name, per_particle, per_cell)                                                            \
    sizes[WEIR_MUELLER_##name].bytes = (uint64_t)(per_particle) * count + (uint64_t)(per_cell) * cells;
    WEIR_MUELLER_BUFFERS
#undef WEIR_BUFFER
    sizes[WEIR_MUELLER_parameters].bytes = sizeof(WeirParameters);
    sizes[WEIR_MUELLER_constants].bytes = sizeof(WeirConstants);
    sizes[WEIR_MUELLER_health].bytes = sizeof(WeirDeviceHealth);
    sizes[WEIR_MUELLER_fluid_sums].bytes = weir_sums_bytes((uint32_t)count);
    sizes[WEIR_MUELLER_block_sum].bytes = 4 * (cells / WEIR_SCAN_BLOCK);
}

#define BIT(name) (1u << WEIR_MUELLER_##name)
enum { SORTED = BIT(sorted_position) | BIT(sorted_velocity) | BIT(sorted_id) };
enum { STATE = BIT(position) | BIT(velocity) | BIT(id) };
#define NAMED(name) #name, "pass " #name, weir_wgsl_solve_##name, NULL, NULL

static const char *const sums_part[] = {weir_wgsl_common_sums, NULL};

static const WeirPassInfo passes[WEIR_MUELLER_PASS_TOTAL] = {
    [WEIR_MUELLER_COUNT] = {NAMED(count), BIT(position) | BIT(id), BIT(cell_count) | BIT(cell_link),
                            WEIR_ITEMS_PARTICLES},
    [WEIR_MUELLER_SCAN_REDUCE] = {NAMED(scan_reduce), BIT(cell_count), BIT(block_sum),
                                  WEIR_ITEMS_CELL_BLOCKS},
    [WEIR_MUELLER_SCAN_WRITE] = {NAMED(scan_write), BIT(block_sum), BIT(cell_count) | BIT(cell_start),
                                 WEIR_ITEMS_CELL_BLOCKS},
    [WEIR_MUELLER_SCATTER] = {NAMED(scatter), STATE | BIT(cell_link) | BIT(cell_start), SORTED,
                              WEIR_ITEMS_PARTICLES},
    [WEIR_MUELLER_DENSITY] = {NAMED(density), BIT(sorted_position) | BIT(sorted_velocity) | BIT(cell_start),
                              BIT(flow) | BIT(cell_link), WEIR_ITEMS_SHARES},
    [WEIR_MUELLER_FORCES] = {NAMED(forces), BIT(sorted_position) | BIT(flow) | BIT(cell_start),
                             BIT(acceleration) | BIT(health), WEIR_ITEMS_SHARES},
    [WEIR_MUELLER_DENSITY_ALL_PAIRS] = {NAMED(density_all_pairs), STATE, BIT(flow) | SORTED,
                                        WEIR_ITEMS_PARTICLES},
    [WEIR_MUELLER_FORCES_ALL_PAIRS] = {NAMED(forces_all_pairs), BIT(sorted_position) | BIT(flow),
                                       BIT(acceleration) | BIT(health), WEIR_ITEMS_PARTICLES},
    [WEIR_MUELLER_INTEGRATE] = {NAMED(integrate), SORTED | BIT(acceleration), STATE | BIT(health),
                                WEIR_ITEMS_PARTICLES},
    [WEIR_MUELLER_DIAGNOSE] = {"diagnose", "pass diagnose", weir_wgsl_solve_diagnose, NULL, sums_part,
                               BIT(sorted_position) | BIT(flow), BIT(fluid_sums), WEIR_ITEMS_SUMS},
};

static const char *const parts[] = {weir_wgsl_common_uniforms,
                                    weir_wgsl_common_index,
                                    weir_wgsl_common_grid,
                                    weir_wgsl_common_kernels,
                                    weir_wgsl_common_fluid,
                                    weir_wgsl_solve_always,
                                    NULL};

const WeirMethodInfo weir_mueller_method = {
    .buffers = buffers,
    .passes = passes,
    .buffer_count = WEIR_MUELLER_BUFFER_TOTAL,
    .pass_count = WEIR_MUELLER_PASS_TOTAL,
    .parts = parts,
};

uint32_t weir_mueller_lanes(const WeirGpu *gpu, uint32_t particle_count)
{
    // Measured on an H100: docs/performance/tries.md.
    double device = weir_parallelism_ratio(gpu);
    return particle_count <= 8192 * device ? 8 : particle_count <= 65536 * device ? 4 : 1;
}

uint32_t weir_mueller_settings(const WeirGpu *gpu, const WeirParameters *parameters,
                               const WeirConstants *constants, char settings[WEIR_SETTINGS_LENGTH])
{
    bool tutorial = parameters->kernels == WEIR_KERNELS_TUTORIAL;
    snprintf(settings, WEIR_SETTINGS_LENGTH,
             "const TUTORIAL_KERNELS = %s;\nconst FOLDED_X = %s;\nconst LANES = %uu;\n",
             tutorial ? "true" : "false", weir_grid_folds_columns(constants) ? "true" : "false",
             weir_mueller_lanes(gpu, constants->particle_count));
    uint32_t always = 1u << WEIR_MUELLER_INTEGRATE | 1u << WEIR_MUELLER_DIAGNOSE;
    uint32_t all_pairs = 1u << WEIR_MUELLER_DENSITY_ALL_PAIRS | 1u << WEIR_MUELLER_FORCES_ALL_PAIRS;
    if (parameters->search == WEIR_SEARCH_ALL_PAIRS) return all_pairs | always;
    return ((1u << WEIR_MUELLER_PASS_TOTAL) - 1) & ~all_pairs;
}
