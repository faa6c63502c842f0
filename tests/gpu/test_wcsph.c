// `wcsph` on the GPU follows the CPU: what a read evaluates, pass by pass, and runs of many steps.
//
// Tolerances are shares of the largest value of the field: 2e-5 for what one evaluation gives, 2e-3 after a run, when
// rounding has grown for 20 to 70 steps. It grows most where the method has an edge. A particle whose surface number
// grazes 0.95 d is shifted in a step or not, by up to a quarter of the fastest one's way (body_3d: 1.7e-4 m, with two lanes
// alone); and one that the barrier throws back (1,500 /s of its depth in dam_3d) leaves 0.001 m/s faster on the CPU too, if it
// started one quantum deeper. So few values may be farther off after a run, but no farther than that.
#include "adapter.h"
#include "core/diagnostics.h"
#include "gpu/wcsph.h"
#include "worlds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static WeirGpu *gpu;

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

// All but `spared` values within the tolerance, and those within 15 of it.
static void check_most(const char *where, const char *what, const float *actual, const float *expected,
                       size_t count, double tolerance, size_t spared)
{
    double worst = 0;
    size_t at = 0, beyond = 0;
    for (size_t n = 0; n < count; ++n) {
        double difference = fabs((double)actual[n] - (double)expected[n]);
        beyond += !(difference <= tolerance);
        if (difference <= worst) continue; // NaN goes on
        worst = difference;
        at = n;
        if (!(difference <= 15 * tolerance)) break;
    }
    if (getenv("WEIR_TEST_SHOW"))
        print_message("%-14s %-13s %.2g of %.2g, %zu beyond\n", where, what, worst, tolerance, beyond);
    if (beyond > spared || !(worst <= (spared > 0 ? 15 : 1) * tolerance))
        fail_msg("%s: %s[%zu] is %.9g on the GPU and %.9g on the CPU, tolerance %.3g, %zu beyond it", where,
                 what, at, (double)actual[at], (double)expected[at], tolerance, beyond);
}

