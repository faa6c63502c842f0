// Scenes by path: "parameters.viscosity", "domain.min", "fluid[2].ball.radius". Loaders for any
// format need no more than to walk their document and call these; every check of a single value is
// here or in parameters.c.
#include "core/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Coordinates and speeds beyond these are slips of the keyboard; float32 would not resolve a spacing there.
static const double coordinate_limit = 1e5;
static const double speed_limit = 1e5;

// A value on its way into the scene, of one of the types that scene files have.
typedef struct Value {
    enum { VALUE_NUMBER, VALUE_LIST, VALUE_TEXT, VALUE_OTHER } kind;
    const double *numbers;
    size_t count;
    const char *text;
} Value;

static const char *skip(const char *path, const char *prefix)
{
    size_t length = strlen(prefix);
    return strncmp(path, prefix, length) == 0 ? path + length : NULL;
}

static WeirStatus wrong_type(WeirScene *scene, const char *path, const Value *value, const char *wanted)
{
    if (value->kind == VALUE_NUMBER) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is the number %g; must be %s", path,
                         value->numbers[0], wanted);
    }
    if (value->kind == VALUE_LIST) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is a list of %zu; must be %s", path,
                         value->count, wanted);
    }
    return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is %s%.40s%s; must be %s", path,
                     value->kind == VALUE_TEXT ? "the text \"" : "", value->text,
                     value->kind == VALUE_TEXT ? "\"" : "", wanted);
}

static WeirStatus set_vector(WeirScene *scene, const char *path, const Value *value, double limit,
                             double vector[3])
{
    if (value->kind != VALUE_LIST || value->count != scene->dimension) {
        return wrong_type(scene, path, value, "a list of 2 numbers, [x, y]");
    }
    for (size_t axis = 0; axis < value->count; ++axis) {
        if (!(fabs(value->numbers[axis]) <= limit)) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "%.80s: %g is out of range; allowed is %g to %g", path, value->numbers[axis],
                             -limit, limit);
        }
    }
    memcpy(vector, value->numbers, value->count * sizeof *vector);
    return WEIR_OK;
}

static WeirStatus set_parameter(WeirScene *scene, const char *path, const char *name, const Value *value)
{
    int index = weir_parameter_find(name);
    if (index < 0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: no such parameter; see `weir params` or docs/parameters.md", path);
    }
    const WeirParameterInfo *info = weir_parameter_info((uint32_t)index);
    if (value->kind == VALUE_TEXT) {
        return weir_parameter_set_choice(&scene->parameters, (uint32_t)index, path, value->text,
                                         &scene->error);
    }
    if (value->kind == (info->kind == WEIR_PARAMETER_VECTOR ? VALUE_LIST : VALUE_NUMBER) &&
        info->kind != WEIR_PARAMETER_CHOICE) {
        return weir_parameter_set(&scene->parameters, (uint32_t)index, path, value->numbers, value->count,
                                  &scene->error);
    }
    if (info->kind != WEIR_PARAMETER_CHOICE) {
        return wrong_type(scene, path, value,
                          info->kind == WEIR_PARAMETER_VECTOR ? "a list of 2 or 3 numbers" : "a number");
    }
    return wrong_type(scene, path, value, info->choices);
}

static WeirStatus set_radius(WeirScene *scene, const char *path, const Value *value, double *radius)
{
    if (value->kind != VALUE_NUMBER) return wrong_type(scene, path, value, "a number");
    if (!(value->numbers[0] > 0.0 && value->numbers[0] <= coordinate_limit)) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: %g is out of range; allowed is above 0 to %g", path, value->numbers[0],
                         coordinate_limit);
    }
    *radius = value->numbers[0];
    return WEIR_OK;
}

// One key of a piece of fluid, on a copy that replaces the piece only if all is well.
static WeirStatus set_fluid_key(WeirScene *scene, WeirFluid *fluid, const char *path, const char *key,
                                const Value *value)
{
    WeirShapeKind shape = skip(key, "box.")    ? WEIR_SHAPE_BOX
                          : skip(key, "ball.") ? WEIR_SHAPE_BALL
                                               : WEIR_SHAPE_NONE;
    if (shape != WEIR_SHAPE_NONE && fluid->shape.kind != WEIR_SHAPE_NONE && fluid->shape.kind != shape) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: this piece of fluid is a box and a ball; must be one of them", path);
    }
    if (shape != WEIR_SHAPE_NONE) fluid->shape.kind = shape;
    if (strcmp(key, "velocity") == 0) return set_vector(scene, path, value, speed_limit, fluid->velocity);
    if (strcmp(key, "box.min") == 0) {
        fluid->shape.has_min = true;
        return set_vector(scene, path, value, coordinate_limit, fluid->shape.min);
    }
    if (strcmp(key, "box.max") == 0) {
        fluid->shape.has_max = true;
        return set_vector(scene, path, value, coordinate_limit, fluid->shape.max);
    }
    if (strcmp(key, "ball.center") == 0) {
        fluid->shape.has_center = true;
        return set_vector(scene, path, value, coordinate_limit, fluid->shape.center);
    }
    if (strcmp(key, "ball.radius") == 0) {
        fluid->shape.has_radius = true;
        return set_radius(scene, path, value, &fluid->shape.radius);
    }
    if (strcmp(key, "box") == 0 || strcmp(key, "ball") == 0) {
        return wrong_type(scene, path, value, "an object with min and max, or center and radius");
    }
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%.80s: unknown key; a piece of fluid has box {min, max} or ball {center, radius}, and "
                     "velocity",
                     path);
}

