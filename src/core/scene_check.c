// The checks of a scene as a whole that need no particles.
#include "core/scene_shape.h"
#include "core/world_build.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

uint32_t weir_wall_layers(const WeirParameters *parameters)
{
    // A support of 3 spacings in float may lie a rounding above 3.
    double ratio = (double)parameters->support_radius / parameters->particle_spacing;
    return (uint32_t)ceil(ratio - 1e-4);
}

static WeirStatus check_fluid(WeirScene *scene, uint32_t index)
{
    const WeirFluid *fluid = &scene->fluid[index];
    char name[32];
    snprintf(name, sizeof name, "fluid[%u]", index);
    WeirStatus status = weir_shape_check(scene, &fluid->shape, name);
    if (!status) status = weir_check_inside(scene, &fluid->shape, name);
    if (!status && fluid->flow != WEIR_FLOW_NONE && scene->dimension != 2)
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%s.flow: is for 2D", name);
    if (!status && fluid->flow == WEIR_FLOW_STANDING_WAVE &&
        (scene->parameters.gravity[1] >= 0.0f || scene->parameters.gravity[0] != 0.0f)) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%s.flow: a standing wave needs gravity along -y; it is %g, %g", name,
                         scene->parameters.gravity[0], scene->parameters.gravity[1]);
    }
    return status;
}

// Support radius against spacing.
static WeirStatus check_support(WeirScene *scene)
{
    WeirParameters parameters = weir_scene_resolved(scene);
    double ratio = (double)parameters.support_radius / parameters.particle_spacing;
    bool wcsph = scene->method == WEIR_METHOD_WCSPH;
    double least = wcsph ? 1.5 : 1.1, most = wcsph ? 12.0 : 40.0;
    if (ratio >= least && ratio <= most) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "parameters.support_radius: %g m is %.3g times the particle_spacing of %g m; allowed is "
                     "%g to %g times",
                     parameters.support_radius, ratio, parameters.particle_spacing, least, most);
}

static WeirStatus check_domain(WeirScene *scene)
{
    double support = weir_scene_resolved(scene).support_radius;
    for (uint32_t axis = 0; axis < scene->dimension; ++axis) {
        double size = scene->domain_max[axis] - scene->domain_min[axis];
        char name = "xyz"[axis];
        if (!(size > 0.0)) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT, "domain: min %c = %g must be below max %c = %g",
                             name, scene->domain_min[axis], name, scene->domain_max[axis]);
        }
        if (scene->method != WEIR_METHOD_WCSPH) continue;
        if (scene->periodic[axis] && (scene->open[axis][0] || scene->open[axis][1])) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "domain: %c is periodic and has an open side; must be one of them", name);
        }
        if (scene->periodic[axis] && size < 2.0 * support * (1.0 - 1e-6)) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "domain.periodic: %c is %g m long; must be at least two support radii, %g m",
                             name, size, 2.0 * support);
        }
        // Coordinates are whole numbers below 2^30; a support radius keeps 2^12 of them.
        if (size > 262000.0 * support) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "domain: %g m along %c is %.3g support radii; allowed are 262000. Raise "
                             "parameters.particle_spacing",
                             size, name, size / support);
        }
    }
    return WEIR_OK;
}

// ---- What belongs to one method only ----

static WeirStatus check_parameters(WeirScene *scene)
{
    const char *method = weir_scene_method(scene);
    for (uint32_t k = 0; k < weir_parameter_count(); ++k) {
        const WeirParameterInfo *info = weir_parameter_info(k);
        double values[3];
        uint32_t count = weir_parameter_get(&scene->parameters, k, values);
        bool is_default = true; // the same as not given
        for (uint32_t n = 0; n < count; ++n) is_default &= (float)values[n] == (float)info->default_value[n];
        if (is_default || !*info->method || strcmp(info->method, method) == 0) continue;
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "parameters.%s: only method %s reads it; this scene's is %s", info->name,
                         info->method, method);
    }
    return WEIR_OK;
}

static WeirStatus check_method(WeirScene *scene)
{
    if (scene->method == WEIR_METHOD_WCSPH) return WEIR_OK;
    const char *found = NULL;
    if (scene->wall_count) found = "walls";
    if (scene->body_count) found = "bodies";
    if (scene->emitter_count) found = "emitters";
    if (scene->drain_count) found = "drains";
    if (scene->free_slip_sides) found = "domain.free_slip";
    for (int axis = 0; axis < 3; ++axis) {
        if (scene->periodic[axis]) found = "domain.periodic";
        if (scene->open[axis][0] || scene->open[axis][1]) found = "domain.open";
    }
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        if (scene->fluid[n].flow != WEIR_FLOW_NONE) found = "fluid: flow";
        if (scene->fluid[n].shape.kind > WEIR_SHAPE_BALL) found = "fluid: polygon";
    }
    if (!found) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%s: only method wcsph knows it; this scene's is mueller", found);
}

WeirStatus weir_scene_check_values(WeirScene *scene)
{
    WeirStatus status = check_domain(scene);
    if (!status) status = check_support(scene);
    if (!status) status = check_parameters(scene);
    if (!status) status = check_method(scene);
    if (status) return status;
    if (scene->fluid_count == 0) {
        return weir_fail(
            &scene->error, WEIR_ERROR_INPUT,
            "fluid: the scene has none; add a piece with box {min, max} or ball {center, radius}");
    }
    for (uint32_t n = 0; n < scene->fluid_count; ++n) {
        status = check_fluid(scene, n);
        if (status) return status;
    }
    return weir_scene_check_pieces(scene);
}
