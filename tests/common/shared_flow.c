// `wcsph` as a whole: places far from the origin, periodic axes, the clock, blow-ups and warnings.
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

// A column that collapses at the near end of a tank and its mirror image at the far end, 100 m away, 1 cm apart: the same
// density error and energy, though float32 metres resolve only 8 um there.
static void a_far_column_falls_as_the_near_one(const WeirBackend *backend)
{
    WeirDiagnostics found[2];
    WeirClock clock[2];
    for (int far = 0; far < 2; ++far) {
        WeirScene *scene = weir_test_tank(2, 100, 0.3, 0.01);
        weir_test_fill(scene, far ? 99.9 : 0, far ? 100 : 0.1, 0.15);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        weir_test_step(sim, 100);
        found[far] = weir_test_diagnose(sim, 0);
        CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
        clock[far] = weir_sim_clock(sim);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
    assert_true(found[0].kinetic_energy > 0.1);
    CHECK_NEAR(found[1].kinetic_energy, found[0].kinetic_energy, 1e-3 * found[0].kinetic_energy);
    CHECK_NEAR(clock[1].max_density_error, clock[0].max_density_error, 0.05 * clock[0].max_density_error);
    CHECK_NEAR(found[1].momentum[0], -found[0].momentum[0], 1e-3 * fabs(found[0].momentum[0]));
}

// A periodic box full of fluid that moves as a whole: nothing in it changes, however often it passes the border.
static void periodic_fluid_moves_as_a_whole(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = weir_test_tank(dimension, 1, 1, 0.1);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", dimension == 3 ? "xyz" : "xy"),
                    WEIR_OK);
        weir_test_gravity(scene, 0, 0);
        weir_test_set(scene, "expected_speed", 1);
        const double v[3] = {0.5, -0.7, 0.3};
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1}, v), WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        CHECK_SIM(sim, weir_sim_run_until(sim, 1.5), WEIR_OK);
        CHECK_NEAR(weir_sim_time(sim), 1.5, 1e-9);
        float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY),
              *position = weir_test_read(sim, WEIR_FIELD_POSITION);
        for (uint32_t i = 0; i < weir_sim_particle_count(sim); ++i) {
            for (uint32_t axis = 0; axis < dimension; ++axis)
                CHECK_NEAR(velocity[dimension * i + axis], v[axis], 2e-5);
        }
        double x = 0.05 + 0.75 - floor(0.05 + 0.75); // the first particle
        CHECK_NEAR(position[0], x, 1e-3);
        free(velocity);
        free(position);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

static void run_until_ends_exactly(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 0.4, 0.4, 0.02);
    weir_test_fill(scene, 0, 0.2, 0.2);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    for (int n = 1; n <= 5; ++n) {
        double time = 0.0123 * n;
        CHECK_SIM(sim, weir_sim_run_until(sim, time), WEIR_OK);
        CHECK_NEAR(weir_sim_time(sim), time, 1e-8);
    }
    uint64_t steps = weir_sim_step_count(sim);
    CHECK_SIM(sim, weir_sim_run_until(sim, 0.05), WEIR_OK); // in the past: nothing happens
    assert_true(weir_sim_step_count(sim) == steps);
    // Steps follow c0 = 20 sqrt(g H), h = 2 spacings, Courant number 0.6 and stay near c0 alone.
    WeirClock clock = weir_sim_clock(sim);
    CHECK_NEAR(clock.time_step, 0.6 * 0.04 / (20 * sqrt(9.81 * 0.2)), 0.15 * clock.time_step);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// The next step's length is known one step ahead (docs/wcsph.md, "Time step"): what a step finds counts for the next but one.
// Fluid that begins to fall, as fast as sound after one step.
static void a_step_is_chosen_one_step_ahead(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 1, 1, 0.1);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "xy"), WEIR_OK);
    weir_test_gravity(scene, 0, 0);
    weir_test_set(scene, "expected_speed", 1);
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1}, NULL), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    weir_test_step(sim, 3);
    double h = 0.2, pull = 1000, before = 0.6 * h / 10, after = 0.6 * h / (10 + pull * before);
    CHECK_NEAR(weir_sim_clock(sim).time_step, before, 1e-3 * before);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "gravity", (double[]){0, -pull, 0}, 3), WEIR_OK);
    weir_test_step(sim, 1);
    CHECK_NEAR(weir_sim_clock(sim).time_step, before, 1e-3 * before);
    weir_test_step(sim, 1);
    CHECK_NEAR(weir_sim_clock(sim).time_step, after, 1e-3 * after);
    assert_true(after < 0.8 * before);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Five times the stable step: found within 100 steps, with step, particle and place; the last good state stays readable.
