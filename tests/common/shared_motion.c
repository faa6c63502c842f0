// Single particles and free fall, where the exact answer is known.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

// Semi-implicit Euler from rest: v_n = n g dt, y_n = y_0 + g dt^2 n (n + 1) / 2.
static void free_fall_is_exact(const WeirBackend *backend)
{
    enum { COUNT = 5, STEPS = 400 };
    const double gravity[2] = {1.25, -9.81};
    WeirScene *scene = weir_test_count_scene(COUNT, 4, 0.05, 0.12);
    weir_test_gravity(scene, gravity[0], gravity[1]);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    double dt = weir_sim_parameters(sim)->time_step;
    float start[2 * COUNT], speed[2 * COUNT];
    for (int i = 0; i < COUNT; ++i) {
        start[2 * i] = 0.5f + 0.5f * (float)i, start[2 * i + 1] = 3.5f - 0.25f * (float)i;
        speed[2 * i] = -0.25f * (float)i, speed[2 * i + 1] = 1.0f;
    }
    weir_test_set_state(sim, start, speed);
    weir_test_step(sim, STEPS);
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (int k = 0; k < 2 * COUNT; ++k) {
        double change = gravity[k % 2] * dt;
        CHECK_NEAR(velocity[k], speed[k] + STEPS * change, STEPS * 0.5 * 2.4e-7);
        CHECK_NEAR(position[k], start[k] + STEPS * dt * speed[k] + change * dt * STEPS * (STEPS + 1) / 2,
                   STEPS * 0.5 * 2.4e-7);
    }
    free(position);
    free(velocity);
    CHECK_NEAR(weir_sim_time(sim), STEPS * dt, 1e-12);
    assert_int_equal(weir_sim_step_count(sim), STEPS);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// A whole block falls as one: inner forces cannot move its centre.
static void block_falls_like_a_stone(const WeirBackend *backend)
{
    enum { STEPS = 200 };
    WeirScene *scene = weir_test_scene(0.02, 0.05, 0, 1);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_box(scene, 0.4, 0.6, 0.6, 0.8);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    uint32_t count = weir_sim_particle_count(sim);
    assert_int_equal(count, 100);
    weir_test_step(sim, STEPS);
    double dt = weir_sim_parameters(sim)->time_step, x = 0, y = 0;
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
    for (uint32_t i = 0; i < count; ++i) x += position[2 * i] / count, y += position[2 * i + 1] / count;
    free(position);
    CHECK_NEAR(x, 0.5, 2e-6);
    CHECK_NEAR(y, 0.7 - 9.81 * dt * dt * STEPS * (STEPS + 1) / 2, 1e-5);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void particle_at_rest_stays(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_count_scene(3, 1, 0.05, 0.12);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    // In the middle, on a wall, and in a corner.
    static const float start[6] = {0.3f, 0.7f, 1.0f, 0.4f, 0.0f, 0.0f}, rest[6] = {0};
    weir_test_set_state(sim, start, rest);
    weir_test_step(sim, 100);
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (int k = 0; k < 6; ++k) {
        CHECK_NEAR(position[k], start[k], 0);
        CHECK_NEAR(velocity[k], 0, 0);
    }
    free(position);
    free(velocity);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Two particles of a stiff fluid in one place: no division by zero, and viscosity still brings them together.
static void coincident_pair_shares_its_speed(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_count_scene(2, 1, 0.05, 0.12);
    weir_test_set(scene, "viscosity", 100);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    static const float start[4] = {0.5f, 0.5f, 0.5f, 0.5f}, speed[4] = {0.001f, 0, -0.001f, 0};
    weir_test_set_state(sim, start, speed);
    float *acceleration = weir_test_read(sim, WEIR_FIELD_ACCELERATION);
    assert_true(acceleration[0] < 0 && acceleration[2] > 0);
    CHECK_NEAR(acceleration[0] + acceleration[2], 0, 1e-6 * fabs(acceleration[0]));
    CHECK_NEAR(acceleration[1], 0, 0);
    free(acceleration);
    weir_test_step(sim, 5);
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (int k = 0; k < 4; ++k) assert_true(isfinite(velocity[k]));
    free(velocity);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(free_fall_is_exact),
    WEIR_SHARED_TEST(block_falls_like_a_stone),
    WEIR_SHARED_TEST(particle_at_rest_stays),
    WEIR_SHARED_TEST(coincident_pair_shares_its_speed),
};
extern const WeirSharedGroup weir_shared_motion;
WEIR_SHARED_GROUP(motion, tests);
