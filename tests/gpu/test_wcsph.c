// `wcsph` on the GPU follows the CPU: what a read evaluates, pass by pass, and runs of many steps.
//
// Tolerances are shares of the largest value of the field: 2e-5 for what one evaluation gives, 2e-3 after a run, when
// rounding has grown for 60 to 100 steps.
#include "adapter.h"
#include "gpu/wcsph.h"
#include "worlds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static WeirGpu *gpu;

typedef void Build(WeirTestWorld *test);
typedef struct Case {
    const char *name;
    Build *build;
    uint32_t steps;
} Case;

#define NOWHERE ((double[]){9, 9, 9}), ((double[]){9, 9, 9})

static WeirTestWorld start(uint32_t dimension, double x, double y, double z)
{
    return weir_test_world(dimension, (double[]){x, y, z});
}

// ---- Worlds ----

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
    const double low[2][3] = {{0.3, 0.35, 0}, {0.35, 0.55, 0}}, high[2][3] = {{0.6, 0.5, 0}, {0.55, 0.7, 0}};
    for (int n = 0; n < 2; ++n) {
        WeirSolid *body = weir_test_world_solid(test, WEIR_SOLID_FREE, low[n], high[n], NOWHERE);
        weir_test_world_body(test, body, low[n], high[n], 600);
        body->velocity[1] = -1.5f;
        body->angular_velocity[2] = n ? 2.0f : -1.0f;
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

static void add_tap(WeirTestWorld *test, double x, double y)
{
    WeirWorld *world = &test->world;
    uint32_t dimension = world->particles.dimension, across = 3, layers = dimension == 3 ? 3 : 1;
    world->emitters = calloc(1, sizeof *world->emitters);
    world->points = calloc((size_t)across * layers * dimension, sizeof *world->points);
    assert_true(world->emitters && world->points);
    world->emitter_count = 1;
    world->point_count = across * layers;
    world->emitters[0] = (WeirEmitter){
        .point_count = across * layers, .speed = 3, .start = 0.003f, .stop = 0.05f, .direction = {0, -1, 0}};
    const double center[3] = {x, y, 0.2};
    for (uint32_t axis = 0; axis < dimension; ++axis) world->emitters[0].center[axis] = (float)center[axis];
    for (uint32_t k = 0; k < across * layers; ++k) {
        double *point = world->points + (size_t)dimension * k;
        point[0] = x + ((double)(k % across) - 1) * test->spacing;
        point[1] = y;
        if (dimension == 3) point[2] = 0.2 + ((double)(k / across) - 1) * test->spacing;
    }
}

static void add_drain(WeirTestWorld *test, double x0, double x1, double y1)
{
    WeirWorld *world = &test->world;
    world->drains = calloc(1, sizeof *world->drains);
    assert_non_null(world->drains);
    world->drain_count = 1;
    world->drains[0] = (WeirDrain){{(float)x0, 0, 0, 0}, {(float)x1, (float)y1, 1, 0}};
}

static void tap_2d(WeirTestWorld *test)
{
    *test = start(2, 0.6, 0.9, 0);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.6, 0.2, 0}, 0.1, 0.3);
    weir_test_world_slots(test, 5);
    weir_test_world_sides(test);
    add_tap(test, 0.3, 0.5);
    add_drain(test, 0.45, 0.6, 0.12);
}

static void tap_3d(WeirTestWorld *test)
{
    *test = start(3, 0.5, 0.6, 0.4);
    weir_test_world_fluid(test, (double[]){0, 0, 0}, (double[]){0.5, 0.15, 0.4}, 0.1, 0.3);
    weir_test_world_slots(test, 300);
    weir_test_world_sides(test);
    add_tap(test, 0.25, 0.4);
    add_drain(test, 0.4, 0.5, 0.1);
}

