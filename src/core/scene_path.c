// Scenes by path: "parameters.viscosity", "domain.min", "fluid[2].ball.radius". Loaders for any
// format need no more than to walk their document and call these; every check of a single value is
// here, in scene_value.c or in parameters.c.
#include "core/scene_value.h"

#include <stdio.h>
#include <string.h>

static const char *skip(const char *path, const char *prefix)
{
    size_t length = strlen(prefix);
    return strncmp(path, prefix, length) == 0 ? path + length : NULL;
}

// ---- Parameters ----

static WeirStatus set_parameter_value(WeirScene *scene, uint32_t index, const char *path,
                                      const WeirValue *value)
{
    const WeirParameterInfo *info = weir_parameter_info(index);
    bool is_choice = info->kind == WEIR_PARAMETER_CHOICE, is_vector = info->kind == WEIR_PARAMETER_VECTOR;
    if (value->kind == WEIR_VALUE_TEXT) {
        return weir_parameter_set_choice(&scene->parameters, index, path, value->text, &scene->error);
    }
    if (!is_choice && value->kind == (is_vector ? WEIR_VALUE_LIST : WEIR_VALUE_NUMBER)) {
        return weir_parameter_set(&scene->parameters, index, path, value->numbers, value->count,
                                  &scene->error);
    }
    if (is_choice) return weir_wrong_type(scene, path, value, info->choices);
    return weir_wrong_type(scene, path, value, is_vector ? "a list of 2 or 3 numbers" : "a number");
}

static WeirStatus set_parameter(WeirScene *scene, const char *path, const char *name, const WeirValue *value)
{
    int index = weir_parameter_find(name);
    if (index < 0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: no such parameter; see `weir params` or docs/parameters.md", path);
    }
    WeirStatus status = set_parameter_value(scene, (uint32_t)index, path, value);
    if (!status) scene->parameters_given |= (uint64_t)1 << index;
    return status;
}

WeirStatus weir_scene_set_parameter_text(WeirScene *scene, const char *name, const char *text)
{
    int index = weir_parameter_find(name);
    if (index < 0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.60s: no such parameter; see `weir params` or docs/parameters.md", name);
    }
    WeirStatus status = weir_parameter_set_text(&scene->parameters, (uint32_t)index, text, &scene->error);
    if (!status) scene->parameters_given |= (uint64_t)1 << index;
    return status;
}

// ---- Objects ----

// Names of an owner's keys, for messages.
static void list_keys(WeirOwner owner, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < weir_scene_key_count; ++k) {
        if (weir_scene_keys[k].owner != owner) continue;
        int written =
            snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "", weir_scene_keys[k].name);
        if (written < 0 || (size_t)written >= size - used) return;
        used += (size_t)written;
    }
}

static WeirStatus unknown_key(WeirScene *scene, const char *path, WeirOwner owner)
{
    char keys[300];
    list_keys(owner, keys, sizeof keys);
    return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: unknown key; known here: %s", path, keys);
}

static WeirStatus need_object(WeirScene *scene, const char *path, const WeirValue *value, WeirOwner owner)
{
    char wanted[320] = "an object with ";
    size_t length = strlen(wanted);
    list_keys(owner, wanted + length, sizeof wanted - length);
    return weir_wrong_type(scene, path, value, wanted);
}

static const WeirSceneKey *find_key(WeirOwner owner, const char *name, size_t length)
{
    for (size_t k = 0; k < weir_scene_key_count; ++k) {
        const WeirSceneKey *key = &weir_scene_keys[k];
        if (key->owner == owner && strlen(key->name) == length && strncmp(key->name, name, length) == 0) {
            return key;
        }
    }
    return NULL;
}

// A piece has one shape, and one of its dimension.
static WeirStatus check_shape(WeirScene *scene, const WeirShape *shape, const WeirSceneKey *key,
                              const char *path)
{
    static const char *const names[] = {"nothing", "box", "ball", "cylinder", "polygon", "mesh"};
    bool solid_only = key->shape == WEIR_SHAPE_CYLINDER || key->shape == WEIR_SHAPE_MESH;
    uint32_t dimension = solid_only ? 3 : 2;
    if ((solid_only || key->shape == WEIR_SHAPE_POLYGON) && scene->dimension != dimension) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: a %s is a shape of dimension %u; the scene's is %u", path, key->name,
                         dimension, scene->dimension);
    }
    if (shape->kind == WEIR_SHAPE_NONE || shape->kind == key->shape) return WEIR_OK;
    bool ordered = shape->kind < key->shape;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%.80s: this piece is a %s and a %s; must be one of them", path,
                     names[ordered ? shape->kind : key->shape], names[ordered ? key->shape : shape->kind]);
}

