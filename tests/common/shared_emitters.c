// Emitters and drains: what is born, when, where, in which slots, and that nothing is lost, many at once too.
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

// ---- When layers come ----

// Two nozzles that blow down, far from each other and above a drain each, and one particle of fluid.
enum { TAPS = 2 };
typedef struct Taps {
    double speed[TAPS];
    uint32_t interval; // steps between chances, at a sound speed of 10
    bool fixed;        // time steps, half as long as the others
} Taps;

static const double nozzle_y = 0.5, tap_start[TAPS] = {0, 0.013};

static double tap_x(uint32_t n)
{
    return (10.5 + 20 * n) * spacing;
}

static WeirSim *open_taps(const WeirBackend *backend, const Taps *taps, double stop)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene,
                weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){40 * spacing, 40 * spacing, 0}),
                WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    weir_test_set(scene, "support_radius", 2.5 * spacing);
    weir_test_set(scene, "sound_speed", 10);
    weir_test_gravity(scene, 0, 0);
    if (taps->fixed) {
        weir_test_choose(scene, "stepping", "fixed");
        weir_test_set(scene, "time_step", 0.5 * weir_scene_stable_time_step(scene));
    }
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){spacing, spacing, 0}, NULL),
                WEIR_OK);
    for (uint32_t n = 0; n < TAPS; ++n) {
        double x = tap_x(n), one = spacing, slots = 60;
        set(scene, "emitters", n, "center", (double[]){x, nozzle_y}, 2);
        set(scene, "emitters", n, "direction", (double[]){0, -1}, 2);
        set(scene, "emitters", n, "size", &one, 1);
        set(scene, "emitters", n, "speed", &taps->speed[n], 1);
        set(scene, "emitters", n, "capacity", &slots, 1);
        set(scene, "emitters", n, "start", &tap_start[n], 1);
        if (stop > 0) set(scene, "emitters", n, "stop", &stop, 1);
        set(scene, "drains", n, "min", (double[]){x - 9 * spacing, 0}, 2);
        set(scene, "drains", n, "max", (double[]){x + 9 * spacing, nozzle_y - 2 * spacing}, 2);
    }
    WeirSim *sim = weir_test_sim(scene, backend, 0);
    weir_scene_destroy(scene);
    return sim;
}

// All that is upstream of its nozzle is where its flow would have brought it from the place of birth if it had been born when
// it was due, and the last layer is there before that, by no more than half a spacing.
static void check_layers(WeirSim *sim, const Taps *taps)
{
    float *position = weir_test_read(sim, WEIR_FIELD_POSITION),
          *group = weir_test_read(sim, WEIR_FIELD_GROUP);
    CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
    WeirClock clock = weir_sim_clock(sim);
    double reach = weir_sim_constants(sim)->search_radius;
    assert_int_equal(clock.fluid_particles, living(sim));
    assert_int_equal(clock.lost_particles, 0);
    for (uint32_t n = 0; n < TAPS; ++n) {
        double travel = taps->speed[n] * (clock.time - tap_start[n]), last = -INFINITY;
        uint32_t upstream = 0;
        for (uint32_t i = 0; i < weir_sim_fluid_slots(sim); ++i) {
            double x = position[2 * i], y = position[2 * i + 1];
            if (group[i] != 0 || fabs(x - tap_x(n)) > 0.1 * spacing || y < nozzle_y + 0.01 * spacing)
                continue;
            double layer = (travel - (nozzle_y + reach - y)) / spacing; // its number
            CHECK_NEAR(layer, round(layer), 0.01);
            assert_true(layer > -0.01);
            last = fmax(last, round(layer));
            ++upstream;
        }
        double due = travel / spacing, first = fmax(floor((travel - reach) / spacing + 0.01) + 1, 0);
        assert_true(due < 0 || last > due - 1.01);
        assert_true(last < due + 0.51);
        if (upstream > 0) assert_int_equal(upstream, last - first + 1); // none is missing or twice
    }
    free(position);
    free(group);
}

static const Taps tap_cases[] = {
    {{0.3, 0.4}, 4, false}, {{1.6, 0.5}, 4, false}, {{0.2, 3}, 2, false},
    {{5, 1}, 1, false},     {{3, 1}, 4, true},
};
enum { TAP_CASES = sizeof tap_cases / sizeof tap_cases[0] };

// However steps are cut into calls and times to end at, layers come before steps whose number the interval divides, never
// late, and one spacing apart.
static void layers_come_at_chances(const WeirBackend *backend)
{
    for (int n = 0; n < TAP_CASES; ++n) {
        const Taps *taps = &tap_cases[n];
        WeirSim *sim = open_taps(backend, taps, 0);
        uint32_t born = 0, births = 0, more = 0;
        for (uint32_t step = 1; step <= 48; ++step) {
            weir_test_step(sim, 1);
            WeirClock clock = weir_sim_clock(sim);
            uint32_t now = clock.fluid_particles + clock.drained_particles - 1;
            if (now > born) {
                assert_int_equal((step - 1) % taps->interval, 0);
                more += (step - 1) % WEIR_EMISSION_INTERVAL > 0;
                ++births;
            }
            born = now;
            if (step % 3 == 0) check_layers(sim, taps);
        }
        assert_true(births >= 2 && (more > 0) == (taps->interval < WEIR_EMISSION_INTERVAL));
        for (int k = 0; k < 20; ++k) {
            CHECK_SIM(sim, weir_sim_run_until(sim, weir_sim_time(sim) + 0.0037 * (1 + k % 3)), WEIR_OK);
            if (k % 2) weir_test_step(sim, 1 + (uint32_t)k % 7);
            check_layers(sim, taps);
        }
        weir_sim_destroy(sim);
    }
}

// All layers that are due until a tap is closed come, the last moment's too.
static void closed_taps_have_given_their_due(const WeirBackend *backend)
{
    for (int n = 0; n < TAP_CASES; ++n) {
        const Taps *taps = &tap_cases[n];
        double stop = tap_start[1] + 10.001 * spacing / taps->speed[1], due = 0;
        for (uint32_t k = 0; k < TAPS; ++k)
            due += 1 + floor((stop - tap_start[k]) * taps->speed[k] / spacing);
        WeirSim *sim = open_taps(backend, taps, stop);
        CHECK_SIM(sim, weir_sim_run_until(sim, 1.1 * stop), WEIR_OK);
        CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
        WeirClock clock = weir_sim_clock(sim);
        assert_int_equal(clock.fluid_particles + clock.drained_particles - 1, due);
        weir_sim_destroy(sim);
    }
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(layers_come_at_chances),     WEIR_SHARED_TEST(closed_taps_have_given_their_due),
    WEIR_SHARED_TEST(layers_take_slots_in_order), WEIR_SHARED_TEST(a_thousand_emitters_and_drains),
    WEIR_SHARED_TEST(emitters_share_few_slots),
};
WEIR_SHARED_GROUP(emitters, tests);