static void a_blow_up_is_found_and_the_last_good_state_kept(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 0.4, 0.4, 0.02);
    weir_test_fill(scene, 0, 0.2, 0.2);
    double stable = weir_scene_stable_time_step(scene);
    weir_test_choose(scene, "stepping", "fixed");
    weir_test_set(scene, "time_step", 5 * stable);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    WeirStatus status = weir_sim_step(sim, 100);
    if (status == WEIR_OK) status = weir_sim_wait(sim);
    assert_int_equal(status, WEIR_ERROR_UNSTABLE);
    CHECK_CONTAINS(weir_sim_error(sim), "step ");
    CHECK_CONTAINS(weir_sim_error(sim), "particle ");
    CHECK_CONTAINS(weir_sim_error(sim), "near (");
    CHECK_CONTAINS(weir_sim_error(sim), "stepping adaptive");
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    WeirDiagnostics last = weir_test_diagnose(sim, 0), same = weir_test_diagnose(sim, WEIR_DIAGNOSE_HASH);
    assert_memory_equal(&last, &same, offsetof(WeirDiagnostics, lost_particles));
    assert_true(isfinite(last.kinetic_energy));
    // It may be one in the middle of a step, half of which the fastest good particle has gone from the walls' seal.
    double limit = 4 * weir_sim_clock(sim).sound_speed, reach = 0.02 + limit * 2.5 * stable;
    for (uint32_t k = 0; k < 2 * weir_sim_fluid_slots(sim); ++k) {
        assert_true(isfinite(velocity[k]) && fabsf(velocity[k]) <= limit);
        assert_true(position[k] > -reach && position[k] < 0.4 + reach);
    }
    free(position);
    free(velocity);
    CHECK_SIM(sim, weir_sim_reset(sim), WEIR_OK);
    double one = 0.2 * stable;
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "time_step", &one, 1), WEIR_OK);
    weir_test_step(sim, 20);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void a_slow_speed_of_sound_is_told(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 0.4, 0.4, 0.02);
    weir_test_fill(scene, 0, 0.2, 0.2);
    weir_test_set(scene, "expected_speed", 1); // it will be 2 m/s
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    assert_string_equal(weir_sim_warning(sim), "");
    CHECK_SIM(sim, weir_sim_run_until(sim, 0.15), WEIR_OK);
    CHECK_CONTAINS(weir_sim_warning(sim), "step ");
    CHECK_CONTAINS(weir_sim_warning(sim), "Mach number");
    CHECK_CONTAINS(weir_sim_warning(sim), "expected_speed");
    CHECK_SIM(sim, weir_sim_reset(sim), WEIR_OK);
    assert_string_equal(weir_sim_warning(sim), "");
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Fluid that falls, splashes and settles in a closed tank: none is lost, and the walls hold it, in 2D and 3D.
static void walls_hold_a_splash(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = weir_test_tank(dimension, 0.4, 0.4, dimension == 3 ? 0.04 : 0.02);
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0.16, 0}, (double[]){0.2, 0.4, 0.4}, NULL),
                    WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        uint32_t slots = weir_sim_fluid_slots(sim);
        for (int n = 1; n <= 4; ++n) {
            CHECK_SIM(sim, weir_sim_run_until(sim, 0.1 * n), WEIR_OK);
            assert_int_equal(weir_sim_clock(sim).fluid_particles, slots);
            assert_int_equal(weir_sim_clock(sim).lost_particles, 0);
            float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
            for (uint32_t k = 0; k < dimension * slots; ++k)
                assert_true(position[k] > -0.02f && position[k] < 0.42f);
            free(position);
        }
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Force on all particles but by gravity over a particle's mass, per axis, and the sum of what acts on the walls'.
static double forces_of(WeirSim *sim, const double gravity[3], double sum[3])
{
    uint32_t dimension = weir_sim_dimension(sim), slots = weir_sim_fluid_slots(sim),
             count = weir_sim_particle_count(sim);
    double on_walls = 0;
    float *acceleration = weir_test_read(sim, WEIR_FIELD_ACCELERATION);
    for (uint32_t i = 0; i < count; ++i)
        for (uint32_t axis = 0; axis < dimension; ++axis) {
            double a = acceleration[dimension * i + axis];
            sum[axis] += i < slots ? a - gravity[axis] : a;
            on_walls += i < slots ? 0 : fabs(a);
        }
    free(acceleration);
    return on_walls;
}

