// Ctrl-C in commands that run long.
#pragma once

#include <stdbool.h>

// From now on the first Ctrl-C (or SIGTERM) asks for an end, the second one ends the program.
void weir_cli_catch_interrupt(void);
bool weir_cli_interrupted(void);
