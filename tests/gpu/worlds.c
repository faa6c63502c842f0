#include "worlds.h"
#include "core/grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void *zeroed(size_t count, size_t size)
{
    void *memory = calloc(count, size);
    assert_non_null(memory);
    return memory;
}

WeirTestWorld weir_test_world(uint32_t dimension, const double size[3])
{
    WeirTestWorld test = {.scene = weir_scene_create(), .random = {12345}, .spacing = 0.05};
    assert_non_null(test.scene);
    CHECK_SCENE(test.scene, weir_scene_set_string(test.scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(test.scene, weir_scene_set_number(test.scene, "dimension", dimension), WEIR_OK);
    weir_test_set(test.scene, "particle_spacing", test.spacing);
    weir_test_set(test.scene, "support_radius", 0.15);
    weir_test_set(test.scene, "sound_speed", 20);
    CHECK_SCENE(test.scene, weir_scene_set_domain(test.scene, (double[]){0, 0, 0}, size), WEIR_OK);
    WeirWorld *world = &test.world;
    world->particles.dimension = dimension;
    world->particles.position = zeroed((size_t)dimension * WEIR_TEST_PARTICLES, sizeof(double));
    world->particles.velocity = zeroed((size_t)dimension * WEIR_TEST_PARTICLES, sizeof(float));
    world->particles.density = zeroed(WEIR_TEST_PARTICLES, sizeof(float));
    world->particles.group = zeroed(WEIR_TEST_PARTICLES, sizeof(uint32_t));
    world->solids = zeroed(WEIR_TEST_SOLIDS, sizeof *world->solids);
    return test;
}

void weir_test_world_free(WeirTestWorld *test)
{
    weir_world_free(&test->world);
    weir_scene_destroy(test->scene);
}

static void add(WeirTestWorld *test, const double at[3], double disorder, double speed, double excess,
                uint32_t group)
{
    WeirParticles *particles = &test->world.particles;
    uint32_t i = particles->count++, dimension = particles->dimension;
    assert_true(i < WEIR_TEST_PARTICLES);
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        double off = disorder * test->spacing * weir_random_range(&test->random, -1, 1);
        particles->position[dimension * i + axis] = at[axis] + off;
        particles->velocity[dimension * i + axis] = (float)(speed * weir_random_range(&test->random, -1, 1));
    }
    double rest = weir_scene_resolved(test->scene).rest_density;
    particles->density[i] = (float)(rest * (1 + excess * weir_random_range(&test->random, 0, 1)));
    particles->group[i] = group;
}

static bool is_inside(const double at[3], const double min[3], const double max[3], uint32_t dimension)
{
    for (uint32_t axis = 0; axis < dimension; ++axis)
        if (at[axis] < min[axis] || at[axis] > max[axis]) return false;
    return true;
}

typedef struct Sites {
    double min[3];
    int count[3];
} Sites;

static Sites sites_of(const WeirTestWorld *test, const double min[3], const double max[3])
{
    Sites sites = {{0, 0, 0}, {1, 1, 1}};
    for (uint32_t axis = 0; axis < test->world.particles.dimension; ++axis) {
        sites.min[axis] = min[axis] + 0.5 * test->spacing;
        sites.count[axis] = (int)floor((max[axis] - min[axis]) / test->spacing + 0.5);
    }
    return sites;
}

static void site(const WeirTestWorld *test, const Sites *sites, int n, double at[3])
{
    int index[3] = {n % sites->count[0], n / sites->count[0] % sites->count[1],
                    n / sites->count[0] / sites->count[1]};
    for (int axis = 0; axis < 3; ++axis) at[axis] = sites->min[axis] + index[axis] * test->spacing;
}

void weir_test_world_fluid(WeirTestWorld *test, const double min[3], const double max[3], double disorder,
                           double speed)
{
    Sites sites = sites_of(test, min, max);
    for (int n = 0; n < sites.count[0] * sites.count[1] * sites.count[2]; ++n) {
        double at[3];
        site(test, &sites, n, at);
        add(test, at, disorder, speed, 0.01, WEIR_GROUP_FLUID);
    }
    test->world.particles.fluid_slots = test->world.particles.count;
}

void weir_test_world_slots(WeirTestWorld *test, uint32_t count)
{
    for (uint32_t n = 0; n < count; ++n) add(test, (double[]){0, 0, 0}, 0, 0, 0, WEIR_GROUP_EMPTY);
    test->world.particles.fluid_slots = test->world.particles.count;
}

WeirSolid *weir_test_world_solid(WeirTestWorld *test, WeirSolidKind kind, const double min[3],
                                 const double max[3], const double hole_min[3], const double hole_max[3])
{
    WeirWorld *world = &test->world;
    uint32_t dimension = world->particles.dimension;
    assert_true(world->solid_count < WEIR_TEST_SOLIDS);
    WeirSolid *solid = &world->solids[world->solid_count];
    *solid = (WeirSolid){.kind = kind, .no_slip = 1, .first = world->particles.count};
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        solid->position[axis] = (float)(0.5 * (min[axis] + max[axis]));
        solid->freedom[axis] = 1.0f;
    }
    Sites sites = sites_of(test, min, max);
    for (int n = 0; n < sites.count[0] * sites.count[1] * sites.count[2]; ++n) {
        double at[3];
        site(test, &sites, n, at);
        if (!is_inside(at, hole_min, hole_max, dimension))
            add(test, at, 0, 0, 0, WEIR_GROUP_SOLID + world->solid_count);
    }
    solid->count = world->particles.count - solid->first;
    ++world->solid_count;
    return solid;
}

