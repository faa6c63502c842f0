// Scenes by calls: life cycle, getters and the checks of a scene as a whole. Values by path: scene_path.c.
#include "core/scene_keys.h"

#include <stdlib.h>
#include <string.h>

WeirScene *weir_scene_create(void)
{
    WeirScene *scene = calloc(1, sizeof *scene);
    if (!scene) return NULL;
    scene->dimension = 2;
    weir_parameters_default(&scene->parameters);
    for (int axis = 0; axis < 2; ++axis) {
        scene->domain_min[axis] = -1.0;
        scene->domain_max[axis] = 1.0;
    }
    return scene;
}

WeirScene *weir_scene_copy(const WeirScene *scene)
{
    WeirScene *copy = malloc(sizeof *copy);
    if (!copy) return NULL;
    *copy = *scene;
    bool copied = true;
    for (int k = 0; k < WEIR_SCENE_LISTS; ++k) {
        const WeirSceneList *list = &weir_scene_lists[k];
        uint32_t count = *(uint32_t *)((char *)copy + list->count_offset);
        for (uint32_t n = 0; n < count; ++n)
            copied &= weir_piece_copy_owned(list->owner, (char *)copy + list->offset + n * list->size);
    }
    if (copied) return copy;
    weir_scene_destroy(copy);
    return NULL;
}

void weir_scene_destroy(WeirScene *scene)
{
    if (!scene) return;
    for (int k = 0; k < WEIR_SCENE_LISTS; ++k) {
        const WeirSceneList *list = &weir_scene_lists[k];
        uint32_t count = *(uint32_t *)((char *)scene + list->count_offset);
        for (uint32_t n = 0; n < count; ++n)
            weir_piece_free(list->owner, (char *)scene + list->offset + n * list->size);
    }
    free(scene);
}

const char *weir_scene_error(const WeirScene *scene)
{
    return scene->error.text;
}

const char *weir_scene_warning(const WeirScene *scene)
{
    return scene->warning.text;
}

const char *weir_scene_title(const WeirScene *scene)
{
    return scene->title;
}

const char *weir_scene_method(const WeirScene *scene)
{
    return scene->method == WEIR_METHOD_WCSPH ? "wcsph" : "mueller";
}

uint32_t weir_scene_dimension(const WeirScene *scene)
{
    return scene->dimension;
}

void weir_scene_domain(const WeirScene *scene, double min[3], double max[3])
{
    memcpy(min, scene->domain_min, sizeof scene->domain_min);
    memcpy(max, scene->domain_max, sizeof scene->domain_max);
}

WeirStatus weir_scene_get_parameter(const WeirScene *scene, const char *name, double values[3])
{
    int index = weir_parameter_find(name);
    if (index < 0) return WEIR_ERROR_INPUT;
    weir_parameter_get(&scene->parameters, (uint32_t)index, values);
    return WEIR_OK;
}

// ---- Pieces of fluid by calls: the same setters as by path, so that every check is made once. ----

WeirStatus weir_scene_set_domain(WeirScene *scene, const double min[3], const double max[3])
{
    double kept[3];
    memcpy(kept, scene->domain_min, sizeof kept);
    WeirStatus status = weir_scene_set_numbers(scene, "domain.min", min, scene->dimension);
    if (!status) status = weir_scene_set_numbers(scene, "domain.max", max, scene->dimension);
    if (status) memcpy(scene->domain_min, kept, sizeof kept); // both or none
    return status;
}

// Undoes a piece of which only a part was accepted.
static WeirStatus keep_or_drop(WeirScene *scene, WeirStatus status)
{
    if (status) memset(&scene->fluid[--scene->fluid_count], 0, sizeof scene->fluid[0]);
    return status;
}

static WeirStatus begin_fluid(WeirScene *scene, const double velocity[3], char path[32])
{
    if (scene->fluid_count >= WEIR_MAX_FLUIDS) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "fluid: more than %d pieces", WEIR_MAX_FLUIDS);
    }
    // fluid[NN].velocity
    uint32_t n = scene->fluid_count;
    char *end = path;
    memcpy(end, "fluid[", 6), end += 6;
    if (n >= 10) *end++ = (char)('0' + n / 10);
    *end++ = (char)('0' + n % 10);
    memcpy(end, "].velocity", 11);
    static const double rest[3] = {0.0, 0.0, 0.0};
    WeirStatus status = weir_scene_set_numbers(scene, path, velocity ? velocity : rest, scene->dimension);
    if (status) scene->fluid_count = n;
    return status;
}

static WeirStatus set_fluid_key(WeirScene *scene, char path[32], const char *key, const double *values,
                                size_t count)
{
    strcpy(strchr(path, ']') + 1, key);
    return count == 1 ? weir_scene_set_number(scene, path, values[0])
                      : weir_scene_set_numbers(scene, path, values, count);
}

WeirStatus weir_scene_add_box(WeirScene *scene, const double min[3], const double max[3],
                              const double velocity[3])
{
    char path[32];
    WeirStatus status = begin_fluid(scene, velocity, path);
    if (status) return status;
    status = set_fluid_key(scene, path, ".box.min", min, scene->dimension);
    if (!status) status = set_fluid_key(scene, path, ".box.max", max, scene->dimension);
    return keep_or_drop(scene, status);
}

WeirStatus weir_scene_add_ball(WeirScene *scene, const double center[3], double radius,
                               const double velocity[3])
{
    char path[32];
    WeirStatus status = begin_fluid(scene, velocity, path);
    if (status) return status;
    status = set_fluid_key(scene, path, ".ball.center", center, scene->dimension);
    if (!status) status = set_fluid_key(scene, path, ".ball.radius", &radius, 1);
    return keep_or_drop(scene, status);
}
