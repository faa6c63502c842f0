// How `wcsph` on the GPU finds neighbours: lists with a skin or walks over cells, and how often particles are sorted.
#include "core/grid.h"
#include "gpu/parallelism.h"
#include "gpu/wcsph.h"

#include <math.h>

// What suits which fluid was measured on an H100 (docs/performance/tries.md). Numbers of particles, pairs and threads are for its
// parallelism, and go with a device's own (parallelism.h).
//
// Shares of the support radius. A list reaches two allowances beyond the support. Where chances to sort are seldom it is to
// last for four uses: three steps of 0.027 in flow at Mach 0.1.
static const double least_allowance = 0.03, most_allowance = 0.08, seldom_allowance = 0.1,
                    walk_allowance = 0.02;
// Neighbours that a list has room for, in those of the lattice: fluid may be squeezed, and disordered.
static const double list_margin = 1.25;
// Longer lists cannot be meant: 8 entries each.
static const double most_parts = 4096.0;
// In 2D lists may be made anew from cells that particles have left so far, and a walk around cells costs more by it. In 3D
// they have room for what the longest allowance leaves.
static const double most_stray = 0.6;
static const uint32_t lists_per_sort = 4; // chances
// For how many chances lists are made. Short ones in 3D, where making them costs most beside their use, are for more.
static const uint32_t list_life = 2, short_list_life = 3;
static const double short_list_neighbors = 60.0;
// A pass takes 4 us even if there is nothing to do: below so many pairs lists and sorts are offered every few steps only.
static const double pairs_for_every_step = 2e7;
// Particles whose lists lie side by side, `PART_STRIDE` in common/lists.wgsl.
enum { LIST_BLOCK = 128 };
// Threads share a particle's neighbours while they are no more than so many times n, and each has so many of the n.
static const double threads_per_neighbor = 2300.0, neighbors_per_lane = 9.0;
static const uint32_t most_lanes = 8;
// In 2D from so many particles on, few of which are near walls; sums over fluid alone take a tenth of the instructions less.
static const double least_marked = 262144.0;

// Whether a periodic axis is so short that a list could hold a particle twice.
static bool is_short(const WeirConstants *constants, double reach)
{
    double support = (double)(1u << constants->coordinate_bits);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        uint32_t period = weir_period(constants, axis);
        if (period > 0 && (double)period < 2.0 * (reach + 0.1) * support) return true;
    }
    return false;
}

// A reader looks up to eight chunks, four parts, beyond a list's end.
enum { LIST_SLACK = 4 * 16 * LIST_BLOCK };

WeirBufferSize weir_gpu_wcsph_list_size(const WeirWcsphTraits *traits)
{
    if (traits->list_parts == 0) return (WeirBufferSize){.bytes = 16}; // nobody looks
    uint64_t block = 16 * LIST_BLOCK * ((uint64_t)traits->list_parts + 1);
    return (WeirBufferSize){block * traits->list_blocks, traits->list_shares, LIST_SLACK};
}

// Storage buffers of pass forces besides the lists.
static uint32_t other_buffers(const WeirConstants *constants, uint64_t most_bytes)
{
    bool apart = 3 * 16 * (uint64_t)constants->particle_count + 7 * 16 > most_bytes;
    return apart ? 7 + 2 * 3 : 7; // coordinate, motion, kicked
}

// In as many shares as the device's bindings ask for. False if these are too many, or the lists too large.
static bool share_lists(WeirWcsphTraits *traits, const WeirConstants *constants, const WeirGpu *gpu,
                        uint64_t most_list_bytes)
{
    uint64_t most_bytes = weir_buffers_most_bytes(gpu), buffers = gpu->limits.maxStorageBuffersPerShaderStage;
    uint64_t blocks = ((uint64_t)constants->particle_count + LIST_BLOCK - 1) / LIST_BLOCK;
    uint64_t block = 16 * LIST_BLOCK * ((uint64_t)traits->list_parts + 1),
             bytes = block * blocks + LIST_SLACK;
    if (most_bytes < block + LIST_SLACK || bytes > most_list_bytes || bytes / 8 > UINT32_MAX) return false;
    uint64_t most_blocks = (most_bytes - LIST_SLACK) / block,
             shares = (blocks + most_blocks - 1) / most_blocks;
    traits->list_shares = (uint32_t)shares;
    traits->list_blocks = (uint32_t)((blocks + shares - 1) / shares);
    return shares <= WEIR_MAX_PARTS &&
           (shares == 1 || shares + other_buffers(constants, most_bytes) <= buffers);
}

// 0: none.
static uint32_t parts_of_lists(const WeirParameters *parameters, const WeirConstants *constants,
                               double allowance)
{
    double reach = 1.0 + 2.0 * allowance;
    double neighbors = weir_lattice_neighbors(parameters, constants->dimension, reach);
    double wanted = ceil(list_margin * neighbors / 8.0) + 1.0;
    if (!(wanted <= most_parts)) return 0; // what is not a number too
    return is_short(constants, reach) ? 0 : (uint32_t)wanted;
}

