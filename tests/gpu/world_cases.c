// Worlds that between them have everything that wcsph can do.
#include "worlds.h"

#include <stdlib.h>
#include <string.h>

// A hole that holds nothing.
#define NOWHERE ((double[]){1, 1, 1}), ((double[]){0, 0, 0})

static WeirTestWorld start(uint32_t dimension, double x, double y, double z)
{
    return weir_test_world(dimension, (double[]){x, y, z});
}

static void dam_2d(WeirTestWorld *test)
{
    *test = start(2, 1.2, 0.9, 0);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.5, 0.6, 0}, 0.1, 0.3);
    weir_test_world_sides(test);
}

static void dam_3d(WeirTestWorld *test)
{
    *test = start(3, 0.6, 0.5, 0.4);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.3, 0.4, 0.4}, 0.1, 0.3);
    weir_test_world_sides(test);
}

static void tait_cubic_2d(WeirTestWorld *test)
{
    dam_2d(test);
    weir_test_choose(test->scene, "equation_of_state", "tait");
    weir_test_choose(test->scene, "kernel", "cubic");
}

static void quintic_3d(WeirTestWorld *test)
{
    dam_3d(test);
    weir_test_choose(test->scene, "kernel", "quintic");
    weir_test_choose(test->scene, "tension_control", "off");
}

static void laminar_2d(WeirTestWorld *test)
{
    dam_2d(test);
    weir_test_set(test->scene, "viscosity", 20);
    test->world.solids[0].surface_velocity[0] = 1.0f;
}

static void slip_2d(WeirTestWorld *test)
{
    laminar_2d(test);
    test->world.solids[0].no_slip = 0;
}

static void plain_2d(WeirTestWorld *test)
{
    dam_2d(test);
    weir_test_set(test->scene, "shifting", 0);
    weir_test_set(test->scene, "density_diffusion", 0);
    weir_test_set(test->scene, "artificial_viscosity", 0);
    weir_test_set(test->scene, "time_step", 0.0005);
    weir_test_choose(test->scene, "stepping", "fixed");
}

static void periodic_2d(WeirTestWorld *test)
{
    *test = start(2, 0.7, 0.55, 0);
    CHECK_SCENE(test->scene, weir_scene_set_string(test->scene, "domain.periodic", "xy"), WEIR_OK);
    weir_test_gravity(test->scene, 0, 0);
    weir_test_set(test->scene, "background_pressure", 4000);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.7, 0.55, 0}, 0.2, 1);
}

static void periodic_3d(WeirTestWorld *test)
{
    *test = start(3, 0.5, 0.4, 0.35);
    CHECK_SCENE(test->scene, weir_scene_set_string(test->scene, "domain.periodic", "xyz"), WEIR_OK);
    weir_test_gravity(test->scene, 0, 0);
    weir_test_set(test->scene, "central_force", 3);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.5, 0.4, 0.35}, 0.2, 1);
}

static void channel_2d(WeirTestWorld *test)
{
    *test = start(2, 0.6, 0.5, 0);
    CHECK_SCENE(test->scene, weir_scene_set_string(test->scene, "domain.periodic", "x"), WEIR_OK);
    weir_test_gravity(test->scene, 1, 0);
    weir_test_set(test->scene, "viscosity", 10);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.6, 0.5, 0}, 0.1, 0.5);
    weir_test_world_solid(test, WEIR_SOLID_FIXED, (double[]){0, -0.15, 0}, (double[]){0.6, 0, 0}, NOWHERE);
    weir_test_world_solid(test, WEIR_SOLID_FIXED, (double[]){0, 0.5, 0}, (double[]){0.6, 0.65, 0}, NOWHERE);
}

static void piston_2d(WeirTestWorld *test)
{
    *test = start(2, 1.2, 0.9, 0);
    weir_test_world_fluid(test, (double[]){0.15, 0, 0}, (double[]){0.8, 0.4, 0}, 0.1, 0.2);
    weir_test_world_sides(test);
    WeirSolid *piston = weir_test_world_solid(test, WEIR_SOLID_DRIVEN, (double[]){0, 0, 0},
                                              (double[]){0.15, 0.6, 0}, NOWHERE);
    static const float rows[][13] = {
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
        {0.05f, 0.02f, 0, 0, 0, 0, 0.05f, 0.7f, 0, 0, 0, 0, 1},
        {0.1f, 0.05f, 0, 0, 0, 0, 0.08f, 0, 0, 0, 0, 0, 0},
    };
    weir_test_world_motion(test, piston, rows, 3, false);
}

