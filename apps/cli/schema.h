// JSON Schema (draft 2020-12) of scene files, made from the parameter list.
#pragma once

#include <jansson.h>

// A new value; NULL if memory ran out.
json_t *weir_scene_schema(void);
// One parameter's schema: type, range, default, what it is.
json_t *weir_parameter_schema(unsigned index);