// One key, "box.min", of the object at `base`. Nothing is changed unless all is well.
static WeirStatus set_key(WeirScene *scene, WeirOwner owner, void *base, const char *path, const char *name,
                          const WeirValue *value)
{
    size_t length = strcspn(name, ".[");
    const WeirSceneKey *key = find_key(owner, name, length);
    if (!key) return unknown_key(scene, path, owner);
    char *field = (char *)base + key->offset;
    const char *rest = name + length;
    if (key->shape != WEIR_SHAPE_NONE) {
        WeirStatus status = check_shape(scene, (WeirShape *)field, key, path);
        if (status) return status;
    }
    WeirStatus status;
    if (key->kind == WEIR_KEY_OBJECT) {
        if (*rest != '.') return need_object(scene, path, value, key->object);
        status = set_key(scene, key->object, field, path, rest + 1, value);
    } else {
        bool is_list = key->kind >= WEIR_KEY_POINTS && key->kind <= WEIR_KEY_ROWS;
        if (*rest == '.' || (*rest == '[' && !is_list)) return unknown_key(scene, path, owner);
        status = weir_field_set(scene, base, key, path, rest, value);
    }
    if (status) return status;
    if (key->shape != WEIR_SHAPE_NONE) ((WeirShape *)field)->kind = key->shape;
    if (key->has_offset) *(bool *)((char *)base + key->has_offset - 1) = true;
    return WEIR_OK;
}

// ---- Lists of pieces ----

static void start_piece(WeirOwner owner, void *piece)
{
    if (owner == WEIR_OWNER_FLUID) ((WeirFluid *)piece)->hydrostatic = true;
    if (owner == WEIR_OWNER_WALL || owner == WEIR_OWNER_BODY) ((WeirSolidPiece *)piece)->no_slip = true;
    if (owner != WEIR_OWNER_PROBE) return;
    ((WeirProbePiece *)piece)->rate = 100.0;
    ((WeirProbePiece *)piece)->direction[0] = 1.0;
}

// `rest` is what follows the list's name: "[0].box.min".
static WeirStatus set_piece(WeirScene *scene, const WeirSceneList *list, const char *path, const char *rest,
                            const WeirValue *value)
{
    char wanted[120];
    const char *key;
    uint32_t *count = (uint32_t *)((char *)scene + list->count_offset);
    long index = weir_path_index(rest, &key);
    if (index < 0) {
        snprintf(wanted, sizeof wanted, "a list of pieces, each with %s", list->wanted);
        return weir_wrong_type(scene, path, value, wanted);
    }
    if (*key != '.') {
        snprintf(wanted, sizeof wanted, "an object with %s", list->wanted);
        return weir_wrong_type(scene, path, value, wanted);
    }
    if (index >= (long)list->most) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: more than %u %s", path, list->most,
                         list->item);
    }
    if (index > (long)*count) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: pieces are made in order, the next is %s[%u]", path, list->name, *count);
    }
    char *piece = (char *)scene + list->offset + (size_t)index * list->size;
    bool is_new = index == (long)*count;
    if (is_new) start_piece(list->owner, piece);
    WeirStatus status = set_key(scene, list->owner, piece, path, key + 1, value);
    if (is_new && status) memset(piece, 0, list->size);
    if (is_new && !status) ++*count;
    return status;
}

// ---- The scene's own keys ----

static WeirStatus set_version(WeirScene *scene, const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_NUMBER) return weir_wrong_type(scene, path, value, "a number");
    if (value->numbers[0] != 1.0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is %g; this version of Weir knows 1", path,
                         value->numbers[0]);
    }
    return WEIR_OK;
}

static bool has_pieces(const WeirScene *scene)
{
    return scene->fluid_count || scene->wall_count || scene->body_count || scene->emitter_count ||
           scene->drain_count || scene->probe_count;
}

