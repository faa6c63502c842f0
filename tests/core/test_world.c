// What a scene of `wcsph` becomes: fluid, the domain's walls, the state at the start.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene.h"

enum { BOTH = 2 };

static void set_vector(WeirScene *scene, const char *path, double x, double y, double z)
{
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, (double[]){x, y, z}, weir_scene_dimension(scene)),
                WEIR_OK);
}

// A tank of 1 m per axis at 0.1 m spacing, half full.
static WeirScene *tank(uint32_t dimension)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", 0.1);
    weir_test_set(scene, "support_radius", 0.3);
    set_vector(scene, "domain.min", 0, 0, 0);
    set_vector(scene, "domain.max", 1, 1, 1);
    set_vector(scene, "fluid[0].box.min", 0, 0, 0);
    set_vector(scene, "fluid[0].box.max", 1, 0.5, 1);
    return scene;
}

static WeirWorld world_of(WeirScene *scene)
{
    WeirWorld world;
    CHECK_SCENE(scene, weir_scene_make_world(scene, &world), WEIR_OK);
    return world;
}

static void boxes_hold_exactly_their_sites(void **state)
{
    (void)state;
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = tank(dimension);
        WeirWorld world = world_of(scene);
        uint32_t fluid = dimension == 3 ? 10 * 5 * 10 : 10 * 5;
        uint32_t outer = dimension == 3 ? 16 * 16 * 16 : 16 * 16, inner = dimension == 3 ? 1000 : 100;
        assert_int_equal(world.particles.dimension, dimension);
        assert_int_equal(world.particles.fluid_slots, fluid);
        assert_int_equal(world.particles.count, fluid + outer - inner);
        assert_int_equal(world.solid_count, 1);
        assert_int_equal(world.solids[0].first, fluid);
        assert_int_equal(world.solids[0].count, outer - inner);
        assert_int_equal(world.solids[0].kind, WEIR_SOLID_FIXED);
        assert_int_equal(world.solids[0].no_slip, 1);
        for (uint32_t i = 0; i < world.particles.count; ++i)
            assert_int_equal(world.particles.group[i], i < fluid ? WEIR_GROUP_FLUID : WEIR_GROUP_SOLID);
        weir_world_free(&world);
        weir_scene_destroy(scene);
    }
}

// Fluid and walls together form one lattice: every particle has its neighbour at one spacing on each side that
// is not the outermost.
static void walls_continue_the_lattice(void **state)
{
    (void)state;
    WeirScene *scene = tank(2);
    CHECK_SCENE(scene, weir_scene_set_boolean(scene, "fluid[0].hydrostatic", false), WEIR_OK);
    WeirWorld world = world_of(scene);
    static bool taken[16][16];
    memset(taken, 0, sizeof taken);
    for (uint32_t i = 0; i < world.particles.count; ++i) {
        const double *p = &world.particles.position[2 * i];
        double column = p[0] / 0.1 - 0.5 + 3, row = p[1] / 0.1 - 0.5 + 3;
        CHECK_NEAR(column, floor(column + 0.5), 1e-5);
        CHECK_NEAR(row, floor(row + 0.5), 1e-5);
        bool *site = &taken[(int)(row + 0.5)][(int)(column + 0.5)];
        assert_false(*site);
        *site = true;
    }
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

static uint32_t count_beyond(const WeirWorld *world, int axis, double low, double high)
{
    uint32_t count = 0, dimension = world->particles.dimension;
    for (uint32_t i = world->particles.fluid_slots; i < world->particles.count; ++i) {
        double x = world->particles.position[dimension * i + (uint32_t)axis];
        count += x > low && x < high;
    }
    return count;
}

static void sides_may_be_open_or_periodic(void **state)
{
    (void)state;
    WeirScene *scene = tank(2);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "+y"), WEIR_OK);
    WeirWorld world = world_of(scene);
    // No lid; the walls beside it go straight on by three layers of three particles.
    assert_int_equal(count_beyond(&world, 1, 1, 2), BOTH * 3 * 3);
    assert_int_equal(world.solids[0].count, 156 - 10 * 3);
    weir_world_free(&world);

    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "x"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_boolean(scene, "domain.free_slip", true), WEIR_OK);
    world = world_of(scene);
    assert_int_equal(world.solids[0].count, 10 * 3); // the bottom alone
    assert_int_equal(world.solids[0].no_slip, 0);
    assert_int_equal(count_beyond(&world, 0, 0, 1), 10 * 3);
    weir_world_free(&world);

    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "+y -y"), WEIR_OK);
    world = world_of(scene);
    assert_int_equal(world.solid_count, 0);
    assert_int_equal(world.particles.count, 50);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

