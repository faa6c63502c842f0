// Everything that Weir measures, by the same formulas for every solver.
#pragma once

#include "core/solver.h"

// Fills all but `step` and `time`; `flags` of WeirDiagnose. Of free fluid alone: walls, bodies and fluid inside a nozzle do
// not count, but are neighbours. Sums run in double, in order of id. WEIR_ERROR_MEMORY only if neighbours are to be counted
// and memory runs out.
WeirStatus weir_diagnose(const WeirState *state, const WeirParameters *parameters,
                         const WeirConstants *constants, uint32_t flags, WeirDiagnostics *diagnostics);
// The same in two parts, for whoever makes the sums elsewhere: all that no flag asks for.
void weir_sum_fluid(const WeirState *state, const WeirParameters *parameters, const WeirConstants *constants,
                    WeirDiagnosticSums *sums);
void weir_diagnose_sums(const WeirDiagnosticSums *sums, const WeirParameters *parameters,
                        const WeirConstants *constants, WeirDiagnostics *diagnostics);
// How far beyond the domain fluid may stand: walls of particles give way a little, so that a particle of `wcsph` is lost half a
// spacing beyond the domain, where the first layer of wall lies.
float weir_domain_slack(const WeirParameters *parameters, const WeirConstants *constants);
// FNV-1a over the 32-bit words of x, y, (z,) vx, vy, (vz,) particle by particle.
uint64_t weir_state_hash(const WeirState *state);
