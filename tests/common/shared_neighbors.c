// Density, pressure, acceleration and neighbour counts against brute force in double precision, on random
// sets and on the sets that break grids.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/build.h"
#include "common/reference.h"
#include "common/shared.h"
#include "core/sim.h"

enum { MAX_COUNT = 300 };

typedef struct PointSet {
    uint32_t count;
    double size, spacing, support;
    float position[2 * MAX_COUNT], velocity[2 * MAX_COUNT];
} PointSet;

static void random_velocities(PointSet *set, WeirRandom *random)
{
    for (uint32_t k = 0; k < 2 * set->count; ++k) set->velocity[k] = (float)weir_random_range(random, -1, 1);
}

// Rounding in single precision: every sum has fewer than `count` terms and each is off by a few units in the
// last place; distances from positions of the size of the domain lose size / support more.
static double round_off(const PointSet *set)
{
    return 3e-6 * (1 + set->size / set->support);
}

static void compare(const PointSet *set, WeirSim *sim, const WeirReference *reference)
{
    float *density = weir_test_read(sim, WEIR_FIELD_DENSITY),
          *pressure = weir_test_read(sim, WEIR_FIELD_PRESSURE);
    float *acceleration = weir_test_read(sim, WEIR_FIELD_ACCELERATION);
    const WeirParameters *parameters = weir_sim_parameters(sim);
    double share = round_off(set), rest = parameters->rest_density, neighbors = 0;
    for (uint32_t i = 0; i < set->count; ++i) {
        double density_error = share * (reference->density[i] + rest);
        CHECK_NEAR(density[i], reference->density[i], density_error);
        CHECK_NEAR(pressure[i], reference->pressure[i], parameters->gas_constant * density_error);
        double scale = share * reference->acceleration_scale[i];
        CHECK_NEAR(acceleration[2 * i], reference->acceleration[2 * i], scale);
        CHECK_NEAR(acceleration[2 * i + 1], reference->acceleration[2 * i + 1], scale);
        neighbors += reference->neighbors[i];
    }
    CHECK_NEAR(weir_test_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS).mean_neighbors, neighbors / set->count,
               1e-12 * neighbors);
    free(density);
    free(pressure);
    free(acceleration);
}

static void check_kernels(const PointSet *set, const WeirBackend *backend, const char *kernels,
                          double negative_pressure)
{
    WeirScene *scene = weir_test_count_scene(set->count, set->size, set->spacing, set->support);
    weir_test_set(scene, "viscosity", 3);
    weir_test_set(scene, "negative_pressure", negative_pressure);
    weir_test_gravity(scene, 1, -9.81);
    weir_test_choose(scene, "kernels", kernels);
    WeirReference reference = {0};
    static const char *const searches[] = {"grid", "all_pairs"};
    for (int n = 0; n < 2; ++n) {
        weir_test_choose(scene, "search", searches[n]);
        WeirSim *sim = weir_test_sim(scene, backend, 2);
        weir_test_set_state(sim, set->position, set->velocity);
        if (n == 0)
            weir_reference_evaluate(&reference, weir_sim_parameters(sim), set->count, set->position,
                                    set->velocity);
        CHECK_NEAR(weir_sim_constants(sim)->particle_mass, weir_reference_mass(weir_sim_parameters(sim)),
                   1e-6 * weir_sim_constants(sim)->particle_mass);
        compare(set, sim, &reference);
        weir_sim_destroy(sim);
    }
    weir_reference_free(&reference);
    weir_scene_destroy(scene);
}

static void check_set(const PointSet *set, const WeirBackend *backend)
{
    check_kernels(set, backend, "consistent", 0);
    check_kernels(set, backend, "consistent", 1);
    check_kernels(set, backend, "tutorial", 0);
}