static void check(const char *where, const char *what, const float *actual, const float *expected,
                  size_t count, double tolerance)
{
    check_most(where, what, actual, expected, count, tolerance, 0);
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

static WeirDiagnosticSums sums_of(WeirSolver *solver)
{
    WeirDiagnosticSums sums;
    WeirStatus status = solver->interface->diagnose(solver, &sums);
    if (status != WEIR_OK) fail_msg("diagnose: %s", solver->message.text);
    return sums;
}

// What the device sums up is what a copy of all particles gives.
static void check_sums(const WeirSolver *solver, const WeirDiagnosticSums *sums, const WeirState *state)
{
    const WeirGpuSolver *own = (const WeirGpuSolver *)solver;
    WeirDiagnosticSums wanted;
    weir_sum_fluid(state, &own->parameters, &own->constants, &wanted);
    assert_int_equal(sums->step, wanted.step);
    CHECK_NEAR(sums->time, wanted.time, 0);
    assert_int_equal(sums->particles, wanted.particles);
    assert_int_equal(sums->lost, wanted.lost);
    double count = (double)wanted.particles, speed = sqrt(wanted.speed2_max);
    for (int axis = 0; axis < 3; ++axis) {
        // Places themselves are rounded, far from the origin too.
        double farthest = fmax(1, (double)own->constants.domain_max[axis]);
        CHECK_NEAR(sums->place[axis], wanted.place[axis],
                   1e-6 * fabs(wanted.place[axis]) + 6e-8 * count * farthest);
        CHECK_NEAR(sums->velocity[axis], wanted.velocity[axis], 1e-6 * count * speed);
    }
    CHECK_NEAR(sums->speed2, wanted.speed2, 2e-6 * wanted.speed2);
    CHECK_NEAR(sums->speed2_max, wanted.speed2_max, 1e-6 * wanted.speed2_max);
    CHECK_NEAR(sums->density_error, wanted.density_error, 1e-7 * count);
    CHECK_NEAR(sums->density_error_max, wanted.density_error_max, 1e-7);
}

static void *copy_of(const void *data, size_t size)
{
    void *copy = malloc(size);
    assert_non_null(copy);
    return memcpy(copy, data, size);
}

// Places, velocities and groups alone are those that come with all the rest.
static void check_motion(WeirSolver *solver)
{
    WeirState motion, all;
    assert_int_equal(solver->interface->read_motion(solver, &motion), WEIR_OK);
    size_t vectors = sizeof(float) * motion.dimension * motion.count,
           groups = sizeof(uint32_t) * motion.count;
    void *position = copy_of(motion.position, vectors), *velocity = copy_of(motion.velocity, vectors);
    void *group = copy_of(motion.group, groups);
    all = read_state(solver);
    assert_true(motion.step == all.step && motion.time == all.time && motion.count == all.count);
    assert_memory_equal(position, all.position, vectors);
    assert_memory_equal(velocity, all.velocity, vectors);
    assert_memory_equal(group, all.group, groups);
    free(position);
    free(velocity);
    free(group);
}

static void compare(const char *where, const WeirTestWorld *test, WeirSolver *on_gpu, WeirSolver *on_cpu,
                    double tolerance)
{
    check_motion(on_gpu);
    WeirDiagnosticSums sums = sums_of(on_gpu);
    WeirState a = read_state(on_gpu), b = read_state(on_cpu);
    check_sums(on_gpu, &sums, &a);
    assert_int_equal(a.count, b.count);
    assert_int_equal(a.dimension, b.dimension);
    assert_int_equal(a.step, b.step);
    CHECK_NEAR(a.time, b.time, 1e-5 * b.time + 1e-12); // steps follow the speed, which follows to 1e-3
    assert_memory_equal(a.group, b.group, a.count * sizeof *a.group);
    size_t count = a.count, values = count * a.dimension;
    size_t spared = tolerance < 1e-3 ? 0 : 6 + values / 1000;
    double speed = fmax(largest(b.velocity, values), 0.1);
    check_most(where, "position", a.position, b.position, values, tolerance * test->spacing, spared);
    check_most(where, "velocity", a.velocity, b.velocity, values, tolerance * speed, spared);
    check_most(where, "density", a.density, b.density, count, 0.01 * tolerance * largest(b.density, count),
               spared);
    // Of solids it is kept as a density: rounding of that is 6e-5 kg/m^3 times c0^2.
    check_most(where, "pressure", a.pressure, b.pressure, count,
               tolerance * largest(b.pressure, count) + 6.2e-5 * 400, spared);
    check_most(where, "acceleration", a.acceleration, b.acceleration, values,
               5 * tolerance * largest(b.acceleration, values), spared);
    if (test->world.solid_count > 0) check_solids(where, test, &a, &b, tolerance);
}

static void compare_health(WeirSolver *on_gpu, WeirSolver *on_cpu)
{
    WeirHealth a = health_of(on_gpu), b = health_of(on_cpu);
    assert_true(a.has_clock);
    assert_int_equal(a.bad_particles, 0);
    assert_int_equal(a.steps, b.steps);
    CHECK_NEAR(a.time, b.time, 1e-5 * b.time + 1e-12); // steps follow the speed, which follows to 1e-3
    CHECK_NEAR(a.time_step, b.time_step, 1e-3 * b.time_step);
    CHECK_NEAR(a.max_speed, b.max_speed, 1e-3 * b.max_speed);
    CHECK_NEAR(a.max_density_error, b.max_density_error, 2e-5); // as densities are compared
    assert_int_equal(a.fluid_particles, b.fluid_particles);
    assert_int_equal(a.drained_particles, b.drained_particles);
    assert_int_equal(a.lost_particles, b.lost_particles);
}

// Begins anew with so many threads per particle, and with what else a test has changed of the solver's traits.
static void begin_anew(WeirSolver *on_gpu, const WeirTestWorld *test, uint32_t lanes)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)on_gpu;
    solver->traits.lanes = lanes;
    WeirParameters parameters = solver->common.parameters;
    WeirConstants constants = solver->common.constants;
    assert_int_equal(on_gpu->interface->configure(on_gpu, &parameters, &constants), WEIR_OK);
    assert_int_equal(on_gpu->interface->set_state(on_gpu, &test->world.particles), WEIR_OK);
}

