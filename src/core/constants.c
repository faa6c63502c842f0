// From parameters and scene to what the passes read.
#include "core/grid.h"
#include "core/kernel.h"

#include <math.h>
#include <string.h>

void weir_grid_make(WeirConstants *constants, const double domain_min[3], const double domain_max[3])
{
    double width = domain_max[0] - domain_min[0], height = domain_max[1] - domain_min[1];
    double cell_height = constants->search_radius, cell_width = cell_height / WEIR_CELLS_PER_RADIUS;
    double limit = fmin(fmax(65536.0, 4.0 * constants->particle_count), 1073741824.0); // 32-bit indices
    while (ceil(width / cell_width) * ceil(height / cell_height) > limit) {
        cell_width *= 2.0;
        if (cell_width > cell_height) cell_height = cell_width;
    }
    constants->cell_columns = (uint32_t)ceil(width / cell_width);
    constants->cell_rows = (uint32_t)ceil(height / cell_height);
    constants->cell_count = constants->cell_columns * constants->cell_rows;
    constants->inverse_cell_width = (float)(1.0 / cell_width);
    constants->inverse_cell_height = (float)(1.0 / cell_height);
}

void weir_constants_set_tool(WeirConstants *constants, const WeirTool *tool)
{
    constants->tool_kind = tool ? (uint32_t)tool->kind : WEIR_TOOL_NONE;
    if (constants->tool_kind == WEIR_TOOL_NONE) return;
    constants->tool_radius = tool->radius;
    constants->tool_strength = tool->strength;
    memcpy(constants->tool_position, tool->position, sizeof tool->position);
    memcpy(constants->tool_velocity, tool->velocity, sizeof tool->velocity);
}

void weir_constants_make(WeirConstants *constants, const WeirParameters *parameters, uint32_t dimension,
                         const double domain_min[3], const double domain_max[3], uint32_t particle_count,
                         const WeirTool *tool)
{
    // A particle on the support radius adds nothing, so this margin only guards against rounding.
    static const double search_margin = 1.0001;
    double h = parameters->support_radius, mass = weir_calibrated_mass(parameters);
    // The kernels at r = 0 are their normalisations times h^3 and h^6.
    double spiky = weir_kernel_spiky(0.0, h) / (h * h * h);
    double density = parameters->kernels == WEIR_KERNELS_TUTORIAL
                         ? weir_kernel_poly6(0.0, h) / (h * h * h * h * h * h)
                         : spiky;
    memset(constants, 0, sizeof *constants);
    for (int axis = 0; axis < 3; ++axis) {
        constants->domain_min[axis] = (float)domain_min[axis];
        constants->domain_max[axis] = (float)domain_max[axis];
    }
    constants->dimension = dimension;
    constants->particle_count = particle_count;
    constants->particle_mass = (float)mass;
    constants->density_factor = (float)(mass * density);
    constants->pressure_factor = (float)(-mass * weir_kernel_spiky_gradient(0.0, h) / (h * h));
    constants->viscosity_factor =
        (float)(mass * parameters->viscosity * weir_kernel_viscosity_laplacian(0.0, h) / h);
    constants->search_radius = (float)(h * search_margin);
    constants->speed_limit = (float)(0.5 * h / parameters->time_step);
    weir_grid_make(constants, domain_min, domain_max);
    weir_constants_set_tool(constants, tool);
}
