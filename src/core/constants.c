// From parameters and scene to what the passes read.
#include "core/grid.h"
#include "core/kernel.h"
#include "core/scene_shape.h"
#include "core/smoothing.h"

#include <float.h>
#include <math.h>
#include <string.h>

void weir_constants_set_tool(WeirConstants *constants, const WeirTool *tool)
{
    constants->tool_kind = tool ? (uint32_t)tool->kind : WEIR_TOOL_NONE;
    if (constants->tool_kind == WEIR_TOOL_NONE) return;
    constants->tool_radius = tool->radius;
    constants->tool_strength = tool->strength;
    memcpy(constants->tool_position, tool->position, sizeof tool->position);
    memcpy(constants->tool_velocity, tool->velocity, sizeof tool->velocity);
}

// ---- The grid ----

// What a folded grid should hold along each axis: the longest piece of fluid and a quarter of it, in units of `unit` m.
static void longest_pieces(const WeirScene *scene, double unit, double length[3])
{
    length[0] = length[1] = length[2] = 0.0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        double low[3], high[3];
        weir_shape_bounds(&scene->fluid[n].shape, scene->dimension, low, high);
        for (uint32_t axis = 0; axis < scene->dimension; ++axis)
            length[axis] = fmax(length[axis], 1.25 * (high[axis] - low[axis]) / unit);
    }
}

// Fits a grid to the domain: cells per axis, cell sizes in a unit of length.
typedef struct Fit {
    double extent[3]; // of the domain
    double least[3];  // a folded grid reaches no less far
    double cell[3];   // size of a cell: as wished, then as it became
    double domain[3]; // cells of the domain
    double lines[3];  // and of the grid
} Fit;

// To at most 4 cells per particle, so that memory is bound to them: first folded where it is longest (grid.h), then with
// larger cells.
static void fit_grid(Fit *fit, uint32_t particle_count)
{
    static const double fewest[3] = {WEIR_LEAST_COLUMNS, WEIR_LEAST_ROWS, WEIR_LEAST_ROWS};
    double limit = fmin(fmax(65536.0, 4.0 * particle_count), 1073741824.0); // 32-bit indices
    double *lines = fit->lines, *cell = fit->cell;
    bool grown = true;
    for (;;) {
        int longest = -1;
        double length = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            if (grown) lines[axis] = fit->domain[axis] = floor(fit->extent[axis] / cell[axis]) + 1.0;
            double less = 0.75 * lines[axis], own = lines[axis] * cell[axis];
            if (less < fewest[axis] || less * cell[axis] < fit->least[axis] || own <= length) continue;
            longest = axis;
            length = own;
        }
        if (lines[0] * lines[1] * lines[2] <= limit) return;
        grown = longest < 0;
        if (!grown) {
            lines[longest] = floor(0.75 * lines[longest]);
            continue;
        }
        cell[0] *= 2.0;
        if (cell[0] > cell[1]) cell[1] = cell[2] = cell[0];
    }
}

static void take_grid(WeirConstants *constants, const Fit *fit)
{
    constants->cell_columns = (uint32_t)fit->lines[0];
    constants->cell_rows = (uint32_t)fit->lines[1];
    constants->cell_layers = (uint32_t)fit->lines[2];
    constants->cell_count = constants->cell_columns * constants->cell_rows * constants->cell_layers;
    constants->domain_columns = (uint32_t)fit->domain[0];
    constants->domain_rows = (uint32_t)fit->domain[1];
}

// Cells of `mueller`.
static void make_cells(WeirConstants *constants, const WeirScene *scene)
{
    double height = constants->search_radius, width = height / WEIR_CELLS_PER_RADIUS;
    Fit fit = {.cell = {width, height, height}};
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        fit.extent[axis] = scene->domain_max[axis] - scene->domain_min[axis];
        fit.cell[axis] = fmax(fit.cell[axis], fit.extent[axis] / 1073741824.0); // lines are 32-bit too
    }
    longest_pieces(scene, 1.0, fit.least);
    fit_grid(&fit, constants->particle_count);
    take_grid(constants, &fit);
    constants->inverse_cell_width = (float)(1.0 / fit.cell[0]);
    constants->inverse_cell_height = (float)(1.0 / fit.cell[1]);
}

