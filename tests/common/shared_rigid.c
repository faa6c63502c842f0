// Rigid bodies and driven walls of `wcsph`: what they get from the fluid and from one another, wherever they are.
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/shared.h"

// A heavy ball, or a crate, sinks to the ground: what it squeezes there gets no energy from the two that squeeze it, and stays in
// the tank. (Particles between a body and a wall were thrown from one to the other until they flew apart.)
static void bodies_sink_to_the_ground(const WeirBackend *backend)
{
    for (int n = 0; n < 4; ++n) {
        uint32_t dimension = n < 2 ? 2 : 3;
        double spacing = n < 2 ? 0.0125 : 0.025;
        WeirScene *scene = weir_test_tank(dimension, 0.5, 0.4, spacing);
        weir_test_fill(scene, 0, 0.5, 0.2);
        if (n % 2 == 0) {
            CHECK_SCENE(scene,
                        weir_scene_set_numbers(scene, "bodies[0].ball.center", (double[]){0.26, 0.13, 0.2},
                                               dimension),
                        WEIR_OK);
            CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].ball.radius", 0.1), WEIR_OK);
        } else {
            weir_test_box_of(scene, "bodies[0].box", (double[]){0.15, 0.05, 0.1},
                             (double[]){0.35, 0.15, 0.3});
        }
        CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 5000), WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        double largest = 0;
        for (double time = 0.02; time < 0.31; time += 0.02) {
            CHECK_SIM(sim, weir_sim_run_until(sim, time), WEIR_OK);
            WeirDiagnostics found = weir_test_diagnose(sim, 0);
            assert_int_equal(found.lost_particles, 0);
            largest = fmax(largest, found.max_speed);
        }
        assert_true(largest < 0.5 * weir_sim_clock(sim).sound_speed);
        assert_int_equal(weir_sim_clock(sim).fluid_particles, weir_sim_fluid_slots(sim));
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// y of the last particle, one of the body's, in 2D.
static double last_height(WeirSim *sim)
{
    uint32_t count = weir_sim_particle_count(sim);
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
    double height = (double)position[2 * count - 1];
    free(position);
    return height;
}

// A body that falls a step at a time, each shorter than float32 tells places apart 900 m from the origin, falls as near it: by g t^2 / 2.
// (There bodies stood still until they were fast, then went in jumps, which stirred the fluid until it flew apart.)
static void bodies_fall_alike_far_from_the_origin(const WeirBackend *backend)
{
    for (int far = 0; far < 2; ++far) {
        const double y = far ? -900 : 0;
        WeirScene *scene = weir_test_tank(2, 1, 1, 0.025);
        CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){0, y, 0}, (double[]){1, y + 1, 0}),
                    WEIR_OK);
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, y, 0}, (double[]){1, y + 0.2, 0}, NULL),
                    WEIR_OK);
        weir_test_box_of(scene, "bodies[0].box", (double[]){0.4, y + 0.5, 0}, (double[]){0.6, y + 0.7, 0});
        CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 500), WEIR_OK);
        weir_test_set(scene, "courant", 0.1);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        double fallen = last_height(sim);
        CHECK_SIM(sim, weir_sim_run_until(sim, 0.04), WEIR_OK);
        fallen -= last_height(sim);
        CHECK_NEAR(fallen, 0.5 * 9.81 * 0.04 * 0.04, far ? 1.5e-4 : 1e-5); // places are told in float32
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// A plate and a box as light as foam fall onto water: neither it nor contact throws them. (They came back from the ceiling faster than
// they had hit it, and what a fluid particle weighs was too much for them.)
static void light_bodies_stay_calm(const WeirBackend *backend)
{
    static const struct {
        double support, low[3], high[3], density;
    } light[] = {{0.08, {0.404, 0.4998}, {0.596, 0.5402}, 20}, {0.05, {0.452, 0.472}, {0.548, 0.568}, 1}};
    for (size_t n = 0; n < sizeof light / sizeof *light; ++n) {
        WeirScene *scene = weir_test_tank(2, 1, 0.7, 0.02);
        weir_test_set(scene, "support_radius", light[n].support);
        weir_test_fill(scene, 0, 1, 0.35);
        weir_test_box_of(scene, "bodies[0].box", light[n].low, light[n].high);
        CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", light[n].density), WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        CHECK_SIM(sim, weir_sim_run_until(sim, 0.45), WEIR_OK);
        // No faster than what falls from the ceiling.
        assert_true(weir_test_diagnose(sim, 0).max_speed < sqrt(2 * 9.81 * 0.7));
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// A plate that weighs nothing against the fluid it spins in comes to rest and rises. (It swung to and fro, faster each time, up to 27 m/s:
// the pressure at its surface followed from its own acceleration of the step before.)
static void a_plate_without_weight_comes_to_rest(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 1, 0.7, 0.02);
    weir_test_set(scene, "support_radius", 0.05);
    weir_test_set(scene, "rest_density", 13600);
    weir_test_fill(scene, 0, 1, 0.35);
    weir_test_box_of(scene, "bodies[0].box", (double[]){0.3549, 0.1298, 0}, (double[]){0.6451, 0.1702, 0});
    CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 1), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "bodies[0].velocity", (double[]){-1.1, 1.1}, 2),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].angular_velocity", 14), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    for (double time = 0.05; time < 0.26; time += 0.05) {
        CHECK_SIM(sim, weir_sim_run_until(sim, time), WEIR_OK);
        assert_true(weir_test_diagnose(sim, 0).max_speed < 4);
    }
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Least y of the last body's particles, in 2D.
static double lowest_of_last_body(WeirSim *sim)
{
    uint32_t last = weir_sim_particle_count(sim) - 1;
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *group = weir_test_read(sim, WEIR_FIELD_GROUP);
    double lowest = (double)position[2 * last + 1];
    for (uint32_t i = last; group[i] == group[last]; --i) lowest = fmin(lowest, (double)position[2 * i + 1]);
    free(position);
    free(group);
    return lowest;
}

