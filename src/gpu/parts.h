// Large buffers in WGSL: copies of the particles, lists. They lie in one array, or, where that is too large for a binding of the
// device, in several: part p of a buffer is binding BINDING_<name> + p WEIR_MAX_BUFFERS. So shaders do not name these arrays:
// they call functions, made here from a method's list, with the index in all parts together.
#pragma once

#include "gpu/buffers.h"

typedef struct WeirPartFunction {
    const char *head;       // name, parameters, of them `k` the index, and result
    const char *body;       // ends in a return; "$name" is the array that k lies in, "#" the index there
    const char *stride;     // elements of a part
    uint32_t reads, writes; // the buffers it needs, by bit; they come apart together
} WeirPartFunction;

// Writes declarations of the arrays that a pass binds, and those of the functions (a list that ends with a head of NULL) that it
// can have. Returns the length, like snprintf(): `text` NULL and `capacity` 0 ask for it.
size_t weir_parts_declare(const WeirBuffers *buffers, const WeirPartFunction *functions, uint32_t reads,
                          uint32_t writes, char *text, size_t capacity);