// Constants of the passes of `mueller`.
static void make_mueller(WeirConstants *constants, const WeirScene *scene, const WeirParameters *parameters)
{
    // A particle on the support radius adds nothing, so this margin only guards against rounding.
    static const double search_margin = 1.0001;
    double h = parameters->support_radius, mass = weir_calibrated_mass(parameters);
    // The kernels at r = 0 are their normalisations times h^3 and h^6.
    double spiky = weir_kernel_spiky(0.0, h) / (h * h * h);
    double density = parameters->kernels == WEIR_KERNELS_TUTORIAL
                         ? weir_kernel_poly6(0.0, h) / (h * h * h * h * h * h)
                         : spiky;
    constants->particle_mass = (float)mass;
    constants->density_factor = (float)(mass * density);
    constants->pressure_factor = (float)(-mass * weir_kernel_spiky_gradient(0.0, h) / (h * h));
    constants->viscosity_factor =
        (float)(mass * parameters->viscosity * weir_kernel_viscosity_laplacian(0.0, h) / h);
    constants->search_radius = (float)(h * search_margin);
    constants->speed_limit = (float)(0.5 * h / parameters->time_step);
    make_cells(constants, scene);
}

// Coordinates and cells of `wcsph`. The grid reaches two support radii beyond the domain, for walls; not along
// periodic axes. Cells are one support radius high and deep and an eighth as wide, at most 4 per particle.
static void make_coordinates(WeirConstants *constants, const WeirScene *scene, double support_radius)
{
    Fit fit = {.cell = {0.0}};
    double *extent = fit.extent, longest = 0.0;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        double margin = scene->periodic[axis] ? 0.0 : 2.0 * support_radius;
        constants->origin[axis] = (float)(scene->domain_min[axis] - margin);
        extent[axis] = scene->domain_max[axis] + margin - (double)constants->origin[axis];
        longest = fmax(longest, extent[axis]);
    }
    // Differences inside the support must be exact in float32 (24 bits), and all coordinates below 2^30.
    uint32_t bits = 24;
    while (bits > 8 && longest / support_radius * (double)(1u << bits) >= 1073741824.0) --bits;
    double quantum = support_radius / (double)(1u << bits);
    constants->coordinate_bits = bits;
    constants->quantum = (float)quantum;
    constants->inverse_quantum = (float)(1.0 / quantum);
    constants->inverse_support = (float)(1.0 / (double)(1u << bits));
    uint32_t *periods[3] = {&constants->period_x, &constants->period_y, &constants->period_z};
    for (int axis = 0; axis < 3; ++axis) {
        double period = scene->domain_max[axis] - scene->domain_min[axis];
        *periods[axis] = scene->periodic[axis] ? (uint32_t)floor(period / quantum + 0.5) : 0;
        extent[axis] /= quantum;
    }
    longest_pieces(scene, quantum, fit.least);
    for (int axis = 0; axis < 3; ++axis)
        if (scene->periodic[axis]) fit.least[axis] = INFINITY;
    fit.cell[0] = (double)(1u << (bits - 3));
    fit.cell[1] = fit.cell[2] = (double)(1u << bits);
    fit_grid(&fit, constants->particle_count);
    take_grid(constants, &fit);
    constants->column_shift = (uint32_t)ilogb(fit.cell[0]);
    constants->row_shift = (uint32_t)ilogb(fit.cell[1]);
}

int32_t weir_coordinate_of(const WeirConstants *constants, double place, uint32_t axis)
{
    double away = rint((place - (double)constants->origin[axis]) / (double)constants->quantum);
    uint32_t period = weir_period(constants, axis);
    if (period > 0) away -= period * floor(away / period);
    return (int32_t)fmin(fmax(away, -2e9), 2e9); // NaN too
}

