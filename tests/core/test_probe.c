// Probes against states whose values are known: a linear pressure field, a level surface, a moved front.
#include "common/build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "core/probe.h"
#include "weir/weir_probe.h"

// A block of fluid at rest on its lattice, with fields that a test sets.
typedef struct Made {
    WeirScene *scene;
    WeirWorld world;
    WeirParameters parameters;
    WeirConstants constants;
    WeirState state;
    float *position, *pressure;
} Made;

static const double spacing = 0.02;

static WeirScene *block_scene(uint32_t dimension, bool periodic)
{
    WeirScene *scene = weir_scene_create();
    assert_non_null(scene);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "parameters.particle_spacing", spacing), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){1, 1, 0.4}), WEIR_OK);
    if (periodic) CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "xy"), WEIR_OK);
    double height = periodic ? 1.0 : 0.5;
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, height, 0.4}, NULL),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_boolean(scene, "fluid[0].hydrostatic", false),
                WEIR_OK); // a bare lattice
    return scene;
}

static void make(Made *made, uint32_t dimension, bool periodic)
{
    *made = (Made){.scene = block_scene(dimension, periodic)};
    CHECK_SCENE(made->scene, weir_scene_make_world(made->scene, &made->world), WEIR_OK);
    const WeirParticles *particles = &made->world.particles;
    made->parameters = weir_scene_resolved(made->scene);
    weir_constants_make(&made->constants, made->scene, &made->parameters, particles->count, NULL);
    size_t floats = (size_t)particles->count * dimension;
    made->position = malloc(floats * sizeof(float));
    made->pressure = calloc(particles->count, sizeof(float));
    assert_non_null(made->position);
    assert_non_null(made->pressure);
    for (size_t k = 0; k < floats; ++k) made->position[k] = (float)particles->position[k];
    // At rest density, so that the lattice fills space exactly.
    for (uint32_t i = 0; i < particles->count; ++i) particles->density[i] = 1000.0f;
    made->state = (WeirState){.count = particles->count,
                              .dimension = dimension,
                              .position = made->position,
                              .velocity = particles->velocity,
                              .density = particles->density,
                              .pressure = made->pressure,
                              .group = particles->group};
}

static void unmake(Made *made)
{
    free(made->position);
    free(made->pressure);
    weir_world_free(&made->world);
    weir_scene_destroy(made->scene);
}

static double measure(const Made *made, WeirProbePiece probe, double values[3])
{
    weir_probe_measure(&probe, 0, &made->state, &made->parameters, &made->constants, values);
    return values[0];
}

static void test_linear_pressure_is_read_exactly(void **state)
{
    (void)state;
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        Made made;
        double values[3];
        make(&made, dimension, false);
        for (uint32_t i = 0; i < made.state.count; ++i) {
            const float *x = &made.position[dimension * i];
            made.pressure[i] = (float)(3000.0 - 500.0 * (double)x[0] - 4000.0 * (double)x[1]);
            made.world.particles.velocity[dimension * i] = x[1];
        }
        // On a site and half-way between four: by symmetry the interpolated value is exact.
        for (int k = 0; k < 2; ++k) {
            double x = 0.25 + 0.5 * spacing * (1 - k), y = 0.25 + 0.5 * spacing * (1 - k);
            x = floor(x / spacing) * spacing + 0.5 * spacing * k;
            y = floor(y / spacing) * spacing + 0.5 * spacing * k;
            WeirProbePiece probe = {.kind = WEIR_PROBE_PRESSURE, .position = {x, y, 0.2}};
            CHECK_NEAR(measure(&made, probe, values), 3000.0 - 500.0 * x - 4000.0 * y, 0.01);
            probe.kind = WEIR_PROBE_VELOCITY;
            CHECK_NEAR(measure(&made, probe, values), y, 1e-6);
            CHECK_NEAR(values[1], 0.0, 1e-12);
        }
        WeirProbePiece outside = {.kind = WEIR_PROBE_PRESSURE, .position = {0.5, 0.9, 0.2}};
        CHECK_NEAR(measure(&made, outside, values), 0.0, 0.0);
        unmake(&made);
    }
}

static void test_height_of_a_level_surface(void **state)
{
    (void)state;
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        Made made;
        double values[3];
        make(&made, dimension, false);
        WeirProbePiece probe = {.kind = WEIR_PROBE_HEIGHT, .position = {0.5, 0.1, 0.2}};
        CHECK_NEAR(measure(&made, probe, values), 0.5, 0.02 * spacing);
        // A drop above the surface does not count, and neither does what lies aside.
        made.position[1] = 0.8f;
        made.position[0] = 0.5f;
        CHECK_NEAR(measure(&made, probe, values), 0.5, 0.02 * spacing);
        // Sideways gravity: height is along -g.
        made.parameters.gravity[0] = -5.0f;
        made.parameters.gravity[1] = 0.0f;
        probe.position[1] = 0.25;
        CHECK_NEAR(measure(&made, probe, values), 1.0, 0.02 * spacing);
        probe.position[1] = 0.9;
        assert_true(isnan(measure(&made, probe, values)));
        unmake(&made);
    }
}

