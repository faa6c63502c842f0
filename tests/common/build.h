// Scenes and simulations that tests need again and again. Every helper fails the test by itself.
#pragma once

#include "common/check.h"

// Repeatable numbers (xorshift64*, Vigna 2016).
typedef struct WeirRandom {
    uint64_t state;
} WeirRandom;
uint32_t weir_random_next(WeirRandom *random);
double weir_random_range(WeirRandom *random, double minimum, double maximum);

// Default parameters but no gravity, a time step of 0.0005 s, the given sizes, and a domain from (min,min) to
// (max,max); no fluid yet.
WeirScene *weir_test_scene(double particle_spacing, double support_radius, double min, double max);
void weir_test_set(WeirScene *scene, const char *parameter, double value);
void weir_test_choose(WeirScene *scene, const char *parameter, const char *choice);
void weir_test_gravity(WeirScene *scene, double x, double y);
void weir_test_box(WeirScene *scene, double x0, double y0, double x1, double y1);
void weir_test_ball(WeirScene *scene, double x, double y, double radius, double vx, double vy);

// A simulation of the scene, ready to step. `threads` as in WeirSimOptions.
WeirSim *weir_test_sim(const WeirScene *scene, const WeirBackend *backend, uint32_t threads);
// A scene that makes exactly `count` particles, in rows from the domain's lowest corner: for
// weir_sim_set_state(). The domain is the square from (0,0) to (size,size).
WeirScene *weir_test_count_scene(uint32_t count, double size, double particle_spacing, double support_radius);

// malloc'd copy of a field.
float *weir_test_read(WeirSim *sim, WeirField field);
WeirDiagnostics weir_test_diagnose(WeirSim *sim, uint32_t flags);
void weir_test_step(WeirSim *sim, uint32_t steps);
void weir_test_set_state(WeirSim *sim, const float *positions, const float *velocities);
uint64_t weir_test_hash(WeirSim *sim);

// Fluid that runs: a small dam break, 400 particles, with gravity. Its own time step holds.
WeirScene *weir_test_dam(void);
// Two balls without gravity that meet at 2 m/s in the middle of the domain and touch no wall for 100 steps.
WeirScene *weir_test_drops(void);
// `piece`.min and .max, as of "walls[0].box".
void weir_test_box_of(WeirScene *scene, const char *piece, const double min[3], const double max[3]);
// `wcsph` away from the origin: fluid that falls over a wall, a body named "body", an emitter above a drain.
WeirScene *weir_test_everything(uint32_t dimension);
// `wcsph` in a domain [0, width] x [0, height] (x [0, height]), with the default gravity; no fluid yet.
WeirScene *weir_test_tank(uint32_t dimension, double width, double height, double spacing);
// Fluid on its ground from x0 to x1, up to `height`, in 3D as deep as that.
void weir_test_fill(WeirScene *scene, double x0, double x1, double height);
