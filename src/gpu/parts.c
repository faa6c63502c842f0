#include "gpu/parts.h"

#include <ctype.h>
#include <stdio.h>

// As much as fits, and how much there would be.
typedef struct Text {
    char *text;
    size_t capacity, length;
} Text;

#define APPEND(to, ...)                                                                                      \
    (to)->length +=                                                                                          \
        (size_t)snprintf((to)->length < (to)->capacity ? (to)->text + (to)->length : NULL,                   \
                         (to)->length < (to)->capacity ? (to)->capacity - (to)->length : 0, __VA_ARGS__)

static void declare_array(Text *to, const WeirBuffers *buffers, uint32_t name, bool is_written)
{
    const WeirBufferInfo *info = &buffers->info[name];
    for (uint32_t part = 0; part < buffers->parts[name]; ++part) {
        APPEND(to, "@group(0) @binding(%u) var<storage, %s> %s", name + part * WEIR_MAX_BUFFERS,
               is_written ? "read_write" : "read", info->name);
        if (buffers->parts[name] > 1) APPEND(to, "_%u", part);
        APPEND(to, ": array<%s>;\n", is_written && info->written ? info->written : info->element);
    }
}

// A function's body for one part of all.
static void append_body(Text *to, const WeirPartFunction *function, uint32_t part, uint32_t parts)
{
    for (const char *c = function->body; *c;) {
        if (*c == '#') {
            APPEND(to, part > 0 ? "k - %uu * %s" : "k", part, function->stride);
            ++c;
        } else if (*c == '$') {
            int length = 0;
            while (isalnum((unsigned char)c[1 + length]) || c[1 + length] == '_') ++length;
            APPEND(to, "%.*s", length, c + 1);
            if (parts > 1) APPEND(to, "_%u", part);
            c += 1 + length;
        } else {
            APPEND(to, "%c", *c++);
        }
    }
}

// The first part is asked for last: passes over pairs never read the particles' first copy, the state.
static void declare_function(Text *to, const WeirPartFunction *function, uint32_t parts)
{
    APPEND(to, "fn %s {\n", function->head);
    for (uint32_t part = parts - 1; part > 0; --part) {
        APPEND(to, "    if k >= %uu * %s {\n        ", part, function->stride);
        append_body(to, function, part, parts);
        APPEND(to, "\n    }\n");
    }
    APPEND(to, "    ");
    append_body(to, function, 0, parts);
    APPEND(to, "\n}\n");
}

// Those that one function needs have as many parts.
static uint32_t parts_of(const WeirBuffers *buffers, const WeirPartFunction *function)
{
    uint32_t name = 0;
    while (!((function->reads | function->writes) >> name & 1)) ++name;
    return buffers->parts[name];
}

// Those that have another type in passes that write them.
static uint32_t retyped(const WeirBuffers *buffers)
{
    uint32_t names = 0;
    for (uint32_t name = 0; name < buffers->count; ++name)
        if (buffers->info[name].written) names |= 1u << name;
    return names;
}

size_t weir_parts_declare(const WeirBuffers *buffers, const WeirPartFunction *functions, uint32_t reads,
                          uint32_t writes, char *text, size_t capacity)
{
    Text to = {text, capacity, 0};
    for (uint32_t name = 0; name < buffers->count; ++name)
        if (buffers->info[name].element && (reads | writes) >> name & 1)
            declare_array(&to, buffers, name, writes >> name & 1);
    for (; functions && functions->head; ++functions) {
        bool can_read = (functions->reads & ~(reads | writes)) == 0 &&
                        (functions->reads & writes & retyped(buffers)) == 0,
             can_write = (functions->writes & ~writes) == 0;
        if (can_read && can_write) declare_function(&to, functions, parts_of(buffers, functions));
    }
    return to.length;
}