// Walls feel what they do to the fluid, whoever of both finds the pressure between them (docs/wcsph.md, "Walls").
static void action_at_walls_is_reaction(const WeirBackend *backend)
{
    static const double gravity[3] = {2, -9.81, 1};
    for (uint32_t n = 0; n < 4; ++n) {
        uint32_t dimension = 2 + n % 2;
        WeirScene *scene = weir_test_tank(dimension, 0.4, 0.4, dimension == 3 ? 0.04 : 0.02);
        CHECK_SCENE(scene,
                    weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){0.2, 0.3, 0.4},
                                       (double[]){-1, -0.5, 0.3}),
                    WEIR_OK);
        weir_test_set(scene, "viscosity", 1);
        weir_test_choose(scene, "equation_of_state", n < 2 ? "linear" : "tait");
        double given[3] = {gravity[0], gravity[1], dimension == 3 ? gravity[2] : 0}, sum[3] = {0, 0, 0};
        CHECK_SCENE(scene, weir_scene_set_numbers(scene, "parameters.gravity", given, dimension), WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        weir_test_step(sim, 60);
        double on_walls = forces_of(sim, given, sum);
        assert_true(on_walls > 100);
        for (uint32_t axis = 0; axis < dimension; ++axis) CHECK_NEAR(sum[axis], 0, 2e-5 * on_walls);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// A block thrown into a corner at half the speed of sound, in 2D and 3D: nothing leaks, nothing blows up.
static void walls_hold_fast_fluid(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = weir_test_tank(dimension, 0.5, 0.5, dimension == 3 ? 0.04 : 0.02);
        const double v[3] = {-4, -4, dimension == 3 ? -2 : 0};
        CHECK_SCENE(scene,
                    weir_scene_add_box(scene, (double[]){0.1, 0.1, 0.1}, (double[]){0.34, 0.34, 0.34}, v),
                    WEIR_OK);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "parameters.stepping", "adaptive"), WEIR_OK);
        weir_test_gravity(scene, 0, 0);
        weir_test_set(scene, "sound_speed", 12);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        CHECK_SIM(sim, weir_sim_run_until(sim, 0.25), WEIR_OK);
        assert_int_equal(weir_sim_clock(sim).fluid_particles, weir_sim_fluid_slots(sim));
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
        for (uint32_t k = 0; k < dimension * weir_sim_fluid_slots(sim); ++k)
            assert_true(position[k] > -0.04f && position[k] < 0.54f);
        free(position);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Shifting goes by the fluid's largest speed, but one particle that flies at half the speed of sound, far off, must not shake a block
// at rest: it did, until whole dam breaks flew apart.
static void a_flyer_shakes_nothing_else(const WeirBackend *backend)
{
    double energy[2];
    for (int fast = 0; fast < 2; ++fast) {
        WeirScene *scene = weir_test_tank(2, 3, 1, 0.02);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "+x"), WEIR_OK);
        weir_test_gravity(scene, 0, 0);
        weir_test_set(scene, "expected_speed", 1);
        weir_test_fill(scene, 0.1, 0.6, 0.5);
        const double v[3] = {fast ? 5 : 1, 0, 0};
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){1.5, 0.5, 0}, (double[]){1.52, 0.52, 0}, v),
                    WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        CHECK_SIM(sim, weir_sim_run_until(sim, 0.25), WEIR_OK);
        WeirDiagnostics found = weir_test_diagnose(sim, 0);
        double mass = 1000 * 0.02 * 0.02;
        energy[fast] = found.kinetic_energy - 0.5 * mass * v[0] * v[0];
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
    assert_true(energy[0] >= 0);
    assert_true(energy[1] < 1.5 * energy[0] + 1e-6);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Distance to the nearest neighbour that all but one in a hundred particles keep.