// A ball or a crate as heavy as gold falls through a puddle: the ground stops it, however many particles it has across. (Contact was as stiff
// as fluid, so they went into the ground, the deeper the finer they were, and crushed what was between.)
static void heavy_bodies_stay_above_the_ground(const WeirBackend *backend)
{
    for (int n = 0; n < 2; ++n) {
        WeirScene *scene = weir_test_tank(2, 0.6, 0.7, 0.02);
        weir_test_set(scene, "support_radius", 0.05);
        weir_test_fill(scene, 0, 0.6, 0.04);
        if (n == 0) {
            CHECK_SCENE(scene,
                        weir_scene_set_numbers(scene, "bodies[0].ball.center", (double[]){0.3, 0.3}, 2),
                        WEIR_OK);
            CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].ball.radius", 0.1), WEIR_OK);
        } else {
            weir_test_box_of(scene, "bodies[0].box", (double[]){0.2, 0.2, 0}, (double[]){0.4, 0.4, 0});
        }
        CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 20000), WEIR_OK);
        CHECK_SCENE(scene, weir_scene_set_numbers(scene, "bodies[0].velocity", (double[]){0, -3}, 2),
                    WEIR_OK);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        double lowest = 1;
        for (double time = 0.01; time < 0.16; time += 0.01) {
            CHECK_SIM(sim, weir_sim_run_until(sim, time), WEIR_OK);
            lowest = fmin(lowest, lowest_of_last_body(sim));
        }
        assert_true(lowest > 0); // within half a spacing
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Adds the momentum of the only solid, of that mass.
static void add_body_momentum(WeirSim *sim, double mass, double momentum[3])
{
    uint32_t dimension = weir_sim_dimension(sim), first = weir_sim_fluid_slots(sim),
             last = weir_sim_particle_count(sim);
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (uint32_t i = first; i < last; ++i) {
        for (uint32_t axis = 0; axis < dimension; ++axis)
            momentum[axis] += mass / (last - first) * velocity[dimension * i + axis];
    }
    free(velocity);
}

