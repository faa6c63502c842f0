#include "core/lattice_axis.h"

#include <math.h>

WeirAxis weir_axis_make(double min, double max, double spacing)
{
    WeirAxis axis = {.min = min, .max = max, .spacing = spacing};
    double size = max - min, sites = fmax(1.0, floor(size / spacing + 0.5));
    axis.sites = (long)fmin(sites, 1e9);
    axis.pitch = size / (double)axis.sites;
    return axis;
}

double weir_axis_site(const WeirAxis *axis, long k)
{
    if (k < 0) return axis->min + ((double)k + 0.5) * axis->spacing;
    if (k >= axis->sites) return axis->max + ((double)(k - axis->sites) + 0.5) * axis->spacing;
    return axis->min + ((double)k + 0.5) * axis->pitch;
}