static void open_2d(WeirTestWorld *test)
{
    *test = start(2, 0.6, 0.6, 0);
    CHECK_SCENE(test->scene, weir_scene_set_string(test->scene, "domain.open", "-y +x"), WEIR_OK);
    weir_test_world_fluid(test, (double[]){0.1, 0, 0}, (double[]){0.6, 0.3, 0}, 0.1, 2);
}

static const Case cases[] = {
    {"dam_2d", dam_2d, 100},        {"dam_3d", dam_3d, 60},           {"tait_cubic_2d", tait_cubic_2d, 60},
    {"quintic_3d", quintic_3d, 30}, {"laminar_2d", laminar_2d, 60},   {"slip_2d", slip_2d, 60},
    {"plain_2d", plain_2d, 60},     {"periodic_2d", periodic_2d, 60}, {"periodic_3d", periodic_3d, 40},
    {"channel_2d", channel_2d, 60}, {"piston_2d", piston_2d, 100},    {"shaker_3d", shaker_3d, 60},
    {"bodies_2d", bodies_2d, 100},  {"body_3d", body_3d, 50},         {"tap_2d", tap_2d, 100},
    {"tap_3d", tap_3d, 50},         {"open_2d", open_2d, 60},
};
enum { CASES = sizeof cases / sizeof cases[0] };

// ---- Comparisons ----

static const WeirBackend *backend_of(bool on_gpu)
{
    return on_gpu ? weir_gpu_backend(gpu) : weir_cpu_backend();
}

static WeirState read_state(WeirSolver *solver)
{
    WeirState state;
    WeirStatus status = solver->interface->read(solver, &state);
    if (status != WEIR_OK) fail_msg("read: %s", solver->message.text);
    return state;
}

static void take_steps(WeirSolver *solver, uint32_t steps, double until)
{
    WeirStatus status = solver->interface->step(solver, steps, until);
    if (status == WEIR_OK) status = solver->interface->wait(solver);
    if (status != WEIR_OK) fail_msg("step: %s", solver->message.text);
}

static WeirHealth health_of(WeirSolver *solver)
{
    WeirHealth health;
    assert_int_equal(solver->interface->poll(solver, &health), WEIR_OK);
    return health;
}

static double largest(const float *values, size_t count)
{
    double most = 0;
    for (size_t n = 0; n < count; ++n) most = fmax(most, fabs((double)values[n]));
    return most;
}

static void check(const char *where, const char *what, const float *actual, const float *expected,
                  size_t count, double tolerance)
{
    double worst = 0;
    size_t at = 0;
    for (size_t n = 0; n < count; ++n) {
        double difference = fabs((double)actual[n] - (double)expected[n]);
        if (difference <= worst) continue; // NaN goes on
        worst = difference;
        at = n;
        if (!(difference <= tolerance)) break;
    }
    if (getenv("WEIR_TEST_SHOW")) print_message("%-14s %-13s %.2g of %.2g\n", where, what, worst, tolerance);
    if (!(worst <= tolerance))
        fail_msg("%s: %s[%zu] is %.9g on the GPU and %.9g on the CPU, tolerance %.3g", where, what, at,
                 (double)actual[at], (double)expected[at], tolerance);
}

static void check_solids(const char *where, const WeirTestWorld *test, const WeirState *actual,
                         const WeirState *expected, double tolerance)
{
    for (uint32_t n = 0; n < test->world.solid_count; ++n) {
        const WeirSolidState *a = &actual->solids[n], *b = &expected->solids[n];
        check(where, "solid position", a->position, b->position, 3, tolerance * 0.1);
        check(where, "orientation", a->orientation, b->orientation, 4, tolerance);
        check(where, "solid velocity", a->velocity, b->velocity, 3, tolerance * 5);
        check(where, "solid angular velocity", a->angular_velocity, b->angular_velocity, 3, tolerance * 20);
        check(where, "solid force", a->force, b->force, 3, tolerance * (200 + 5 * largest(b->force, 3)));
        check(where, "solid torque", a->torque, b->torque, 3, tolerance * (200 + 5 * largest(b->torque, 3)));
    }
}

