// What Weir thinks of a scene that is valid: the speeds to expect, the time step that it can bear.
#include "core/kernel.h"
#include "core/scene_shape.h"
#include "core/smoothing.h"

#include <math.h>

// Largest speed that a piece of fluid can reach, m/s: v^2 = v0^2 + `factor` g (fall to the domain's end).
static double falling_speed(const WeirScene *scene, const WeirFluid *fluid, double factor)
{
    double low[3], high[3], speed2 = 0.0;
    weir_shape_bounds(&fluid->shape, scene->dimension, low, high);
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        double gravity = scene->periodic[axis] ? 0.0 : scene->parameters.gravity[axis];
        double fall =
            gravity < 0.0 ? high[axis] - scene->domain_min[axis] : scene->domain_max[axis] - low[axis];
        speed2 += fluid->velocity[axis] * fluid->velocity[axis] + factor * fabs(gravity) * fmax(fall, 0.0);
    }
    return sqrt(speed2);
}

static double largest_speed(const WeirScene *scene, double factor)
{
    double largest = 0.0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n)
        largest = fmax(largest, falling_speed(scene, &scene->fluid[n], factor));
    return largest;
}

// Shortest extent of the domain.
static double shortest_extent(const WeirScene *scene)
{
    double shortest = INFINITY;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis)
        shortest = fmin(shortest, scene->domain_max[axis] - scene->domain_min[axis]);
    return shortest;
}

// The weakly compressible criterion, Morris et al. 1997: c^2 >= max(V^2, nu V / L, F L) / 0.01. F is what drives the
// flow along periodic axes and towards the domain's middle.
double weir_scene_expected_speed(const WeirScene *scene)
{
    const WeirParameters *parameters = &scene->parameters;
    double length = shortest_extent(scene), speed = largest_speed(scene, 4.0);
    double viscosity = (double)parameters->viscosity / parameters->rest_density;
    double force = (double)parameters->central_force * length;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        if (scene->periodic[axis]) force += fabs((double)parameters->gravity[axis]);
    }
    double expected = sqrt(fmax(speed * speed, fmax(viscosity * speed / length, force * length)));
    return expected > 0.0 ? expected : 1.0; // nothing moves by itself
}

WeirParameters weir_scene_resolved(const WeirScene *scene)
{
    WeirParameters resolved = scene->parameters;
    if (scene->method != WEIR_METHOD_WCSPH) return resolved;
    if (resolved.support_radius == 0.0f)
        resolved.support_radius = (scene->dimension == 2 ? 4.0f : 3.0f) * resolved.particle_spacing;
    double speed =
        resolved.expected_speed > 0.0f ? resolved.expected_speed : weir_scene_expected_speed(scene);
    if (resolved.sound_speed == 0.0f) resolved.sound_speed = (float)(10.0 * speed);
    return resolved;
}

// docs/wcsph.md, time step, for the largest speed expected.
static double wcsph_time_step(const WeirScene *scene)
{
    WeirParameters parameters = weir_scene_resolved(scene);
    double h = weir_smoothing_length(parameters.kernel, parameters.support_radius);
    double sound = (double)parameters.courant * h / (1.1 * parameters.sound_speed);
    double mu = parameters.viscosity;
    return mu > 0.0 ? fmin(sound, 0.125 * h * h * parameters.rest_density / mu) : sound;
}

double weir_scene_stable_time_step(const WeirScene *scene)
{
    if (scene->method == WEIR_METHOD_WCSPH) return wcsph_time_step(scene);
    return weir_stable_time_step(&scene->parameters, largest_speed(scene, 2.0));
}

void weir_scene_advise(WeirScene *scene)
{
    double stable = weir_scene_stable_time_step(scene);
    bool wcsph = scene->method == WEIR_METHOD_WCSPH;
    scene->warning.text[0] = '\0';
    if (wcsph && scene->parameters.stepping != WEIR_STEPPING_FIXED) return;
    if (scene->parameters.time_step > stable) {
        weir_fail(
            &scene->warning, WEIR_OK,
            "parameters.time_step: %g s is above the largest stable step, about %.2g s for these parameters; "
            "the fluid may blow up. Use %.2g s, or %s",
            scene->parameters.time_step, stable, stable, wcsph ? "stepping adaptive" : "lower gas_constant");
    }
}
