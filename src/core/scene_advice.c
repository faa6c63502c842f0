// What Weir thinks of a scene that is valid: the speeds to expect, the time step that it can bear.
#include "core/kernel.h"
#include "core/scene_shape.h"
#include "core/smoothing.h"
#include "core/world_build.h"

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

// Largest speed that a piece's flow starts with, or comes to: a drop that is stretched keeps its energy, so its tips
// reach sqrt(2) times the speed of its edge.
static double flow_speed(const WeirScene *scene, const WeirFluid *fluid)
{
    double low[3], high[3], rate = fabs(fluid->flow_rate), square = 0.0;
    weir_shape_bounds(&fluid->shape, scene->dimension, low, high);
    for (int axis = 0; axis < 2; ++axis) square += 0.25 * (high[axis] - low[axis]) * (high[axis] - low[axis]);
    if (fluid->flow == WEIR_FLOW_TAYLOR_GREEN) return rate;
    if (fluid->flow == WEIR_FLOW_ROTATING_SQUARE) return rate * sqrt(square);
    if (fluid->flow == WEIR_FLOW_STRETCH) return rate * sqrt(square); // a disc: sqrt(2) times its radius
    return 0.0;
}

// Of all that is given: flows, walls, bodies, emitters.
static double given_speed(const WeirScene *scene)
{
    double largest = 0.0, spacing = scene->parameters.particle_spacing;
    for (uint32_t n = 0; n < scene->fluid_count; ++n)
        largest = fmax(largest, flow_speed(scene, &scene->fluid[n]));
    for (uint32_t n = 0; n < scene->wall_count; ++n)
        largest = fmax(largest, weir_solid_speed(&scene->wall[n], scene->dimension));
    for (uint32_t n = 0; n < scene->body_count; ++n)
        largest = fmax(largest, weir_solid_speed(&scene->body[n], scene->dimension));
    for (uint32_t n = 0; n < scene->emitter_count; ++n) {
        const WeirEmitterPiece *emitter = &scene->emitter[n];
        double size = fmax(emitter->size, spacing);
        double area = scene->dimension == 3 ? 0.785 * size * size : size;
        double speed = emitter->speed > 0.0 ? emitter->speed : emitter->flow_rate / area,
               square = speed * speed;
        for (uint32_t axis = 0; axis < scene->dimension; ++axis) { // and its fall
            double gravity = scene->parameters.gravity[axis], at = emitter->center[axis];
            double fall = gravity < 0.0 ? at - scene->domain_min[axis] : scene->domain_max[axis] - at;
            square += 2.0 * fabs(gravity) * fmax(fall, 0.0);
        }
        largest = fmax(largest, sqrt(square));
    }
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
    double length = shortest_extent(scene), speed = fmax(largest_speed(scene, 4.0), given_speed(scene));
    double viscosity = (double)parameters->viscosity / parameters->rest_density;
    double drive = 0.0, central = parameters->central_force;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        if (scene->periodic[axis]) drive += fabs((double)parameters->gravity[axis]);
    }
    for (uint32_t n = 0; n < scene->fluid_count; ++n) { // a drop swings with its radius times Omega
        const WeirShape *shape = &scene->fluid[n].shape;
        double low[3], high[3];
        weir_shape_bounds(shape, scene->dimension, low, high);
        speed = fmax(speed, sqrt(central) * 0.5 * (high[0] - low[0]));
    }
    double expected = sqrt(fmax(speed * speed, fmax(viscosity * speed / length, drive * length)));
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
    return fmin(sound, weir_viscous_step(&parameters));
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
