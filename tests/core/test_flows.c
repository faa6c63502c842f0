// Fields of flow at the start against their formulas, the functions they are made of, and the speeds to expect.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/exact_math.h"
#include "core/scene.h"

static const double pi = 3.14159265358979323846;

static WeirScene *start(double low, double high, double spacing)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    weir_test_gravity(scene, 0, 0);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){low, low, 0}, (double[]){high, high, 0}),
                WEIR_OK);
    return scene;
}

static void set_flow(WeirScene *scene, const char *flow, double rate)
{
    CHECK_SCENE(scene, weir_scene_set_string(scene, "fluid[0].flow", flow), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "fluid[0].flow_rate", rate), WEIR_OK);
}

static WeirWorld world_of(WeirScene *scene)
{
    WeirWorld world;
    CHECK_SCENE(scene, weir_scene_make_world(scene, &world), WEIR_OK);
    return world;
}

typedef void Field(double x, double y, double velocity[2], double *pressure);

// Velocity, and pressure by the linear equation of state, of every particle; `scale` of the pressure.
static void check_field(WeirScene *scene, Field *field, double scale)
{
    WeirWorld world = world_of(scene);
    WeirParameters parameters = weir_scene_resolved(scene);
    double c2 = (double)parameters.sound_speed * parameters.sound_speed;
    for (uint32_t i = 0; i < world.particles.fluid_slots; ++i) {
        const double *point = &world.particles.position[2 * i];
        double velocity[2], pressure;
        field(point[0], point[1], velocity, &pressure);
        CHECK_NEAR(world.particles.velocity[2 * i], velocity[0], 2e-6 * scale);
        CHECK_NEAR(world.particles.velocity[2 * i + 1], velocity[1], 2e-6 * scale);
        CHECK_NEAR(c2 * (world.particles.density[i] - 1000.0), 1000 * pressure, 1e-7 * 1000 * c2);
    }
    weir_world_free(&world);
}

static void vortices(double x, double y, double velocity[2], double *pressure)
{
    velocity[0] = -2 * cos(2 * pi * x) * sin(2 * pi * y);
    velocity[1] = 2 * sin(2 * pi * x) * cos(2 * pi * y);
    *pressure = -1.0 * (cos(4 * pi * x) + cos(4 * pi * y));
}

static void taylor_green_vortices(void **state)
{
    (void)state;
    WeirScene *scene = start(0, 1, 0.05);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "xy"), WEIR_OK);
    weir_test_box(scene, 0, 0, 1, 1);
    set_flow(scene, "taylor_green", 2);
    check_field(scene, vortices, 2);
    CHECK_NEAR(weir_scene_expected_speed(scene), 2, 1e-9);
    weir_scene_destroy(scene);
}

static void drop(double x, double y, double velocity[2], double *pressure)
{
    velocity[0] = -3 * (x - 0.25) + 0.5;
    velocity[1] = 3 * (y + 0.5);
    *pressure = 0.5 * (9 + 4) * (1 - (x - 0.25) * (x - 0.25) - (y + 0.5) * (y + 0.5));
}

static void stretched_drop(void **state)
{
    (void)state;
    WeirScene *scene = start(-3, 3, 0.1);
    weir_test_set(scene, "central_force", 4);
    weir_test_ball(scene, 0.25, -0.5, 1, 0.5, 0);
    set_flow(scene, "stretch", 3);
    check_field(scene, drop, 3);
    // Its mass is that of the disc, whatever lattice it has: rings hold it to a few particles.
    CHECK_NEAR(weir_scene_particle_count(scene) - (60.0 + 8) * (60 + 8) + 3600, 100 * pi, 3);
    weir_scene_destroy(scene);
}

static void resting_drop(double x, double y, double velocity[2], double *pressure)
{
    velocity[0] = velocity[1] = 0;
    *pressure = 0.5 * 4 * (1 - x * x - y * y);
}

static void a_drop_rests_in_the_central_force(void **state)
{
    (void)state;
    WeirScene *scene = start(-3, 3, 0.1);
    weir_test_set(scene, "central_force", 4);
    weir_test_ball(scene, 0, 0, 1, 0, 0);
    check_field(scene, resting_drop, 1);
    CHECK_NEAR(weir_scene_expected_speed(scene), 2, 1e-9); // Omega R
    weir_scene_destroy(scene);
}

