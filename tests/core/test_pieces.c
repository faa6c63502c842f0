// Walls, bodies, emitters, drains, probes, motions and flows: what they become, and every way to be wrong.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "core/scene.h"
#include "core/solids.h"

// A tank of 2 m by 1 m (by 1 m) with water 0.4 m deep at 0.05 m spacing.
static WeirScene *tank(uint32_t dimension)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", 0.05);
    weir_test_set(scene, "support_radius", 0.15);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "domain.min", (double[]){0, 0, 0}, dimension), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "domain.max", (double[]){2, 1, 1}, dimension), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "fluid[0].box.min", (double[]){0, 0, 0}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "fluid[0].box.max", (double[]){2, 0.4, 1}, dimension),
                WEIR_OK);
    return scene;
}

// Sets keys from text: "walls[0].box.min 0 0; walls[0].name lid; walls[0].inside true".
static WeirStatus set_all(WeirScene *scene, const char *keys)
{
    char text[1000], *next = NULL;
    snprintf(text, sizeof text, "%s", keys);
    for (char *part = strtok_r(text, ";", &next); part; part = strtok_r(NULL, ";", &next)) {
        part += strspn(part, " ");
        char *value = strchr(part, ' ');
        assert_non_null(value);
        *value++ = '\0';
        double numbers[16];
        size_t count = 0;
        char *end = value;
        for (char *rest = value; count < 16; rest = end, ++count) {
            numbers[count] = strtod(rest, &end);
            if (end == rest) break;
        }
        WeirStatus status;
        if (strcmp(value, "true") == 0 || strcmp(value, "false") == 0)
            status = weir_scene_set_boolean(scene, part, value[0] == 't');
        else if (*end != '\0' || count == 0)
            status = weir_scene_set_string(scene, part, value);
        else if (count == 1)
            status = weir_scene_set_number(scene, part, numbers[0]);
        else
            status = weir_scene_set_numbers(scene, part, numbers, count);
        if (status) return status;
    }
    return WEIR_OK;
}

static WeirScene *tank_with(uint32_t dimension, const char *keys)
{
    WeirScene *scene = tank(dimension);
    CHECK_SCENE(scene, set_all(scene, keys), WEIR_OK);
    return scene;
}

static WeirWorld world_of(WeirScene *scene)
{
    WeirWorld world;
    CHECK_SCENE(scene, weir_scene_make_world(scene, &world), WEIR_OK);
    return world;
}

typedef struct Refused {
    uint32_t dimension;
    const char *keys;
    const char *says[4];
} Refused;