static void random_sets(const WeirBackend *backend)
{
    WeirRandom random = {.state = 7};
    for (int repeat = 0; repeat < 3; ++repeat) {
        PointSet set = {.count = 200 + 37 * (uint32_t)repeat, .size = 1, .spacing = 0.05, .support = 0.11};
        for (uint32_t k = 0; k < 2 * set.count; ++k)
            set.position[k] = (float)weir_random_range(&random, 0, set.size);
        random_velocities(&set, &random);
        check_set(&set, backend);
    }
}

static void all_in_one_cell(const WeirBackend *backend)
{
    WeirRandom random = {.state = 8};
    PointSet set = {.count = 150, .size = 1, .spacing = 0.05, .support = 0.11};
    for (uint32_t k = 0; k < 2 * set.count; ++k)
        set.position[k] = (float)weir_random_range(&random, 0.501, 0.509);
    random_velocities(&set, &random);
    check_set(&set, backend);
}

// Multiples of the support radius and of its fractions: the borders of any cells that a grid may choose. Many
// pairs are exactly one support radius apart and must count as no neighbours. 1/8 is exact in binary.
static void on_cell_borders(const WeirBackend *backend)
{
    WeirRandom random = {.state = 9};
    PointSet set = {.count = 17 * 17, .size = 1, .spacing = 0.05, .support = 0.125};
    for (uint32_t i = 0; i < set.count; ++i) {
        set.position[2 * i] = (float)(i % 17) * 0.0625f;
        set.position[2 * i + 1] = (float)(i / 17) * 0.0625f;
    }
    random_velocities(&set, &random);
    check_set(&set, backend);
}

// The borders as the grid itself computes them, and the floats next to them.
static void beside_cell_borders(const WeirBackend *backend)
{
    WeirRandom random = {.state = 10};
    PointSet set = {.count = 240, .size = 1, .spacing = 0.05, .support = 0.11};
    WeirScene *scene = weir_test_count_scene(set.count, set.size, set.spacing, set.support);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    const WeirConstants *constants = weir_sim_constants(sim);
    for (uint32_t i = 0; i < set.count; ++i) {
        uint32_t column = weir_random_next(&random) % constants->cell_columns;
        uint32_t row = weir_random_next(&random) % constants->cell_rows;
        float border[2] = {(float)(column / (double)constants->inverse_cell_width),
                           (float)(row / (double)constants->inverse_cell_height)};
        for (int axis = 0; axis < 2; ++axis) {
            uint32_t side = weir_random_next(&random) % 3;
            // Not beside 0 itself: floats there are closer than any distance that means something.
            float next = nextafterf(fmaxf(border[axis], 1e-6f), side == 1 ? 0.0f : 1.0f);
            float value = side == 0 ? border[axis] : next;
            set.position[2 * i + axis] = fminf(fmaxf(value, 0.0f), 1.0f);
        }
    }
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
    random_velocities(&set, &random);
    check_set(&set, backend);
}

static void at_domain_corners(const WeirBackend *backend)
{
    WeirRandom random = {.state = 11};
    PointSet set = {.count = 120, .size = 1, .spacing = 0.05, .support = 0.11};
    for (uint32_t i = 0; i < set.count; ++i) {
        bool exact = i < 4;
        for (uint32_t axis = 0; axis < 2; ++axis) {
            double inward = exact ? 0 : weir_random_range(&random, 0, 0.08);
            set.position[2 * i + axis] = (float)((i >> axis & 1) ? 1 - inward : inward);
        }
    }
    random_velocities(&set, &random);
    check_set(&set, backend);
}

static void coincident_particles(const WeirBackend *backend)
{
    WeirRandom random = {.state = 12};
    PointSet set = {.count = 60, .size = 1, .spacing = 0.05, .support = 0.11};
    for (uint32_t i = 0; i < set.count; ++i) {
        set.position[2 * i] = 0.3f + 0.05f * (float)(i % 4);
        set.position[2 * i + 1] = 0.7f;
    }
    random_velocities(&set, &random);
    check_set(&set, backend);
}