static void square_that_turns(void **state)
{
    (void)state;
    WeirScene *scene = start(-1, 1, 0.01);
    weir_test_box(scene, -0.5, -0.5, 0.5, 0.5);
    set_flow(scene, "rotating_square", 2);
    WeirWorld world = world_of(scene);
    double c2 = pow((double)weir_scene_resolved(scene).sound_speed, 2), center = 0, edge = 0;
    uint32_t at_center = 0, at_edge = 0;
    for (uint32_t i = 0; i < world.particles.fluid_slots; ++i) {
        double x = world.particles.position[2 * i], y = world.particles.position[2 * i + 1];
        double pressure = c2 * (world.particles.density[i] - 1000.0);
        CHECK_NEAR(world.particles.velocity[2 * i], 2 * y, 1e-6);
        CHECK_NEAR(world.particles.velocity[2 * i + 1], -2 * x, 1e-6);
        if (fabs(x) < 0.01 && fabs(y) < 0.01) center += pressure, ++at_center;
        if (x > 0.494 && fabs(y) < 0.3) edge += pressure, ++at_edge;
    }
    // validation.md: -0.1473 rho omega^2 L^2 in the middle, none at the sides.
    assert_int_equal(at_center, 4);
    CHECK_NEAR(center / at_center, -0.1473 * 1000 * 4, 0.005 * 147.3 * 4);
    CHECK_NEAR(edge / at_edge, 0, 15);
    CHECK_NEAR(weir_scene_expected_speed(scene), 2 * sqrt(0.5), 1e-9);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

static void wave(double x, double y, double velocity[2], double *pressure)
{
    double omega = sqrt(9.81 * pi * tanh(pi)), speed = 0.05 * omega / sinh(pi);
    velocity[0] = -speed * cosh(pi * y) * sin(pi * x);
    velocity[1] = speed * sinh(pi * y) * cos(pi * x);
    *pressure = 0; // that of its own weight: test_world
}

static void first_mode_of_a_tank(void **state)
{
    (void)state;
    WeirScene *scene = start(0, 2, 0.05);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_box(scene, 0, 0, 2, 1);
    set_flow(scene, "standing_wave", 0.05);
    CHECK_SCENE(scene, weir_scene_set_boolean(scene, "fluid[0].hydrostatic", false), WEIR_OK);
    check_field(scene, wave, 1);
    weir_scene_destroy(scene);
}

static void functions_are_exact(void **state)
{
    (void)state;
    WeirRandom random = {.state = 5};
    for (int n = 0; n < 2000; ++n) {
        double angle = weir_random_range(&random, -1, 1) * pow(10, weir_random_range(&random, -3, 4)), sine,
               cosine;
        weir_sine_cosine(angle, &sine, &cosine);
        CHECK_NEAR(sine, sin(angle), 1e-11);
        CHECK_NEAR(cosine, cos(angle), 1e-11);
        double x = weir_random_range(&random, -50, 50);
        CHECK_NEAR(weir_exponential(x) / exp(x), 1, 1e-14);
        double y = pow(10, weir_random_range(&random, -3, 3));
        CHECK_NEAR(weir_seventh_root(y) / pow(y, 1.0 / 7), 1, 1e-14);
        double w[3] = {sine, cosine * 0.6, cosine * 0.8}, u[3], v[3];
        weir_basis(w, u, v);
        for (int k = 0; k < 3; ++k)
            CHECK_NEAR(u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3], w[k], 1e-10);
    }
    CHECK_NEAR(weir_seventh_root(-1), 0, 0);
    CHECK_NEAR(weir_exponential(-1000), 0, 0);
}

static void the_speed_of_sound_follows_the_scene(void **state)
{
    (void)state;
    // A channel driven along its periodic axis: sqrt(F L), L its width; no fall.
    WeirScene *scene = start(0, 1, 0.05);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "x"), WEIR_OK);
    weir_test_gravity(scene, 0.25, 0);
    weir_test_box(scene, 0, 0, 1, 1);
    CHECK_NEAR(weir_scene_expected_speed(scene), 0.5, 1e-9);
    // A lid of 2 m/s in treacle: nu V / L = 8, more than V^2 = 4.
    weir_test_set(scene, "viscosity", 4000);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[0].box.min", (double[]){0, 1}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[0].box.max", (double[]){1, 1.2}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "walls[0].surface_velocity", (double[]){2, 0}, 2),
                WEIR_OK);
    CHECK_NEAR(weir_scene_expected_speed(scene), sqrt(8), 1e-9);
    weir_scene_destroy(scene);
    // Water of depth 0.5 m falls: 2 sqrt(g H).
    scene = start(0, 1, 0.05);
    weir_test_gravity(scene, 0, -10);
    weir_test_box(scene, 0, 0, 0.5, 0.5);
    CHECK_NEAR(weir_scene_expected_speed(scene), 2 * sqrt(5), 1e-6);
    // A jet of 8 m/s from 0.8 m.
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "emitters[0].center", (double[]){0.5, 0.8}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "emitters[0].direction", (double[]){0, -1}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "emitters[0].size", 0.1), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "emitters[0].flow_rate", 0.8), WEIR_OK);
    CHECK_NEAR(weir_scene_expected_speed(scene), sqrt(64 + 16), 1e-5);
    weir_scene_destroy(scene);
    // Nothing at all.
    scene = start(0, 1, 0.05);
    weir_test_box(scene, 0, 0, 0.5, 0.5);
    CHECK_NEAR(weir_scene_expected_speed(scene), 1, 0);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(taylor_green_vortices),
        cmocka_unit_test(stretched_drop),
        cmocka_unit_test(a_drop_rests_in_the_central_force),
        cmocka_unit_test(square_that_turns),
        cmocka_unit_test(first_mode_of_a_tank),
        cmocka_unit_test(functions_are_exact),
        cmocka_unit_test(the_speed_of_sound_follows_the_scene),
    };
    return cmocka_run_group_tests_name("flows", tests, NULL, NULL);
}