// Fluid that meets a resting body at 0.6 of the speed of sound: there the barrier brakes it.
static void throw_at_body(WeirTestWorld *test, const double low[3], const double high[3])
{
    weir_test_world_fluid(test, (double[]){0.1, 0.1, 0.1}, (double[]){0.4, 0.3, 0.3}, 0.1, 0.1);
    WeirParticles *particles = &test->world.particles;
    for (uint32_t i = 0; i < particles->count; ++i) particles->velocity[particles->dimension * i] += 12;
    WeirSolid *body = weir_test_world_solid(test, WEIR_SOLID_FREE, low, high, NOWHERE);
    weir_test_world_body(test, body, low, high, 2000);
}

static void throw_2d(WeirTestWorld *test)
{
    *test = start(2, 1.2, 0.9, 0);
    throw_at_body(test, (double[]){0.45, 0.15, 0}, (double[]){0.65, 0.4, 0});
}

static void throw_3d(WeirTestWorld *test)
{
    *test = start(3, 1, 0.6, 0.4);
    throw_at_body(test, (double[]){0.45, 0.1, 0.1}, (double[]){0.6, 0.3, 0.35});
}

// A table that starts anew during the run.
static void shaker_3d(WeirTestWorld *test)
{
    *test = start(3, 0.4, 0.5, 0.4);
    weir_test_world_fluid(test, (double[]){0, 0.1, 0}, (double[]){0.4, 0.4, 0.4}, 0.1, 0.2);
    weir_test_world_sides(test);
    WeirSolid *floor = weir_test_world_solid(test, WEIR_SOLID_DRIVEN, (double[]){0.1, 0, 0.1},
                                             (double[]){0.3, 0.1, 0.3}, NOWHERE);
    static const float rows[][13] = {
        {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0},
        {0.02f, 0, 0.01f, 0, 0, 0.05f, 0, 0, 0, 0, 0, 2, 0},
        {0.04f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0},
    };
    weir_test_world_motion(test, floor, rows, 3, true);
}

static void bodies_2d(WeirTestWorld *test)
{
    *test = start(2, 1.2, 0.9, 0);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){1.2, 0.3, 0}, 0.05, 0.1);
    weir_test_world_sides(test);
    const double low[2][3] = {{0.3, 0.35, 0}, {0.35, 0.52, 0}}, high[2][3] = {{0.6, 0.5, 0}, {0.55, 0.67, 0}};
    for (int n = 0; n < 2; ++n) {
        WeirSolid *body = weir_test_world_solid(test, WEIR_SOLID_FREE, low[n], high[n], NOWHERE);
        weir_test_world_body(test, body, low[n], high[n], 600);
        body->velocity[1] = n ? -4.0f : -1.5f; // the second hits the first
        body->angular_velocity[2] = n ? 2.0f : -1.0f;
    }
}

// A plate that something heavy has crushed: ten times as many of its particles touch the other body as a face of it has.
static void crushed_2d(WeirTestWorld *test)
{
    *test = start(2, 1.2, 0.9, 0);
    weir_test_gravity(test->scene, 0, 0);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){1.2, 0.1, 0}, 0.05, 0.1);
    weir_test_world_sides(test);
    const double low[2][3] = {{0.15, 0.43, 0}, {0.35, 0.25, 0}},
                 high[2][3] = {{0.95, 0.53, 0}, {1.0, 0.75, 0}};
    for (int n = 0; n < 2; ++n) {
        WeirSolid *body = weir_test_world_solid(test, WEIR_SOLID_FREE, low[n], high[n], NOWHERE);
        weir_test_world_body(test, body, low[n], high[n], n ? 7800 : 1);
    }
}

static void body_3d(WeirTestWorld *test)
{
    *test = start(3, 0.6, 0.7, 0.4);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.6, 0.25, 0.4}, 0.05, 0.1);
    weir_test_world_sides(test);
    const double low[3] = {0.15, 0.3, 0.1}, high[3] = {0.45, 0.45, 0.3};
    WeirSolid *body = weir_test_world_solid(test, WEIR_SOLID_FREE, low, high, NOWHERE);
    weir_test_world_body(test, body, low, high, 700);
    body->velocity[1] = -2.0f;
    body->angular_velocity[0] = 1.0f;
    body->angular_velocity[1] = 3.0f;
    body->freedom[2] = 0.0f;
}

