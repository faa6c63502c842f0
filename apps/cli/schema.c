#include "schema.h"
#include "output.h"

#include <string.h>

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

static json_t *reference(const char *description, const char *definition)
{
    return json_pack("{s:s, s:s}", "description", description, "$ref", definition);
}

static json_t *fluid_schema(void)
{
    json_t *box = json_pack("{s:s, s:b, s:[s,s], s:{s:o, s:o}}", "type", "object", "additionalProperties", 0,
                            "required", "min", "max", "properties", "min",
                            reference("Lowest corner, m.", "#/$defs/point"), "max",
                            reference("Highest corner, m.", "#/$defs/point"));
    json_t *ball = json_pack("{s:s, s:b, s:[s,s], s:{s:o, s:{s:s, s:s, s:i}}}", "type", "object",
                             "additionalProperties", 0, "required", "center", "radius", "properties",
                             "center", reference("Centre, m.", "#/$defs/point"), "radius", "description",
                             "Radius, m.", "type", "number", "exclusiveMinimum", 0);
    json_t *piece = json_pack(
        "{s:s, s:b, s:[{s:[s]},{s:[s]}], s:{s:o, s:o, s:o}}", "type", "object", "additionalProperties", 0,
        "oneOf", "required", "box", "required", "ball", "properties", "box", box, "ball", ball, "velocity",
        reference("Velocity at the start, m/s; at rest if not given.", "#/$defs/point"));
    return json_pack(
        "{s:s, s:s, s:i, s:i, s:o}", "description",
        "Pieces of fluid, filled with particles on a lattice of parameters.particle_spacing; they "
        "lie inside the domain and do not overlap.",
        "type", "array", "minItems", 1, "maxItems", 64, "items", piece);
}

static json_t *domain_schema(void)
{
    return json_pack("{s:s, s:s, s:b, s:i, s:{s:o, s:o}}", "description",
                     "The box that holds the fluid; from [-1, -1] to [1, 1] if not given.", "type", "object",
                     "additionalProperties", 0, "minProperties", 1, "properties", "min",
                     reference("Lowest corner, m.", "#/$defs/point"), "max",
                     reference("Highest corner, m.", "#/$defs/point"));
}

json_t *weir_scene_schema(void)
{
    json_t *properties = json_pack(
        "{s:{s:s, s:i}, s:{s:s, s:s, s:i}, s:{s:s, s:i}, s:{s:s, s:[s]}, s:o, s:o, s:o}", "version",
        "description", "Version of the format.", "const", 1, "title", "description", "A name for people.",
        "type", "string", "maxLength", 119, "dimension", "description", "Dimensions of space.", "const", 2,
        "method", "description", "How the fluid is simulated.", "enum", "mueller", "parameters",
        parameters_schema(), "domain", domain_schema(), "fluid", fluid_schema());
    json_t *point = json_pack("{s:s, s:i, s:i, s:{s:s}}", "type", "array", "minItems", 2, "maxItems", 2,
                              "items", "type", "number");
    return json_pack("{s:s, s:s, s:s, s:b, s:[s], s:o, s:{s:o}}", "$schema",
                     "https://json-schema.org/draft/2020-12/schema", "title", "Weir scene", "type", "object",
                     "additionalProperties", 0, "required", "fluid", "properties", properties, "$defs",
                     "point", point);
}