static double least_distance(WeirSim *sim)
{
    uint32_t count = weir_sim_particle_count(sim), dimension = weir_sim_dimension(sim);
    float *x = weir_test_read(sim, WEIR_FIELD_POSITION);
    double *nearest = malloc(count * sizeof *nearest);
    assert_non_null(nearest);
    for (uint32_t i = 0; i < count; ++i) {
        nearest[i] = INFINITY;
        for (uint32_t j = 0; j < count; ++j) {
            double r2 = 0.0;
            for (uint32_t axis = 0; axis < dimension; ++axis)
                r2 += pow((double)x[dimension * i + axis] - (double)x[dimension * j + axis], 2.0);
            if (j != i && r2 < nearest[i]) nearest[i] = r2;
        }
    }
    qsort(nearest, count, sizeof *nearest, by_value);
    double result = sqrt(nearest[count / 100]);
    free(nearest);
    free(x);
    return result;
}

// Shifting keeps particles apart at small supports and large steps too, where it could overshoot.
static void shifting_makes_no_pairs(const WeirBackend *backend)
{
    static const double supports[2] = {2.5, 2.1}, turn = 6.283185307179586;
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        double spacing = dimension == 3 ? 0.1 : 0.04;
        WeirScene *scene = weir_test_tank(dimension, 1, 1, spacing);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", dimension == 3 ? "xyz" : "xy"),
                    WEIR_OK);
        weir_test_gravity(scene, 0, 0);
        weir_test_set(scene, "expected_speed", 1);
        weir_test_set(scene, "support_radius", supports[dimension - 2] * spacing);
        weir_test_set(scene, "courant", 0.68);
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1}, NULL),
                    WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
              *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
        for (uint32_t i = 0; i < weir_sim_particle_count(sim); ++i) {
            double x = turn * position[dimension * i], y = turn * position[dimension * i + 1];
            velocity[dimension * i] = (float)(sin(x) * cos(y));
            velocity[dimension * i + 1] = (float)(-cos(x) * sin(y));
        }
        weir_test_set_state(sim, position, velocity);
        weir_test_step(sim, 250);
        CHECK_AT_MOST(0.6 * spacing, least_distance(sim));
        free(position);
        free(velocity);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// A full periodic box, c0 = 10 m/s, as large steps as are allowed.
static WeirScene *sound_box(uint32_t dimension, const char *kernel)
{
    WeirScene *scene = weir_test_tank(dimension, 1, 1, dimension == 3 ? 0.1 : 0.04);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", dimension == 3 ? "xyz" : "xy"),
                WEIR_OK);
    weir_test_gravity(scene, 0, 0);
    weir_test_choose(scene, "kernel", kernel);
    weir_test_set(scene, "support_radius", dimension == 3 ? 0.3 : 0.16);
    weir_test_set(scene, "sound_speed", 10);
    weir_test_set(scene, "courant", 0.68);
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1}, NULL), WEIR_OK);
    return scene;
}

// Kinetic and elastic, per mass, m^2/s^2.
static double sound_energy(WeirSim *sim)
{
    uint32_t dimension = weir_sim_dimension(sim), count = weir_sim_particle_count(sim);
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY),
          *density = weir_test_read(sim, WEIR_FIELD_DENSITY);
    double sum = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        double squeezed = 10.0 * (density[i] / 1000.0 - 1.0);
        sum += squeezed * squeezed;
        for (uint32_t axis = 0; axis < dimension; ++axis) {
            double v = velocity[dimension * i + axis];
            sum += v * v;
        }
    }
    free(velocity);
    free(density);
    return 0.5 * sum / count;
}

