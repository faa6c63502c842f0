// The commands of the program, one file each.
#pragma once

#include "options.h"

extern const WeirCommand weir_run_command;      // run.c
extern const WeirCommand weir_bench_command;    // bench.c
extern const WeirCommand weir_info_command;     // info.c
extern const WeirCommand weir_params_command;   // params.c
extern const WeirCommand weir_validate_command; // validate.c
