#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SUGGESTED_LENGTH = 40 };

// Edit distance (insert, delete, replace, swap of neighbours count one each).
static size_t edit_distance(const char *a, const char *b)
{
    size_t n = strlen(a), m = strlen(b);
    size_t rows[3][MAX_SUGGESTED_LENGTH + 1];
    if (n > MAX_SUGGESTED_LENGTH || m > MAX_SUGGESTED_LENGTH) return SIZE_MAX;
    for (size_t k = 0; k <= m; ++k) rows[0][k] = k;
    for (size_t row = 1; row <= n; ++row) {
        size_t *now = rows[row % 3], *last = rows[(row + 2) % 3], *before = rows[(row + 1) % 3];
        now[0] = row;
        for (size_t k = 1; k <= m; ++k) {
            size_t best = last[k - 1] + (a[row - 1] != b[k - 1]);
            if (last[k] + 1 < best) best = last[k] + 1;
            if (now[k - 1] + 1 < best) best = now[k - 1] + 1;
            bool swapped = row > 1 && k > 1 && a[row - 1] == b[k - 2] && a[row - 2] == b[k - 1];
            if (swapped && before[k - 2] + 1 < best) best = before[k - 2] + 1;
            now[k] = best;
        }
    }
    return rows[n % 3][m];
}

const char *weir_suggest(const char *text, const void *names, size_t count, size_t stride)
{
    const char *best_name = NULL;
    size_t best = 1 + strlen(text) / 3;
    for (size_t k = 0; k < count; ++k) {
        const char *name = *(const char *const *)((const char *)names + k * stride);
        size_t distance = edit_distance(text, name);
        // A name that was cut short is meant as well: --thread for --threads.
        if (strlen(text) > 3 && strncmp(text, name, strlen(text)) == 0) distance = 1;
        if (distance > best || (distance == best && best_name)) continue;
        best = distance;
        best_name = name;
    }
    return best_name;
}

bool weir_parse_count(const char *text, uint64_t minimum, uint64_t maximum, uint64_t *value)
{
    char *end;
    errno = 0;
    if (*text < '0' || *text > '9') return false;
    unsigned long long parsed = strtoull(text, &end, 10);
    if (*end != '\0' || errno || parsed < minimum || parsed > maximum) return false;
    *value = parsed;
    return true;
}

static bool is_choice(const char *choices, const char *text)
{
    size_t length = strlen(text);
    for (const char *name = choices; name;) {
        const char *end = strchr(name, '|');
        if ((end ? (size_t)(end - name) : strlen(name)) == length && strncmp(name, text, length) == 0) {
            return true;
        }
        name = end ? end + 1 : NULL;
    }
    return false;
}

static bool wrong_value(const WeirCommand *command, const WeirOption *option, const char *text)
{
    fprintf(stderr, "weir %s: %s: '%s' is not allowed; ", command->name, option->name, text);
    if (option->kind == WEIR_OPTION_CHOICE) {
        fprintf(stderr, "must be one of %s\n", option->choices);
    } else {
        fprintf(stderr, "must be a %s from %.10g to %.10g\n",
                option->kind == WEIR_OPTION_COUNT ? "whole number" : "number", option->minimum,
                option->maximum);
    }
    return false;
}

static bool store_value(const WeirCommand *command, const WeirOption *option, const char *text, void *values)
{
    void *field = (char *)values + option->offset;
    switch (option->kind) {
    case WEIR_OPTION_FLAG:
        *(bool *)field = true;
        return true;
    case WEIR_OPTION_TEXT:
        *(const char **)field = text;
        return true;
    case WEIR_OPTION_CHOICE:
        if (!is_choice(option->choices, text)) return wrong_value(command, option, text);
        *(const char **)field = text;
        return true;
    case WEIR_OPTION_COUNT: {
        WeirCount *count = field;
        count->is_set = true;
        return weir_parse_count(text, (uint64_t)option->minimum, (uint64_t)option->maximum, &count->value) ||
               wrong_value(command, option, text);
    }
    case WEIR_OPTION_NUMBER: {
        char *end;
        double number = strtod(text, &end);
        bool good = end != text && *end == '\0' && number >= option->minimum && number <= option->maximum;
        if (good) *(double *)field = number;
        return good || wrong_value(command, option, text);
    }
    case WEIR_OPTION_LIST: {
        WeirTextList *list = field;
        if (list->count == sizeof list->items / sizeof list->items[0]) {
            fprintf(stderr, "weir %s: %s is given more than %zu times\n", command->name, option->name,
                    list->count);
            return false;
        }
        list->items[list->count++] = text;
        return true;
    }
    }
    return false;
}