// Without diffusion and viscosity a standing wave loses no more than what the compact Laplacian takes from a wave of 25
// spacings in five periods (10 spacings in one, in 3D), a quarter or so, and gains nothing: the rate of the density belongs
// to the velocities after the kick. With the old ones it would grow 30-fold.
static void a_standing_sound_wave_keeps_its_energy(const WeirBackend *backend)
{
    static const char *const kernels[] = {"wendland", "cubic", "quintic"};
    for (int n = 0; n < 6; ++n) {
        uint32_t dimension = n < 3 ? 2 : 3;
        WeirScene *scene = sound_box(dimension, kernels[n % 3]);
        weir_test_set(scene, "artificial_viscosity", 0);
        weir_test_set(scene, "density_diffusion", 0);
        weir_test_set(scene, "shifting", 0);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
              *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
        for (uint32_t i = 0; i < weir_sim_particle_count(sim); ++i)
            velocity[dimension * i] = (float)(0.01 * sin(6.283185307179586 * position[dimension * i]));
        weir_test_set_state(sim, position, velocity);
        double start = sound_energy(sim);
        CHECK_SIM(sim, weir_sim_run_until(sim, dimension == 3 ? 0.1 : 0.5), WEIR_OK);
        CHECK_AT_MOST(sound_energy(sim), 1.001 * start);
        CHECK_AT_MOST(0.55 * start, sound_energy(sim));
        free(position);
        free(velocity);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// No wave of any length grows at the largest Courant number, whatever the kernel: noise only fades.
static void noise_fades(const WeirBackend *backend)
{
    static const char *const kernels[] = {"wendland", "cubic", "quintic"};
    for (int n = 0; n < 6; ++n) {
        uint32_t dimension = n < 3 ? 2 : 3, random = 1;
        WeirScene *scene = sound_box(dimension, kernels[n % 3]);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
              *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
        for (uint32_t k = 0; k < dimension * weir_sim_particle_count(sim); ++k) {
            random = random * 1664525 + 1013904223;
            velocity[k] = 0.1f * ((float)(random >> 8) / 8388608.0f - 1.0f);
        }
        weir_test_set_state(sim, position, velocity);
        double start = sound_energy(sim);
        weir_test_step(sim, 200);
        double middle = sound_energy(sim);
        weir_test_step(sim, 200);
        CHECK_AT_MOST(middle, start);
        CHECK_AT_MOST(sound_energy(sim), middle);
        free(position);
        free(velocity);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Sites of a lattice of `side` sites along each axis for `count` particles, drawn at random.
static void scatter_on_lattice(uint32_t dimension, uint32_t side, uint32_t count, float *position)
{
    uint32_t sites = dimension == 3 ? side * side * side : side * side, random = 1, done = 0;
    for (uint32_t site = 0; site < sites && done < count; ++site) {
        random = random * 1664525 + 1013904223;
        if ((double)random / 4294967296.0 * (sites - site) >= count - done) continue;
        const uint32_t at[3] = {site % side, site / side % side, site / side / side};
        for (uint32_t axis = 0; axis < dimension; ++axis)
            position[dimension * done + axis] = ((float)at[axis] + 0.5f) / (float)side;
        ++done;
    }
}

// Fluid full of holes, in which nobody's support is full, with noise of 0.2 c0: it only loses energy. With the rate of full
// fluid everywhere (docs/wcsph.md, "Continuity") it would gain 7- to 20-fold, and did blow up a splash of 1 M particles.
static void ragged_fluid_loses_energy(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        uint32_t side = dimension == 3 ? 12 : 30, random = 1;
        WeirScene *scene = weir_test_tank(dimension, 1, 1, 1.0 / side);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", dimension == 3 ? "xyz" : "xy"),
                    WEIR_OK);
        weir_test_gravity(scene, 0, 0);
        weir_test_set(scene, "support_radius", (dimension == 3 ? 2.1 : 2.5) / side);
        weir_test_set(scene, "sound_speed", 10);
        weir_test_set(scene, "courant", 0.68);
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1.0 / 3.0, 1, 1}, NULL),
                    WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
              *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
        uint32_t count = weir_sim_particle_count(sim);
        scatter_on_lattice(dimension, side, count, position);
        for (uint32_t k = 0; k < dimension * count; ++k) {
            random = random * 1664525 + 1013904223;
            velocity[k] = 2.0f * ((float)(random >> 8) / 8388608.0f - 1.0f);
        }
        weir_test_set_state(sim, position, velocity);
        double start = sound_energy(sim), before = start;
        for (int n = 0; n < 4; ++n) {
            weir_test_step(sim, dimension == 3 ? 50 : 100);
            double now = sound_energy(sim);
            CHECK_AT_MOST(now, before);
            before = now;
        }
        CHECK_AT_MOST(before, 0.1 * start);
        free(position);
        free(velocity);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Three times the particles that the density allows: they push each other apart. When the density took no notice, it blew up
// within 9 steps.
static void crowded_fluid_spreads(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        uint32_t side = dimension == 3 ? 14 : 40;
        WeirScene *scene = weir_test_tank(dimension, 1, 1, 1.0 / side);
        weir_test_gravity(scene, 0, 0);
        weir_test_set(scene, "support_radius", (dimension == 3 ? 2.1 : 2.5) / side);
        weir_test_set(scene, "sound_speed", 10);
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 1, 1}, NULL),
                    WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
              *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
        uint32_t floats = dimension * weir_sim_fluid_slots(sim);
        float shrink = (float)pow(3.0, -1.0 / dimension);
        for (uint32_t k = 0; k < floats; ++k) position[k] *= shrink;
        weir_test_set_state(sim, position, velocity);
        double crowded = weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).mean_neighbors;
        weir_test_step(sim, 300);
        CHECK_AT_MOST(weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).mean_neighbors, 0.7 * crowded);
        free(position);
        free(velocity);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Whoever paces frames divides their time by the steps that they took: these are told when they are queued, though a