// Two bodies that touch each other across a periodic border, the lower one turning. The period is not a power of two in quanta: NVIDIA's
// cards took remainders of negative ways as unsigned, which would not show.
static void border_2d(WeirTestWorld *test)
{
    *test = start(2, 0.9, 0.9, 0);
    CHECK_SCENE(test->scene, weir_scene_set_string(test->scene, "domain.periodic", "x"), WEIR_OK);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.9, 0.25, 0}, 0.05, 0.1);
    weir_test_world_solid(test, WEIR_SOLID_FIXED, (double[]){0, -0.15, 0}, (double[]){0.9, 0, 0}, NOWHERE);
    const double low[2][3] = {{0.75, 0.3, 0}, {0.85, 0.47, 0}}, high[2][3] = {{1.05, 0.45, 0}, {1, 0.62, 0}};
    for (int n = 0; n < 2; ++n) {
        WeirSolid *body = weir_test_world_solid(test, WEIR_SOLID_FREE, low[n], high[n], NOWHERE);
        weir_test_world_body(test, body, low[n], high[n], 600);
        body->velocity[0] = 2;
        body->velocity[1] = n ? -3.0f : 0.0f;
        body->angular_velocity[2] = n ? 0.0f : 2.0f;
    }
}

// `across` particles wide; the first and the last layer may come at `start` and `stop`, s.
static void add_tap(WeirTestWorld *test, double x, double y, uint32_t across, double speed, double start,
                    double stop)
{
    WeirWorld *world = &test->world;
    uint32_t dimension = world->particles.dimension, count = dimension == 3 ? across * across : across;
    uint32_t n = world->emitter_count++, first = world->point_count;
    world->point_count += count;
    world->emitters = realloc(world->emitters, world->emitter_count * sizeof *world->emitters);
    world->points = realloc(world->points, (size_t)world->point_count * dimension * sizeof *world->points);
    assert_true(world->emitters && world->points);
    world->emitters[n] = (WeirEmitter){.point_first = first,
                                       .point_count = count,
                                       .speed = (float)speed,
                                       .start = (float)start,
                                       .stop = (float)stop,
                                       .direction = {0, -1, 0}};
    const double center[3] = {x, y, 0.2}, middle = 0.5 * (across - 1);
    for (uint32_t axis = 0; axis < dimension; ++axis) world->emitters[n].center[axis] = (float)center[axis];
    for (uint32_t k = 0; k < count; ++k) {
        double *point = world->points + (size_t)dimension * (first + k);
        point[0] = x + (k % across - middle) * test->spacing;
        point[1] = y;
        if (dimension == 3) point[2] = 0.2 + (k / across - middle) * test->spacing;
    }
}

static void add_drain(WeirTestWorld *test, double x0, double x1, double y1)
{
    WeirWorld *world = &test->world;
    uint32_t n = world->drain_count++;
    world->drains = realloc(world->drains, world->drain_count * sizeof *world->drains);
    assert_non_null(world->drains);
    world->drains[n] = (WeirDrain){{(float)x0, 0, 0, 0}, {(float)x1, (float)y1, 1, 0}};
}

static void tap_2d(WeirTestWorld *test)
{
    *test = start(2, 0.6, 0.9, 0);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.6, 0.2, 0}, 0.1, 0.3);
    weir_test_world_slots(test, 5);
    weir_test_world_sides(test);
    add_tap(test, 0.3, 0.5, 3, 3, 0.003, 0.05);
    add_drain(test, 0.45, 0.6, 0.12);
}

// Taps of one to three particles whose layers come together, one by one, or never, too few slots for all, and a row of
// drains, last ones first.
static void taps_2d(WeirTestWorld *test)
{
    *test = start(2, 2, 0.8, 0);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){2, 0.1, 0}, 0.1, 0.3);
    weir_test_world_slots(test, 60);
    weir_test_world_sides(test);
    for (uint32_t n = 0; n < 18; ++n) {
        double first = 0.002 * (n % 4);
        add_tap(test, 0.15 + 0.1 * n, 0.4, 1 + n % 3, 2, first, n == 7 ? first : 0.03 + 0.001 * n);
    }
    for (int n = 39; n >= 0; --n) add_drain(test, 0.05 * n, 0.05 * n + 0.01, 0.06);
}

