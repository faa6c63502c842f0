// Probes: numbers measured from a state, by one function for every solver.
//
// A value at a point x is the Shepard-normalised sum over fluid particles, sum_j V_j f_j W / sum_j V_j W, with the
// simulation's kernel; where the sum of weights is below 0.1 there is no fluid: pressure 0, velocity 0.
#pragma once

#include "core/scene.h"
#include "core/solver.h"

// Numbers that a probe gives: the dimension for velocity and force, else 1.
uint32_t weir_probe_components(const WeirProbePiece *probe, uint32_t dimension);
// Measures one probe. height: the highest point of the line through `position` against gravity (+y without gravity)
// where sum_j V_j W >= 0.5, NaN if there is none; front: largest coordinate along `direction` of a fluid particle,
// plus half a spacing. `solid`: index into state->solids of a force probe's target.
void weir_probe_measure(const WeirProbePiece *probe, uint32_t solid, const WeirState *state,
                        const WeirParameters *parameters, const WeirConstants *constants, double values[3]);
// The same of a front or mass, from what a solver found (WeirGathered).
double weir_probe_value(const WeirProbePiece *probe, double found, const WeirParameters *parameters,
                        const WeirConstants *constants);
// Index of the wall or body `name` ("domain": the domain's own walls) among a world's solids; false if there is none.
bool weir_probe_target(const WeirScene *scene, const char *name, uint32_t *solid);

// What a probe looks at, for solvers that gather it: fluid nearer than a support to a point, or to the line through it along a
// direction; the farthest along a direction; the fluid in a box; or forces on solids.
typedef enum WeirLookKind {
    WEIR_LOOK_POINT,
    WEIR_LOOK_LINE,
    WEIR_LOOK_FARTHEST,
    WEIR_LOOK_BOX,
    WEIR_LOOK_FORCE
} WeirLookKind;
typedef struct WeirLook {
    float point[3]; // m; the lowest corner of a box
    uint32_t kind;
    float direction[3]; // the highest corner of a box
    uint32_t unused;
} WeirLook;
WeirLook weir_probe_look(const WeirProbePiece *probe, const WeirParameters *parameters,
                         const WeirConstants *constants);
// Particles that all of them may gather, more than usual.
uint32_t weir_probe_reach(const WeirProbePiece *probes, uint32_t count, const WeirParameters *parameters,
                          const WeirConstants *constants);