static const WeirOption *find_option(const WeirCommand *command, const char *text, size_t length)
{
    for (size_t k = 0; k < command->option_count; ++k) {
        const char *name = command->options[k].name;
        if (strlen(name) == length && strncmp(name, text, length) == 0) return &command->options[k];
    }
    return NULL;
}

static void unknown_option(const WeirCommand *command, const char *text, size_t length)
{
    char name[MAX_SUGGESTED_LENGTH + 1];
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    const char *near = weir_suggest(name, command->options, command->option_count, sizeof(WeirOption));
    fprintf(stderr, "weir %s: unknown option '%.*s'", command->name, (int)length, text);
    if (near) fprintf(stderr, "; did you mean '%s'?", near);
    fprintf(stderr, "\nSee: weir %s --help\n", command->name);
}

// One option, "--name value" or "--name=value"; *next is the argument after it.
static bool parse_option(const WeirCommand *command, int argument_count, char **arguments, int *next,
                         void *values)
{
    const char *text = arguments[(*next)++];
    size_t length = strcspn(text, "=");
    const WeirOption *option = find_option(command, text, length);
    if (!option) {
        unknown_option(command, text, length);
        return false;
    }
    const char *value = text[length] == '=' ? text + length + 1 : NULL;
    if (option->kind == WEIR_OPTION_FLAG && value) {
        fprintf(stderr, "weir %s: %s takes no value\n", command->name, option->name);
        return false;
    }
    if (option->kind != WEIR_OPTION_FLAG && !value) {
        if (*next == argument_count) {
            fprintf(stderr, "weir %s: %s needs a value, %s\n", command->name, option->name, option->value);
            return false;
        }
        value = arguments[(*next)++];
    }
    return store_value(command, option, value, values);
}

static bool take_positional(const WeirCommand *command, const char *text, void *values,
                            const char **positional)
{
    WeirTextList *list = command->takes_list ? (void *)((char *)values + command->list_offset) : NULL;
    if (list && list->count < sizeof list->items / sizeof list->items[0]) {
        list->items[list->count++] = text;
        return true;
    }
    if (command->positional && !*positional) {
        *positional = text;
        return true;
    }
    fprintf(stderr, "weir %s: unexpected argument '%s'\nSee: weir %s --help\n", command->name, text,
            command->name);
    return false;
}

bool weir_options_parse(const WeirCommand *command, int argument_count, char **arguments, void *values,
                        const char **positional, int *exit_status)
{
    bool only_positional = false;
    *exit_status = WEIR_EXIT_INPUT;
    *positional = NULL;
    for (int next = 0; next < argument_count;) {
        const char *text = arguments[next];
        if (!only_positional && strcmp(text, "--") == 0) {
            only_positional = true;
            ++next;
        } else if (!only_positional && (strcmp(text, "--help") == 0 || strcmp(text, "-h") == 0)) {
            weir_command_help(command, stdout);
            *exit_status = WEIR_EXIT_DONE;
            return false;
        } else if (!only_positional && text[0] == '-' && text[1] != '\0') {
            if (!parse_option(command, argument_count, arguments, &next, values)) return false;
        } else {
            if (!take_positional(command, text, values, positional)) return false;
            ++next;
        }
    }
    if (command->positional && !*positional) {
        fprintf(stderr, "weir %s: %s is missing\nSee: weir %s --help\n", command->name, command->positional,
                command->name);
        return false;
    }
    return true;
}

void weir_command_help(const WeirCommand *command, FILE *file)
{
    fprintf(file, "weir %s %s\n\n%s\n", command->name, command->synopsis, command->summary);
    if (command->option_count > 0) fprintf(file, "\n");
    for (size_t k = 0; k < command->option_count; ++k) {
        const WeirOption *option = &command->options[k];
        const char *value = option->kind == WEIR_OPTION_CHOICE ? option->choices : option->value;
        char left[64];
        snprintf(left, sizeof left, "%s%s%s", option->name, value ? " " : "", value ? value : "");
        fprintf(file, "  %-28s %s\n", left, option->help);
    }
    fprintf(file, "  %-28s %s\n", "--help", "this text");
    if (*command->notes) fprintf(file, "\n%s\n", command->notes);
}