WeirSolid *weir_test_world_sides(WeirTestWorld *test)
{
    double min[3], max[3], low[3], high[3];
    weir_scene_domain(test->scene, min, max);
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = min[axis] - 3 * test->spacing;
        high[axis] = max[axis] + 3 * test->spacing;
    }
    return weir_test_world_solid(test, WEIR_SOLID_FIXED, low, high, min, max);
}

void weir_test_world_body(WeirTestWorld *test, WeirSolid *solid, const double min[3], const double max[3],
                          double density)
{
    double side[3] = {0, 0, 0}, mass = density;
    for (uint32_t axis = 0; axis < test->world.particles.dimension; ++axis) {
        side[axis] = max[axis] - min[axis];
        mass *= side[axis];
    }
    solid->mass = (float)mass;
    for (int axis = 0; axis < 3; ++axis) {
        int b = (axis + 1) % 3, c = (axis + 2) % 3;
        bool turns = test->world.particles.dimension == 3 || axis == 2;
        double inertia = mass / 12 * (side[b] * side[b] + side[c] * side[c]);
        solid->inverse_inertia[axis][axis] = turns ? (float)(1 / inertia) : 0.0f;
        solid->angular_freedom[axis] = turns ? 1.0f : 0.0f;
    }
}

void weir_test_world_motion(WeirTestWorld *test, WeirSolid *solid, const float (*rows)[13], uint32_t count,
                            bool repeats)
{
    WeirWorld *world = &test->world;
    WeirMotionRow *motion = realloc(world->motion, (world->motion_count + count) * sizeof *motion);
    assert_non_null(motion);
    world->motion = motion;
    for (uint32_t n = 0; n < count; ++n) {
        WeirMotionRow *row = &motion[world->motion_count + n];
        *row = (WeirMotionRow){.time = rows[n][0]};
        memcpy(row->displacement, rows[n] + 1, sizeof row->displacement);
        memcpy(row->rotation, rows[n] + 4, sizeof row->rotation);
        memcpy(row->displacement_rate, rows[n] + 7, sizeof row->displacement_rate);
        memcpy(row->rotation_rate, rows[n] + 10, sizeof row->rotation_rate);
    }
    solid->motion_first = world->motion_count;
    solid->motion_count = count;
    solid->motion_repeats = repeats;
    world->motion_count += count;
}

WeirSolverSetup weir_test_world_setup(const WeirTestWorld *test)
{
    WeirSolverSetup setup = {.method = WEIR_METHOD_WCSPH, .world = &test->world, .threads = 1};
    setup.parameters = weir_scene_resolved(test->scene);
    const WeirParticles *particles = &test->world.particles;
    weir_constants_make(&setup.constants, test->scene, &setup.parameters, particles->count, NULL);
    setup.constants.first_solid = particles->fluid_slots;
    setup.constants.solid_count = test->world.solid_count;
    return setup;
}

WeirSolver *weir_test_world_solver(const WeirTestWorld *test, const WeirBackend *backend)
{
    WeirSolverSetup setup = weir_test_world_setup(test);
    WeirStatus status = WEIR_OK;
    WeirMessage message = {""};
    WeirSolver *solver = backend->create_solver(backend, &setup, &status, &message);
    if (!solver) fail_msg("no solver: %s", message.text);
    return solver;
}
