// How runs of `wcsph` on the GPU behave: equal bits, batches, end times, health, the last good state, live parameters.
#include "adapter.h"
#include "core/probe.h"
#include "core/sim.h"
#include "gpu/wcsph.h"
#include "worlds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static WeirGpu *gpu;

static void take_steps(WeirSolver *solver, uint32_t steps, double until)
{
    WeirStatus status = solver->interface->step(solver, steps, until);
    if (status == WEIR_OK) status = solver->interface->wait(solver);
    if (status != WEIR_OK) fail_msg("step: %s", solver->message.text);
}

static WeirHealth health_of(WeirSolver *solver)
{
    WeirHealth health;
    assert_int_equal(solver->interface->wait(solver), WEIR_OK);
    assert_int_equal(solver->interface->poll(solver, &health), WEIR_OK);
    return health;
}

static WeirState read_state(WeirSolver *solver)
{
    WeirState state;
    WeirStatus status = solver->interface->read(solver, &state);
    if (status != WEIR_OK) fail_msg("read: %s", solver->message.text);
    return state;
}

static WeirStatus diagnose(WeirSolver *solver)
{
    WeirDiagnosticSums sums;
    return solver->interface->diagnose(solver, &sums);
}

static uint64_t mix(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t n = 0; n < size; ++n) hash = (hash ^ bytes[n]) * 1099511628211u;
    return hash;
}

// Of all that a state holds.
static uint64_t hash_of(WeirSolver *solver, uint32_t solids)
{
    WeirState state = read_state(solver);
    size_t vectors = sizeof(float) * state.count * state.dimension;
    uint64_t hash = mix(14695981039346656037u, state.position, vectors);
    hash = mix(hash, state.velocity, vectors);
    hash = mix(hash, state.acceleration, vectors);
    hash = mix(hash, state.density, sizeof(float) * state.count);
    hash = mix(hash, state.pressure, sizeof(float) * state.count);
    hash = mix(hash, state.group, sizeof(uint32_t) * state.count);
    return mix(hash, state.solids, solids * sizeof *state.solids);
}

typedef struct Course {
    WeirGpu *gpu;
    uint32_t steps, at_a_time;
    bool reads;    // in between
    bool indirect; // the device decides how many workgroups sort, as in large scenes
} Course;

static uint64_t run(const char *name, Course course)
{
    WeirTestWorld test = weir_test_case(name);
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(course.gpu));
    ((WeirWcsphGpu *)solver)->indirect = course.indirect;
    for (uint32_t done = 0; done < course.steps; done += course.at_a_time) {
        take_steps(solver, course.at_a_time, INFINITY);
        if (course.reads) assert_int_equal(diagnose(solver), WEIR_OK);
        if (course.reads) read_state(solver);
    }
    uint64_t hash = hash_of(solver, test.world.solid_count);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
    return hash;
}

// The lists' buffer: its parts, 0 if there are no lists, and their bytes together.
static uint32_t list_parts(const char *name, uint64_t *bytes)
{
    WeirTestWorld test = weir_test_case(name);
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    const WeirWcsphGpu *own = (const WeirWcsphGpu *)solver;
    uint32_t parts = own->traits.list_parts > 0 ? own->common.buffers.parts[WEIR_WCSPH_neighbor_list] : 0;
    *bytes = weir_buffers_bytes(&own->common.buffers, WEIR_WCSPH_neighbor_list);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
    return parts;
}

static const char *const lively[] = {"piston_2d", "bodies_2d", "body_3d", "taps_2d", "periodic_3d", "dam_2d"};
enum { LIVELY = sizeof lively / sizeof lively[0] };

// The same bits run to run, however the steps are cut into calls, whether somebody reads in between, and whoever decides
// how many workgroups sort.
static void equal_runs_give_equal_bits(void **state)
{
    (void)state;
    for (int n = 0; n < LIVELY; ++n) {
        uint64_t once = run(lively[n], (Course){gpu, 24, 24, false, false});
        assert_true(run(lively[n], (Course){gpu, 24, 24, false, false}) == once);
        assert_true(run(lively[n], (Course){gpu, 24, n % 2 ? 8 : 1, true, false}) == once);
        assert_true(run(lively[n], (Course){gpu, 24, n % 2 ? 24 : 6, false, true}) == once);
    }
}

