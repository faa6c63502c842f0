// Options of a command, by a table: parsing, checks, suggestions and help all come from it.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

// Exit statuses of the program.
enum { WEIR_EXIT_DONE = 0, WEIR_EXIT_FAILED = 1, WEIR_EXIT_INPUT = 2, WEIR_EXIT_INTERRUPTED = 130 };

typedef enum WeirOptionKind {
    WEIR_OPTION_FLAG,   // bool
    WEIR_OPTION_TEXT,   // const char *
    WEIR_OPTION_CHOICE, // const char *, one of `choices`
    WEIR_OPTION_COUNT,  // WeirCount, a whole number from minimum to maximum
    WEIR_OPTION_NUMBER, // double from minimum to maximum; 0 until it is set
    WEIR_OPTION_LIST,   // WeirTextList, the option may be given many times
} WeirOptionKind;

typedef struct WeirCount {
    bool is_set;
    uint64_t value;
} WeirCount;

typedef struct WeirTextList {
    const char *items[64];
    size_t count;
} WeirTextList;

typedef struct WeirOption {
    const char *name; // "--steps"
    WeirOptionKind kind;
    const char *value;   // what help calls the value: "N"
    const char *choices; // WEIR_OPTION_CHOICE: "auto|cpu|gpu"
    size_t offset;       // of the field in the command's own struct
    double minimum, maximum;
    const char *help;
} WeirOption;

typedef struct WeirCommand {
    const char *name;       // "run"
    const char *synopsis;   // "SCENE [options]"
    const char *summary;    // one line
    const char *notes;      // printed after the options, "" if there is none
    const char *positional; // name of the one argument that is no option; NULL if there is none
    bool takes_list;        // instead, any number of arguments that are no options...
    size_t list_offset;     // ...go into this WeirTextList of the command's own struct
    const WeirOption *options;
    size_t option_count;
    int (*run)(int argument_count, char **arguments);
} WeirCommand;

// Reads `arguments` (those after the command's name) into `values`, the command's struct, and the positional
// one into *positional. False after a message on standard error, or after --help; *exit_status says how to
// end then.
bool weir_options_parse(const WeirCommand *command, int argument_count, char **arguments, void *values,
                        const char **positional, int *exit_status);
void weir_command_help(const WeirCommand *command, FILE *file);
// The one of `count` names that `text` was most likely meant to be; NULL if none is near. Names are taken
// `stride` bytes apart, so that a table's first member serves.
const char *weir_suggest(const char *text, const void *names, size_t count, size_t stride);
// A whole number in text; false if it is none or out of range.
bool weir_parse_count(const char *text, uint64_t minimum, uint64_t maximum, uint64_t *value);
