// The pointer's tools: what they do to single particles within their radius, and that nothing else
// feels them.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

// Particles at the tool's centre, halfway out along (3,4)/5, just inside, just outside, and far away.
enum { COUNT = 5 };
static const float start[2 * COUNT] = {2, 2, 2.3f, 2.4f, 2, 2.99f, 3.01f, 2, 0.5f, 3.5f};
static const float speed[2 * COUNT] = {0, 0, 0, 0, 1, 0, 0, 0, 0, 0};

// Velocities after one step under the tool, without gravity.
static void run_tool(const WeirBackend *backend, const WeirTool *tool, float velocity[2 * COUNT])
{
    WeirScene *scene = weir_test_count_scene(COUNT, 4, 0.05, 0.12);
    weir_test_set(scene, "time_step", 0.001);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    weir_test_set_state(sim, start, speed);
    CHECK_SIM(sim, weir_sim_set_tool(sim, tool), WEIR_OK);
    weir_test_step(sim, 1);
    CHECK_SIM(sim, weir_sim_read(sim, WEIR_FIELD_VELOCITY, velocity, 2 * COUNT), WEIR_OK);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void push_and_pull(const WeirBackend *backend)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        WeirTool tool = {.kind = sign > 0 ? WEIR_TOOL_PUSH : WEIR_TOOL_PULL,
                         .position = {2, 2},
                         .radius = 1,
                         .strength = 100};
        float velocity[2 * COUNT];
        run_tool(backend, &tool, velocity);
        // dt * strength * (1 - distance / radius), outwards for a push.
        CHECK_NEAR(velocity[2], sign * 0.05 * 0.6, 1e-6);
        CHECK_NEAR(velocity[3], sign * 0.05 * 0.8, 1e-6);
        CHECK_NEAR(velocity[4], 1, 1e-6);
        CHECK_NEAR(velocity[5], sign * 0.001, 1e-6);
        for (int k = 6; k < 2 * COUNT; ++k) CHECK_NEAR(velocity[k], speed[k], 0);
        CHECK_NEAR(velocity[0], 0, 0); // the centre has no direction
        CHECK_NEAR(velocity[1], 0, 0);
    }
}

static void stir_drags_along(const WeirBackend *backend)
{
    WeirTool tool = {
        .kind = WEIR_TOOL_STIR, .position = {2, 2}, .velocity = {3, -1}, .radius = 1, .strength = 200};
    float velocity[2 * COUNT];
    run_tool(backend, &tool, velocity);
    // dt * strength * (1 - distance / radius) * (tool's velocity - own).
    CHECK_NEAR(velocity[0], 0.2 * 3, 1e-6);
    CHECK_NEAR(velocity[1], 0.2 * -1, 1e-6);
    CHECK_NEAR(velocity[2], 0.1 * 3, 1e-6);
    CHECK_NEAR(velocity[4], 1 + 0.002 * (3 - 1), 1e-5);
    for (int k = 6; k < 2 * COUNT; ++k) CHECK_NEAR(velocity[k], speed[k], 0);
}

static void no_tool_no_force(const WeirBackend *backend)
{
    float velocity[2 * COUNT];
    WeirTool none = {.kind = WEIR_TOOL_NONE, .position = {2, 2}, .radius = 1, .strength = 100};
    run_tool(backend, &none, velocity);
    for (int k = 0; k < 2 * COUNT; ++k) CHECK_NEAR(velocity[k], speed[k], 0);
    run_tool(backend, NULL, velocity);
    for (int k = 0; k < 2 * COUNT; ++k) CHECK_NEAR(velocity[k], speed[k], 0);
}

static void impossible_tools_are_refused(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_count_scene(1, 1, 0.05, 0.12);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    static const WeirTool bad[] = {
        {.kind = WEIR_TOOL_PUSH, .position = {NAN, 0.5f}, .radius = 0.1f, .strength = 1},
        {.kind = WEIR_TOOL_PULL, .position = {0.5f, 0.5f}, .radius = INFINITY, .strength = 1},
        {.kind = WEIR_TOOL_STIR,
         .position = {0.5f, 0.5f},
         .velocity = {0, NAN},
         .radius = 0.1f,
         .strength = 1},
        {.kind = WEIR_TOOL_PUSH, .position = {0.5f, 0.5f}, .radius = -1, .strength = 1},
        {.kind = WEIR_TOOL_PUSH, .position = {0.5f, 0.5f}, .radius = 0.1f, .strength = NAN},
        {.kind = (WeirToolKind)77, .position = {0.5f, 0.5f}, .radius = 0.1f, .strength = 1},
    };
    for (size_t n = 0; n < sizeof bad / sizeof bad[0]; ++n)
        CHECK_SIM(sim, weir_sim_set_tool(sim, &bad[n]), WEIR_ERROR_INPUT);
    weir_test_step(sim, 3);
    assert_int_equal(weir_test_diagnose(sim, 0).lost_particles, 0);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(push_and_pull),
    WEIR_SHARED_TEST(stir_drags_along),
    WEIR_SHARED_TEST(no_tool_no_force),
    WEIR_SHARED_TEST(impossible_tools_are_refused),
};
extern const WeirSharedGroup weir_shared_tools;
WEIR_SHARED_GROUP(tools, tests);
