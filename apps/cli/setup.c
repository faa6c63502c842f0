#include "setup.h"

#include <string.h>

#include "json/json_scene.h"

static const WeirParameterInfo *find_parameter(const char *name)
{
    for (uint32_t k = 0; k < weir_parameter_count(); ++k) {
        const WeirParameterInfo *info = weir_parameter_info(k);
        if (strcmp(info->name, name) == 0) return info;
    }
    return NULL;
}

static const char *suggest_parameter(const char *name)
{
    const char *names[256];
    uint32_t count = weir_parameter_count();
    if (count > 256) count = 256;
    for (uint32_t k = 0; k < count; ++k) names[k] = weir_parameter_info(k)->name;
    return weir_suggest(name, names, count, sizeof names[0]);
}

bool weir_cli_set_parameters(WeirScene *scene, const char *command, const WeirTextList *assignments)
{
    for (size_t k = 0; k < assignments->count; ++k) {
        const char *text = assignments->items[k], *value = strchr(text, '=');
        char name[64] = "";
        if (!value || value == text) {
            fprintf(stderr, "weir %s: --set %s: must be NAME=VALUE, for example viscosity=0.2\n", command,
                    text);
            return false;
        }
        snprintf(name, sizeof name, "%.*s", (int)(value - text), text);
        if (weir_scene_set_parameter_text(scene, name, value + 1) == WEIR_OK) continue;
        fprintf(stderr, "weir %s: --set %s", command, weir_scene_error(scene));
        const char *near = find_parameter(name) ? NULL : suggest_parameter(name);
        fprintf(stderr, near ? "; did you mean '%s'?\n" : "\n", near);
        return false;
    }
    return true;
}

WeirScene *weir_cli_load_scene(const char *path, const char *command, const WeirTextList *assignments,
                               const char *search, int *exit_status)
{
    char message[1024];
    WeirScene *scene;
    *exit_status = WEIR_EXIT_INPUT;
    if (weir_json_load_scene(path, &scene, message, sizeof message)) {
        fprintf(stderr, "weir %s: %s\n", command, message);
        return NULL;
    }
    bool good = weir_cli_set_parameters(scene, command, assignments);
    if (good && search) weir_scene_set_parameter_text(scene, "search", search);
    if (good && weir_scene_check(scene)) {
        fprintf(stderr, "weir %s: %s: %s\n", command, path, weir_scene_error(scene));
        good = false;
    }
    if (!good) {
        weir_scene_destroy(scene);
        return NULL;
    }
    if (*weir_scene_warning(scene)) {
        fprintf(stderr, "weir %s: warning: %s: %s\n", command, path, weir_scene_warning(scene));
    }
    *exit_status = WEIR_EXIT_DONE;
    return scene;
}

double weir_cli_number(const WeirScene *scene, const char *parameter)
{
    double values[3] = {0};
    weir_scene_get_parameter(scene, parameter, values);
    return values[0];
}

void weir_cli_choice_name(const WeirScene *scene, const char *parameter, char name[32])
{
    const WeirParameterInfo *info = find_parameter(parameter);
    const char *start = info ? info->choices : NULL;
    for (int k = (int)weir_cli_number(scene, parameter); start && k > 0; --k) {
        start = strchr(start, '|');
        if (start) ++start;
    }
    snprintf(name, 32, "%.*s", start ? (int)strcspn(start, "|") : 0, start ? start : "");
}

int weir_cli_exit_status(WeirStatus status)
{
    if (status == WEIR_OK) return WEIR_EXIT_DONE;
    return status == WEIR_ERROR_INPUT ? WEIR_EXIT_INPUT : WEIR_EXIT_FAILED;
}
