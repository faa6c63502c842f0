// Walls and bodies in time: prescribed motion, rigid-body motion. Shared by the CPU solver and tests; the GPU's
// pass `solids` (shaders/wcsph/solids.wgsl) is its mirror. All in float with one order, so that bits agree.
#pragma once

#include "core/world.h"

// States at the start of the world's solids.
void weir_solids_start(const WeirWorld *world, WeirSolidState *states);

// Fluid particles whose mass each particle in a solid's face may stand for where solids repel each other (the lighter one's counts):
// less than 1 for light and small free bodies, which the force of a particle would throw, more for heavy ones, which it would not stop,
// FLT_MAX for walls and driven bodies (docs/wcsph.md, "Contact of solids").
float weir_solid_bulk(const WeirSolid *solid, uint32_t dimension, float particle_mass, float spacing);

// The same between a solid and fluid, where a body counts with what it drags along.
float weir_solid_barrier(const WeirSolid *solid, const WeirSolidState *state, float bulk);

// Share of a solid's acceleration that the pressure at its surface sees: 1, but less for bodies so light that it would follow from itself
// (docs/wcsph.md, "Light bodies").
float weir_solid_sway(const WeirSolid *solid, const WeirSolidState *state);

// Second half of a step, after the fluid's forces are summed into states[].force and torque, and the mass of the fluid in reach of a
// body's particles, which it drags along, into states[].force[3]: free bodies take their new velocities over `dt` (gravity, fluid, contact), driven
// ones the mean velocities of [time, time + dt].
// acceleration and angular_acceleration become those of this step.
void weir_solids_kick(const WeirWorld *world, const float gravity[4], double time, float dt,
                      WeirSolidState *states);

// Moves reference points and orientations over `dt` (half a step, called twice per step) with the present
// velocities; driven solids are put where their motion has them at `time`, the end of that half.
void weir_solids_drift(const WeirWorld *world, const WeirConstants *constants, double time, float dt,
                       WeirSolidState *states);

// Where the solid's point that started at `local` (relative to its reference point, m) is now, and its velocity.
void weir_solid_point(const WeirSolidState *state, const float local[3], double position[3],
                      float velocity[3]);

// Displacement, rotation (angle times axis) and their rates of a driven solid at `time`.
void weir_motion_at(const WeirMotionRow *rows, uint32_t count, bool repeats, double time, WeirMotionRow *now);
