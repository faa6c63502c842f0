#include "known_device.h"

#include <jansson.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// Of the folder, made if asked for; false if there is none.
static bool cache_folder(char *path, size_t size, bool make)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    bool is_named = cache && cache[0] == '/';
    if (!is_named && (!home || home[0] != '/')) return false;
    int length = is_named ? snprintf(path, size, "%s", cache) : snprintf(path, size, "%s/.cache", home);
    if (length < 0 || (size_t)length + sizeof "/weir" > size) return false;
    if (make) mkdir(path, 0700);
    strcat(path, "/weir");
    if (make) mkdir(path, 0700);
    return true;
}

WeirKnownDevice weir_cli_recall_device(void)
{
    WeirKnownDevice known = {0};
    char folder[PATH_MAX], path[PATH_MAX + 16];
    if (!cache_folder(folder, sizeof folder, false)) return known;
    snprintf(path, sizeof path, "%s/device.json", folder);
    json_t *file = json_load_file(path, 0, NULL);
    const char *name = json_string_value(json_object_get(file, "device"));
    json_int_t parallelism = json_integer_value(json_object_get(file, "parallelism"));
    if (name && strlen(name) < sizeof known.name && parallelism > 0 && parallelism <= UINT32_MAX) {
        strcpy(known.name, name);
        known.parallelism = (uint32_t)parallelism;
    }
    json_decref(file);
    return known;
}

void weir_cli_remember_device(const WeirKnownDevice *known, const WeirGpu *gpu)
{
    uint32_t parallelism = weir_gpu_parallelism(gpu);
    bool is_known = strcmp(known->name, weir_gpu_device(gpu)) == 0 && known->parallelism == parallelism;
    char folder[PATH_MAX], path[PATH_MAX + 16], fresh[PATH_MAX + 16];
    if (is_known || !cache_folder(folder, sizeof folder, true)) return;
    snprintf(path, sizeof path, "%s/device.json", folder);
    snprintf(fresh, sizeof fresh, "%s/device.json.new", folder);
    json_t *file =
        json_pack("{s:s, s:I}", "device", weir_gpu_device(gpu), "parallelism", (json_int_t)parallelism);
    if (file && json_dump_file(file, fresh, JSON_INDENT(2)) == 0) rename(fresh, path);
    json_decref(file);
}