static void tap_3d(WeirTestWorld *test)
{
    *test = start(3, 0.5, 0.6, 0.4);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.5, 0.15, 0.4}, 0.11, 0.3);
    weir_test_world_slots(test, 300);
    weir_test_world_sides(test);
    add_tap(test, 0.25, 0.4, 3, 2, 0.003, 0.05);
    add_drain(test, 0.4, 0.5, 0.1);
}

// Far from the origin, in a long domain whose coordinates are coarser.
static void long_2d(WeirTestWorld *test)
{
    *test = start(2, 60, 1, 0);
    weir_test_world_fluid(test, (double[]){59.5, 0, 0}, (double[]){60, 0.5, 0}, 0.1, 0.3);
    weir_test_world_solid(test, WEIR_SOLID_FIXED, (double[]){59, -0.15, 0}, (double[]){60.15, 0, 0}, NOWHERE);
    weir_test_world_solid(test, WEIR_SOLID_FIXED, (double[]){60, 0, 0}, (double[]){60.15, 0.6, 0}, NOWHERE);
}

// Strips along every axis, so far across that the grid is folded under them: their ends share cells with each other.
static void folded_2d(WeirTestWorld *test)
{
    *test = start(2, 300, 250, 0);
    weir_test_world_fluid(test, (double[]){20, 50, 0}, (double[]){60, 50.1, 0}, 0.1, 0.3);
    weir_test_world_fluid(test, (double[]){100, 80, 0}, (double[]){100.1, 120, 0}, 0.1, 0.3);
}

static void folded_3d(WeirTestWorld *test)
{
    *test = start(3, 60, 50, 40);
    weir_test_world_fluid(test, (double[]){20, 20, 20}, (double[]){30, 20.05, 20.1}, 0.1, 0.3);
    weir_test_world_fluid(test, (double[]){5, 10, 20}, (double[]){5.05, 20, 20.1}, 0.1, 0.3);
    weir_test_world_fluid(test, (double[]){30, 40, 15}, (double[]){30.1, 40.05, 25}, 0.1, 0.3);
}

static void open_2d(WeirTestWorld *test)
{
    *test = start(2, 0.6, 0.6, 0);
    CHECK_SCENE(test->scene, weir_scene_set_string(test->scene, "domain.open", "-y +x"), WEIR_OK);
    weir_test_world_fluid(test, (double[]){0.1, 0, 0}, (double[]){0.6, 0.3, 0}, 0.1, 2);
}

const WeirTestCase weir_test_cases[] = {
    {"dam_2d", dam_2d, 67},         {"dam_3d", dam_3d, 40},           {"tait_cubic_2d", tait_cubic_2d, 40},
    {"quintic_3d", quintic_3d, 20}, {"laminar_2d", laminar_2d, 40},   {"slip_2d", slip_2d, 40},
    {"plain_2d", plain_2d, 40},     {"periodic_2d", periodic_2d, 40}, {"periodic_3d", periodic_3d, 27},
    {"channel_2d", channel_2d, 40}, {"piston_2d", piston_2d, 67},     {"shaker_3d", shaker_3d, 40},
    {"bodies_2d", bodies_2d, 67},   {"body_3d", body_3d, 27},         {"tap_2d", tap_2d, 67},
    {"taps_2d", taps_2d, 40},       {"tap_3d", tap_3d, 33},           {"open_2d", open_2d, 40},
    {"long_2d", long_2d, 40},       {"folded_2d", folded_2d, 20},     {"folded_3d", folded_3d, 20},
    {"border_2d", border_2d, 40},   {"throw_2d", throw_2d, 15},       {"throw_3d", throw_3d, 15},
    {"crushed_2d", crushed_2d, 10},
};
const uint32_t weir_test_case_count = sizeof weir_test_cases / sizeof weir_test_cases[0];

WeirTestWorld weir_test_case(const char *name)
{
    WeirTestWorld test = {0};
    for (uint32_t n = 0; n < weir_test_case_count; ++n)
        if (strcmp(weir_test_cases[n].name, name) == 0) weir_test_cases[n].build(&test);
    assert_non_null(test.scene);
    return test;
}