// Some keys are refused when they are set, others when the scene is checked: either way by one message.
static void pieces_that_cannot_be_are_refused(void **state)
{
    (void)state;
    static const Refused refused[] = {
        // Shapes.
        {2, "walls[0].name a", {"walls[0]", "box, ball or polygon", "missing"}},
        {3, "walls[0].name a", {"walls[0]", "cylinder", "missing"}},
        {2, "walls[0].box.min 1 0", {"walls[0]", "box.max", "missing"}},
        {2, "walls[0].box.min 1 0; walls[0].box.max 0.5 0.2", {"walls[0].box", "min x = 1", "0.5"}},
        {2, "walls[0].box.min 1 0; walls[0].ball.radius 1", {"walls[0].ball.radius", "box and a ball"}},
        {2, "walls[0].cylinder.radius 1", {"walls[0].cylinder", "dimension 3"}},
        {3, "walls[0].polygon[0] 1 1", {"walls[0].polygon", "dimension 2"}},
        {3,
         "walls[0].cylinder.from 1 0 1; walls[0].cylinder.to 1 0 1; walls[0].cylinder.radius 0.2",
         {"walls[0].cylinder", "same point"}},
        {2, "walls[0].polygon[0] 1 1; walls[0].polygon[1] 2 1", {"walls[0].polygon", "2 corners", "3"}},
        {2, "walls[0].polygon[1] 1 1", {"walls[0].polygon[1]", "in order", "[0]"}},
        {2,
         "walls[0].polygon[0] 0 0; walls[0].polygon[1] 1 1; walls[0].polygon[2] 1 0; walls[0].polygon[3] 0 1",
         {"walls[0].polygon", "cross"}},
        {2,
         "walls[0].polygon[0] 0 0; walls[0].polygon[1] 1 1; walls[0].polygon[2] 2 2",
         {"walls[0].polygon", "no area"}},
        {2,
         "walls[0].polygon[0] 0 0; walls[0].polygon[1] 1 1; walls[0].polygon[2] 1 1",
         {"polygon[2]", "twice"}},
        {3, "walls[0].mesh.file a.stl", {"walls[0].mesh.file", "a.stl", "command line only", "vertices"}},
        {3, "walls[0].mesh.vertices 0 0 0 1 0 0 0 1 0 0 0 1", {"walls[0]", "mesh.triangles", "missing"}},
        {3,
         "walls[0].mesh.vertices 0 0 0 1 0 0 0 1 0 0 0 1; walls[0].mesh.triangles 0 2 1 0 1 3 0 3 2 1 2 9",
         {"walls[0].mesh.triangles[3]", "corner 9", "4 vertices"}},
        {3,
         "walls[0].mesh.vertices 0 0 0 1 0 0 0 1 0 0 0 1; walls[0].mesh.triangles[0] 0 2 1.5",
         {"walls[0].mesh.triangles[0]", "1.5", "whole"}},
        {3, "walls[0].mesh.vertices 0 0 0 1", {"walls[0].mesh.vertices", "list of 4"}},
        // Walls.
        {2, "walls[0].box.min 3 0; walls[0].box.max 4 1", {"walls[0]", "no particle", "outside"}},
        {2,
         "walls[0].box.min 0 0; walls[0].box.max 1 1; walls[0].name domain",
         {"walls[0].name", "domain", "taken"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].name a; walls[1].box.min 0 0; "
         "walls[1].box.max "
         "0.2 1; walls[1].name a",
         {"walls[0].name", "\"a\"", "taken"}},
        {2, "walls[0].name abcdefghijklmnopqrstuvwxyzabcdefgh", {"walls[0].name", "34", "31"}},
        {2, "walls[0].inside 1", {"walls[0].inside", "true or false"}},
        {2, "walls[0].colour red", {"walls[0].colour", "unknown key", "surface_velocity"}},
        {2, "walls[0].box.min 0 0; walls[0].box.max 2 0.4", {"fluid[0]", "nothing is left"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].surface_velocity 1 0; "
         "walls[0].motion.velocity 1 0",
         {"walls[0]", "surface_velocity", "motion"}},
        // Motions.
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.amplitude 1 0",
         {"walls[0]", "motion.period"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.period 1",
         {"walls[0]", "motion.amplitude"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.velocity 1 0; walls[0].motion.rows[0] "
         "0 0 0 "
         "0; walls[0].motion.rows[1] 1 0 0 0",
         {"walls[0].motion", "velocity", "rows"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.rows[0] 0 0 0 0",
         {"walls[0].motion.rows", "2"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.rows 0 0 0 0 1 0 0 0 1 0 0 0",
         {"walls[0].motion.rows[2]", "above 1"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.rows -1 0 0 0 1 0 0 0",
         {"walls[0].motion.rows[0]", "-1"}},
        {2,
         "walls[0].box.min 1 0; walls[0].box.max 2 1; walls[0].motion.rows 0 0 1 0 1 0 0 0",
         {"walls[0].motion.rows[0]", "moved already"}},
        {2, "walls[0].motion.rows[0] 0 0 0", {"walls[0].motion.rows[0]", "[t, dx, dy, angle]"}},
        {3, "walls[0].motion.rows[0] 0 0 0 0", {"walls[0].motion.rows[0]", "[t, dx, dy, dz, rx, ry, rz]"}},
        {2, "walls[0].motion.angular_velocity 0 0 1", {"angular_velocity", "a number"}},
        {3, "walls[0].motion.angular_velocity 1", {"angular_velocity", "[x, y, z]"}},
        // Bodies.
        {2, "bodies[0].box.min 1 0.5; bodies[0].box.max 1.2 0.7", {"bodies[0]", "density", "missing"}},
        {2,
         "bodies[0].density 500; bodies[0].box.min 1 0.5; bodies[0].box.max 1.2 1.1",
         {"bodies[0]", "1.1", "0 to 1"}},
        {2,
         "bodies[0].density 500; bodies[0].ball.center 1 0.7; bodies[0].ball.radius 0.2; bodies[1].density "
         "500; "
         "bodies[1].ball.center 1.1 0.7; bodies[1].ball.radius 0.1",
         {"bodies[0]", "reaches into bodies[1]"}},
        {2,
         "bodies[0].density 500; bodies[0].ball.center 1 0.7; bodies[0].ball.radius 0.2; walls[0].box.min 1 "
         "0.5; "
         "walls[0].box.max 1.5 0.7",
         {"bodies[0]", "reaches into walls[0]"}},
        {2,
         "bodies[0].density 500; bodies[0].polygon[0] 1 0.6; bodies[0].polygon[1] 1.2 0.6; "
         "bodies[0].polygon[2] 1.1 0.62",
         {"bodies[0]", "no particle", "thinner", "0.05"}},
        {2, "bodies[0].density 0", {"bodies[0].density", "0.001"}},
        {2, "bodies[0].fixed xz", {"bodies[0].fixed", "xz", "axes"}},
        {2, "bodies[0].fixed xx", {"bodies[0].fixed", "xx"}},
        {2, "bodies[0].fixed_rotation x", {"bodies[0].fixed_rotation", "\"z\""}},
        // Emitters and drains.
        {2, "emitters[0].size 0.1", {"emitters[0]", "center", "missing"}},
        {2, "emitters[0].center 1 0.8", {"emitters[0]", "direction", "missing"}},
        {2, "emitters[0].center 1 0.8; emitters[0].direction 0 -1", {"emitters[0]", "size", "missing"}},
        {2,
         "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.1",
         {"emitters[0]", "speed"}},
        {2,
         "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.1; emitters[0].speed 1; "
         "emitters[0].flow_rate 1",
         {"emitters[0]", "speed and flow_rate"}},
        {2,
         "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.1; emitters[0].speed 1; "
         "emitters[0].start 2; emitters[0].stop 1",
         {"emitters[0]", "stop = 1", "start = 2"}},
        {2,
         "emitters[0].center 1 0.97; emitters[0].direction 0 1; emitters[0].size 0.1; emitters[0].speed 1",
         {"emitters[0]", "out of the domain", "y"}},
        {2,
         "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.1; emitters[0].speed 1; "
         "walls[0].box.min 0.9 0.5; walls[0].box.max 1.5 0.75",
         {"emitters[0]", "blows into walls[0]"}},
        {2,
         "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.1; emitters[0].speed 1; "
         "bodies[0].box.min 0.9 0.5; bodies[0].box.max 1.5 0.75; bodies[0].density 1",
         {"emitters[0]", "blows into bodies[0]"}},
        {2, "emitters[0].capacity 1.5", {"emitters[0].capacity", "whole number"}},
        {2, "emitters[1024].size 0.1", {"emitters[1024].size", "more than 1024 emitters"}},
        {2, "drains[1024].min 0 0", {"drains[1024].min", "more than 1024 drains"}},
        {2, "drains[0].min 1 0", {"drains[0]", "max", "missing"}},
        {2, "drains[0].min 1 0; drains[0].max 0 1", {"drains[0]", "min x = 1"}},
        // Probes.
        {2, "probes[0].position 1 0", {"probes[0]", "kind", "missing"}},
        {2, "probes[0].kind pressure", {"probes[0]", "position", "missing"}},
        {2, "probes[0].kind heat", {"probes[0].kind", "heat", "pressure|velocity"}},
        {2, "probes[0].kind force", {"probes[0]", "target", "missing"}},
        {2, "probes[0].kind force; probes[0].target lid", {"probes[0].target", "\"lid\""}},
        {2, "probes[0].kind mass; probes[0].min 0 0", {"probes[0]", "max", "missing"}},
        {2, "probes[0].rate 0", {"probes[0].rate", "above 0"}},
        // Flows and domains.
        {2, "fluid[0].flow whirl", {"fluid[0].flow", "whirl", "taylor_green"}},
        {3, "fluid[0].flow taylor_green", {"fluid[0].flow", "2D"}},
        {2, "fluid[0].flow standing_wave; parameters.gravity 0 0", {"fluid[0].flow", "gravity"}},
        {2, "domain.periodic xyx", {"domain.periodic", "xyx"}},
        {2, "domain.open y", {"domain.open", "+y -x"}},
        {2, "domain.open +y+x", {"domain.open", "+y+x"}},
    };
    for (size_t n = 0; n < sizeof refused / sizeof refused[0]; ++n) {
        WeirScene *scene = tank(refused[n].dimension);
        WeirStatus status = set_all(scene, refused[n].keys);
        if (!status) status = weir_scene_check(scene);
        if (status != WEIR_ERROR_INPUT) fail_msg("%s: gave status %d", refused[n].keys, (int)status);
        for (int k = 0; k < 4 && refused[n].says[k]; ++k)
            CHECK_CONTAINS(weir_scene_error(scene), refused[n].says[k]);
        weir_scene_destroy(scene);
    }
}

static void names_find_their_solids(void **state)
{
    (void)state;
    WeirScene *scene =
        tank_with(2, "walls[0].box.min 0.5 0; walls[0].box.max 0.7 0.2; walls[0].name step; "
                     "bodies[0].box.min 1 0.5; bodies[0].box.max 1.2 0.7; bodies[0].density 500; "
                     "bodies[0].name cork");
    assert_int_equal(weir_scene_solid_index(scene, "domain"), 0);
    assert_int_equal(weir_scene_solid_index(scene, "step"), 1);
    assert_int_equal(weir_scene_solid_index(scene, "cork"), 2);
    assert_int_equal(weir_scene_solid_index(scene, ""), -1);
    assert_int_equal(weir_scene_solid_index(scene, "lid"), -1);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.open", "-x +x -y +y"), WEIR_OK);
    assert_int_equal(weir_scene_solid_index(scene, "domain"), -1);
    assert_int_equal(weir_scene_solid_index(scene, "step"), 0);
    weir_scene_destroy(scene);
}

// Every particle of a solid has its group, and water keeps half a spacing away.
static void solids_follow_the_fluid(void **state)
{
    (void)state;
    WeirScene *scene =
        tank_with(2, "walls[0].box.min 0.5 0; walls[0].box.max 0.7 0.2; "
                     "bodies[0].box.min 1 0.3; bodies[0].box.max 1.2 0.5; bodies[0].density 500");
    WeirWorld world = world_of(scene);
    assert_int_equal(world.solid_count, 3);
    assert_int_equal(world.particles.fluid_slots, 40 * 8 - 4 * 4 - 4 * 2);
    uint32_t next = world.particles.fluid_slots;
    for (uint32_t s = 0; s < 3; ++s) {
        assert_int_equal(world.solids[s].first, next);
        for (uint32_t i = 0; i < world.solids[s].count; ++i, ++next)
            assert_int_equal(world.particles.group[next], WEIR_GROUP_SOLID + s);
    }
    assert_int_equal(next, world.particles.count);
    // The box is its lattice, its whole body; the wall stands on the domain's own floor, which stays.
    assert_int_equal(world.solids[2].count, 16);
    assert_int_equal(world.solids[1].count, 16);
    assert_int_equal(world.solids[0].count, 46 * 26 - 40 * 20);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

static void walls_win_over_sides_and_later_walls(void **state)
{
    (void)state;
    // A wall around a box that is the domain itself: the sides have nothing left.
    WeirScene *scene = tank_with(2, "walls[0].box.min 0 0; walls[0].box.max 2 1; walls[0].inside true");
    WeirWorld world = world_of(scene);
    assert_int_equal(world.solids[0].count, 0);
    assert_int_equal(world.solids[1].count, 46 * 26 - 40 * 20);
    weir_world_free(&world);
    CHECK_SCENE(scene, set_all(scene, "walls[1].box.min -0.1 0.5; walls[1].box.max 0.1 0.7"), WEIR_OK);
    world = world_of(scene);
    assert_int_equal(world.solids[2].count, 2 * 4); // what stands out of the first one
    weir_world_free(&world);
    weir_scene_destroy(scene);
    // A piston will leave: the side behind it stays.
    scene = tank_with(2, "walls[0].box.min 0 0; walls[0].box.max 0.1 1; walls[0].motion.velocity 0.1 0");
    world = world_of(scene);
    assert_int_equal(world.solids[0].count, 46 * 26 - 40 * 20);
    assert_int_equal(world.solids[1].count, 2 * 20);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

static double moment_2d(const WeirSolid *body)
{
    return 1.0 / (double)body->inverse_inertia[2][2];
}

static void bodies_have_their_mass(void **state)
{
    (void)state;
    WeirScene *scene = tank_with(
        2, "bodies[0].box.min 0.2 0.5; bodies[0].box.max 0.6 0.7; bodies[0].density 500; bodies[0].fixed x; "
           "bodies[0].velocity 0 1; bodies[1].ball.center 1 0.7; bodies[1].ball.radius 0.2; "
           "bodies[1].density 200; "
           "bodies[1].fixed_rotation z; bodies[2].polygon[0] 1.4 0.5; bodies[2].polygon[1] 1.4 0.8; "
           "bodies[2].polygon[2] 1.8 0.5; bodies[2].density 1000; bodies[2].angular_velocity 2");
    WeirWorld world = world_of(scene);
    const WeirSolid *body = &world.solids[1];
    CHECK_NEAR(body[0].mass, 500 * 0.08, 1e-4);
    CHECK_NEAR(moment_2d(&body[0]), 500 * 0.08 * (0.16 + 0.04) / 12, 1e-5);
    CHECK_NEAR(body[0].position[0], 0.4, 1e-6);
    CHECK_NEAR(body[0].velocity[1], 1, 0);
    CHECK_NEAR(body[0].freedom[0] + 10 * body[0].freedom[1] + 100 * body[0].freedom[2], 10, 0);
    CHECK_NEAR(body[0].angular_freedom[0] + body[0].angular_freedom[1] + 10 * body[0].angular_freedom[2], 10,
               0);
    double area = 3.14159265358979 * 0.04;
    CHECK_NEAR(body[1].mass, 200 * area, 1e-4);
    CHECK_NEAR(moment_2d(&body[1]), 200 * area * 0.02, 1e-5);
    CHECK_NEAR(body[1].angular_freedom[2], 0, 0);
    CHECK_NEAR(body[1].count * 0.0025, area, 0.01 * area); // its particles fill it
    // A right triangle a = 0.4 by b = 0.3: centre at a third, moment m (a^2 + b^2) / 18.
    CHECK_NEAR(body[2].mass, 60, 1e-3);
    CHECK_NEAR(body[2].position[0], 1.4 + 0.4 / 3, 1e-6);
    CHECK_NEAR(body[2].position[1], 0.6, 1e-6);
    CHECK_NEAR(moment_2d(&body[2]), 60 * 0.25 / 18, 1e-5);
    CHECK_NEAR(body[2].angular_velocity[2], 2, 0);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

// A mesh of a box has the box's moments; a cylinder's tensor turns with its axis.
static void solid_moments_in_3d(void **state)
{
    (void)state;
    WeirScene *scene =
        tank_with(3, "bodies[0].mesh.vertices 0 0 0 2 0 0 0 1 0 2 1 0; bodies[0].mesh.vertices[4] 0 0 1; "
                     "bodies[0].mesh.vertices[5] 2 0 1; bodies[0].mesh.vertices[6] 0 1 1; "
                     "bodies[0].mesh.vertices[7] 2 1 1; "
                     "bodies[0].mesh.triangles[0] 0 2 1; bodies[0].mesh.triangles[1] 1 2 3; "
                     "bodies[0].mesh.triangles[2] 4 5 6; "
                     "bodies[0].mesh.triangles[3] 5 7 6; bodies[0].mesh.triangles[4] 0 1 4; "
                     "bodies[0].mesh.triangles[5] 1 5 4; "
                     "bodies[0].mesh.triangles[6] 2 6 3; bodies[0].mesh.triangles[7] 3 6 7; "
                     "bodies[0].mesh.triangles[8] 0 4 2; "
                     "bodies[0].mesh.triangles[9] 2 4 6; bodies[0].mesh.triangles[10] 1 3 5; "
                     "bodies[0].mesh.triangles[11] 3 7 5");
    CHECK_SCENE(
        scene,
        set_all(scene,
                "bodies[0].mesh.scale 0.2; bodies[0].mesh.translate 0.3 0.5 0.3; bodies[0].density 500; "
                "bodies[1].cylinder.from 1.2 0.6 0.3; bodies[1].cylinder.to 1.2 0.6 0.7; "
                "bodies[1].cylinder.radius 0.1; bodies[1].density 400; bodies[2].ball.center 1.7 0.7 0.5; "
                "bodies[2].ball.radius 0.2; bodies[2].density 300"),
        WEIR_OK);
    WeirWorld world = world_of(scene);
    const WeirSolid *body = &world.solids[1];
    double mass = 500 * 0.4 * 0.2 * 0.2;
    CHECK_NEAR(body[0].mass, mass, 1e-5);
    CHECK_NEAR(1 / body[0].inverse_inertia[0][0], mass * 0.08 / 12, 1e-6);
    CHECK_NEAR(1 / body[0].inverse_inertia[1][1], mass * 0.20 / 12, 1e-6);
    CHECK_NEAR(body[0].inverse_inertia[0][1], 0, 1e-4);
    CHECK_NEAR(body[0].position[0], 0.5, 1e-6);
    CHECK_NEAR(body[0].count * 1.25e-4, 0.016, 0.02 * 0.016);
    mass = 400 * 3.14159265358979 * 0.01 * 0.4;
    CHECK_NEAR(body[1].mass, mass, 1e-4);
    CHECK_NEAR(1 / body[1].inverse_inertia[2][2], mass * 0.005, 1e-6);
    CHECK_NEAR(1 / body[1].inverse_inertia[0][0], mass * (0.0025 + 0.16 / 12), 1e-6);
    CHECK_NEAR(body[1].count * 1.25e-4, mass / 400, 0.05 * mass / 400);
    mass = 300 * 4.0 / 3 * 3.14159265358979 * 0.008;
    CHECK_NEAR(body[2].mass, mass, 1e-4);
    CHECK_NEAR(1 / body[2].inverse_inertia[1][1], 0.4 * mass * 0.04, 1e-6);
    CHECK_NEAR(body[2].count * 1.25e-4, mass / 300, 0.03 * mass / 300);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

// What the table gives between its rows, against the motion that was asked for.
static void motions_become_tables(void **state)
{
    (void)state;
    WeirScene *scene = tank_with(
        2, "walls[0].box.min 0.5 0.5; walls[0].box.max 0.6 0.7; walls[0].motion.amplitude 0.1 0.2; "
           "walls[0].motion.angle 0.3; walls[0].motion.period 0.7; walls[0].motion.pivot 0.55 0.5; "
           "walls[1].box.min 1 0.5; walls[1].box.max 1.1 0.7; walls[1].motion.velocity 0.5 -0.25; "
           "walls[1].motion.angular_velocity 2; walls[2].ball.center 1.5 0.7; walls[2].ball.radius 0.1; "
           "walls[2].motion.rows 0 0 0 0 1 0.5 0 0.1 2 2 0 0.4 4 8 0 1.6");
    WeirWorld world = world_of(scene);
    assert_int_equal(world.solids[0].motion_count, 0);
    CHECK_NEAR(world.solids[1].position[1], 0.5, 1e-7);
    CHECK_NEAR(world.solids[2].position[1], 0.6, 1e-7);
    for (double t = 0; t < 2; t += 0.0137) {
        WeirMotionRow now;
        const WeirSolid *solid = &world.solids[1];
        weir_motion_at(&world.motion[solid->motion_first], solid->motion_count, solid->motion_repeats, t,
                       &now);
        double phase = 2 * 3.14159265358979 * t / 0.7;
        CHECK_NEAR(now.displacement[0], 0.1 * sin(phase), 2e-6);
        CHECK_NEAR(now.displacement[1], 0.2 * sin(phase), 2e-6);
        CHECK_NEAR(now.rotation[2], 0.3 * sin(phase), 2e-6);
        CHECK_NEAR(now.displacement_rate[0], 0.1 * 2 * 3.14159265358979 / 0.7 * cos(phase), 2e-4);
        solid = &world.solids[2];
        weir_motion_at(&world.motion[solid->motion_first], solid->motion_count, solid->motion_repeats, t,
                       &now);
        CHECK_NEAR(now.displacement[0], 0.5 * t, 1e-6);
        CHECK_NEAR(now.displacement[1], -0.25 * t, 1e-6);
        CHECK_NEAR(now.rotation[2], 2 * t, 1e-5);
        CHECK_NEAR(now.displacement_rate[0], 0.5, 1e-5);
    }
    // x = t^2 / 2 on uneven rows: the parabola's own rates inside.
    const WeirMotionRow *rows = &world.motion[world.solids[3].motion_first];
    CHECK_NEAR(rows[1].displacement_rate[0], 1, 1e-6);
    CHECK_NEAR(rows[2].displacement_rate[0], 2, 1e-6);
    CHECK_NEAR(rows[2].rotation_rate[2], 0.4, 1e-6);
    assert_true(weir_scene_expected_speed(scene) >= 3 - 1e-6); // 6 m in 2 s
    // The mean velocity of a tiny step has no noise, though floats of the place have 5e-7 m of it.
    WeirSolidState states[4];
    weir_solids_start(&world, states);
    weir_solids_kick(&world, (float[4]){0}, 3.0, 1e-5f, states);
    float before = states[3].velocity[0];
    weir_solids_kick(&world, (float[4]){0}, 3.0 + 1e-5f, 1e-5f, states);
    WeirMotionRow now;
    weir_motion_at(rows, world.solids[3].motion_count, false, 3.00001, &now);
    CHECK_NEAR(before, now.displacement_rate[0], 1e-4);
    CHECK_NEAR(states[3].velocity[0], before, 1e-4);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

// A body that weighs less than the fluid that it drags along starts slower, by force, gravity and torque alike, so that what is in
// balance stays so; one that weighs more, or has no fluid around it, moves freely.
static void light_bodies_start_slower(void **state)
{
    (void)state;
    WeirSolid solid = {.kind = WEIR_SOLID_FREE, .count = 100, .mass = 2, .freedom = {1, 1, 1}};
    for (int axis = 0; axis < 3; ++axis) {
        solid.angular_freedom[axis] = 1;
        solid.inverse_inertia[axis][axis] = 0.5f;
    }
    const WeirWorld world = {.solids = &solid, .solid_count = 1};
    static const struct {
        float dragged, share;
    } cases[] = {{0, 1}, {1.9f, 1}, {2, 1}, {8, 0.25f}};
    for (size_t n = 0; n < sizeof cases / sizeof *cases; ++n) {
        WeirSolidState now = {
            .orientation = {0, 0, 0, 1}, .force = {4, 20, 0, cases[n].dragged}, .torque = {0, 0, 6}};
        weir_solids_kick(&world, (float[4]){0, -10, 0, 0}, 0.0, 0.5f, &now);
        CHECK_NEAR(now.velocity[0], 0.5 * 2 * cases[n].share, 1e-6);
        CHECK_NEAR(now.velocity[1], 0, 1e-6); // force and weight are in balance
        CHECK_NEAR(now.angular_velocity[2], 0.5 * 3 * cases[n].share, 1e-6);
    }
    // Between it and fluid it counts with what it drags along, 1 at most; its surface sees all of its acceleration where that is little.
    const WeirSolidState light = {.force = {0, 0, 0, 8}}, heavy = {.force = {0, 0, 0, 0.25f}},
                         dry = {.force = {0}};
    CHECK_NEAR(weir_solid_barrier(&solid, &light, 0.1f), 0.4, 1e-6);
    CHECK_NEAR(weir_solid_barrier(&solid, &light, 0.5f), 1, 0);
    CHECK_NEAR(weir_solid_barrier(&solid, &heavy, 0.1f), 0.1f, 0);
    CHECK_NEAR(weir_solid_sway(&solid, &light), 1 / 6.0, 1e-6);
    CHECK_NEAR(weir_solid_sway(&solid, &heavy), 1, 0);
    CHECK_NEAR(weir_solid_sway(&solid, &dry), 1, 0);
    // 100 particles are 10 wide in 2D, 5 in 3D; across a face two pairs each.
    CHECK_NEAR(weir_solid_bulk(&solid, 2, 0.5f, 0.1f), 2 / (2 * 10 * 0.5), 1e-6);
    CHECK_NEAR(weir_solid_bulk(&solid, 3, 0.5f, 0.1f), 2 / (2 * 25 * 0.5), 1e-6);
    // A square of 100 heavy particles counts as a rod of 14, a plate of 2 by 50 as one of 50, a cube's face as 3 times as large.
    solid.inverse_inertia[2][2] = 6 / (2 * 1.0f);
    CHECK_NEAR(weir_solid_bulk(&solid, 2, 0.01f, 0.1f), 2 / (2 * 14.142 * 0.01), 1e-3);
    CHECK_NEAR(weir_solid_bulk(&solid, 2, 0.09f, 0.1f), 1, 0);
    solid.inverse_inertia[2][2] = 12 / (2 * 25.0f);
    CHECK_NEAR(weir_solid_bulk(&solid, 2, 0.01f, 0.1f), 2 / (2 * 50 * 0.01), 1e-3);
    for (int axis = 0; axis < 3; ++axis) solid.inverse_inertia[axis][axis] = 6 / (2 * 0.2154f);
    CHECK_NEAR(weir_solid_bulk(&solid, 3, 0.01f, 0.1f), 2 / (2 * 3 * 21.54 * 0.01), 1e-2);
    solid.kind = WEIR_SOLID_DRIVEN;
    assert_true(weir_solid_bulk(&solid, 2, 0.5f, 0.1f) > 1e30f);
}

static void emitters_have_points_and_slots(void **state)
{
    (void)state;
    WeirScene *scene =
        tank_with(2, "emitters[0].center 1 0.8; emitters[0].direction 0 -2; emitters[0].size 0.2; "
                     "emitters[0].flow_rate 0.1; emitters[0].capacity 77; drains[0].min 0 0; "
                     "drains[0].max 0.1 0.1");
    WeirWorld world = world_of(scene);
    assert_int_equal(world.emitter_count, 1);
    assert_int_equal(world.point_count, 4);
    for (int n = 0; n < 4; ++n) {
        CHECK_NEAR(fabs(world.points[2 * n] - 1), n == 0 || n == 3 ? 0.075 : 0.025, 1e-6);
        CHECK_NEAR(world.points[2 * n + 1], 0.8, 1e-12);
    }
    CHECK_NEAR(world.emitters[0].speed, 0.5, 1e-6);
    CHECK_NEAR(world.emitters[0].direction[1], -1, 0);
    CHECK_NEAR(world.emitters[0].stop, 1e30, 1e24);
    assert_int_equal(world.particles.fluid_slots, 320 + 77);
    for (uint32_t i = 320; i < 397; ++i) assert_int_equal(world.particles.group[i], WEIR_GROUP_EMPTY);
    assert_int_equal(world.drain_count, 1);
    CHECK_NEAR(world.drains[0].max[1], 0.1, 1e-7);
    weir_world_free(&world);
    // Chosen: what the domain can hold beside the water, or what comes while it is open.
    WeirScene *chosen =
        tank_with(2, "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.2; "
                     "emitters[0].speed 1");
    world = world_of(chosen);
    assert_int_equal(world.particles.fluid_slots, 800 + 4 * 4);
    weir_world_free(&world);
    // Two emitters fill no more of it.
    WeirScene *two =
        tank_with(2, "emitters[0].center 1 0.8; emitters[0].direction 0 -1; emitters[0].size 0.2; "
                     "emitters[0].speed 1; emitters[1].center 0.5 0.8; emitters[1].direction 0 -1; "
                     "emitters[1].size 0.1; emitters[1].speed 1");
    world = world_of(two);
    assert_int_equal(world.particles.fluid_slots, 800 + 4 * 4 + 4 * 2);
    weir_world_free(&world);
    weir_scene_destroy(two);
    CHECK_SCENE(chosen, weir_scene_set_number(chosen, "emitters[0].stop", 0.5), WEIR_OK);
    world = world_of(chosen);
    assert_int_equal(world.particles.fluid_slots, 320 + 4 * 11);
    weir_world_free(&world);
    weir_scene_destroy(chosen);
    weir_scene_destroy(scene);
    scene = tank_with(3, "emitters[0].center 1 0.8 0.5; emitters[0].direction 0 -1 0; emitters[0].size 0.2; "
                         "emitters[0].speed 1; emitters[0].capacity 10");
    world = world_of(scene);
    assert_int_equal(world.point_count, 12); // of 16 sites, those inside the circle
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

// Layers may wait for the 4th step, unless the fastest flow would come farther than half a spacing of 0.1 m by then.
static void fast_emitters_have_more_chances(void **state)
{
    (void)state;
    WeirEmitter emitters[] = {{.speed = 0.5f}, {.speed = 1.0f}, {.speed = 0.1f}};
    WeirWorld world = {.emitters = emitters};
    WeirParameters parameters = {.particle_spacing = 0.1f, .courant = 0.5f, .time_step = 0.026f};
    WeirConstants constants = {.smoothing_length = 0.2f, .sound_speed = 10.0f}; // steps of 0.01 s at most
    assert_int_equal(weir_world_emission_interval(&world, &parameters, &constants), 4);
    world.emitter_count = 3;
    assert_int_equal(weir_world_emission_interval(&world, &parameters, &constants), 4);
    emitters[1].speed = 1.3f;
    assert_int_equal(weir_world_emission_interval(&world, &parameters, &constants), 2);
    emitters[1].speed = 2.6f;
    assert_int_equal(weir_world_emission_interval(&world, &parameters, &constants), 1);
    emitters[1].speed = 9.0f;
    assert_int_equal(weir_world_emission_interval(&world, &parameters, &constants), 1);
    emitters[1].speed = 0.9f;
    parameters.stepping = WEIR_STEPPING_FIXED;
    assert_int_equal(weir_world_emission_interval(&world, &parameters, &constants), 2);
}

// Drains in any order: each is in one group, inside its box; what is in no box is in no drain.
static void drains_are_grouped(void **state)
{
    (void)state;
    enum { COUNT = 2 * WEIR_DRAIN_GROUP + 5 };
    WeirWorld world = {.drains = calloc(COUNT, sizeof *world.drains), .drain_count = COUNT};
    WeirRandom random = {7};
    assert_non_null(world.drains);
    double sum = 0;
    for (int n = 0; n < COUNT; ++n) {
        for (int axis = 0; axis < 3; ++axis) {
            world.drains[n].min[axis] = (float)weir_random_range(&random, -2, 2);
            world.drains[n].max[axis] = world.drains[n].min[axis] + (float)weir_random_range(&random, 0, 1);
            sum += (double)world.drains[n].min[axis] + 3 * (double)world.drains[n].max[axis];
        }
    }
    assert_true(weir_world_group_drains(&world));
    assert_int_equal(world.drain_group_count, 3);
    for (int n = 0; n < COUNT; ++n) {
        const WeirDrain *drain = &world.drains[n], *group = &world.drain_groups[n / WEIR_DRAIN_GROUP];
        for (int axis = 0; axis < 3; ++axis) {
            assert_true(drain->min[axis] >= group->min[axis] && drain->max[axis] <= group->max[axis]);
            sum -= (double)drain->min[axis] + 3 * (double)drain->max[axis];
        }
    }
    CHECK_NEAR(sum, 0, 1e-9); // the same drains
    // Neighbours along x: the boxes hardly overlap.
    assert_true(world.drain_groups[0].max[0] < world.drain_groups[2].min[0]);
    weir_world_free(&world);
}

// An inlet through the wall: no wall where its layers come from, a closed one elsewhere.
static void inlets_open_the_wall(void **state)
{
    (void)state;
    WeirScene *scene =
        tank_with(2, "emitters[0].center 0 0.8; emitters[0].direction 1 0; emitters[0].size 0.2; "
                     "emitters[0].speed 1");
    WeirWorld world = world_of(scene);
    uint32_t whole = 46 * 26 - 40 * 20;
    assert_int_equal(world.solids[0].count, whole - 3 * 4);
    weir_world_free(&world);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "emitters[0].stop", 1), WEIR_OK);
    world = world_of(scene);
    assert_int_equal(world.solids[0].count, whole);
    weir_world_free(&world);
    weir_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_that_cannot_be_are_refused),
        cmocka_unit_test(names_find_their_solids),
        cmocka_unit_test(solids_follow_the_fluid),
        cmocka_unit_test(walls_win_over_sides_and_later_walls),
        cmocka_unit_test(bodies_have_their_mass),
        cmocka_unit_test(solid_moments_in_3d),
        cmocka_unit_test(motions_become_tables),
        cmocka_unit_test(light_bodies_start_slower),
        cmocka_unit_test(emitters_have_points_and_slots),
        cmocka_unit_test(fast_emitters_have_more_chances),
        cmocka_unit_test(drains_are_grouped),
        cmocka_unit_test(inlets_open_the_wall),
    };
    return cmocka_run_group_tests_name("pieces", tests, NULL, NULL);
}