// `rest` is what follows "fluid": "[0].box.min".
static WeirStatus set_fluid(WeirScene *scene, const char *path, const char *rest, const Value *value)
{
    char *end = NULL;
    unsigned long index = *rest == '[' && rest[1] >= '0' && rest[1] <= '9' ? strtoul(rest + 1, &end, 10) : 0;
    if (!end || *end != ']') {
        return wrong_type(scene, path, value, "a list of pieces, each with box or ball");
    }
    if (end[1] != '.') return wrong_type(scene, path, value, "an object with box or ball");
    if (index >= WEIR_MAX_FLUIDS) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: more than %d pieces of fluid", path,
                         WEIR_MAX_FLUIDS);
    }
    if (index > scene->fluid_count) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: pieces are made in order, the next is fluid[%u]", path, scene->fluid_count);
    }
    WeirFluid fluid = {0};
    if (index < scene->fluid_count) fluid = scene->fluid[index];
    WeirStatus status = set_fluid_key(scene, &fluid, path, end + 2, value);
    if (status) return status;
    scene->fluid[index] = fluid;
    if (index == scene->fluid_count) ++scene->fluid_count;
    return WEIR_OK;
}

// version, dimension and method have one value in this version; they are checked, so that a file made for
// another one is refused by name.
static WeirStatus set_fixed_number(WeirScene *scene, const char *path, const Value *value, double wanted)
{
    if (value->kind != VALUE_NUMBER) return wrong_type(scene, path, value, "a number");
    if (value->numbers[0] != wanted) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is %g; this version of Weir knows %g", path,
                         value->numbers[0], wanted);
    }
    return WEIR_OK;
}

static WeirStatus set_title(WeirScene *scene, const char *path, const Value *value)
{
    if (value->kind != VALUE_TEXT) return wrong_type(scene, path, value, "a text");
    if (strlen(value->text) >= WEIR_TITLE_LENGTH) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "title: has %zu characters; allowed are %d",
                         strlen(value->text), WEIR_TITLE_LENGTH - 1);
    }
    strcpy(scene->title, value->text);
    return WEIR_OK;
}

static WeirStatus set_method(WeirScene *scene, const char *path, const Value *value)
{
    if (value->kind != VALUE_TEXT) return wrong_type(scene, path, value, "a text");
    if (strcmp(value->text, "mueller") != 0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "method: is \"%.40s\"; must be one of mueller",
                         value->text);
    }
    return WEIR_OK;
}

static WeirStatus set_value(WeirScene *scene, const char *path, const Value *value)
{
    const char *rest;
    if ((rest = skip(path, "parameters."))) return set_parameter(scene, path, rest, value);
    if (strcmp(path, "domain.min") == 0)
        return set_vector(scene, path, value, coordinate_limit, scene->domain_min);
    if (strcmp(path, "domain.max") == 0)
        return set_vector(scene, path, value, coordinate_limit, scene->domain_max);
    if ((rest = skip(path, "fluid")) && (*rest == '[' || *rest == '\0'))
        return set_fluid(scene, path, rest, value);
    if (strcmp(path, "title") == 0) return set_title(scene, path, value);
    if (strcmp(path, "method") == 0) return set_method(scene, path, value);
    if (strcmp(path, "version") == 0) return set_fixed_number(scene, path, value, 1);
    if (strcmp(path, "dimension") == 0) return set_fixed_number(scene, path, value, 2);
    if (strcmp(path, "parameters") == 0 || strcmp(path, "domain") == 0) {
        return wrong_type(scene, path, value, "an object");
    }
    if (*path == '\0') return wrong_type(scene, "scene", value, "an object");
    if (skip(path, "domain.")) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: unknown key; the domain has min and max",
                         path);
    }
    return weir_fail(
        &scene->error, WEIR_ERROR_INPUT,
        "%.80s: unknown key; a scene has version, title, dimension, method, parameters, domain, fluid", path);
}

WeirStatus weir_scene_set_number(WeirScene *scene, const char *path, double value)
{
    return set_value(scene, path, &(Value){.kind = VALUE_NUMBER, .numbers = &value, .count = 1});
}

WeirStatus weir_scene_set_numbers(WeirScene *scene, const char *path, const double *values, size_t count)
{
    return set_value(scene, path, &(Value){.kind = VALUE_LIST, .numbers = values, .count = count});
}

WeirStatus weir_scene_set_string(WeirScene *scene, const char *path, const char *value)
{
    return set_value(scene, path, &(Value){.kind = VALUE_TEXT, .text = value});
}

WeirStatus weir_scene_refuse(WeirScene *scene, const char *path, const char *type_name)
{
    return set_value(scene, path, &(Value){.kind = VALUE_OTHER, .text = type_name});
}
