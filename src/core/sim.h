// What the renderer and tests may know of a simulation beyond the public API.
#pragma once

#include "core/solver.h"

// The solver that runs the simulation; NULL if it could not be made.
WeirSolver *weir_sim_solver(WeirSim *sim);
// Parameters and constants as the next step will use them.
const WeirParameters *weir_sim_parameters(const WeirSim *sim);
const WeirConstants *weir_sim_constants(const WeirSim *sim);
// The state by id, as weir_sim_read() copies it: evaluated, on the host, valid until the next call.
WeirStatus weir_sim_state(WeirSim *sim, WeirState *state);
// What the scene's probes look at: all of the state, and `found` NULL, where the solver gathers nothing.
WeirStatus weir_sim_gather(WeirSim *sim, WeirGathered *gathered);
// Simulated time of a state, s.
double weir_sim_time_of(const WeirSim *sim, const WeirState *state);
