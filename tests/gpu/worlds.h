// Small worlds of `wcsph`, made piece by piece without scenes' builders, so that solvers can be compared on anything
// that a world may hold.
#pragma once

#include "common/build.h"
#include "core/scene.h"

enum { WEIR_TEST_PARTICLES = 8192, WEIR_TEST_SOLIDS = 4 };

typedef struct WeirTestWorld {
    WeirScene *scene; // parameters, domain
    WeirWorld world;
    WeirRandom random;
    double spacing;
    uint32_t fluid_slots; // until the first solid is added
} WeirTestWorld;

// A domain from the origin to `size` (3 numbers), at 0.05 m spacing, sound speed 20 m/s, gravity along -y.
WeirTestWorld weir_test_world(uint32_t dimension, const double size[3]);
void weir_test_world_free(WeirTestWorld *test);
// Lattice of fluid in a box, each particle off its site by up to `disorder` spacings, with velocities up to `speed` and
// densities up to 1 % above rest.
void weir_test_world_fluid(WeirTestWorld *test, const double min[3], const double max[3], double disorder,
                           double speed);
void weir_test_world_slots(WeirTestWorld *test, uint32_t count); // empty ones
// Lattice of a solid in a box, but not inside [hole_min, hole_max]. Its reference point is the middle of the box.
WeirSolid *weir_test_world_solid(WeirTestWorld *test, WeirSolidKind kind, const double min[3],
                                 const double max[3], const double hole_min[3], const double hole_max[3]);
// Walls three spacings thick around the domain, one solid.
WeirSolid *weir_test_world_sides(WeirTestWorld *test);
// Mass and inertia of a free body that is a box.
void weir_test_world_body(WeirTestWorld *test, WeirSolid *solid, const double min[3], const double max[3],
                          double density);
// Rows of a prescribed motion: time, displacement, rotation and both rates; 13 numbers each.
void weir_test_world_motion(WeirTestWorld *test, WeirSolid *solid, const float (*rows)[13], uint32_t count,
                            bool repeats);

// What a solver for it is made from.
WeirSolverSetup weir_test_world_setup(const WeirTestWorld *test);
// A solver of `backend` for it; fails the test if there is none.
WeirSolver *weir_test_world_solver(const WeirTestWorld *test, const WeirBackend *backend);

// world_cases.c: worlds that between them have everything, with a number of steps that shows it.
typedef struct WeirTestCase {
    const char *name;
    void (*build)(WeirTestWorld *test);
    uint32_t steps;
} WeirTestCase;
extern const WeirTestCase weir_test_cases[];
extern const uint32_t weir_test_case_count;
// The one of that name.
WeirTestWorld weir_test_case(const char *name);