// Where the domain's sides act on fluid (docs/wcsph.md). Free fluid goes no deeper into a wall than the seal, just short of its
// first layer; what gets past an open side, or a support radius past a wall, is lost.
static void make_bounds(WeirConstants *constants, const WeirScene *scene, const WeirParameters *parameters)
{
    static const double seal_depth = 0.45; // spacings
    for (uint32_t axis = 0; axis < 3; ++axis) {
        int32_t *const seal[2] = {&constants->seal_low[axis], &constants->seal_high[axis]};
        int32_t *const inside[2] = {&constants->inside_low[axis], &constants->inside_high[axis]};
        const double ends[2] = {scene->domain_min[axis], scene->domain_max[axis]};
        for (int side = 0; side < 2; ++side) {
            *seal[side] = *inside[side] = side == 0 ? INT32_MIN : INT32_MAX;
            if (axis >= scene->dimension || scene->periodic[axis]) continue;
            double outward = side == 0 ? -1.0 : 1.0;
            bool open = scene->open[axis][side];
            double deepest = open ? 0.0 : parameters->support_radius;
            *inside[side] = weir_coordinate_of(constants, ends[side] + outward * deepest, axis);
            double sealed = ends[side] + outward * seal_depth * parameters->particle_spacing;
            if (!open) *seal[side] = weir_coordinate_of(constants, sealed, axis);
        }
    }
}

// m^3; in 2D m^2.
static double site_volume(double spacing, uint32_t dimension)
{
    return dimension == 3 ? spacing * spacing * spacing : spacing * spacing;
}

// Sites of an endless lattice: those of a box of cells, all of them or every other one as on a chessboard. The resting
// lattice is square or cubic; fluid that has moved, and was shifted, comes close to the densest one, hexagonal or
// face-centred cubic.
typedef struct Lattice {
    double cell[3]; // m; the third 0 in 2D
    bool alternate;
} Lattice;

static Lattice resting_lattice(double spacing, uint32_t dimension)
{
    return (Lattice){{spacing, spacing, dimension == 3 ? spacing : 0.0}, false};
}

// With as much volume per site.
static Lattice densest_lattice(double spacing, uint32_t dimension)
{
    if (dimension == 3) {
        double edge = spacing / cbrt(2.0);
        return (Lattice){{edge, edge, edge}, true};
    }
    double side = spacing * sqrt(2.0 / sqrt(3.0));
    return (Lattice){{0.5 * side, 0.5 * sqrt(3.0) * side, 0.0}, true};
}

// Over the sites: V W with the middle included and V (-F) r^2 / d, which are 1 but for the kernel's quadrature error; and
// V (1 - r / R) r^2 / d; and V (-F) |y|, 1/m.
typedef struct LatticeSums {
    double filling, laplacian, compact, crossing;
} LatticeSums;

static LatticeSums lattice_sums(const WeirParameters *parameters, uint32_t dimension, Lattice lattice)
{
    double spacing = parameters->particle_spacing, support = parameters->support_radius;
    double volume = site_volume(spacing, dimension);
    int reach[3] = {0, 0, 0};
    for (uint32_t axis = 0; axis < dimension; ++axis)
        reach[axis] = (int)fmin(ceil(support / lattice.cell[axis]), 100.0);
    LatticeSums sums = {0.0, 0.0, 0.0, 0.0};
    for (int k = -reach[2]; k <= reach[2]; ++k) {
        for (int j = -reach[1]; j <= reach[1]; ++j) {
            for (int i = -reach[0]; i <= reach[0]; ++i) {
                if (lattice.alternate && (i + j + k) % 2 != 0) continue;
                double x = i * lattice.cell[0], y = j * lattice.cell[1], z = k * lattice.cell[2];
                double r = sqrt(x * x + y * y + z * z);
                sums.filling += volume * weir_smoothing_value(parameters->kernel, dimension, r, support);
                double slope = -weir_smoothing_gradient(parameters->kernel, dimension, r, support);
                sums.laplacian += volume * slope * r * r / dimension;
                sums.crossing += volume * slope * fabs(y);
                sums.compact += volume * r * r / dimension * fmax(1.0 - r / support, 0.0);
            }
        }
    }
    return sums;
}