static void support_beyond_domain(const WeirBackend *backend)
{
    WeirRandom random = {.state = 13};
    PointSet set = {.count = 64, .size = 0.2, .spacing = 0.02, .support = 0.6};
    for (uint32_t k = 0; k < 2 * set.count; ++k)
        set.position[k] = (float)weir_random_range(&random, 0, set.size);
    random_velocities(&set, &random);
    check_set(&set, backend);
}

// A domain with more cells than the grid: clusters that share its cells with each other, some across its borders, and the
// domain's far corner.
static void clusters_in_a_folded_grid(const WeirBackend *backend)
{
    enum { CLUSTERS = 10, EACH = 30 };
    WeirRandom random = {.state = 14};
    PointSet set = {.count = CLUSTERS * EACH, .size = 40, .spacing = 0.05, .support = 0.11};
    WeirScene *scene = weir_test_count_scene(set.count, set.size, set.spacing, set.support);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    const WeirConstants *constants = weir_sim_constants(sim);
    assert_true(constants->domain_columns > constants->cell_columns);
    assert_true(constants->domain_rows > constants->cell_rows);
    assert_true(constants->cell_count <= 65536);
    double width = constants->cell_columns / (double)constants->inverse_cell_width;
    double height = constants->cell_rows / (double)constants->inverse_cell_height;
    for (uint32_t n = 0; n < CLUSTERS; ++n) {
        double x = 0.3 + (n % 2 ? width : 0.0), y = 0.2 + (n % 3 ? height : 0.0);
        if (n >= 4 && n < 9) x = width - 0.1 * n / 3; // across the border
        if (n >= 6 && n < 9) y = height - 0.05 * (n - 5);
        if (n == 9) x = y = set.size - 0.3;
        for (uint32_t k = n * EACH; k < (n + 1) * EACH; ++k) {
            set.position[2 * k] = (float)(x + weir_random_range(&random, 0, 0.3));
            set.position[2 * k + 1] = (float)(y + weir_random_range(&random, 0, 0.3));
        }
    }
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
    random_velocities(&set, &random);
    check_set(&set, backend);
}

// A small block, alone or with one particle 50 m away: as many candidates.
static void a_far_particle_costs_nothing(const WeirBackend *backend)
{
    double candidates[2];
    for (int far = 0; far < 2; ++far) {
        WeirScene *scene = weir_test_scene(0.05, 0.11, 0, far ? 60 : 3);
        weir_test_box(scene, 0, 0, 1, 1);
        if (far) weir_test_box(scene, 50, 50, 50.05, 50.05);
        WeirSim *sim = weir_test_sim(scene, backend, 1);
        WeirNeighborCount found;
        WeirStatus status;
        while ((status = weir_sim_count_neighbors(sim, 0, &found)) == WEIR_PENDING)
            CHECK_SIM(sim, weir_sim_wait(sim), WEIR_OK);
        CHECK_SIM(sim, status, WEIR_OK);
        candidates[far] = found.candidates;
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
    assert_true(candidates[0] > 10);
    CHECK_NEAR(candidates[1], candidates[0], 0.05 * candidates[0]);
}

static void one_particle(const WeirBackend *backend)
{
    PointSet set = {.count = 1, .size = 1, .spacing = 0.05, .support = 0.11};
    set.position[0] = 0.4f, set.position[1] = 1.0f, set.velocity[0] = 3.0f;
    check_set(&set, backend);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(random_sets),
    WEIR_SHARED_TEST(all_in_one_cell),
    WEIR_SHARED_TEST(on_cell_borders),
    WEIR_SHARED_TEST(beside_cell_borders),
    WEIR_SHARED_TEST(at_domain_corners),
    WEIR_SHARED_TEST(coincident_particles),
    WEIR_SHARED_TEST(support_beyond_domain),
    WEIR_SHARED_TEST(one_particle),
    WEIR_SHARED_TEST(clusters_in_a_folded_grid),
    WEIR_SHARED_TEST(a_far_particle_costs_nothing),
};
extern const WeirSharedGroup weir_shared_neighbors;
WEIR_SHARED_GROUP(neighbors, tests);