// Dispatches in two dimensions, and shaders without run-time checks, change nothing.
static void dispatches_and_checks_change_nothing(void **state)
{
    (void)state;
    WeirGpu *trusted = weir_test_gpu(&(WeirGpuOptions){.trusted_shaders = true});
    for (int n = 1; n < LIVELY; n += 2) {
        uint64_t once = run(lively[n], (Course){gpu, 10, 10, false, false});
        uint32_t own = gpu->max_groups;
        gpu->max_groups = 3;
        assert_true(run(lively[n], (Course){gpu, 10, 10, false, false}) == once);
        gpu->max_groups = own;
        assert_true(run(lively[n], (Course){trusted, 10, 10, false, false}) == once);
    }
    weir_gpu_destroy(trusted);
}

// Where all lists, or all copies of the particles, do not fit one binding, they lie in several: that changes nothing.
static void buffers_in_parts_change_nothing(void **state)
{
    (void)state;
    static const char *const names[] = {"body_3d", "dam_3d", "tap_3d", "dam_2d"};
    uint64_t own = gpu->limits.maxStorageBufferBindingSize, bytes;
    for (int n = 0; n < 4; ++n) {
        WeirTestWorld test = weir_test_case(names[n]);
        uint64_t count = test.world.particles.count;
        weir_test_world_free(&test);
        uint64_t once = run(names[n], (Course){gpu, 24, 24, false, false});
        assert_int_equal(list_parts(names[n], &bytes), 1);
        gpu->limits.maxStorageBufferBindingSize = bytes / 3 + 8192;
        assert_in_range(list_parts(names[n], &bytes), 2, 4);
        assert_true(run(names[n], (Course){gpu, 24, 24, false, false}) == once);
        gpu->options.list_memory = 1;
        uint64_t walked = run(names[n], (Course){gpu, 24, 24, false, false});
        gpu->options.list_memory = 0;
        gpu->limits.maxStorageBufferBindingSize =
            3 * 16 * count + 7 * 16 - 1; // coordinate and motion are apart
        uint32_t parts = list_parts(names[n], &bytes);
        assert_true(parts > 0 ||
                    strcmp(names[n], "dam_3d") != 0); // the others' lists would be in too many parts
        assert_true(run(names[n], (Course){gpu, 24, 8, true, false}) == (parts > 0 ? once : walked));
        gpu->limits.maxStorageBufferBindingSize = 2 * 16 * count - 1; // of a moving solid's world kicked too
        assert_int_equal(list_parts(names[n], &bytes), 0);
        assert_true(run(names[n], (Course){gpu, 24, 24, false, false}) == walked);
        gpu->limits.maxStorageBufferBindingSize = own;
    }
}

// Lists that a device cannot bind, or that are to take less memory, are left out.
static void lists_keep_to_their_limits(void **state)
{
    (void)state;
    WGPULimits own = gpu->limits;
    uint64_t bytes, less;
    assert_int_equal(list_parts("dam_3d", &bytes), 1);
    gpu->limits.maxStorageBufferBindingSize = bytes / 3 + 8192;
    gpu->limits.maxStorageBuffersPerShaderStage = 8;
    assert_int_equal(list_parts("dam_3d", &less), 0);
    gpu->limits = own;
    gpu->options.list_memory = bytes;
    assert_int_equal(list_parts("dam_3d", &less), 1);
    gpu->options.list_memory = bytes - 1;
    assert_int_equal(list_parts("dam_3d", &less), 0);
    gpu->options.list_memory = 0;
}

