// The CPU's solvers, one per method.
#pragma once

#include "core/solver.h"

// On failure NULL, with *status and message set.
WeirSolver *weir_mueller_cpu_create(const WeirSolverSetup *setup, WeirStatus *status, WeirMessage *message);
WeirSolver *weir_wcsph_cpu_create(const WeirSolverSetup *setup, WeirStatus *status, WeirMessage *message);