static void test_front_and_mass(void **state)
{
    (void)state;
    Made made;
    double values[3];
    make(&made, 2, false);
    WeirProbePiece front = {.kind = WEIR_PROBE_FRONT, .direction = {0, 2, 0}};
    CHECK_NEAR(measure(&made, front, values), 0.5, 1e-6);
    made.position[1] = 0.7f;
    CHECK_NEAR(measure(&made, front, values), 0.7 + 0.5 * spacing, 1e-6);
    front.direction[0] = -1.0;
    front.direction[1] = 0.0;
    CHECK_NEAR(measure(&made, front, values), 0.0, 1e-6);
    WeirProbePiece mass = {.kind = WEIR_PROBE_MASS, .min = {0.1, 0.1}, .max = {0.3, 0.4}};
    CHECK_NEAR(measure(&made, mass, values), 1000.0 * 0.2 * 0.3, 1e-3);
    unmake(&made);
}

static void test_sides_that_are_periodic_have_neighbours(void **state)
{
    (void)state;
    Made made;
    double values[3];
    make(&made, 2, true);
    for (uint32_t i = 0; i < made.state.count; ++i) {
        double x = made.position[2 * i];
        made.pressure[i] = (float)cos(2.0 * 3.14159265358979 * x);
    }
    WeirProbePiece probe = {.kind = WEIR_PROBE_PRESSURE, .position = {0.0, 0.0}};
    double corner = measure(&made, probe, values);
    probe.position[0] = 0.5;
    probe.position[1] = 0.5;
    CHECK_NEAR(corner, -measure(&made, probe, values), 1e-5);
    CHECK_NEAR(corner, 1.0, 0.02);
    unmake(&made);
}

static void test_walls_and_empty_slots_do_not_count(void **state)
{
    (void)state;
    Made made;
    double values[3];
    make(&made, 2, false);
    for (uint32_t i = 0; i < made.state.count; ++i) made.pressure[i] = 7.0f;
    WeirProbePiece below = {.kind = WEIR_PROBE_MASS, .min = {-1, -1}, .max = {2, 2}};
    CHECK_NEAR(measure(&made, below, values), 500.0, 1e-3);
    for (uint32_t i = 0; i < made.state.count; ++i) made.world.particles.group[i] = WEIR_GROUP_EMPTY;
    CHECK_NEAR(measure(&made, below, values), 0.0, 0.0);
    made.world.particles.group[0] = WEIR_GROUP_INLET + 2;
    CHECK_NEAR(measure(&made, below, values), 0.4, 1e-6);
    WeirProbePiece pressure = {.kind = WEIR_PROBE_PRESSURE, .position = {made.position[0], made.position[1]}};
    CHECK_NEAR(measure(&made, pressure, values), 7.0, 1e-6);
    unmake(&made);
}

static void add_probe(WeirScene *scene, const char *index, const char *kind, double rate)
{
    char path[64];
    snprintf(path, sizeof path, "probes[%s].kind", index);
    CHECK_SCENE(scene, weir_scene_set_string(scene, path, kind), WEIR_OK);
    snprintf(path, sizeof path, "probes[%s].position", index);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, (double[]){0.5, 0.1}, 2), WEIR_OK);
    snprintf(path, sizeof path, "probes[%s].rate", index);
    CHECK_SCENE(scene, weir_scene_set_number(scene, path, rate), WEIR_OK);
}

static void test_sampler_keeps_each_probes_rate(void **state)
{
    (void)state;
    WeirScene *scene = block_scene(2, false);
    add_probe(scene, "0", "height", 100);
    add_probe(scene, "1", "velocity", 250);
    WeirSim *sim = weir_test_sim(scene, NULL, 1);
    WeirProbes *probes = weir_probes_create(sim);
    assert_non_null(probes);
    assert_int_equal(weir_probes_count(probes), 2);
    CHECK_SIM(sim, weir_probes_run_until(probes, sim, 0.02), WEIR_OK);
    CHECK_NEAR(weir_sim_time(sim), 0.02, 1e-9);
    WeirProbeSeries height = weir_probe_series(probes, 0), velocity = weir_probe_series(probes, 1);
    assert_int_equal(height.count, 3);
    assert_int_equal(velocity.count, 6);
    for (uint32_t k = 0; k < height.count; ++k) {
        CHECK_NEAR(height.time[k], k / 100.0, 1e-9);
        CHECK_NEAR(height.values[k], 0.5, spacing);
    }
    for (uint32_t k = 0; k < velocity.count; ++k) CHECK_NEAR(velocity.time[k], k / 250.0, 1e-9);
    WeirProbeInfo info = weir_probe_info(probes, 1);
    assert_string_equal(info.name, "probe 2");
    assert_string_equal(info.kind, "velocity");
    assert_int_equal(info.components, 2);
    weir_probes_clear(probes);
    assert_int_equal(weir_probe_series(probes, 0).count, 0);
    weir_probes_destroy(probes);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_linear_pressure_is_read_exactly),
        cmocka_unit_test(test_height_of_a_level_surface),
        cmocka_unit_test(test_front_and_mass),
        cmocka_unit_test(test_sides_that_are_periodic_have_neighbours),
        cmocka_unit_test(test_walls_and_empty_slots_do_not_count),
        cmocka_unit_test(test_sampler_keeps_each_probes_rate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
