// The walk: objects extend the path by ".key", lists of objects by "[index]"; numbers, texts, booleans and lists of
// numbers are set; anything else is refused by the core, which knows what the path should hold.
#include "json/json_scene.h"
#include "json/scene_files.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_FILE_SIZE = 1 << 20, // a scene is a page of text; a larger file is not a scene
    MAX_PATH = 256,
};

// Path of the value that the walk is at; where the scene lies, for files that it names, and what went wrong with them.
typedef struct Path {
    char text[MAX_PATH];
    size_t length;
    const char *scene_path;
    char *message;
    size_t message_size;
} Path;

static WeirStatus walk(WeirScene *scene, Path *path, const json_t *value);

// Keys that would be read as a path of their own are quoted, so that the core finds them unknown. A path that
// is cut at its end is unknown too: no scene key is as long.
static void path_add_key(Path *path, const char *key)
{
    size_t room = sizeof path->text - path->length;
    bool quoted = key[0] == '\0' || strpbrk(key, ".[]\"");
    int written = snprintf(path->text + path->length, room, quoted ? "%s\"%s\"" : "%s%s",
                           path->length > 0 ? "." : "", key);
    path->length += (size_t)written < room ? (size_t)written : room - 1;
}

static void path_add_index(Path *path, size_t index)
{
    size_t room = sizeof path->text - path->length;
    int written = snprintf(path->text + path->length, room, "[%zu]", index);
    path->length += (size_t)written < room ? (size_t)written : room - 1;
}

static void path_cut(Path *path, size_t length)
{
    path->length = length;
    path->text[length] = '\0';
}

static WeirStatus walk_object(WeirScene *scene, Path *path, const json_t *object)
{
    const char *key;
    json_t *value;
    size_t length = path->length;
    if (json_object_size(object) == 0 && length > 0) {
        return weir_scene_refuse(scene, path->text, "an empty object");
    }
    json_object_foreach((json_t *)object, key, value)
    {
        path_add_key(path, key);
        WeirStatus status = walk(scene, path, value);
        if (status) return status;
        path_cut(path, length);
    }
    return WEIR_OK;
}

static WeirStatus set_numbers(WeirScene *scene, Path *path, const json_t *list)
{
    size_t count = json_array_size(list);
    double few[16], *numbers = count <= 16 ? few : malloc(count * sizeof *numbers);
    if (!numbers) return weir_scene_refuse(scene, path->text, "longer than memory allows");
    for (size_t index = 0; index < count; ++index)
        numbers[index] = json_number_value(json_array_get(list, index));
    WeirStatus status = weir_scene_set_numbers(scene, path->text, numbers, count);
    if (numbers != few) free(numbers);
    return status;
}

// A list of numbers is one value; anything else is a list of pieces.
static WeirStatus walk_list(WeirScene *scene, Path *path, const json_t *list)
{
    size_t count = json_array_size(list), found = 0, length = path->length;
    while (found < count && json_is_number(json_array_get(list, found))) ++found;
    if (found == count) return set_numbers(scene, path, list);
    if (found > 0) return weir_scene_refuse(scene, path->text, "a list of mixed types");
    for (size_t index = 0; index < count; ++index) {
        path_add_index(path, index);
        WeirStatus status = walk(scene, path, json_array_get(list, index));
        if (status) return status;
        path_cut(path, length);
    }
    return WEIR_OK;
}

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), wanted = strlen(end);
    return length >= wanted && strcmp(text + length - wanted, end) == 0;
}

// A text, or the file that it names: "walls[0].mesh.file".
static WeirStatus set_text(WeirScene *scene, Path *path, const char *text)
{
    bool is_table = ends_with(path->text, ".motion.file"), is_mesh = ends_with(path->text, ".mesh.file");
    if (!is_table && !is_mesh) return weir_scene_set_string(scene, path->text, text);
    char key[MAX_PATH];
    size_t length = path->length - strlen("file");
    memcpy(key, path->text, length);
    key[length] = '\0';
    return is_table
               ? weir_file_read_table(scene, key, path->scene_path, text, path->message, path->message_size)
               : weir_file_read_mesh(scene, key, path->scene_path, text, path->message, path->message_size);
}

