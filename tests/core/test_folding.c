// A domain with more cells than the grid may have is folded: far away fluid shares cells, and nothing else changes.
#include <math.h>
#include <stdlib.h>

#include "common/build.h"
#include "core/grid.h"
#include "core/sim.h"

static const double spacing = 0.05;

static void add_strip(WeirScene *scene, const double min[3], const double max[3], double speed)
{
    const double velocity[3] = {speed, -speed, 0.5 * speed};
    CHECK_SCENE(scene, weir_scene_add_box(scene, min, max, velocity), WEIR_OK);
}

// Velocities by id, so that every neighbour counts everywhere.
static void disturb(WeirSim *sim)
{
    WeirRandom random = {4711};
    float *place = weir_test_read(sim, WEIR_FIELD_POSITION),
          *velocity = weir_test_read(sim, WEIR_FIELD_VELOCITY);
    for (uint32_t k = 0; k < weir_sim_dimension(sim) * weir_sim_particle_count(sim); ++k)
        velocity[k] += (float)weir_random_range(&random, -0.3, 0.3);
    weir_test_set_state(sim, place, velocity);
    free(place);
    free(velocity);
}

// Two strips that meet at 0.4 m/s, in a domain that reaches `room` metres farther on all sides; and where there
// is room, strips elsewhere that fold onto them.
static WeirSim *meeting_strips(uint32_t dimension, double room)
{
    WeirScene *scene = weir_scene_create();
    assert_non_null(scene);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    weir_test_set(scene, "support_radius", 0.13);
    weir_test_set(scene, "sound_speed", 20);
    weir_test_set(scene, "time_step", 0.001);
    weir_test_choose(scene, "stepping", "fixed");
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "parameters.gravity", (double[]){0, 0, 0}, dimension),
                WEIR_OK);
    bool deep = dimension == 3;
    CHECK_SCENE(scene,
                weir_scene_set_string(scene, "domain.open", deep ? "-x +x -y +y -z +z" : "-x +x -y +y"),
                WEIR_OK);
    double length = deep ? 3.0 : 20.0, rim = 0.3 + room;
    weir_scene_set_domain(scene, (double[3]){-rim, -rim, -rim},
                          (double[3]){2.0 * length + rim, 0.2 + rim, 0.1 + rim});
    add_strip(scene, (double[3]){0, 0, 0}, (double[3]){length, 0.2, 0.1}, 0.2);
    add_strip(scene, (double[3]){length, 0, 0}, (double[3]){2.0 * length, 0.2, 0.1}, -0.2);
    for (int n = 1; room > 0.0 && n <= 5; ++n) {
        double x = 7.3 * n, y = 0.17 * room * (n - 3.5), z = -0.15 * room * (n - 2.6);
        add_strip(scene, (double[3]){x, y, z}, (double[3]){x + 3, y + 0.1, z + 0.1}, 0.2);
        add_strip(scene, (double[3]){x, y + 1, z + 1}, (double[3]){x + 0.1, y + 2, z + 1.1}, -0.2);
    }
    WeirSim *sim = weir_test_sim(scene, weir_cpu_backend(), 2);
    weir_scene_destroy(scene);
    disturb(sim);
    return sim;
}

static void check_folding(uint32_t dimension)
{
    WeirSim *near = meeting_strips(dimension, 0.0), *far = meeting_strips(dimension, 60.0);
    const WeirConstants *folded = weir_sim_constants(far);
    double limit = fmax(65536.0, 4.0 * weir_sim_particle_count(far));
    CHECK_AT_MOST(folded->cell_count, limit);
    assert_true(weir_grid_folds_columns(folded));
    assert_int_equal(folded->column_shift, folded->coordinate_bits - 3); // as fine as ever
    assert_false(weir_grid_folds_columns(weir_sim_constants(near)));
    weir_test_step(near, 6); // before rounding puts a particle on the other side of a switch of shifting
    weir_test_step(far, 6);
    float *x = weir_test_read(near, WEIR_FIELD_POSITION), *y = weir_test_read(far, WEIR_FIELD_POSITION);
    float *a = weir_test_read(near, WEIR_FIELD_DENSITY), *b = weir_test_read(far, WEIR_FIELD_DENSITY);
    for (uint32_t i = 0; i < weir_sim_particle_count(near); ++i) {
        for (uint32_t axis = 0; axis < dimension; ++axis)
            CHECK_NEAR(y[dimension * i + axis], x[dimension * i + axis], 2e-3 * spacing);
        CHECK_NEAR(b[i], a[i], 0.05);
    }
    // They have met: otherwise nothing was compared.
    CHECK_AT_MOST(1.0, weir_sim_clock(near).max_density_error * 1e3);
    free(x);
    free(y);
    free(a);
    free(b);
    weir_sim_destroy(near);
    weir_sim_destroy(far);
}

static void folding_changes_nothing_in_2d(void **state)
{
    (void)state;
    check_folding(2);
}

static void folding_changes_nothing_in_3d(void **state)
{
    (void)state;
    check_folding(3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(folding_changes_nothing_in_2d),
        cmocka_unit_test(folding_changes_nothing_in_3d),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
