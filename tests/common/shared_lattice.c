// A resting lattice has the rest density: the mass is calibrated, whatever kernel and support.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/shared.h"

static void check_lattice(const WeirBackend *backend, double ratio, const char *kernels)
{
    enum { SIDE = 20 };
    const double spacing = 0.02, low = 0.1, rest_density = 850;
    WeirScene *scene = weir_test_scene(spacing, ratio * spacing, 0, 1);
    weir_test_set(scene, "rest_density", rest_density);
    weir_test_choose(scene, "kernels", kernels);
    weir_test_box(scene, low, low, low + SIDE * spacing, low + SIDE * spacing);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    assert_int_equal(weir_sim_particle_count(sim), SIDE * SIDE);
    float *density = weir_test_read(sim, WEIR_FIELD_DENSITY);
    int margin = (int)ceil(ratio), bulk = 0;
    for (int row = margin; row < SIDE - margin; ++row) {
        for (int column = margin; column < SIDE - margin; ++column, ++bulk)
            CHECK_NEAR(density[row * SIDE + column], rest_density, 1e-3 * rest_density);
    }
    assert_true(bulk >= 100);
    // The free surface is not hidden: a corner has lost most of its neighbours.
    assert_true(density[0] < 0.95 * rest_density);
    free(density);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static void bulk_has_rest_density(const WeirBackend *backend)
{
    static const double ratios[] = {1.5, 2, 2.5, 3, 4, 5};
    for (size_t n = 0; n < sizeof ratios / sizeof ratios[0]; ++n) {
        check_lattice(backend, ratios[n], "consistent");
        check_lattice(backend, ratios[n], "tutorial");
    }
}

static void particles_lie_on_their_lattice(const WeirBackend *backend)
{
    WeirScene *scene = weir_test_scene(0.1, 0.25, 0, 1);
    weir_test_box(scene, 0.2, 0.3, 0.5, 0.5);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "fluid[0].velocity", (double[]){2, -3}, 2), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, backend, 1);
    assert_int_equal(weir_sim_particle_count(sim), 6);
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION);
    float *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (int i = 0; i < 6; ++i) { // ids run along x first
        CHECK_NEAR(position[2 * i], 0.25 + 0.1 * (i % 3), 1e-7);
        CHECK_NEAR(position[2 * i + 1], 0.35 + 0.1 * (i / 3), 1e-7);
        CHECK_NEAR(velocity[2 * i], 2, 0);
        CHECK_NEAR(velocity[2 * i + 1], -3, 0);
    }
    free(position);
    free(velocity);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(bulk_has_rest_density),
    WEIR_SHARED_TEST(particles_lie_on_their_lattice),
};
extern const WeirSharedGroup weir_shared_lattice;
WEIR_SHARED_GROUP(lattice, tests);