static void compare(const char *where, const WeirTestWorld *test, WeirSolver *on_gpu, WeirSolver *on_cpu,
                    double tolerance)
{
    WeirState a = read_state(on_gpu), b = read_state(on_cpu);
    assert_int_equal(a.count, b.count);
    assert_int_equal(a.dimension, b.dimension);
    assert_int_equal(a.step, b.step);
    CHECK_NEAR(a.time, b.time, 1e-6 * b.time + 1e-12);
    assert_memory_equal(a.group, b.group, a.count * sizeof *a.group);
    size_t count = a.count, values = count * a.dimension;
    double speed = fmax(largest(b.velocity, values), 0.1);
    check(where, "position", a.position, b.position, values, tolerance * test->spacing);
    check(where, "velocity", a.velocity, b.velocity, values, tolerance * speed);
    check(where, "density", a.density, b.density, count, 0.01 * tolerance * largest(b.density, count));
    // Of solids it is kept as a density: rounding of that is 6e-5 kg/m^3 times c0^2.
    check(where, "pressure", a.pressure, b.pressure, count,
          tolerance * largest(b.pressure, count) + 6.2e-5 * 400);
    check(where, "acceleration", a.acceleration, b.acceleration, values,
          5 * tolerance * largest(b.acceleration, values));
    if (test->world.solid_count > 0) check_solids(where, test, &a, &b, tolerance);
}

static void compare_health(WeirSolver *on_gpu, WeirSolver *on_cpu)
{
    WeirHealth a = health_of(on_gpu), b = health_of(on_cpu);
    assert_true(a.has_clock);
    assert_int_equal(a.bad_particles, 0);
    assert_int_equal(a.steps, b.steps);
    CHECK_NEAR(a.time, b.time, 1e-6 * b.time + 1e-12);
    CHECK_NEAR(a.time_step, b.time_step, 1e-3 * b.time_step);
    CHECK_NEAR(a.max_speed, b.max_speed, 1e-3 * b.max_speed);
    CHECK_NEAR(a.max_density_error, b.max_density_error, 1e-5);
    assert_int_equal(a.fluid_particles, b.fluid_particles);
    assert_int_equal(a.drained_particles, b.drained_particles);
    assert_int_equal(a.lost_particles, b.lost_particles);
}

static void run_case(const Case *chosen)
{
    WeirTestWorld test;
    chosen->build(&test);
    WeirSolver *on_gpu = weir_test_world_solver(&test, backend_of(true));
    WeirSolver *on_cpu = weir_test_world_solver(&test, backend_of(false));
    compare(chosen->name, &test, on_gpu, on_cpu, 2e-5);
    take_steps(on_gpu, 1, INFINITY);
    take_steps(on_cpu, 1, INFINITY);
    compare(chosen->name, &test, on_gpu, on_cpu, 5e-5);
    compare_health(on_gpu, on_cpu);
    take_steps(on_gpu, chosen->steps, INFINITY);
    take_steps(on_cpu, chosen->steps, INFINITY);
    compare_health(on_gpu, on_cpu);
    compare(chosen->name, &test, on_gpu, on_cpu, 2e-3);
    on_gpu->interface->destroy(on_gpu);
    on_cpu->interface->destroy(on_cpu);
    weir_test_world_free(&test);
}

static void follows_the_cpu(void **state)
{
    const char *only = getenv("WEIR_TEST_CASE");
    (void)state;
    for (int n = 0; n < CASES; ++n)
        if (!only || strcmp(only, cases[n].name) == 0) run_case(&cases[n]);
}

int main(void)
{
    gpu = weir_test_gpu(NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_the_cpu),
    };
    int failed = cmocka_run_group_tests_name("wcsph", tests, NULL, NULL);
    weir_gpu_destroy(gpu);
    return failed;
}
