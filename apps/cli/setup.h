// From a command's arguments to a scene that is ready to simulate.
#pragma once

#include "options.h"
#include "weir/weir.h"

// Applies "NAME=VALUE" of --set. False after a message on standard error, which starts with `command`.
bool weir_cli_set_parameters(WeirScene *scene, const char *command, const WeirTextList *assignments);
// Loads the file, applies --set and --search (NULL: as the scene says), checks the scene and prints its
// advice. NULL after a message; *exit_status says how to end then.
WeirScene *weir_cli_load_scene(const char *path, const char *command, const WeirTextList *assignments,
                               const char *search, int *exit_status);
// The name that a choice parameter has now, "grid".
void weir_cli_choice_name(const WeirScene *scene, const char *parameter, char name[32]);
double weir_cli_number(const WeirScene *scene, const char *parameter);
// Exit status for a status of the library.
int weir_cli_exit_status(WeirStatus status);
