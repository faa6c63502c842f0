// weir params: the parameter list as a table for people, Markdown (docs/parameters.md), JSON or the JSON
// Schema of scene files (docs/scene.schema.json).
#include "commands.h"
#include "output.h"
#include "schema.h"

#include <string.h>

#include "core/scene_keys.h"
#include "weir/weir.h"

typedef struct ParamsOptions {
    bool markdown, keys, schema, json;
} ParamsOptions;

static const char *kind_name(WeirParameterKind kind)
{
    static const char *const names[] = {[WEIR_PARAMETER_NUMBER] = "number",
                                        [WEIR_PARAMETER_VECTOR] = "vector",
                                        [WEIR_PARAMETER_CHOICE] = "choice"};
    return names[kind];
}

static void format_default(const WeirParameterInfo *info, char *text, size_t size)
{
    const double *value = info->default_value;
    if (info->kind == WEIR_PARAMETER_VECTOR) {
        snprintf(text, size, "%g, %g", value[0], value[1]);
    } else if (info->kind == WEIR_PARAMETER_NUMBER) {
        snprintf(text, size, "%g", value[0]);
    } else {
        const char *name = info->choices;
        for (int k = (int)value[0]; k > 0 && strchr(name, '|'); --k) name = strchr(name, '|') + 1;
        snprintf(text, size, "%.*s", (int)strcspn(name, "|"), name);
    }
}

static void format_range(const WeirParameterInfo *info, const char *separator, char *text, size_t size)
{
    if (info->kind != WEIR_PARAMETER_CHOICE) {
        snprintf(text, size, "%g to %g", info->minimum, info->maximum);
        return;
    }
    size_t used = 0;
    for (const char *name = info->choices; *name && used + 1 < size; ++name) {
        int written = *name == '|' ? snprintf(text + used, size - used, "%s", separator)
                                   : snprintf(text + used, size - used, "%c", *name);
        used += (size_t)written;
    }
}

static void print_table(void)
{
    printf("%-18s %-8s %-12s %-24s %s\n", "name", "unit", "default", "allowed", "live, what it is");
    for (uint32_t k = 0; k < weir_parameter_count(); ++k) {
        const WeirParameterInfo *info = weir_parameter_info(k);
        char standard[48], range[96];
        format_default(info, standard, sizeof standard);
        format_range(info, ", ", range, sizeof range);
        printf("%-18s %-8s %-12s %-24s %-5s %s\n", info->name, info->unit, standard, range,
               info->live ? "yes" : "no", info->help);
    }
    printf(
        "\nA live parameter may change while a simulation runs; the others take effect at the next start.\n");
}

static void print_markdown(void)
{
    printf("# Parameters\n\n"
           "Made by `make docs` from `src/core/params.inl`; do not edit. Every parameter has this name in "
           "scene\n"
           "files (`parameters.NAME`), on the command line (`--set NAME=VALUE`), in the page's panel, in C "
           "and in "
           "WGSL.\n"
           "A live one may change while a simulation runs; the others take effect at the next start.\n\n"
           "| name | unit | default | allowed | live | what it is |\n|---|---|---|---|---|---|\n");
    for (uint32_t k = 0; k < weir_parameter_count(); ++k) {
        const WeirParameterInfo *info = weir_parameter_info(k);
        char standard[48], range[128];
        format_default(info, standard, sizeof standard);
        format_range(info, "`, `", range, sizeof range);
        const char *quote = info->kind == WEIR_PARAMETER_CHOICE ? "`" : "";
        printf("| `%s` | %s | %s%s%s | %s%s%s | %s | %s |\n", info->name, info->unit, quote, standard, quote,
               quote, range, quote, info->live ? "yes" : "no", info->help);
    }
}

// ---- Keys of a scene: docs/scene_keys.md ----

static const char *key_type(const WeirSceneKey *key, char *text, size_t size)
{
    static const char *const names[] = {
        [WEIR_KEY_NUMBER] = "number",
        [WEIR_KEY_WHOLE] = "whole number",
        [WEIR_KEY_VECTOR] = "`[x, y]` or `[x, y, z]`",
        [WEIR_KEY_SPIN] = "number; `[x, y, z]` in 3D",
        [WEIR_KEY_BOOLEAN] = "`true` or `false`",
        [WEIR_KEY_NAME] = "text",
        [WEIR_KEY_CHOICE] = "",
        [WEIR_KEY_AXES] = "letters of axes, `\"xy\"`",
        [WEIR_KEY_SIDES] = "sides, `\"+y -x\"`",
        [WEIR_KEY_POINTS] = "list of `[x, y]`",
        [WEIR_KEY_VERTICES] = "list of `[x, y, z]`",
        [WEIR_KEY_TRIANGLES] = "list of `[a, b, c]`",
        [WEIR_KEY_ROWS] = "list of rows",
        [WEIR_KEY_FILE] = "file name",
        [WEIR_KEY_OBJECT] = "object",
    };
    if (key->kind != WEIR_KEY_CHOICE) return names[key->kind];
    size_t used = 0;
    for (const char *name = key->choices; *name && used + 2 < size; ++name) {
        const char one[2] = {*name, '\0'};
        int written = snprintf(text + used, size - used, "%s", *name == '|' ? ", " : one);
        used += (size_t)written;
    }
    return text;
}