// device's clock comes to know of them later. The simulated time follows the wall's.
static void advance_tells_the_steps_that_it_queues(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 1, 0.5, 0.02);
    weir_test_fill(scene, 0, 0.3, 0.3);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    weir_test_step(sim, 1);
    CHECK_SIM(sim, weir_sim_wait(sim), WEIR_OK);
    double start = weir_sim_time(sim), frame = 5.5 * weir_sim_clock(sim).time_step;
    uint64_t before = weir_sim_step_count(sim), total = 0;
    for (int n = 0; n < 20; ++n) {
        uint32_t taken = 0;
        CHECK_SIM(sim, weir_sim_advance(sim, frame, &taken), WEIR_OK);
        assert_in_range(taken, 3, 12);
        total += taken;
    }
    CHECK_SIM(sim, weir_sim_wait(sim), WEIR_OK);
    assert_int_equal(weir_sim_step_count(sim) - before, total);
    CHECK_NEAR(weir_sim_time(sim) - start, 20 * frame, 0.1 * 20 * frame);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Walls of particles give way a little: what stands in one, as single particles do in stirred fluid, can be read, so it can be
// set too. Deeper than half a spacing no fluid comes.
static void fluid_in_a_wall_is_a_state(const WeirBackend *backend)
{
    const float spacing = 0.02f;
    WeirScene *scene = weir_test_tank(2, 1, 0.5, spacing);
    weir_test_fill(scene, 0, 0.3, 0.3);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    position[0] = -0.4f * spacing;
    weir_test_set_state(sim, position, velocity);
    weir_test_step(sim, 2);
    float *later = weir_test_read(sim, WEIR_FIELD_POSITION);
    assert_true(later[0] > position[0] && later[0] < 0.1f * spacing); // pushed back
    weir_test_set_state(sim, later, velocity);
    position[0] = -0.6f * spacing;
    CHECK_SIM(sim, weir_sim_set_state(sim, position, velocity), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_sim_error(sim),
                   "positions: particle 0 has x = -0.012; the domain allows -0.01 to 1.01");
    free(position);
    free(velocity);
    free(later);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(a_far_column_falls_as_the_near_one),
    WEIR_SHARED_TEST(periodic_fluid_moves_as_a_whole),
    WEIR_SHARED_TEST(run_until_ends_exactly),
    WEIR_SHARED_TEST(a_step_is_chosen_one_step_ahead),
    WEIR_SHARED_TEST(a_blow_up_is_found_and_the_last_good_state_kept),
    WEIR_SHARED_TEST(a_slow_speed_of_sound_is_told),
    WEIR_SHARED_TEST(walls_hold_a_splash),
    WEIR_SHARED_TEST(action_at_walls_is_reaction),
    WEIR_SHARED_TEST(walls_hold_fast_fluid),
    WEIR_SHARED_TEST(a_flyer_shakes_nothing_else),
    WEIR_SHARED_TEST(shifting_makes_no_pairs),
    WEIR_SHARED_TEST(a_standing_sound_wave_keeps_its_energy),
    WEIR_SHARED_TEST(noise_fades),
    WEIR_SHARED_TEST(ragged_fluid_loses_energy),
    WEIR_SHARED_TEST(crowded_fluid_spreads),
    WEIR_SHARED_TEST(advance_tells_the_steps_that_it_queues),
    WEIR_SHARED_TEST(fluid_in_a_wall_is_a_state),
};
WEIR_SHARED_GROUP(flow, tests);