// Vectors are as long as the dimension, so it is settled before any is given; loaders set method and dimension
// first, wherever the file has them.
static WeirStatus set_dimension(WeirScene *scene, const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_NUMBER) return weir_wrong_type(scene, path, value, "a number");
    double wanted = value->numbers[0];
    bool wcsph = scene->method == WEIR_METHOD_WCSPH;
    if (wanted != 2.0 && !(wanted == 3.0 && wcsph)) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is %g; method %s knows %s", path, wanted,
                         weir_scene_method(scene), wcsph ? "2 and 3" : "2 (wcsph: 2 and 3)");
    }
    if (wanted == scene->dimension) return WEIR_OK;
    if (has_pieces(scene)) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: is %g; the scene has pieces of dimension %u already; set it before them",
                         path, wanted, scene->dimension);
    }
    scene->dimension = (uint32_t)wanted;
    scene->domain_min[2] = wanted == 3.0 ? -1.0 : 0.0;
    scene->domain_max[2] = wanted == 3.0 ? 1.0 : 0.0;
    return WEIR_OK;
}

static WeirStatus set_title(WeirScene *scene, const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
    if (strlen(value->text) >= WEIR_TITLE_LENGTH) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "title: has %zu characters; allowed are %d",
                         strlen(value->text), WEIR_TITLE_LENGTH - 1);
    }
    strcpy(scene->title, value->text);
    return WEIR_OK;
}

static WeirStatus set_method(WeirScene *scene, const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
    int method = weir_choice_index("mueller|wcsph", value->text);
    if (method < 0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "method: is \"%.40s\"; must be one of mueller|wcsph", value->text);
    }
    if (method == WEIR_METHOD_MUELLER && scene->dimension != 2) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "method: mueller knows dimension 2; this scene's is %u", scene->dimension);
    }
    scene->method = method == 1 ? WEIR_METHOD_WCSPH : WEIR_METHOD_MUELLER;
    // The default is a length for mueller and 0, which means 4 or 3 spacings, for wcsph.
    int support = weir_parameter_find("support_radius");
    if (!(scene->parameters_given >> support & 1)) {
        const WeirParameterInfo *info = weir_parameter_info((uint32_t)support);
        scene->parameters.support_radius = method == 1 ? 0.0f : (float)info->default_value[0];
    }
    return WEIR_OK;
}

static WeirStatus set_value(WeirScene *scene, const char *path, const WeirValue *value)
{
    const char *rest;
    if ((rest = skip(path, "parameters."))) return set_parameter(scene, path, rest, value);
    if ((rest = skip(path, "domain."))) return set_key(scene, WEIR_OWNER_DOMAIN, scene, path, rest, value);
    for (int k = 0; k < WEIR_SCENE_LISTS; ++k) {
        rest = skip(path, weir_scene_lists[k].name);
        if (rest && (*rest == '[' || *rest == '\0'))
            return set_piece(scene, &weir_scene_lists[k], path, rest, value);
    }
    if (strcmp(path, "title") == 0) return set_title(scene, path, value);
    if (strcmp(path, "method") == 0) return set_method(scene, path, value);
    if (strcmp(path, "version") == 0) return set_version(scene, path, value);
    if (strcmp(path, "dimension") == 0) return set_dimension(scene, path, value);
    if (strcmp(path, "parameters") == 0 || strcmp(path, "domain") == 0) {
        return weir_wrong_type(scene, path, value, "an object");
    }
    if (*path == '\0') return weir_wrong_type(scene, "scene", value, "an object");
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%.80s: unknown key; a scene has version, title, method, dimension, parameters, domain, "
                     "fluid, walls, "
                     "bodies, emitters, drains, probes",
                     path);
}

WeirStatus weir_scene_set_number(WeirScene *scene, const char *path, double value)
{
    return set_value(scene, path, &(WeirValue){.kind = WEIR_VALUE_NUMBER, .numbers = &value, .count = 1});
}

WeirStatus weir_scene_set_numbers(WeirScene *scene, const char *path, const double *values, size_t count)
{
    return set_value(scene, path, &(WeirValue){.kind = WEIR_VALUE_LIST, .numbers = values, .count = count});
}

WeirStatus weir_scene_set_string(WeirScene *scene, const char *path, const char *value)
{
    return set_value(scene, path, &(WeirValue){.kind = WEIR_VALUE_TEXT, .text = value});
}

WeirStatus weir_scene_set_boolean(WeirScene *scene, const char *path, bool value)
{
    double number = value;
    return set_value(
        scene, path,
        &(WeirValue){
            .kind = WEIR_VALUE_BOOLEAN, .numbers = &number, .count = 1, .text = value ? "true" : "false"});
}

WeirStatus weir_scene_refuse(WeirScene *scene, const char *path, const char *type_name)
{
    return set_value(scene, path, &(WeirValue){.kind = WEIR_VALUE_OTHER, .text = type_name});
}
