// Many emitters and drains at once: what is born, where, in which slots, and that nothing is lost.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/sim.h"

enum {
    COLUMNS = 40,
    ROWS = 25,
    EMITTERS = COLUMNS * ROWS,
    PITCH_X = 10,
    PITCH_Y = 12
}; // pitches in spacings
static const double spacing = 0.02, speed = 1.0;

static uint32_t width_of(uint32_t n)
{
    return 1 + n % 3;
}

static void place_of(uint32_t n, double center[2])
{
    center[0] = (PITCH_X * (n % COLUMNS) + 5.0) * spacing;
    center[1] = (PITCH_Y * (double)(n / COLUMNS) + 6.0) * spacing;
}

static void set(WeirScene *scene, const char *list, uint32_t n, const char *key, const double *values,
                size_t count)
{
    char path[64];
    snprintf(path, sizeof path, "%s[%u].%s", list, n, key);
    WeirStatus status = count == 1 ? weir_scene_set_number(scene, path, *values)
                                   : weir_scene_set_numbers(scene, path, values, count);
    CHECK_SCENE(scene, status, WEIR_OK);
}

// A thousand nozzles, one to three particles wide, that blow down into space without gravity; one particle of fluid.
// `capacity`: slots per particle of a layer, 0: one slot per emitter.
static WeirScene *field(double capacity, double late)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    double size[3] = {COLUMNS * PITCH_X * spacing, ROWS * PITCH_Y * spacing, 0};
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){0, 0, 0}, size), WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    weir_test_set(scene, "support_radius", 2.5 * spacing);
    weir_test_set(scene, "sound_speed", 10);
    weir_test_gravity(scene, 0, 0);
    double one[3] = {spacing, spacing, 0};
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, one, NULL), WEIR_OK);
    for (uint32_t n = 0; n < EMITTERS; ++n) {
        double center[2], slots = capacity > 0 ? capacity * width_of(n) : 1;
        double width = width_of(n) * spacing, start = late * (n % 5);
        place_of(n, center);
        set(scene, "emitters", n, "center", center, 2);
        set(scene, "emitters", n, "direction", (double[]){0, -1}, 2);
        set(scene, "emitters", n, "size", &width, 1);
        set(scene, "emitters", n, "speed", &speed, 1);
        set(scene, "emitters", n, "capacity", &slots, 1);
        set(scene, "emitters", n, "start", &start, 1);
    }
    return scene;
}

// Below each nozzle one drain.
static void add_drains(WeirScene *scene)
{
    for (uint32_t n = 0; n < EMITTERS; ++n) {
        double at[2];
        place_of(n, at);
        double low[2] = {at[0] - 3 * spacing, at[1] - 4 * spacing},
               high[2] = {at[0] + 3 * spacing, at[1] - spacing};
        set(scene, "drains", n, "min", low, 2);
        set(scene, "drains", n, "max", high, 2);
    }
}

static uint32_t living(WeirSim *sim)
{
    float *group = weir_test_read(sim, WEIR_FIELD_GROUP);
    uint32_t count = 0;
    for (uint32_t i = 0; i < weir_sim_fluid_slots(sim); ++i) count += group[i] >= 0;
    free(group);
    return count;
}

// Each layer comes in time, runs through its nozzle and leaves through its drain; the slots are used again.
static void a_thousand_emitters_and_drains(const WeirBackend *backend)
{
    double layer = spacing / speed, late = 0.1 * layer, end = 9.55 * layer;
    WeirScene *scene = field(5, late);
    add_drains(scene);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    // The first layer brings with it all those that are due within half a spacing of flow.
    weir_test_step(sim, 1);
    assert_int_equal(living(sim), 1 + 1999);
    CHECK_SIM(sim, weir_sim_run_until(sim, end), WEIR_OK);
    CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
    uint32_t emitted = 0, now = living(sim);
    for (uint32_t n = 0; n < EMITTERS; ++n)
        emitted += width_of(n) * (1 + (uint32_t)floor((end - late * (n % 5)) / layer));
    WeirClock clock = weir_sim_clock(sim);
    assert_int_equal(clock.lost_particles, 0);
    assert_int_equal(clock.fluid_particles, now);
    assert_int_equal(now, 1 + emitted - clock.drained_particles);
    assert_true(emitted > weir_sim_fluid_slots(sim) + 1000); // many slots were used twice
    // All that has come as far as its drain is gone: from a support radius above the nozzle to a spacing below it.
    assert_true(now > 3 * 1999 && now < 5 * 1999);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Too few slots: layers wait for others to be drained, and no particle is lost or counted twice.
static void emitters_share_few_slots(const WeirBackend *backend)
{
    WeirScene *scene = field(2, 0.1 * spacing / speed);
    add_drains(scene);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    uint32_t drained = 0, slots = weir_sim_fluid_slots(sim);
    for (int n = 0; n < 4; ++n) {
        weir_test_step(sim, 50);
        CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
        WeirClock clock = weir_sim_clock(sim);
        assert_int_equal(clock.fluid_particles, living(sim));
        assert_true(clock.fluid_particles <= slots && clock.drained_particles >= drained);
        drained = clock.drained_particles;
    }
    assert_true(drained > slots / 2);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// Layers of one step take the empty slots from the lowest id on, in order of their emitters; one that does not fit
// leaves its slots to the next.
static void layers_take_slots_in_order(const WeirBackend *backend)
{
    WeirScene *scene = field(0, 0);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "xy"), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    double reach = weir_sim_constants(sim)->search_radius;
    weir_test_step(sim, 1);
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *group = weir_test_read(sim, WEIR_FIELD_GROUP);
    uint32_t slots = weir_sim_fluid_slots(sim), id = 1, born = 0;
    assert_int_equal(slots, 1 + EMITTERS);
    for (uint32_t n = 0; n < EMITTERS; ++n) {
        double center[2];
        place_of(n, center);
        if (width_of(n) > slots - id) continue;
        for (uint32_t k = 0; k < width_of(n); ++k, ++id) {
            assert_true(group[id] == 0);
            CHECK_NEAR(position[2 * id], center[0] + (k + 0.5 - 0.5 * width_of(n)) * spacing, 1e-3 * spacing);
            CHECK_NEAR(position[2 * id + 1], center[1] + reach, 0.1 * spacing);
        }
        ++born;
    }
    assert_int_equal(id, slots); // the last slot fits an emitter of one particle
    assert_true(born > 490 && born < 510);
    // Nothing leaves this domain, so the others wait for ever.
    weir_test_step(sim, 60);
    CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
    assert_int_equal(weir_sim_clock(sim).fluid_particles, slots);
    free(position);
    free(group);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(layers_take_slots_in_order),
    WEIR_SHARED_TEST(a_thousand_emitters_and_drains),
    WEIR_SHARED_TEST(emitters_share_few_slots),
};
WEIR_SHARED_GROUP(emitters, tests);