// Hydrostatics of a compressible fluid, dp / rho = -g dy, with all of the lattice's weight on the bottom.
static void water_starts_under_its_own_weight(void **state)
{
    (void)state;
    static const char *const equations[] = {"linear", "tait"};
    for (int tait = 0; tait < 2; ++tait) {
        WeirScene *scene = tank(3);
        weir_test_choose(scene, "equation_of_state", equations[tait]);
        WeirWorld world = world_of(scene);
        WeirParameters parameters = weir_scene_resolved(scene);
        double c2 = (double)parameters.sound_speed * parameters.sound_speed;
        for (uint32_t i = 0; i < world.particles.fluid_slots; ++i) {
            double fall = 9.81 * world.particles.position[3 * i + 1] / c2, weight = 9.81 * 0.5 / c2;
            double bottom = tait ? pow(1 + 7 * weight, 1.0 / 7) : 1 + weight;
            double ratio = tait ? pow(pow(bottom, 6) - 6 * fall, 1.0 / 6) : bottom * exp(-fall);
            CHECK_NEAR(world.particles.density[i] / 1000.0, ratio, 1e-7);
        }
        for (uint32_t i = world.particles.fluid_slots; i < world.particles.count; ++i)
            CHECK_NEAR(world.particles.density[i], 1000.0, 0);
        weir_world_free(&world);
        CHECK_SCENE(scene, weir_scene_set_boolean(scene, "fluid[0].hydrostatic", false), WEIR_OK);
        world = world_of(scene);
        for (uint32_t i = 0; i < world.particles.fluid_slots; ++i)
            CHECK_NEAR(world.particles.density[i], 1000.0, 0);
        weir_world_free(&world);
        weir_scene_destroy(scene);
    }
}

static void choices_are_made_for_the_scene(void **state)
{
    (void)state;
    WeirScene *scene = tank(2);
    CHECK_NEAR(weir_scene_resolved(scene).support_radius, 0.3, 1e-7);
    weir_test_set(scene, "support_radius", 0);
    WeirParameters parameters = weir_scene_resolved(scene);
    CHECK_NEAR(parameters.support_radius, 0.4, 1e-7);
    CHECK_NEAR(parameters.sound_speed, 20 * sqrt(9.81 * 0.5), 1e-4);
    weir_test_set(scene, "expected_speed", 3);
    CHECK_NEAR(weir_scene_resolved(scene).sound_speed, 30, 1e-5);
    weir_test_set(scene, "sound_speed", 44);
    weir_test_set(scene, "support_radius", 0.26);
    CHECK_NEAR(weir_scene_resolved(scene).sound_speed, 44, 0);
    CHECK_NEAR(weir_scene_resolved(scene).support_radius, 0.26, 1e-7);
    weir_scene_destroy(scene);
}

static void check_refused(WeirScene *scene, const char *const says[], size_t count)
{
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_ERROR_INPUT);
    for (size_t n = 0; n < count; ++n) CHECK_CONTAINS(weir_scene_error(scene), says[n]);
    weir_scene_destroy(scene);
}
#define CHECK_REFUSED(scene, ...)                                                                            \
    check_refused(scene, (const char *const[]){__VA_ARGS__},                                                 \
                  sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

static void domains_that_cannot_be_are_refused(void **state)
{
    (void)state;
    WeirScene *scene = tank(2);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "x"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "-x"), WEIR_OK);
    CHECK_REFUSED(scene, "domain", "x", "periodic", "open");
    scene = tank(2);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "x"), WEIR_OK);
    weir_test_set(scene, "support_radius", 0.51);
    CHECK_REFUSED(scene, "domain.periodic", "x", "1.02");
    scene = tank(2);
    weir_test_set(scene, "support_radius", 0.1);
    CHECK_REFUSED(scene, "support_radius", "1.5 to 12");
    scene = tank(2);
    set_vector(scene, "domain.min", -1e5, 0, 0);
    CHECK_REFUSED(scene, "domain", "support radii", "particle_spacing");
    scene = tank(3);
    set_vector(scene, "domain.min", -3000, -3000, 0);
    CHECK_REFUSED(scene, "domain", "particles", "particle_spacing");
}

static void keys_of_the_other_method_are_refused(void **state)
{
    (void)state;
    WeirScene *scene = tank(2);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "+y"), WEIR_OK);
    weir_test_set(scene, "support_radius", 0.25);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "mueller"), WEIR_OK);
    CHECK_REFUSED(scene, "domain.open", "wcsph", "mueller");
    scene = tank(2);
    weir_test_set(scene, "gas_constant", 1000);
    CHECK_REFUSED(scene, "parameters.gas_constant", "wcsph", "mueller");
    scene = tank(3);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "mueller"), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "dimension");
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", 2), WEIR_ERROR_INPUT);
    CHECK_CONTAINS(weir_scene_error(scene), "pieces");
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_hold_exactly_their_sites),
        cmocka_unit_test(walls_continue_the_lattice),
        cmocka_unit_test(sides_may_be_open_or_periodic),
        cmocka_unit_test(water_starts_under_its_own_weight),
        cmocka_unit_test(choices_are_made_for_the_scene),
        cmocka_unit_test(domains_that_cannot_be_are_refused),
        cmocka_unit_test(keys_of_the_other_method_are_refused),
    };
    return cmocka_run_group_tests_name("world", tests, NULL, NULL);
}
