// Random bodies that fall into water, with a paddle or a rotor that stirs it: whatever they squeeze against the ground, the
// walls and one another, nothing blows up and no particle is lost.
#include <stdio.h>

#include "common/build.h"

enum { BODIES = 3 };
#ifdef NDEBUG
enum { SCENES = 6 };
static const double end = 0.8;
#else
enum { SCENES = 1 }; // sanitizers are twenty times slower, and look for other faults
static const double end = 0.25;
#endif

static void set(WeirScene *scene, const char *path, const double *values, uint32_t count)
{
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, values, count), WEIR_OK);
}

static void set_one(WeirScene *scene, const char *path, double value)
{
    CHECK_SCENE(scene, weir_scene_set_number(scene, path, value), WEIR_OK);
}

// Above the water, side by side.
static void add_body(WeirScene *scene, uint32_t n, WeirRandom *random)
{
    static const double densities[] = {300, 1500, 4000, 10000};
    uint32_t dimension = weir_scene_dimension(scene);
    char path[64];
#define AT(key) (snprintf(path, sizeof path, "bodies[%u]." key, n), path)
    double r = weir_random_range(random, 0.07, 0.12);
    double center[3] = {0.3 + 0.3 * n, weir_random_range(random, 0.5, 0.6), 0.25};
    if (weir_random_next(random) % 2 == 0) {
        set(scene, AT("ball.center"), center, dimension);
        set_one(scene, AT("ball.radius"), r);
    } else {
        double min[3], max[3];
        for (int k = 0; k < 3; ++k) {
            min[k] = center[k] - r;
            max[k] = center[k] + r;
        }
        set(scene, AT("box.min"), min, dimension);
        set(scene, AT("box.max"), max, dimension);
    }
    set_one(scene, AT("density"), densities[weir_random_next(random) % 4]);
    double velocity[3] = {weir_random_range(random, -3, 3), weir_random_range(random, -4, 1),
                          weir_random_range(random, -1, 1)};
    set(scene, AT("velocity"), velocity, dimension);
#undef AT
}

static void add_paddle(WeirScene *scene)
{
    uint32_t dimension = weir_scene_dimension(scene);
    set(scene, "walls[0].box.min", (double[]){1.2, 0, 0}, dimension);
    set(scene, "walls[0].box.max", (double[]){1.3, 0.5, 0.5}, dimension);
    set(scene, "walls[0].motion.amplitude", (double[]){0.15, 0, 0}, dimension);
    set_one(scene, "walls[0].motion.period", 0.7);
}

static void add_rotor(WeirScene *scene)
{
    uint32_t dimension = weir_scene_dimension(scene);
    set(scene, "walls[0].box.min", (double[]){1.15, 0.2, 0.1}, dimension);
    set(scene, "walls[0].box.max", (double[]){1.45, 0.28, 0.4}, dimension);
    if (dimension == 3) {
        set(scene, "walls[0].motion.angular_velocity", (double[]){0, 0, 8}, 3);
    } else {
        set_one(scene, "walls[0].motion.angular_velocity", 8);
    }
}

static void nothing_squeezed_blows_up(void **state)
{
    (void)state;
    WeirRandom random = {.state = 31};
    for (uint32_t round = 0; round < SCENES; ++round) {
        uint32_t dimension = round % 3 == 2 ? 3 : 2;
        WeirScene *scene = weir_scene_create();
        CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
        set_one(scene, "dimension", dimension);
        weir_test_set(scene, "particle_spacing", dimension == 3 ? 0.04 : 0.02);
        weir_test_set(scene, "expected_speed", 4);
        CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){1.6, 1, 0.5}),
                    WEIR_OK);
        CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){1, 0.3, 0.5}, NULL),
                    WEIR_OK);
        for (uint32_t n = 0; n < BODIES; ++n) add_body(scene, n, &random);
        if (round % 2 == 0) add_paddle(scene);
        if (round % 4 == 1) add_rotor(scene);
        WeirSim *sim = weir_test_sim(scene, NULL, 0);
        CHECK_SIM(sim, weir_sim_run_until(sim, end), WEIR_OK);
        assert_int_equal(weir_test_diagnose(sim, 0).lost_particles, 0);
        assert_int_equal(weir_sim_clock(sim).fluid_particles, weir_sim_fluid_slots(sim));
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_squeezed_blows_up),
    };
    return cmocka_run_group_tests_name("bodies", tests, NULL, NULL);
}