// What fluid loses that meets a free body at the speed of sound the body gets, to round-off.
static void a_body_gets_what_the_fluid_loses(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = weir_test_tank(dimension, 1.6, 1.6, 0.05);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", dimension == 3 ? "xyz" : "xy"),
                    WEIR_OK);
        weir_test_set(scene, "sound_speed", 20);
        weir_test_gravity(scene, 0, 0);
        CHECK_SCENE(scene,
                    weir_scene_add_box(scene, (double[]){0.4, 0.5, 0.5}, (double[]){0.7, 0.8, 0.8},
                                       (double[]){19, 5, 3}),
                    WEIR_OK);
        CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 1500), WEIR_OK);
        weir_test_box_of(scene, "bodies[0].box", (double[]){0.75, 0.6, 0.6}, (double[]){0.95, 0.8, 0.8});
        double mass = 1500 * (dimension == 2 ? 0.04 : 0.008);
        WeirSim *sim = weir_test_sim(scene, backend, 0);
        WeirDiagnostics before = weir_test_diagnose(sim, 0);
        weir_test_step(sim, 40);
        WeirDiagnostics after = weir_test_diagnose(sim, 0);
        double body[3] = {0, 0, 0};
        add_body_momentum(sim, mass, body);
        assert_true(body[0] > 0.1 * before.momentum[0]);
        for (uint32_t axis = 0; axis < dimension; ++axis)
            CHECK_NEAR(after.momentum[axis] + body[axis], before.momentum[axis], 1e-5 * before.momentum[0]);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Bodies and driven walls that go round and round a periodic domain, in both directions, keep their shape. (Those that had come 119 supports far,
// or two lengths of a longer domain, lay on the GPU with all their particles on its border, and threw the fluid there apart.)
static void bodies_go_around_a_periodic_domain(const WeirBackend *backend)
{
    static const double speed[2] = {40, -40}, height[2] = {0.6, 0.9};
    WeirScene *scene = weir_test_tank(2, 0.8, 1.4, 0.05);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "x"), WEIR_OK);
    weir_test_gravity(scene, 0, 0);
    weir_test_set(scene, "expected_speed", 2);
    weir_test_fill(scene, 0, 0.8, 0.1);
    for (int n = 0; n < 2; ++n) {
        const char *piece = n ? "bodies[0]" : "walls[0]";
        char path[40];
        snprintf(path, sizeof path, "%s.box", piece);
        weir_test_box_of(scene, path, (double[]){0.3, height[n], 0}, (double[]){0.5, height[n] + 0.1, 0});
        snprintf(path, sizeof path, n ? "%s.velocity" : "%s.motion.velocity", piece);
        CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, (double[]){speed[n], 0}, 2), WEIR_OK);
    }
    CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 1000), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    uint32_t count = weir_sim_particle_count(sim), seen = 0;
    float *start = weir_test_read(sim, WEIR_FIELD_POSITION);
    CHECK_SIM(sim, weir_sim_run_until(sim, 0.7), WEIR_OK);
    float *end = weir_test_read(sim, WEIR_FIELD_POSITION);
    for (uint32_t i = weir_sim_fluid_slots(sim); i < count; ++i) {
        int n = start[2 * i + 1] > 0.8f;
        if (start[2 * i + 1] < 0.6f || start[2 * i + 1] > 1.0f) continue; // the domain's own walls
        double x = (double)start[2 * i] + 0.7 * speed[n];
        CHECK_NEAR(end[2 * i], x - 0.8 * floor(x / 0.8), 1e-4);
        CHECK_NEAR(end[2 * i + 1], start[2 * i + 1], 1e-5);
        ++seen;
    }
    assert_int_equal(seen, 2 * 4 * 2);
    free(start);
    free(end);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// A body that leaves through an open side stays where it is when it is far away, in one piece. (It fell for ever, ever faster.)
static void a_body_that_leaves_comes_to_rest(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_tank(2, 0.4, 0.4, 0.02);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "+x"), WEIR_OK);
    weir_test_fill(scene, 0, 0.1, 0.04);
    weir_test_box_of(scene, "bodies[0].box", (double[]){0.26, 0.2, 0}, (double[]){0.36, 0.3, 0});
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "bodies[0].velocity", (double[]){2, 0}, 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 700), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].angular_velocity", 5), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    uint32_t last = weir_sim_particle_count(sim) - 1;
    float *start = weir_test_read(sim, WEIR_FIELD_POSITION), *end[2];
    for (int n = 0; n < 2; ++n) {
        CHECK_SIM(sim, weir_sim_run_until(sim, 0.3 + 0.1 * n), WEIR_OK);
        end[n] = weir_test_read(sim, WEIR_FIELD_POSITION);
        assert_true(end[n][2 * last] > 0.5f && end[n][2 * last] < 0.7f);
    }
    for (uint32_t k = 2 * (last - 24); k < 2 * last + 2; ++k) CHECK_NEAR(end[1][k], end[0][k], 0);
    CHECK_NEAR(hypotf(end[1][2 * last] - end[1][2 * last - 2], end[1][2 * last + 1] - end[1][2 * last - 1]),
               hypotf(start[2 * last] - start[2 * last - 2], start[2 * last + 1] - start[2 * last - 1]),
               1e-5);
    free(start);
    for (int n = 0; n < 2; ++n) free(end[n]);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(a_body_gets_what_the_fluid_loses),
    WEIR_SHARED_TEST(bodies_sink_to_the_ground),
    WEIR_SHARED_TEST(bodies_fall_alike_far_from_the_origin),
    WEIR_SHARED_TEST(light_bodies_stay_calm),
    WEIR_SHARED_TEST(a_plate_without_weight_comes_to_rest),
    WEIR_SHARED_TEST(heavy_bodies_stay_above_the_ground),
    WEIR_SHARED_TEST(bodies_go_around_a_periodic_domain),
    WEIR_SHARED_TEST(a_body_that_leaves_comes_to_rest),
};
WEIR_SHARED_GROUP(rigid, tests);
