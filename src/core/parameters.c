// The parameter list at work: one table made from params.inl serves defaults, checks and every front end.
#include "core/parameters.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const WeirParameterInfo parameter_table[] = {
#define WEIR_VECTOR(name, unit, x, y, z, minimum, maximum, method, live, help)                               \
    {#name, unit, help, NULL, WEIR_PARAMETER_VECTOR, {x, y, z}, minimum, maximum, method, live},
#define WEIR_NUMBER(name, unit, value, minimum, maximum, method, live, help)                                 \
    {#name, unit, help, NULL, WEIR_PARAMETER_NUMBER, {value}, minimum, maximum, method, live},
#define WEIR_CHOICE(name, names, value, method, live, help)                                                  \
    {#name, "1", help, names, WEIR_PARAMETER_CHOICE, {value}, 0, 0, method, live},
#include "core/params.inl"
};
enum { PARAMETER_COUNT = sizeof parameter_table / sizeof parameter_table[0] };

static const size_t parameter_offset[] = {
#define WEIR_VECTOR(name, ...) offsetof(WeirParameters, name),
#define WEIR_NUMBER(name, ...) offsetof(WeirParameters, name),
#define WEIR_CHOICE(name, ...) offsetof(WeirParameters, name),
#include "core/params.inl"
};

const char weir_wgsl_structs[] = "struct Parameters {\n"
#define WEIR_VECTOR(name, ...) "    @align(16) @size(16) " #name ": vec4f,\n"
#define WEIR_NUMBER(name, ...) "    @size(4) " #name ": f32,\n"
#define WEIR_CHOICE(name, ...) "    @size(4) " #name ": u32,\n"
#include "core/params.inl"
                                 "}\nstruct Constants {\n"
#define WEIR_CONSTANT_VECTOR(name, help) "    @align(16) @size(16) " #name ": vec4f,\n"
#define WEIR_CONSTANT_PLACE(name, help)  "    @align(16) @size(16) " #name ": vec4i,\n"
#define WEIR_CONSTANT_NUMBER(name, help) "    @size(4) " #name ": f32,\n"
#define WEIR_CONSTANT_COUNT(name, help)  "    @size(4) " #name ": u32,\n"
#include "core/constants.inl"
                                 "}\n";

// WGSL packs 4-byte scalars after 16-byte vectors without gaps and rounds the struct up to 16 bytes.
static_assert(sizeof(WeirParameters) % 16 == 0, "WeirParameters must have the size of its WGSL struct");
static_assert(sizeof(WeirConstants) % 16 == 0, "WeirConstants must have the size of its WGSL struct");
static_assert(offsetof(WeirParameters, particle_spacing) == 16, "numbers follow the vectors without a gap");
static_assert(offsetof(WeirConstants, tool_radius) == 10 * 16, "numbers follow the vectors without a gap");

uint32_t weir_parameter_count(void)
{
    return PARAMETER_COUNT;
}

const WeirParameterInfo *weir_parameter_info(uint32_t index)
{
    return index < PARAMETER_COUNT ? &parameter_table[index] : NULL;
}

int weir_parameter_find(const char *name)
{
    for (int i = 0; i < PARAMETER_COUNT; ++i) {
        if (strcmp(parameter_table[i].name, name) == 0) return i;
    }
    return -1;
}

static void store_values(WeirParameters *parameters, uint32_t index, const double values[3])
{
    char *field = (char *)parameters + parameter_offset[index];
    if (parameter_table[index].kind == WEIR_PARAMETER_CHOICE) {
        *(uint32_t *)(void *)field = (uint32_t)values[0];
        return;
    }
    uint32_t count = parameter_table[index].kind == WEIR_PARAMETER_VECTOR ? 3 : 1;
    for (uint32_t k = 0; k < count; ++k) ((float *)(void *)field)[k] = (float)values[k];
}

void weir_parameters_default(WeirParameters *parameters)
{
    memset(parameters, 0, sizeof *parameters);
    for (uint32_t i = 0; i < PARAMETER_COUNT; ++i)
        store_values(parameters, i, parameter_table[i].default_value);
}

uint32_t weir_parameter_get(const WeirParameters *parameters, uint32_t index, double values[3])
{
    const char *field = (const char *)parameters + parameter_offset[index];
    values[0] = values[1] = values[2] = 0.0;
    if (parameter_table[index].kind == WEIR_PARAMETER_CHOICE) {
        values[0] = *(const uint32_t *)(const void *)field;
        return 1;
    }
    uint32_t count = parameter_table[index].kind == WEIR_PARAMETER_VECTOR ? 3 : 1;
    for (uint32_t k = 0; k < count; ++k) values[k] = ((const float *)(const void *)field)[k];
    return count;
}

// Number of names in "a|b|c".
static uint32_t choice_count(const char *choices)
{
    uint32_t count = 1;
    for (; *choices; ++choices) count += *choices == '|';
    return count;
}

WeirStatus weir_parameter_set(WeirParameters *parameters, uint32_t index, const char *path,
                              const double *values, size_t count, WeirMessage *message)
{
    const WeirParameterInfo *info = &parameter_table[index];
    double checked[3] = {0.0, 0.0, 0.0};
    if (info->kind == WEIR_PARAMETER_CHOICE) {
        uint32_t choices = choice_count(info->choices);
        if (count != 1 || !(values[0] >= 0 && values[0] < choices) || values[0] != floor(values[0])) {
            return weir_fail(message, WEIR_ERROR_INPUT, "%s: must be one of %s", path, info->choices);
        }
    } else if (info->kind == WEIR_PARAMETER_VECTOR ? count != 2 && count != 3 : count != 1) {
        return weir_fail(message, WEIR_ERROR_INPUT, "%s: has %zu numbers; must be %s", path, count,
                         info->kind == WEIR_PARAMETER_VECTOR ? "a list of 2 or 3 numbers" : "one number");
    }
    for (size_t k = 0; k < count; ++k) {
        checked[k] = values[k];
        if (info->kind == WEIR_PARAMETER_CHOICE) continue;
        // Written so that NaN fails too.
        if (!(values[k] >= info->minimum && values[k] <= info->maximum)) {
            return weir_fail(message, WEIR_ERROR_INPUT, "%s: %g %s is out of range; allowed is %g to %g",
                             path, values[k], info->unit, info->minimum, info->maximum);
        }
    }
    store_values(parameters, index, checked);
    return WEIR_OK;
}

WeirStatus weir_parameter_set_choice(WeirParameters *parameters, uint32_t index, const char *path,
                                     const char *choice, WeirMessage *message)
{
    const WeirParameterInfo *info = &parameter_table[index];
    if (info->kind != WEIR_PARAMETER_CHOICE) {
        return weir_fail(message, WEIR_ERROR_INPUT, "%s: is the text \"%.40s\"; must be %s", path, choice,
                         info->kind == WEIR_PARAMETER_VECTOR ? "a list of 2 or 3 numbers" : "a number");
    }
    size_t length = strlen(choice);
    double position = 0;
    for (const char *name = info->choices; name; ++position) {
        const char *end = strchr(name, '|');
        size_t name_length = end ? (size_t)(end - name) : strlen(name);
        if (name_length == length && strncmp(name, choice, length) == 0) {
            store_values(parameters, index, (double[3]){position, 0, 0});
            return WEIR_OK;
        }
        name = end ? end + 1 : NULL;
    }
    return weir_fail(message, WEIR_ERROR_INPUT, "%s: is \"%.40s\"; must be one of %s", path, choice,
                     info->choices);
}

WeirStatus weir_parameter_set_text(WeirParameters *parameters, uint32_t index, const char *text,
                                   WeirMessage *message)
{
    const WeirParameterInfo *info = &parameter_table[index];
    if (info->kind == WEIR_PARAMETER_CHOICE) {
        return weir_parameter_set_choice(parameters, index, info->name, text, message);
    }
    double values[4];
    size_t count = 0;
    const char *rest = text;
    while (count < 4) {
        char *end;
        values[count] = strtod(rest, &end);
        if (end == rest || (*end != ',' && *end != '\0')) {
            return weir_fail(message, WEIR_ERROR_INPUT, "%s: \"%.40s\" is not %s", info->name, text,
                             info->kind == WEIR_PARAMETER_VECTOR ? "numbers separated by commas"
                                                                 : "a number");
        }
        ++count;
        if (*end == '\0') break;
        rest = end + 1;
    }
    return weir_parameter_set(parameters, index, info->name, values, count, message);
}

double weir_lattice_neighbors(const WeirParameters *parameters, uint32_t dimension, double supports)
{
    double ratio = supports * parameters->support_radius / parameters->particle_spacing;
    return dimension == 3 ? 4.19 * ratio * ratio * ratio : 3.1416 * ratio * ratio;
}
