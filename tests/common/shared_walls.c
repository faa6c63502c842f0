// No particle ever gets out, at any speed; a wall takes its share of the normal speed and nothing else.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

enum { DIRECTIONS = 16, WALL_COUNT = 4 * DIRECTIONS };

static void check_inside(WeirSolver *solver, double size)
{
    WeirState state;
    assert_int_equal(solver->interface->read(solver, &state), WEIR_OK);
    for (uint32_t k = 0; k < 2 * state.count; ++k) {
        assert_true(isfinite(state.velocity[k]));
        assert_true(state.position[k] >= 0 && state.position[k] <= size); // NaN fails
    }
}

// At the solver, below the simulation's stop at a blow-up: walls must hold even then.
static void throw_at_walls(const WeirBackend *backend, double speed, double restitution, double time_step)
{
    const double size = 2;
    WeirScene *scene = weir_test_count_scene(WALL_COUNT, size, 0.05, 0.12);
    weir_test_set(scene, "restitution", restitution);
    weir_test_set(scene, "time_step", time_step);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    double position[2 * WALL_COUNT];
    float velocity[2 * WALL_COUNT];
    static const float starts[4][2] = {{1, 1}, {0.001f, 1.999f}, {2, 1}, {0, 0}};
    for (int i = 0; i < WALL_COUNT; ++i) {
        double angle = (i % DIRECTIONS) * 6.283185307 / DIRECTIONS;
        position[2 * i] = starts[i / DIRECTIONS][0], position[2 * i + 1] = starts[i / DIRECTIONS][1];
        velocity[2 * i] = (float)(speed * cos(angle)), velocity[2 * i + 1] = (float)(speed * sin(angle));
    }
    WeirParticles particles = {
        .dimension = 2, .count = WALL_COUNT, .position = position, .velocity = velocity};
    WeirSolver *solver = weir_sim_solver(sim);
    assert_non_null(solver);
    assert_int_equal(solver->interface->set_state(solver, &particles), WEIR_OK);
    for (int step = 0; step < 12; ++step) {
        assert_int_equal(solver->interface->step(solver, 1, INFINITY), WEIR_OK);
        assert_int_equal(solver->interface->wait(solver), WEIR_OK);
        check_inside(solver, size);
    }
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void nothing_gets_out(const WeirBackend *backend)
{
    static const double restitutions[] = {0, 0.5, 1}, speeds[] = {3, 1e4, 1e7};
    for (int r = 0; r < 3; ++r) {
        for (int s = 0; s < 3; ++s) {
            throw_at_walls(backend, speeds[s], restitutions[r], 1e-6);
            throw_at_walls(backend, speeds[s], restitutions[r], 1e-3);
            throw_at_walls(backend, speeds[s], restitutions[r], 0.1);
        }
    }
}

// One bounce each: left, right, bottom, top and a corner. The tangential speed stays.
static void check_restitution(const WeirBackend *backend, float restitution)
{
    enum { COUNT = 5 };
    static const float start[2 * COUNT] = {0.01f, 1.5f, 1.99f, 1.3f, 0.5f, 0.01f, 0.7f, 1.99f, 1.99f, 0.01f};
    static const float speed[2 * COUNT] = {-20, 3, 20, 3, 3, -20, 3, 20, 20, -20};
    static const bool hits[2 * COUNT] = {true, false, true, false, false, true, false, true, true, true};
    WeirScene *scene = weir_test_count_scene(COUNT, 2, 0.05, 0.12);
    weir_test_set(scene, "restitution", restitution);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_set_state(sim, start, speed);
    weir_test_step(sim, 2); // 2 * 0.0005 s * 20 m/s = 0.02 m
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (int k = 0; k < 2 * COUNT; ++k) {
        double expected = hits[k] ? -restitution * speed[k] : speed[k];
        CHECK_NEAR(velocity[k], expected, 1e-6 * fabs(speed[k]));
        assert_true(position[k] >= 0 && position[k] <= 2);
    }
    free(position);
    free(velocity);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void restitution_reflects_the_speed(const WeirBackend *backend)
{
    check_restitution(backend, 0);
    check_restitution(backend, 0.5f);
    check_restitution(backend, 1);
}

// A full box shaken by strong gravity from all sides keeps every particle.
static void shaken_box_keeps_all(const WeirBackend *backend)
{
    static const double directions[4][2] = {{300, 0}, {-300, 300}, {0, -300}, {-300, -300}};
    WeirScene *scene = weir_test_scene(0.02, 0.05, 0, 0.3);
    weir_test_set(scene, "time_step", 0.0002);
    weir_test_box(scene, 0, 0, 0.3, 0.2);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    for (int n = 0; n < 4; ++n) {
        CHECK_SIM(sim, weir_sim_set_parameter(sim, "gravity", directions[n], 2), WEIR_OK);
        weir_test_step(sim, 100);
        WeirDiagnostics diagnostics = weir_test_diagnose(sim, 0);
        assert_int_equal(diagnostics.lost_particles, 0);
        assert_true(diagnostics.max_speed > 1);
    }
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(nothing_gets_out),
    WEIR_SHARED_TEST(restitution_reflects_the_speed),
    WEIR_SHARED_TEST(shaken_box_keeps_all),
};
extern const WeirSharedGroup weir_shared_walls;
WEIR_SHARED_GROUP(walls, tests);