// A device that binds too few buffers says so.
static void too_few_bindings_are_told(void **state)
{
    (void)state;
    WGPULimits own = gpu->limits;
    WeirTestWorld test = weir_test_case("dam_3d");
    gpu->limits.maxStorageBufferBindingSize = 3 * 16 * (uint64_t)test.world.particles.count - 1;
    gpu->limits.maxStorageBuffersPerShaderStage = 8;
    WeirStatus status = WEIR_OK;
    WeirMessage message = {""};
    WeirSolverSetup setup = weir_test_world_setup(&test);
    WeirSolver *solver =
        weir_gpu_backend(gpu)->create_solver(weir_gpu_backend(gpu), &setup, &status, &message);
    gpu->limits = own;
    assert_null(solver);
    assert_int_equal(status, WEIR_ERROR_MEMORY);
    assert_non_null(strstr(message.text, "need 12 storage buffers in the GPU's pass walls"));
    assert_non_null(strstr(message.text, "allows 8; raise parameters.particle_spacing"));
    weir_test_world_free(&test);
}

// A run ends exactly where it was asked to, and what was asked beyond it does not count.
static void runs_end_in_time(void **state)
{
    (void)state;
    WeirTestWorld test = weir_test_case("bodies_2d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    take_steps(solver, 200, 0.02);
    WeirHealth first = health_of(solver);
    CHECK_NEAR(first.time, 0.02, 1e-12);
    assert_true(first.steps > 5 && first.steps < 199);
    uint64_t hash = hash_of(solver, test.world.solid_count);
    // Nothing is left to do.
    take_steps(solver, 10, 0.02);
    assert_int_equal(health_of(solver).steps, first.steps);
    assert_true(hash_of(solver, test.world.solid_count) == hash);
    CHECK_NEAR(read_state(solver).time, 0.02, 1e-12);
    // And on.
    take_steps(solver, 200, 0.0301);
    WeirHealth second = health_of(solver);
    CHECK_NEAR(second.time, 0.0301, 1e-12);
    assert_true(second.steps > first.steps && second.steps < 199);
    assert_int_equal(read_state(solver).step, second.steps);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

static void set_bad(WeirTestWorld *test, uint32_t id, float density, float speed)
{
    test->world.particles.density[id] = density;
    test->world.particles.velocity[test->world.particles.dimension * id] = speed;
}

static bool all_finite(const float *values, size_t count)
{
    for (size_t n = 0; n < count; ++n)
        if (!isfinite(values[n])) return false;
    return true;
}

// One particle that cannot be is found in its first step, with its place; its neighbours may be found with it.
static void a_blow_up_is_found(void **state)
{
    (void)state;
    static const float bad[][2] = {{NAN, 0}, {INFINITY, 0}, {1000, NAN}, {1000, 1e30f}, {1000, 85}};
    for (size_t n = 0; n < sizeof bad / sizeof bad[0]; ++n) {
        WeirTestWorld test = weir_test_case("dam_2d");
        const double *place = test.world.particles.position + 2 * 57;
        set_bad(&test, 57, bad[n][0], bad[n][1]);
        WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
        take_steps(solver, 30, INFINITY);
        WeirHealth health = health_of(solver);
        assert_true(health.bad_particles > 0);
        assert_int_equal(health.first_bad_step, 1);
        assert_true(health.first_bad_id <= 57);
        CHECK_NEAR(health.first_bad_position[0], place[0], 0.4);
        CHECK_NEAR(health.first_bad_position[1], place[1], 0.4);
        assert_int_equal(diagnose(solver), WEIR_ERROR_UNSTABLE); // ask a read
        // It stopped there.
        take_steps(solver, 5, INFINITY);
        assert_true(health_of(solver).steps <= 1);
        read_state(solver);
        solver->interface->destroy(solver);
        weir_test_world_free(&test);
    }
}

// What is read after a blow-up is the state just before it: whole, finite, below four times the speed of sound.
static void the_last_good_state_is_kept(void **state)
{
    (void)state;
    for (int known = 0; known < 2; ++known) {
        WeirTestWorld test = weir_test_case("bodies_2d");
        weir_test_gravity(test.scene, -1000, 0);
        weir_test_choose(test.scene, "stepping", "fixed");
        weir_test_set(test.scene, "time_step", 0.002);
        WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
        assert_int_equal(solver->interface->step(solver, 400, INFINITY), WEIR_OK);
        if (known) health_of(solver); // otherwise the read is the first to learn of it
        WeirState last = read_state(solver);
        WeirHealth health = health_of(solver);
        assert_true(health.bad_particles > 0);
        assert_true(health.first_bad_step > 2 && health.first_bad_step < 400);
        assert_int_equal(last.step, health.first_bad_step - 1);
        CHECK_NEAR(last.time, 0.002 * ((double)last.step + 0.5), 1e-8);
        assert_true(all_finite(last.position, 2 * last.count));
        assert_true(all_finite(last.velocity, 2 * last.count));
        assert_true(all_finite(last.density, last.count));
        assert_true(all_finite(last.acceleration, 2 * last.count));
        float fastest = 0;
        for (uint32_t i = 0; i < test.world.particles.fluid_slots; ++i)
            fastest = fmaxf(fastest, hypotf(last.velocity[2 * i], last.velocity[2 * i + 1]));
        assert_true(fastest > 1 && fastest <= 80);
        assert_true(all_finite(last.solids[1].position, 4));
        assert_int_equal(diagnose(solver), WEIR_ERROR_UNSTABLE);
        // It stays, and a new state goes on.
        uint64_t hash = hash_of(solver, test.world.solid_count);
        take_steps(solver, 3, INFINITY);
        assert_true(hash_of(solver, test.world.solid_count) == hash);
        assert_int_equal(solver->interface->set_state(solver, &test.world.particles), WEIR_OK);
        assert_int_equal(health_of(solver).bad_particles, 0);
        take_steps(solver, 1, INFINITY);
        assert_int_equal(health_of(solver).steps, 1);
        assert_int_equal(diagnose(solver), WEIR_OK);
        solver->interface->destroy(solver);
        weir_test_world_free(&test);
    }
}

static WeirStatus gather(WeirSolver *solver, WeirGathered *gathered)
{
    return solver->interface->gather(solver, gathered);
}

// Probes get the fluid around them and no more; where that is more than was reckoned with, or after a blow-up, a read tells.
static void probes_get_what_they_look_at(void **state)
{
    (void)state;
    const WeirProbePiece probes[] = {{.kind = WEIR_PROBE_PRESSURE, .position = {0.25, 0.3, 0}},
                                     {.kind = WEIR_PROBE_FRONT, .direction = {3, 0, 0}},
                                     {.kind = WEIR_PROBE_MASS, .max = {0.5, 0.3, 0}}};
    WeirTestWorld test = weir_test_case("dam_2d");
    WeirSolverSetup setup = weir_test_world_setup(&test);
    setup.probes = probes;
    setup.probe_count = 3;
    WeirStatus status = WEIR_OK;
    WeirMessage message = {""};
    WeirSolver *solver =
        weir_gpu_backend(gpu)->create_solver(weir_gpu_backend(gpu), &setup, &status, &message);
    assert_non_null(solver);
    take_steps(solver, 9, INFINITY);
    WeirGathered gathered;
    assert_int_equal(gather(solver, &gathered), WEIR_OK);
    WeirState near = gathered.state, all = read_state(solver);
    uint32_t count = 0;
    for (uint32_t i = 0; i < test.world.particles.fluid_slots; ++i) {
        const float *place = all.position + 2 * i;
        if (!(hypot((double)place[0] - 0.25, (double)place[1] - 0.3) < 0.15)) continue;
        assert_memory_equal(near.position + 2 * count, place, 2 * sizeof *place); // in order of id
        assert_memory_equal(near.velocity + 2 * count, all.velocity + 2 * i, 2 * sizeof *place);
        assert_true(near.density[count] == all.density[i] && near.pressure[count] == all.pressure[i]);
        ++count;
    }
    assert_int_equal(near.count, count);
    assert_true(count > 20 && near.step == 9 && near.time == all.time);
    CHECK_NEAR(gathered.found[1], 3 * 0.5, 0.3);
    CHECK_NEAR(gathered.found[2], 60, 10);
    WeirWcsphGpu *own = (WeirWcsphGpu *)solver;
    own->traits.most_gathered = count - 1;
    assert_int_equal(gather(solver, &gathered), WEIR_ERROR_UNSTABLE);
    own->traits.most_gathered = count;
    assert_int_equal(gather(solver, &gathered), WEIR_OK);
    set_bad(&test, 57, NAN, 0);
    assert_int_equal(solver->interface->set_state(solver, &test.world.particles), WEIR_OK);
    take_steps(solver, 1, INFINITY);
    assert_int_equal(gather(solver, &gathered), WEIR_ERROR_UNSTABLE);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

// More ids than one digit of the order has.
static void probes_get_it_in_order(void **state)
{
    (void)state;
    WeirScene *scene = weir_test_scene(0.02, 0.06, 0, 3);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    weir_test_box(scene, 0, 0, 3, 2.4);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "probes[0].kind", "height"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "probes[0].position", (double[]){1.5, 0}, 2), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, weir_gpu_backend(gpu), 1);
    WeirGathered gathered;
    WeirState all;
    CHECK_SIM(sim, weir_sim_gather(sim, &gathered), WEIR_OK);
    CHECK_SIM(sim, weir_sim_state(sim, &all), WEIR_OK);
    uint32_t count = 0, last = 0;
    for (uint32_t i = 0; i < weir_sim_fluid_slots(sim); ++i) {
        const float *place = all.position + 2 * i;
        if (!(fabs((double)place[0] - 1.5) < 0.06)) continue;
        assert_memory_equal(gathered.state.position + 2 * count++, place, 2 * sizeof *place);
        last = i;
    }
    assert_true(gathered.state.count == count && count > 500 && last > 1 << 14);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// The upper body overtakes the lower one, and contact holds them apart: no two of their particles come closer than half a
// spacing.
static void bodies_push_each_other(void **state)
{
    (void)state;
    WeirTestWorld test = weir_test_case("bodies_2d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    take_steps(solver, 300, 0.06);
    WeirState now = read_state(solver);
    CHECK_NEAR(now.time, 0.06, 1e-12);
    const WeirSolid *low = &test.world.solids[1], *high = &test.world.solids[2];
    double nearest = 9;
    for (uint32_t i = low->first; i < low->first + low->count; ++i) {
        for (uint32_t j = high->first; j < high->first + high->count; ++j) {
            double x = (double)now.position[2 * i] - (double)now.position[2 * j];
            double y = (double)now.position[2 * i + 1] - (double)now.position[2 * j + 1];
            nearest = fmin(nearest, hypot(x, y));
        }
    }
    assert_true(nearest > 0.5 * test.spacing && nearest < 1.3 * test.spacing);
    assert_true(now.solids[2].velocity[1] > -3.5f); // it was -4
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

// What is crushed comes to rest: contact of however many pairs is no more than one step may take.
static void a_crushed_body_rests(void **state)
{
    (void)state;
    const WeirBackend *const backends[] = {weir_cpu_backend(), weir_gpu_backend(gpu)};
    for (int n = 0; n < 2; ++n) {
        WeirTestWorld test = weir_test_case("crushed_2d");
        WeirSolver *solver = weir_test_world_solver(&test, backends[n]);
        take_steps(solver, 150, INFINITY);
        const WeirSolidState *plate = &read_state(solver).solids[1];
        float speed = hypotf(plate->velocity[0], plate->velocity[1]);
        if (speed > 0.2f || fabsf(plate->angular_velocity[2]) > 0.5f)
            fail_msg("%s: %g m/s, %g 1/s", backends[n]->name, (double)speed,
                     (double)plate->angular_velocity[2]);
        solver->interface->destroy(solver);
        weir_test_world_free(&test);
    }
}

// A tap and a drain for a long time: no particle appears from nowhere or vanishes, and slots are used again.
static void taps_never_run_dry(void **state)
{
    (void)state;
    WeirTestWorld test = weir_test_case("tap_2d");
    test.world.emitters[0].start = 0;
    test.world.emitters[0].stop = 100;
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    uint32_t slots = test.world.particles.fluid_slots;
    for (int n = 0; n < 8; ++n) {
        take_steps(solver, 100, INFINITY);
        WeirHealth health = health_of(solver);
        WeirState now = read_state(solver);
        uint32_t fluid = 0, empty = 0;
        for (uint32_t i = 0; i < slots; ++i) {
            fluid += now.group[i] != WEIR_GROUP_EMPTY;
            empty += now.group[i] == WEIR_GROUP_EMPTY;
        }
        assert_int_equal(health.bad_particles, 0);
        assert_int_equal(health.fluid_particles, fluid);
        assert_int_equal(fluid + empty, slots);
        for (uint32_t i = slots; i < now.count; ++i) assert_int_equal(now.group[i], WEIR_GROUP_SOLID);
    }
    const WeirWcsphControl *seen = &((WeirWcsphGpu *)solver)->seen;
    assert_true(seen->emitted > 5 + 3 * 3); // more than there were empty slots: some were used twice
    assert_true(seen->drained > 20);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

// Where emitters act sorts are offered at their chances, more often where parameters that change make faster flow of it.
static void sorts_are_offered_for_layers(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        uint32_t lists, sorts, layers;
    } cases[] = {{"dam_2d", 4, 16, 4},
                 {"periodic_3d", 4, 4, 4},
                 {"taps_2d", 4, 4, 4},
                 {"tap_3d", 4, 4, 4},
                 {"tap_2d", 2, 2, 2}};
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; ++n) {
        WeirTestWorld test = weir_test_case(cases[n].name);
        WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
        const WeirWcsphTraits *traits = &((WeirWcsphGpu *)solver)->traits;
        assert_int_equal(traits->list_interval, cases[n].lists);
        assert_int_equal(traits->sort_interval, cases[n].sorts);
        assert_int_equal(traits->emission_interval, cases[n].layers);
        solver->interface->destroy(solver);
        weir_test_world_free(&test);
    }
    WeirTestWorld test = weir_test_case("taps_2d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    WeirSolver *on_cpu = weir_test_world_solver(&test, weir_cpu_backend());
    const WeirWcsphTraits *traits = &((WeirWcsphGpu *)solver)->traits;
    WeirParameters parameters = ((WeirGpuSolver *)solver)->parameters;
    WeirConstants constants = ((WeirGpuSolver *)solver)->constants;
    static const double steps[] = {0.003, 0.005, 0.003};
    static const uint32_t sorts[] = {4, 2, 2}, layers[] = {4, 2, 4};
    parameters.stepping = WEIR_STEPPING_FIXED;
    for (int n = 0; n < 3; ++n) {
        parameters.time_step = (float)steps[n];
        assert_int_equal(solver->interface->configure(solver, &parameters, &constants), WEIR_OK);
        assert_int_equal(on_cpu->interface->configure(on_cpu, &parameters, &constants), WEIR_OK);
        assert_int_equal(traits->sort_interval, sorts[n]);
        assert_int_equal(traits->emission_interval, layers[n]);
        for (int k = 0; k < 3; ++k) {
            take_steps(solver, 3, INFINITY);
            take_steps(on_cpu, 3, INFINITY);
            assert_int_equal(health_of(solver).fluid_particles, health_of(on_cpu).fluid_particles);
        }
    }
    assert_true(health_of(solver).fluid_particles > 40 * 2 + 40);
    solver->interface->destroy(solver);
    on_cpu->interface->destroy(on_cpu);
    weir_test_world_free(&test);
}

// What may change while it runs takes effect, also where it needs other pipelines.
static void parameters_change_while_it_runs(void **state)
{
    (void)state;
    WeirTestWorld test = weir_test_case("dam_2d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    WeirGpuSolver *common = (WeirGpuSolver *)solver;
    take_steps(solver, 5, INFINITY);
    WeirParameters parameters = common->parameters;
    WeirConstants constants = common->constants;
    parameters.gravity[0] = 500;
    parameters.shifting = 0;
    parameters.density_diffusion = 0;
    parameters.viscosity = 3;
    assert_int_equal(solver->interface->configure(solver, &parameters, &constants), WEIR_OK);
    float before = read_state(solver).acceleration[2 * 30];
    assert_true(before > 300);
    uint64_t memory = weir_gpu_memory(gpu);
    take_steps(solver, 5, INFINITY);
    assert_true(weir_gpu_memory(gpu) == memory);
    constants.cell_count += 1;
    assert_int_equal(solver->interface->configure(solver, &parameters, &constants), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(solver->message.text, "new simulation");
    take_steps(solver, 5, INFINITY);
    assert_int_equal(health_of(solver).steps, 15);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

static void passes_are_timed(void **state)
{
    (void)state;
    static const char *const names[] = {"count", "scan_reduce", "scan_write",   "scatter", "neighbors",
                                        "walls", "forces",      "solid_forces", "solids",  "finish"};
    WeirTestWorld test = weir_test_case("body_3d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    take_steps(solver, 3, INFINITY);
    WeirPassTime times[WEIR_MAX_PASSES];
    uint32_t count = solver->interface->pass_times(solver, times, WEIR_MAX_PASSES);
    if (gpu->timestamps) {
        assert_int_equal(count, sizeof names / sizeof names[0]);
        for (uint32_t n = 0; n < count; ++n) assert_string_equal(times[n].name, names[n]);
    }
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
}

// All memory is given back, and a device that is too small says which buffer and how many particles would fit.
static void memory_is_bounded(void **state)
{
    (void)state;
    assert_true(weir_gpu_memory(gpu) == 0);
    WeirTestWorld test = weir_test_case("dam_3d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    CHECK_AT_MOST((double)weir_gpu_memory(gpu) / test.world.particles.count, 800.0);
    take_steps(solver, 2, INFINITY);
    solver->interface->destroy(solver);
    assert_true(weir_gpu_memory(gpu) == 0);
    uint64_t own = gpu->limits.maxStorageBufferBindingSize;
    gpu->limits.maxStorageBufferBindingSize = 32768;
    WeirSolverSetup setup = {.method = WEIR_METHOD_WCSPH, .world = &test.world};
    setup.constants = (WeirConstants){.particle_count = test.world.particles.count, .dimension = 3};
    setup.constants.first_solid = test.world.particles.fluid_slots;
    setup.constants.cell_count = 1000;
    WeirStatus status = WEIR_OK;
    WeirMessage message = {""};
    assert_null(weir_gpu_backend(gpu)->create_solver(weir_gpu_backend(gpu), &setup, &status, &message));
    gpu->limits.maxStorageBufferBindingSize = own;
    assert_int_equal(status, WEIR_ERROR_MEMORY);
    CHECK_CONTAINS(message.text, "particle_spacing");
    assert_true(weir_gpu_memory(gpu) == 0);
    weir_test_world_free(&test);
}

int main(void)
{
    gpu = weir_test_gpu(NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(probes_get_what_they_look_at),
        cmocka_unit_test(probes_get_it_in_order),
        cmocka_unit_test(equal_runs_give_equal_bits),
        cmocka_unit_test(dispatches_and_checks_change_nothing),
        cmocka_unit_test(buffers_in_parts_change_nothing),
        cmocka_unit_test(lists_keep_to_their_limits),
        cmocka_unit_test(too_few_bindings_are_told),
        cmocka_unit_test(runs_end_in_time),
        cmocka_unit_test(a_blow_up_is_found),
        cmocka_unit_test(the_last_good_state_is_kept),
        cmocka_unit_test(bodies_push_each_other),
        cmocka_unit_test(a_crushed_body_rests),
        cmocka_unit_test(taps_never_run_dry),
        cmocka_unit_test(sorts_are_offered_for_layers),
        cmocka_unit_test(parameters_change_while_it_runs),
        cmocka_unit_test(passes_are_timed),
    };
    int failed = cmocka_run_group_tests_name("wcsph_run", tests, NULL, NULL);
    weir_gpu_destroy(gpu);
    return failed;
}
