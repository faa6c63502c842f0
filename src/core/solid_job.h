// One wall or body on its way to particles: layers parallel to its surface at depths (k + 1/2) spacing into the
// solid, about one spacing apart.
#pragma once

#include "core/near.h"
#include "core/scene_shape.h"

typedef struct WeirSolidJob {
    const WeirSurface *surface;
    bool around;     // the solid is outside the shape
    uint32_t layers; // of particles; UINT32_MAX: all of the solid
    double spacing;
    bool clipped; // particles outside low, high are of no use
    double low[3], high[3];
    WeirNear near; // the particles made so far
} WeirSolidJob;

// Depth of a point in the solid, negative outside it.
static inline double weir_job_depth(const WeirSolidJob *job, const double *point)
{
    double distance = weir_surface_distance(job->surface, point);
    return job->around ? distance : -distance;
}

void weir_job_add(WeirSolidJob *job, const double *point);

// Particles of one shape each.
void weir_job_box(WeirSolidJob *job);
void weir_job_ball(WeirSolidJob *job);
void weir_job_cylinder(WeirSolidJob *job);
void weir_job_polygon(WeirSolidJob *job);
void weir_job_mesh(WeirSolidJob *job);

// Visits points of a fine raster from the shape's lowest corner, wherever the solid is at
// most `deepest` metres deep; skips the rest by halving boxes.
typedef void WeirVisit(WeirSolidJob *job, const double *point);
void weir_job_scan(WeirSolidJob *job, WeirVisit *visit, double deepest);
// Fills what is left: wherever no particle is within 0.73 spacings in 2D, 0.87 in 3D.
void weir_job_fill(WeirSolidJob *job);