enum { WAVES = 7, PHASES = 16 };

// Waves of displacements on the resting lattice, along each axis and diagonal, with PHASES phases from site to site up to pi:
// how fast shifting undoes them, as a share of the amplitude per unit of u / (- sum_j V_j (1 + 0.2 (W / W(spacing))^4) F x).
typedef struct ShiftingRates {
    double rate[WAVES][PHASES];
} ShiftingRates;

// A site at `place`, in spacings.
static void add_site(ShiftingRates *rates, const WeirParameters *parameters, uint32_t dimension,
                     double spacing, const int place[3])
{
    double r = spacing * sqrt(place[0] * place[0] + place[1] * place[1] + place[2] * place[2]), term[2];
    double support = parameters->support_radius, step = 1e-4 * spacing;
    double at_spacing = weir_smoothing_value(parameters->kernel, dimension, spacing, support);
    for (int side = 0; side < 2; ++side) {
        double at = r + (side ? step : -step);
        double ratio = weir_smoothing_value(parameters->kernel, dimension, at, support) / at_spacing;
        term[side] = (1.0 + 0.2 * pow(ratio, 4.0)) *
                     weir_smoothing_gradient(parameters->kernel, dimension, at, support);
    }
    double volume = site_volume(spacing, dimension);
    double value = 0.5 * (term[0] + term[1]), slope = (term[1] - term[0]) / (2.0 * step);
    for (int wave = 0; wave < (1 << dimension) - 1; ++wave) {
        int sites = 0, axes = 0;
        for (int axis = 0; axis < 3; ++axis) {
            int along = (wave + 1) >> axis & 1;
            sites += along * place[axis];
            axes += along;
        }
        double way = spacing * spacing * sites * sites / axes;
        for (int n = 0; n < PHASES; ++n)
            rates->rate[wave][n] += volume * (1.0 - cos((n + 1) * 3.141592653589793 / PHASES * sites)) *
                                    (value + slope * way / r);
    }
}

// 1 / the speed of fluid along a wall from which friction is turbulent (docs/wcsph.md): where the profile
// u+ = 8.3 y+^(1/7) meets the viscous sublayer u+ = y+ (H. Werner, H. Wengle 1993). `height`: what speed over friction's shear
// rate is for fluid at rest on its lattice that slides along a wall.
static float inverse_turbulent_slip(const WeirParameters *parameters, double height)
{
    double reynolds = pow(8.3, 7.0 / 3.0);
    if (!(parameters->viscosity > 0.0f) || parameters->wall_function == WEIR_WALL_FUNCTION_OFF) return 0.0f;
    return (float)fmin(parameters->rest_density * height / (reynolds * parameters->viscosity), FLT_MAX);
}

// Shifting is an explicit step of a diffusion of the particles: if it undid the fastest wave by more than twice the amplitude
// in a step it would make pairs of particles. 1.4 times at most.
static double shifting_limit(const WeirParameters *parameters, uint32_t dimension)
{
    double support = parameters->support_radius;
    double spacing =
        fmax(parameters->particle_spacing, support / 6.0); // from there on the rates hardly change
    int reach = (int)ceil(support / spacing), layers = dimension == 3 ? reach : 0;
    ShiftingRates rates = {0};
    for (int k = -layers; k <= layers; ++k) {
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
                if (i != 0 || j != 0 || k != 0)
                    add_site(&rates, parameters, dimension, spacing, (int[]){i, j, k});
            }
        }
    }
    double fastest = 0.0;
    for (int wave = 0; wave < WAVES; ++wave)
        for (int n = 0; n < PHASES; ++n) fastest = fmax(fastest, rates.rate[wave][n]);
    double strength =
        4.0 * weir_smoothing_length(parameters->kernel, support) * parameters->shifting * fastest;
    return strength > 0.0 ? fmin(1.4 / strength, 1e30) : 1e30;
}