// In 3D rows and layers half as high offer 2.3 candidates per neighbour instead of 3.6: where cells, an eighth of a support
// wide, then still hold nearly a particle each. Lists name three layers, so for them only rows are halved.
static bool halves_rows(const WeirParameters *parameters, uint32_t dimension)
{
    double ratio = (double)parameters->support_radius / parameters->particle_spacing;
    return dimension == 3 && ratio * ratio * ratio / 32.0 >= 0.75;
}

// Few particles do not fill a large device, and a thread takes neighbours one after the other; but each thread more has
// its own way to them, and its share to hand over. A processor that plays the device is full with one thread each.
static uint32_t lanes_for(double particles, double neighbors, const WeirGpu *gpu)
{
    uint32_t lanes = 1, most = gpu->software ? 1 : most_lanes;
    double threads = weir_parallelism_ratio(gpu) * threads_per_neighbor * neighbors;
    while (lanes < most && 2 * lanes * particles <= threads && 2 * lanes * neighbors_per_lane <= neighbors)
        lanes *= 2;
    return lanes;
}

// Threads of a workgroup of pass forces: large ones where particles have one thread each, in 3D small ones elsewhere.
static uint32_t share_threads_for(uint32_t dimension, uint32_t lanes)
{
    if (lanes == 1) return 2 * WEIR_WORKGROUP_SIZE;
    return dimension == 3 ? WEIR_WORKGROUP_SIZE / 2 : WEIR_WORKGROUP_SIZE;
}

// How often particles are sorted. `margin`: how far lists look beyond the support, in supports; 0: there are none.
static void take_sorting(WeirWcsphTraits *traits, const WeirConstants *constants, double margin)
{
    bool strays = margin > 0.0 && constants->dimension == 2;
    // Sorts bring places back into a periodic domain, by one period.
    bool repeats = constants->period_x > 0 || constants->period_y > 0;
    traits->sort_interval =
        strays && !repeats ? lists_per_sort * traits->list_interval : traits->list_interval;
    double support = (double)(1u << constants->coordinate_bits);
    traits->most_stray = (uint32_t)((margin + (strays ? most_stray : 0.0)) * support);
}

void weir_gpu_wcsph_plan(WeirWcsphTraits *traits, const WeirParameters *parameters,
                         const WeirConstants *constants, const WeirGpu *gpu, uint64_t most_list_bytes)
{
    double support = (double)(1u << constants->coordinate_bits);
    double neighbors = weir_lattice_neighbors(parameters, constants->dimension, 1.0);
    double device = weir_parallelism_ratio(gpu);
    double pairs = constants->particle_count * neighbors;
    traits->lanes = lanes_for(constants->particle_count, neighbors, gpu);
    traits->share_threads = share_threads_for(constants->dimension, traits->lanes);
    bool every = pairs > device * pairs_for_every_step || parameters->stepping == WEIR_STEPPING_FIXED;
    traits->list_interval = every ? 1 : WEIR_EMISSION_INTERVAL;
    traits->list_life =
        constants->dimension == 3 && neighbors <= short_list_neighbors ? short_list_life : list_life;
    double least = least_allowance, most = every ? most_allowance : seldom_allowance;
    traits->list_parts = parts_of_lists(parameters, constants, most);
    bool lists = traits->list_parts > 0 && share_lists(traits, constants, gpu, most_list_bytes);
    if (!lists) traits->list_parts = 0;
    traits->one_pass = constants->dimension == 2 && !traits->moving_solids;
    traits->marks_mixed = lists && traits->solid_count > 0 && constants->dimension == 2 &&
                          constants->particle_count >= device * least_marked;
    if (!lists) least = most = walk_allowance;
    traits->least_allowance = (uint32_t)(least * support);
    traits->most_allowance = (uint32_t)(most * support);
    take_sorting(traits, constants, lists ? 2.0 * most : 0.0);
    // One row on either side holds all of a list, or what a walk wants while the order lasts.
    uint32_t height = (uint32_t)((1.0 + (lists ? 2.0 : 1.0) * most) * support) + 16;
    traits->row_height = height > 1u << constants->row_shift ? height : 1u << constants->row_shift;
    traits->layer_height = traits->row_height;
    if (halves_rows(parameters, constants->dimension)) {
        traits->row_height = (traits->row_height + 1) / 2;
        if (!lists) traits->layer_height = traits->row_height; // lists name three layers
    }
}

static uint32_t rows_of(uint32_t rows, uint32_t shift, uint32_t height)
{
    uint64_t extent = (uint64_t)rows << shift;
    return (uint32_t)((extent + height - 1) / height);
}

WeirConstants weir_gpu_wcsph_cells(const WeirWcsphTraits *traits, const WeirConstants *constants)
{
    WeirConstants cells = *constants;
    cells.cell_rows = rows_of(constants->cell_rows, constants->row_shift, traits->row_height);
    cells.cell_layers = constants->dimension == 3
                            ? rows_of(constants->cell_layers, constants->row_shift, traits->layer_height)
                            : 1;
    cells.cell_count = cells.cell_columns * cells.cell_rows * cells.cell_layers;
    return cells;
}
