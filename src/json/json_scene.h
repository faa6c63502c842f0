// Scene files, docs/scene.schema.json. The loader only walks the document; every check of a value
// is in the core.
#pragma once

#include "weir/weir.h"

// Loads a scene file. On failure *scene is NULL and `message` says which file, where in it (line:column for
// malformed JSON, the key's path for a bad value), what is there and what is allowed. The scene as a whole is
// not checked yet: weir_scene_check().
WeirStatus weir_json_load_scene(const char *path, WeirScene **scene, char *message, size_t message_size);
// The same from `size` bytes of text; `path` is where they came from, for messages and for files that the scene names.
WeirStatus weir_json_parse_scene(const char *text, size_t size, const char *path, WeirScene **scene,
                                 char *message, size_t message_size);