// Constants of the passes of `wcsph`.
static void make_wcsph(WeirConstants *constants, const WeirScene *scene, const WeirParameters *parameters)
{
    double support = parameters->support_radius, spacing = parameters->particle_spacing;
    uint32_t kernel = parameters->kernel, dimension = scene->dimension;
    double volume = site_volume(spacing, dimension);
    constants->particle_mass = (float)(parameters->rest_density * volume);
    constants->smoothing_length = (float)weir_smoothing_length(kernel, support);
    constants->kernel_factor = (float)weir_smoothing_factor(kernel, dimension, support);
    constants->gradient_factor = (float)weir_smoothing_gradient_factor(kernel, dimension, support);
    constants->clustering_factor = (float)(0.2 / pow(weir_smoothing_shape(kernel, spacing / support), 4.0));
    LatticeSums resting = lattice_sums(parameters, dimension, resting_lattice(spacing, dimension));
    LatticeSums densest = lattice_sums(parameters, dimension, densest_lattice(spacing, dimension));
    constants->shifting_limit = (float)shifting_limit(parameters, dimension);
    constants->lattice_filling = (float)resting.filling;
    constants->laplacian_factor = (float)(2.0 * (double)constants->particle_mass / densest.compact);
    // Its fastest wave has the rate 16 / R^2 (15 to 15.9 on lattices at all supports); beyond 2 / rate it overshoots for ever.
    constants->diffusion_limit =
        (float)(1.9 / 16.0 * support * support / (parameters->sound_speed * parameters->sound_speed));
    constants->sound_speed = parameters->sound_speed;
    constants->acoustic_rate = parameters->sound_speed / constants->smoothing_length;
    constants->search_radius = (float)support;
    constants->speed_limit = 4.0f * parameters->sound_speed; // docs/wcsph.md
    // The larger of laminar and artificial viscosity acts (docs/wcsph.md).
    double length = weir_smoothing_length(kernel, support) * parameters->sound_speed;
    double artificial = parameters->rest_density * parameters->artificial_viscosity * length;
    double laminar = 2.0 * (dimension + 2.0) * parameters->viscosity;
    constants->viscosity_factor = (float)fmax(artificial, laminar);
    constants->viscous_step = (float)weir_viscous_step(parameters);
    constants->artificial_factor = artificial > laminar ? (float)artificial : 0.0f;
    // On the densest lattice Morris' Laplacian of a quadratic field is exact.
    constants->friction_factor = (float)(2.0 * parameters->viscosity / densest.laplacian);
    constants->laminar_factor = artificial > laminar ? 0.0f : constants->friction_factor;
    constants->inverse_turbulent_slip =
        inverse_turbulent_slip(parameters, densest.laplacian / (2.0 * resting.crossing));
    for (int axis = 0; axis < (int)dimension; ++axis) {
        for (int side = 0; side < 2; ++side)
            if (scene->open[axis][side]) constants->open_sides |= 1u << (2 * axis + side);
    }
    make_coordinates(constants, scene, support);
    make_bounds(constants, scene, parameters);
}

void weir_constants_make(WeirConstants *constants, const WeirScene *scene, const WeirParameters *parameters,
                         uint32_t particle_count, const WeirTool *tool)
{
    memset(constants, 0, sizeof *constants);
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        constants->domain_min[axis] = (float)scene->domain_min[axis];
        constants->domain_max[axis] = (float)scene->domain_max[axis];
        constants->center[axis] = (float)(0.5 * (scene->domain_min[axis] + scene->domain_max[axis]));
    }
    constants->dimension = scene->dimension;
    constants->particle_count = particle_count;
    constants->cell_layers = 1;
    if (scene->method == WEIR_METHOD_WCSPH) {
        make_wcsph(constants, scene, parameters);
    } else {
        make_mueller(constants, scene, parameters);
    }
    weir_constants_set_tool(constants, tool);
}
