#include "schema.h"
#include "output.h"

#include <string.h>

#include "core/scene_keys.h"
#include "weir/weir.h"

static json_t *choice_names(const char *choices)
{
    json_t *names = json_array();
    for (const char *name = choices; name;) {
        size_t length = strcspn(name, "|");
        json_array_append_new(names, json_stringn(name, length));
        name = name[length] == '|' ? name + length + 1 : NULL;
    }
    return names;
}

json_t *weir_parameter_schema(unsigned index)
{
    const WeirParameterInfo *info = weir_parameter_info(index);
    char description[512];
    bool has_unit = info->kind != WEIR_PARAMETER_CHOICE && strcmp(info->unit, "1") != 0;
    snprintf(description, sizeof description, "%s%s%s%s", info->help, has_unit ? " [" : "",
             has_unit ? info->unit : "", has_unit ? "]" : "");
    if (info->kind == WEIR_PARAMETER_CHOICE) {
        json_t *names = choice_names(info->choices);
        json_t *standard = json_array_get(names, (size_t)info->default_value[0]);
        return json_pack("{s:s, s:O, s:o}", "description", description, "default", standard, "enum", names);
    }
    if (info->kind == WEIR_PARAMETER_VECTOR) {
        return json_pack("{s:s, s:s, s:i, s:i, s:[f,f], s:{s:s, s:f, s:f}}", "description", description,
                         "type", "array", "minItems", 2, "maxItems", 3, "default", info->default_value[0],
                         info->default_value[1], "items", "type", "number", "minimum", info->minimum,
                         "maximum", info->maximum);
    }
    return json_pack("{s:s, s:s, s:f, s:f, s:f}", "description", description, "type", "number", "minimum",
                     info->minimum, "maximum", info->maximum, "default", info->default_value[0]);
}

static json_t *parameters_schema(void)
{
    json_t *properties = json_object();
    for (uint32_t k = 0; k < weir_parameter_count(); ++k) {
        json_object_set_new(properties, weir_parameter_info(k)->name, weir_parameter_schema(k));
    }
    return json_pack("{s:s, s:s, s:b, s:i, s:o}", "description",
                     "What differs from the defaults; docs/parameters.md describes each.", "type", "object",
                     "additionalProperties", 0, "minProperties", 1, "properties", properties);
}

// ---- The scene's keys, for one dimension: lists of coordinates are as long as it ----

static json_t *number_list(uint32_t count, const char *description)
{
    return json_pack("{s:s, s:s, s:i, s:i, s:{s:s}}", "description", description, "type", "array", "minItems",
                     (int)count, "maxItems", (int)count, "items", "type", "number");
}

static json_t *number(const WeirSceneKey *key, const char *type)
{
    return json_pack("{s:s, s:s, s:f, s:f}", "description", key->help, "type", type,
                     key->above ? "exclusiveMinimum" : "minimum", key->low, "maximum", key->high);
}

static json_t *item_list(const WeirSceneKey *key, uint32_t count)
{
    json_t *item = json_pack("{s:s, s:i, s:i, s:{s:s}}", "type", "array", "minItems", (int)count, "maxItems",
                             (int)count, "items", "type", "number");
    return json_pack("{s:s, s:s, s:i, s:o}", "description", key->help, "type", "array", "minItems", 1,
                     "items", item);
}

static json_t *text(const WeirSceneKey *key, const char *pattern)
{
    return json_pack("{s:s, s:s, s:s}", "description", key->help, "type", "string", "pattern", pattern);
}

static json_t *axes(const WeirSceneKey *key, uint32_t dimension)
{
    bool about = strcmp(key->name, "fixed_rotation") == 0;
    return text(key, dimension == 3 ? "^[xyz]{0,3}$" : about ? "^z?$" : "^[xy]{0,2}$");
}

static json_t *object_schema(WeirOwner owner, const char *description, uint32_t dimension);

static json_t *key_schema(const WeirSceneKey *key, uint32_t dimension)
{
    switch (key->kind) {
    case WEIR_KEY_NUMBER:
        return number(key, "number");
    case WEIR_KEY_WHOLE:
        return number(key, "integer");
    case WEIR_KEY_VECTOR:
        return number_list(dimension, key->help);
    case WEIR_KEY_SPIN:
        return dimension == 3 ? number_list(3, key->help) : number(key, "number");
    case WEIR_KEY_BOOLEAN:
        return json_pack("{s:s, s:s}", "description", key->help, "type", "boolean");
    case WEIR_KEY_NAME:
        return json_pack("{s:s, s:s, s:i, s:i}", "description", key->help, "type", "string", "minLength", 1,
                         "maxLength", WEIR_NAME_LENGTH - 1);
    case WEIR_KEY_CHOICE:
        return json_pack("{s:s, s:o}", "description", key->help, "enum", choice_names(key->choices));
    case WEIR_KEY_AXES:
        return axes(key, dimension);
    case WEIR_KEY_SIDES:
        return text(key, dimension == 3 ? "^ *([+-][xyz]( +|$))*$" : "^ *([+-][xy]( +|$))*$");
    case WEIR_KEY_POINTS:
        return item_list(key, 2);
    case WEIR_KEY_VERTICES:
    case WEIR_KEY_TRIANGLES:
        return item_list(key, 3);
    case WEIR_KEY_ROWS:
        return item_list(key, dimension == 3 ? 7 : 4);
    case WEIR_KEY_FILE:
        return text(key, ".");
    case WEIR_KEY_OBJECT:
        return object_schema(key->object, key->help, dimension);
    }
    return NULL;
}

