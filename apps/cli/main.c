// weir: the command line program. Each command is in a file of its own and described by its table.
#include "commands.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "weir/weir.h"

static const WeirCommand *const commands[] = {&weir_run_command, &weir_validate_command, &weir_bench_command,
                                              &weir_info_command, &weir_params_command};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_help(FILE *file)
{
    fprintf(file, "weir " WEIR_VERSION ": a real-time SPH fluid simulator\n\n");
    for (size_t k = 0; k < COMMAND_COUNT; ++k) {
        char left[64];
        snprintf(left, sizeof left, "weir %s", commands[k]->name);
        fprintf(file, "  %-14s %s\n", left, commands[k]->summary);
    }
    fprintf(file, "  %-14s %s\n  %-14s %s\n", "weir --help", "this text", "weir --version", "the version");
    fprintf(file,
            "\nweir COMMAND --help describes a command. Exit status: 0 done, 1 the run failed, 2 bad input,\n"
            "130 ended by Ctrl-C.\n");
}

static int unknown_command(const char *text)
{
    const char *names[COMMAND_COUNT + 2] = {[COMMAND_COUNT] = "--help", [COMMAND_COUNT + 1] = "--version"};
    for (size_t k = 0; k < COMMAND_COUNT; ++k) names[k] = commands[k]->name;
    const char *near = weir_suggest(text, names, COMMAND_COUNT + 2, sizeof names[0]);
    fprintf(stderr, "weir: unknown %s '%s'", text[0] == '-' ? "option" : "command", text);
    if (near) fprintf(stderr, "; did you mean '%s'?", near);
    fprintf(stderr, "\nSee: weir --help\n");
    return WEIR_EXIT_INPUT;
}

// What is still buffered may not fit on a full disk or into a closed pipe.
static int finish(int status)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return status;
    perror("weir: standard output");
    return status == WEIR_EXIT_DONE ? WEIR_EXIT_FAILED : status;
}

int main(int argument_count, char **arguments)
{
    // A closed pipe and a file that is too large are a message and an exit status.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    if (argument_count < 2) {
        print_help(stderr);
        return WEIR_EXIT_INPUT;
    }
    const char *name = arguments[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        print_help(stdout);
        return finish(WEIR_EXIT_DONE);
    }
    if (strcmp(name, "--version") == 0) {
        printf("weir %s\n", WEIR_VERSION);
        return finish(WEIR_EXIT_DONE);
    }
    for (size_t k = 0; k < COMMAND_COUNT; ++k) {
        if (strcmp(name, commands[k]->name) == 0) {
            return finish(commands[k]->run(argument_count - 2, arguments + 2));
        }
    }
    return unknown_command(name);
}
