// What Weir thinks of a scene that is valid: the time step that it can bear.
#include "core/kernel.h"
#include "core/scene.h"

#include <math.h>

// Largest speed that the fluid can reach, m/s: its own at the start and the fall to the domain's
// lowest point.
static double largest_speed(const WeirScene *scene)
{
    double largest = 0.0;
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        const WeirFluid *fluid = &scene->fluid[n];
        double speed2 = 0.0; // v^2 = v0^2 + 2 g (fall)
        for (int axis = 0; axis < 2; ++axis) {
            bool ball = fluid->shape.kind == WEIR_SHAPE_BALL;
            double low = ball ? fluid->shape.center[axis] - fluid->shape.radius : fluid->shape.min[axis];
            double high = ball ? fluid->shape.center[axis] + fluid->shape.radius : fluid->shape.max[axis];
            double gravity = scene->parameters.gravity[axis];
            double fall = gravity < 0.0 ? high - scene->domain_min[axis] : scene->domain_max[axis] - low;
            speed2 += fluid->velocity[axis] * fluid->velocity[axis] + 2.0 * fabs(gravity) * fmax(fall, 0.0);
        }
        largest = fmax(largest, sqrt(speed2));
    }
    return largest;
}

double weir_scene_expected_speed(const WeirScene *scene)
{
    return largest_speed(scene);
}

WeirParameters weir_scene_resolved(const WeirScene *scene)
{
    WeirParameters resolved = scene->parameters;
    if (scene->method != WEIR_METHOD_WCSPH) return resolved;
    if (resolved.support_radius == 0.0f) resolved.support_radius = 3.0f * resolved.particle_spacing;
    double speed =
        resolved.expected_speed > 0.0f ? resolved.expected_speed : weir_scene_expected_speed(scene);
    if (resolved.sound_speed == 0.0f) resolved.sound_speed = (float)(10.0 * speed);
    return resolved;
}

double weir_scene_stable_time_step(const WeirScene *scene)
{
    return weir_stable_time_step(&scene->parameters, largest_speed(scene));
}

void weir_scene_advise(WeirScene *scene)
{
    double stable = weir_scene_stable_time_step(scene);
    scene->warning.text[0] = '\0';
    if (scene->parameters.time_step > stable) {
        weir_fail(
            &scene->warning, WEIR_OK,
            "parameters.time_step: %g s is above the largest stable step, about %.2g s for these parameters; "
            "the fluid may blow up. Use %.2g s, or lower gas_constant",
            scene->parameters.time_step, stable, stable);
    }
}