static bool is_of_dimension(const WeirSceneKey *key, uint32_t dimension)
{
    if (key->shape == WEIR_SHAPE_CYLINDER || key->shape == WEIR_SHAPE_MESH) return dimension == 3;
    return key->shape != WEIR_SHAPE_POLYGON || dimension == 2;
}

static json_t *strings(const char *a, const char *b)
{
    return b ? json_pack("[s, s]", a, b) : json_pack("[s]", a);
}

// What an object cannot do without.
static json_t *required_keys(WeirOwner owner)
{
    switch (owner) {
    case WEIR_OWNER_BOX:
    case WEIR_OWNER_DRAIN:
        return strings("min", "max");
    case WEIR_OWNER_BALL:
        return strings("center", "radius");
    case WEIR_OWNER_CYLINDER:
        return json_pack("[s, s, s]", "from", "to", "radius");
    case WEIR_OWNER_EMITTER:
        return json_pack("[s, s, s]", "center", "direction", "size");
    case WEIR_OWNER_PROBE:
        return strings("kind", NULL);
    default:
        return NULL;
    }
}

static json_t *object_schema(WeirOwner owner, const char *description, uint32_t dimension)
{
    json_t *properties = json_object(), *shapes = json_array();
    for (size_t k = 0; k < weir_scene_key_count; ++k) {
        const WeirSceneKey *key = &weir_scene_keys[k];
        if (key->owner != owner || !is_of_dimension(key, dimension)) continue;
        json_object_set_new(properties, key->name, key_schema(key, dimension));
        if (key->shape != WEIR_SHAPE_NONE)
            json_array_append_new(shapes, json_pack("{s:[s]}", "required", key->name));
    }
    json_t *object = json_pack("{s:s, s:s, s:b, s:i, s:o}", "description", description, "type", "object",
                               "additionalProperties", 0, "minProperties", 1, "properties", properties);
    json_t *required = required_keys(owner);
    if (required) json_object_set_new(object, "required", required);
    if (json_array_size(shapes) > 0) json_object_set(object, "oneOf", shapes);
    json_decref(shapes);
    return object;
}

static json_t *list_schema(const WeirSceneList *list, uint32_t dimension)
{
    return json_pack("{s:s, s:s, s:i, s:i, s:o}", "description", list->help, "type", "array", "minItems", 1,
                     "maxItems", (int)list->most, "items", object_schema(list->owner, "", dimension));
}

static json_t *scene_of_dimension(uint32_t dimension)
{
    json_t *methods = dimension == 3 ? strings("wcsph", NULL) : strings("mueller", "wcsph");
    json_t *properties = json_pack(
        "{s:{s:s, s:i}, s:{s:s, s:s, s:i}, s:{s:s, s:i}, s:{s:s, s:o}, s:{s:s}, s:o}", "version",
        "description", "Version of the format.", "const", 1, "title", "description", "A name for people.",
        "type", "string", "maxLength", 119, "dimension", "description",
        "Dimensions of space; 2 if not given.", "const", (int)dimension, "method", "description",
        "How the fluid is simulated; mueller if not given.", "enum", methods, "parameters", "$ref",
        "#/$defs/parameters", "domain",
        object_schema(WEIR_OWNER_DOMAIN,
                      "The box that holds the fluid; from -1 to 1 along each axis if not given.", dimension));
    for (int k = 0; k < WEIR_SCENE_LISTS; ++k)
        json_object_set_new(properties, weir_scene_lists[k].name,
                            list_schema(&weir_scene_lists[k], dimension));
    json_t *required =
        dimension == 3 ? json_pack("[s, s, s]", "method", "dimension", "fluid") : strings("fluid", NULL);
    return json_pack("{s:s, s:b, s:o, s:o}", "type", "object", "additionalProperties", 0, "required",
                     required, "properties", properties);
}

json_t *weir_scene_schema(void)
{
    return json_pack("{s:s, s:s, s:{s:[s], s:{s:{s:i}}}, s:{s:s}, s:{s:s}, s:{s:o, s:o, s:o}}", "$schema",
                     "https://json-schema.org/draft/2020-12/schema", "title", "Weir scene", "if", "required",
                     "dimension", "properties", "dimension", "const", 3, "then", "$ref", "#/$defs/scene_3d",
                     "else", "$ref", "#/$defs/scene_2d", "$defs", "parameters", parameters_schema(),
                     "scene_2d", scene_of_dimension(2), "scene_3d", scene_of_dimension(3));
}