static WeirStatus walk(WeirScene *scene, Path *path, const json_t *value)
{
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return walk_object(scene, path, value);
    case JSON_ARRAY:
        return walk_list(scene, path, value);
    case JSON_REAL:
    case JSON_INTEGER:
        return weir_scene_set_number(scene, path->text, json_number_value(value));
    case JSON_STRING:
        return set_text(scene, path, json_string_value(value));
    case JSON_TRUE:
        return weir_scene_set_boolean(scene, path->text, true);
    case JSON_FALSE:
        return weir_scene_set_boolean(scene, path->text, false);
    case JSON_NULL:
        break;
    }
    return weir_scene_refuse(scene, path->text, "null");
}

// The dimension says how long vectors are, and the method which dimensions there are: both come first, wherever
// the file has them.
static WeirStatus walk_document(WeirScene *scene, Path *path, const json_t *document)
{
    static const char *const first[] = {"method", "dimension"};
    for (int k = 0; k < 2; ++k) {
        const json_t *value = json_object_get(document, first[k]);
        if (!value) continue;
        path_add_key(path, first[k]);
        WeirStatus status = walk(scene, path, value);
        if (status) return status;
        path_cut(path, 0);
    }
    return walk(scene, path, document);
}

// Reads the whole file, from malloc; NULL with the reason in `message`.
static char *read_file(const char *path, size_t *size, char *message, size_t message_size)
{
    FILE *file = fopen(path, "rb");
    char *text = file ? malloc(MAX_FILE_SIZE + 1) : NULL;
    if (!file || !text) {
        snprintf(message, message_size, "%s: cannot be read: %s", path, strerror(errno));
        if (file) fclose(file);
        return NULL;
    }
    errno = 0;
    *size = fread(text, 1, MAX_FILE_SIZE + 1, file);
    if (ferror(file)) {
        snprintf(message, message_size, "%s: cannot be read: %s", path, strerror(errno));
    } else if (*size > MAX_FILE_SIZE) {
        snprintf(message, message_size, "%s: is larger than %d bytes; that is no scene file", path,
                 MAX_FILE_SIZE);
    } else {
        fclose(file);
        return text;
    }
    fclose(file);
    free(text);
    return NULL;
}

static json_t *parse_text(const char *text, size_t size, const char *path, char *message, size_t message_size)
{
    json_error_t error;
    // Whole numbers too large for an integer are numbers all the same; the core checks their range.
    json_t *document = json_loadb(text, size, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &error);
    if (!document) {
        snprintf(message, message_size, "%s:%d:%d: malformed JSON: %s", path, error.line, error.column,
                 error.text);
    }
    return document;
}

WeirStatus weir_json_load_scene(const char *path, WeirScene **scene, char *message, size_t message_size)
{
    size_t size;
    *scene = NULL;
    char *text = read_file(path, &size, message, message_size);
    if (!text) return WEIR_ERROR_INPUT;
    WeirStatus status = weir_json_parse_scene(text, size, path, scene, message, message_size);
    free(text);
    return status;
}

WeirStatus weir_json_parse_scene(const char *text, size_t size, const char *path, WeirScene **scene,
                                 char *message, size_t message_size)
{
    *scene = NULL;
    json_t *document = parse_text(text, size, path, message, message_size);
    if (!document) return WEIR_ERROR_INPUT;
    WeirScene *loaded = weir_scene_create();
    if (!loaded) {
        json_decref(document);
        snprintf(message, message_size, "%s: memory ran out", path);
        return WEIR_ERROR_MEMORY;
    }
    char trouble[512] = "";
    Path position = {.scene_path = path, .message = trouble, .message_size = sizeof trouble};
    WeirStatus status = walk_document(loaded, &position, document);
    json_decref(document);
    if (status) {
        snprintf(message, message_size, "%s: %s", path, *trouble ? trouble : weir_scene_error(loaded));
        weir_scene_destroy(loaded);
        return status;
    }
    *scene = loaded;
    return WEIR_OK;
}