// `lanes` 0: as many threads per particle as the solver chooses. `marked`: as it is in large scenes.
static void run_case(const WeirTestCase *chosen, uint32_t lanes, bool marked)
{
    WeirTestWorld test;
    chosen->build(&test);
    WeirSolver *on_gpu = weir_test_world_solver(&test, backend_of(true));
    ((WeirWcsphGpu *)on_gpu)->traits.marks_mixed = marked;
    if (lanes > 0) begin_anew(on_gpu, &test, lanes);
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

// Fluid in the first layer of a wall or beyond is lost, and so is what has no speed.
static void counts_the_lost(void **state)
{
    (void)state;
    WeirTestWorld test = weir_test_case("dam_3d");
    WeirParticles *particles = &test.world.particles;
    particles->position[0] = -0.51 * test.spacing;
    particles->position[3] = -0.49 * test.spacing; // not yet
    particles->position[3 * 2 + 2] = 0.4 + 0.51 * test.spacing;
    particles->velocity[3 * 3 + 2] = INFINITY;
    particles->velocity[3 * 4] = NAN;
    WeirSolver *solver = weir_test_world_solver(&test, backend_of(true));
    WeirDiagnosticSums sums = sums_of(solver);
    assert_int_equal(sums.lost, 4);
    assert_int_equal(sums.particles, particles->fluid_slots);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

static void follows_the_cpu(void **state)
{
    const char *only = getenv("WEIR_TEST_CASE");
    (void)state;
    for (uint32_t n = 0; n < weir_test_case_count; ++n)
        if (!only || strcmp(only, weir_test_cases[n].name) == 0) run_case(&weir_test_cases[n], 0, false);
}

// One, two, four or eight threads share a particle's neighbours: a free body in a box, and emitters and drains.
static void follows_the_cpu_with_any_number_of_lanes(void **state)
{
    (void)state;
    uint32_t runs = 0;
    for (uint32_t n = 0; n < weir_test_case_count; ++n) {
        const WeirTestCase *chosen = &weir_test_cases[n];
        if (strcmp(chosen->name, "body_3d") != 0 && strcmp(chosen->name, "tap_2d") != 0) continue;
        for (uint32_t lanes = 1; lanes <= 8; lanes *= 2, ++runs) run_case(chosen, lanes, false);
    }
    assert_int_equal(runs, 8);
}

// Lists of fluid alone are summed apart in large scenes in 2D, here in small ones.
static void follows_the_cpu_with_marked_lists(void **state)
{
    (void)state;
    uint32_t runs = 0;
    for (uint32_t n = 0; n < weir_test_case_count; ++n) {
        const WeirTestCase *chosen = &weir_test_cases[n];
        if (strcmp(chosen->name, "dam_2d") != 0 && strcmp(chosen->name, "bodies_2d") != 0 &&
            strcmp(chosen->name, "tap_2d") != 0)
            continue;
        for (uint32_t lanes = 1; lanes <= 4; lanes *= 4, ++runs) run_case(chosen, lanes, true);
    }
    assert_int_equal(runs, 6);
}

// Where particles outrun their lists before those may be made anew, the walk over cells finds the same neighbours: here
// lists are made for a way of one quantum. Lanes share such a walk too.
static void outrun_lists_lose_nobody(void **state)
{
    (void)state;
    static const char *const names[] = {"dam_2d", "periodic_3d", "bodies_2d"};
    static const uint32_t lanes[] = {1, 8, 4};
    for (size_t n = 0; n < sizeof names / sizeof names[0]; ++n) {
        WeirTestWorld test = weir_test_case(names[n]);
        WeirSolver *on_gpu = weir_test_world_solver(&test, backend_of(true));
        WeirSolver *on_cpu = weir_test_world_solver(&test, backend_of(false));
        WeirWcsphGpu *solver = (WeirWcsphGpu *)on_gpu;
        assert_int_equal(solver->traits.list_interval, 4);
        solver->traits.least_allowance = solver->traits.most_allowance = 1;
        begin_anew(on_gpu, &test, lanes[n]);
        uint32_t outrun = 0;
        for (int k = 0; k < 20; ++k) {
            take_steps(on_gpu, 3, INFINITY);
            take_steps(on_cpu, 3, INFINITY);
            health_of(on_gpu);
            outrun += solver->seen.clock.travelled - solver->seen.listed_at > solver->seen.allowance;
        }
        assert_true(outrun > 5);
        assert_int_equal(solver->seen.allowance, 1);
        compare(names[n], &test, on_gpu, on_cpu, 2e-3);
        on_gpu->interface->destroy(on_gpu);
        on_cpu->interface->destroy(on_cpu);
        weir_test_world_free(&test);
    }
}

// Lists may be made anew while particles keep the slots and cells of the last sort, wherever they have gone since: here sorts
// are all but given up, and particles move on by up to two supports.
static void lists_without_a_sort_lose_nobody(void **state)
{
    (void)state;
    static const char *const names[] = {"dam_2d", "bodies_2d", "body_3d"};
    static const uint32_t lanes[] = {1, 4, 2};
    for (size_t n = 0; n < sizeof names / sizeof names[0]; ++n) {
        WeirTestWorld test = weir_test_case(names[n]);
        WeirSolver *on_gpu = weir_test_world_solver(&test, backend_of(true));
        WeirSolver *on_cpu = weir_test_world_solver(&test, backend_of(false));
        WeirWcsphGpu *solver = (WeirWcsphGpu *)on_gpu;
        uint32_t support = 1u << ((WeirGpuSolver *)on_gpu)->constants.coordinate_bits;
        solver->traits.least_allowance = solver->traits.most_allowance = support / 50;
        solver->traits.most_stray = 100 * support;
        begin_anew(on_gpu, &test, lanes[n]);
        take_steps(on_gpu, 1, INFINITY);
        health_of(on_gpu);
        uint32_t sorted_at = solver->seen.sorted_at, listed_at = solver->seen.listed_at, lists = 0;
        take_steps(on_cpu, 1, INFINITY);
        for (int k = 0; k < 20; ++k) {
            take_steps(on_gpu, 4, INFINITY);
            take_steps(on_cpu, 4, INFINITY);
            health_of(on_gpu);
            lists += solver->seen.listed_at != listed_at;
            listed_at = solver->seen.listed_at;
        }
        assert_int_equal(solver->seen.sorted_at, sorted_at);
        assert_true(lists > 5);
        assert_true(listed_at - sorted_at > support);
        compare(names[n], &test, on_gpu, on_cpu, 2e-3);
        on_gpu->interface->destroy(on_gpu);
        on_cpu->interface->destroy(on_cpu);
        weir_test_world_free(&test);
    }
}

// Without lists, as where they would take too much memory, the walk alone finds the neighbours.
static void walks_find_what_lists_find(void **state)
{
    (void)state;
    static const char *const names[] = {"dam_2d", "body_3d"};
    static const uint32_t lanes[] = {2, 1};
    for (size_t n = 0; n < sizeof names / sizeof names[0]; ++n) {
        WeirTestWorld test = weir_test_case(names[n]);
        WeirSolver *on_cpu = weir_test_world_solver(&test, backend_of(false));
        gpu->options.list_memory = 1;
        WeirSolver *on_gpu = weir_test_world_solver(&test, backend_of(true));
        gpu->options.list_memory = 0;
        assert_int_equal(((WeirWcsphGpu *)on_gpu)->traits.list_parts, 0);
        begin_anew(on_gpu, &test, lanes[n]);
        // (After 40 a wall's particle has its only fluid at the very end of its support: no pressure, or all of it.)
        take_steps(on_gpu, 36, INFINITY);
        take_steps(on_cpu, 36, INFINITY);
        compare(names[n], &test, on_gpu, on_cpu, 2e-3);
        on_gpu->interface->destroy(on_gpu);
        on_cpu->interface->destroy(on_cpu);
        weir_test_world_free(&test);
    }
}

// All groups, or the one that is named: "cases", "lanes".
int main(int argc, char **argv)
{
    const char *only = argc > 1 ? argv[1] : "";
    const bool cases_run = strcmp(only, "lanes") != 0, lanes_run = strcmp(only, "cases") != 0;
    gpu = weir_test_gpu(NULL);
    const struct CMUnitTest cases[] = {
        cmocka_unit_test(counts_the_lost),
        cmocka_unit_test(follows_the_cpu),
        cmocka_unit_test(outrun_lists_lose_nobody),
        cmocka_unit_test(lists_without_a_sort_lose_nobody),
        cmocka_unit_test(walks_find_what_lists_find),
    };
    const struct CMUnitTest lanes[] = {
        cmocka_unit_test(follows_the_cpu_with_any_number_of_lanes),
        cmocka_unit_test(follows_the_cpu_with_marked_lists),
    };
    int failed = 0;
    if (cases_run) failed += cmocka_run_group_tests_name("wcsph", cases, NULL, NULL);
    if (lanes_run) failed += cmocka_run_group_tests_name("wcsph_lanes", lanes, NULL, NULL);
    weir_gpu_destroy(gpu);
    return failed;
}