static void print_keys_of(WeirOwner owner, const char *title, const char *help)
{
    printf("\n## `%s`\n\n%s%s| key | value | allowed | what it is |\n|---|---|---|---|\n", title, help,
           *help ? "\n\n" : "");
    for (size_t k = 0; k < weir_scene_key_count; ++k) {
        const WeirSceneKey *key = &weir_scene_keys[k];
        char type[128], range[64] = "";
        if (key->owner != owner) continue;
        if (key->high > 0.0)
            snprintf(range, sizeof range, "%s%g to %g", key->above ? "above " : "", key->low, key->high);
        printf("| `%s` | %s | %s | %s |\n", key->name, key_type(key, type, sizeof type), range, key->help);
    }
}

static void print_keys(void)
{
    static const struct {
        WeirOwner owner;
        const char *title;
    } objects[] = {{WEIR_OWNER_MOTION, "motion"},
                   {WEIR_OWNER_BOX, "box"},
                   {WEIR_OWNER_BALL, "ball"},
                   {WEIR_OWNER_CYLINDER, "cylinder"},
                   {WEIR_OWNER_MESH, "mesh"}};
    printf(
        "# Keys of scene files\n\n"
        "Made by `make docs` from `src/core/scene_keys.c`; do not edit. `docs/scene.md` explains them with "
        "examples.\n"
        "Beside these a scene has `version` (1), `title`, `method` (mueller or wcsph), `dimension` (2; wcsph "
        "also 3) "
        "and\n`parameters` (`docs/parameters.md`).\n");
    print_keys_of(WEIR_OWNER_DOMAIN, "domain",
                  "The box that holds the fluid; from -1 to 1 along each axis if not given.");
    for (int k = 0; k < WEIR_SCENE_LISTS; ++k) {
        char title[64], help[400];
        const WeirSceneList *list = &weir_scene_lists[k];
        snprintf(title, sizeof title, "%s[]", list->name);
        snprintf(help, sizeof help, "%s At most %u.", list->help, list->most);
        print_keys_of(list->owner, title, help);
    }
    for (size_t k = 0; k < sizeof objects / sizeof objects[0]; ++k)
        print_keys_of(objects[k].owner, objects[k].title, "");
}

static bool print_json(void)
{
    json_t *list = json_array();
    for (uint32_t k = 0; k < weir_parameter_count(); ++k) {
        const WeirParameterInfo *info = weir_parameter_info(k);
        json_t *entry = json_pack("{s:s, s:s, s:s, s:b}", "name", info->name, "kind", kind_name(info->kind),
                                  "unit", info->unit, "live", info->live);
        json_t *rest = weir_parameter_schema(k);
        json_object_update(entry, rest);
        json_decref(rest);
        json_array_append_new(list, entry);
    }
    return weir_json_print(list, stdout);
}

static int params_command(int argument_count, char **arguments)
{
    ParamsOptions options = {0};
    const char *positional;
    int exit_status;
    if (!weir_options_parse(&weir_params_command, argument_count, arguments, &options, &positional,
                            &exit_status)) {
        return exit_status;
    }
    if (options.markdown + options.keys + options.schema + options.json > 1) {
        fprintf(stderr, "weir params: --markdown, --keys, --schema and --json: must be one of them\n");
        return WEIR_EXIT_INPUT;
    }
    bool printed = true;
    if (options.markdown) {
        print_markdown();
    } else if (options.keys) {
        print_keys();
    } else if (options.schema) {
        printed = weir_json_print(weir_scene_schema(), stdout);
    } else if (options.json) {
        printed = print_json();
    } else {
        print_table();
    }
    return printed ? WEIR_EXIT_DONE : WEIR_EXIT_FAILED;
}

#define FIELD(field) offsetof(ParamsOptions, field)
static const WeirOption params_options[] = {
    {"--markdown", WEIR_OPTION_FLAG, NULL, NULL, FIELD(markdown), 0, 0, "as docs/parameters.md"},
    {"--keys", WEIR_OPTION_FLAG, NULL, NULL, FIELD(keys), 0, 0, "keys of scene files, as docs/scene_keys.md"},
    {"--schema", WEIR_OPTION_FLAG, NULL, NULL, FIELD(schema), 0, 0, "JSON Schema of scene files"},
    {"--json", WEIR_OPTION_FLAG, NULL, NULL, FIELD(json), 0, 0, "as JSON"},
};

const WeirCommand weir_params_command = {
    .name = "params",
    .synopsis = "[--markdown | --keys | --schema | --json]",
    .summary = "lists the parameters with units, defaults and ranges",
    .notes = "",
    .options = params_options,
    .option_count = sizeof params_options / sizeof params_options[0],
    .run = params_command,
};
