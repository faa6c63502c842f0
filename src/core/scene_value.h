// A value on its way into the scene, and the setters of single fields. Each checks all of the value before it
// changes anything.
#pragma once

#include "core/scene_keys.h"

typedef struct WeirValue {
    enum { WEIR_VALUE_NUMBER, WEIR_VALUE_LIST, WEIR_VALUE_TEXT, WEIR_VALUE_BOOLEAN, WEIR_VALUE_OTHER } kind;
    const double *numbers; // 0 or 1 of a boolean
    size_t count;
    const char *text;
} WeirValue;

// "PATH: is the number 3; must be WANTED"
WeirStatus weir_wrong_type(WeirScene *scene, const char *path, const WeirValue *value, const char *wanted);
// Sets the field of `key` in `owner`; `rest` is what follows the key's name in the path: "" or "[3]".
WeirStatus weir_field_set(WeirScene *scene, void *owner, const WeirSceneKey *key, const char *path,
                          const char *rest, const WeirValue *value);
// Index in "[12]rest"; -1 if there is none. *end gets what follows the bracket.
long weir_path_index(const char *text, const char **end);
