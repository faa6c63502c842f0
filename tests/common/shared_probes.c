// Probes: what is sampled while a simulation runs is what src/core/probe.c measures of the state that may be read.
#include <math.h>
#include <stdio.h>

#include "common/build.h"
#include "common/shared.h"
#include "core/probe.h"
#include "core/sim.h"
#include "weir/weir_probe.h"

static void set(WeirScene *scene, uint32_t k, const char *key, const double values[3])
{
    char path[64];
    snprintf(path, sizeof path, "probes[%u].%s", k, key);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, values, weir_scene_dimension(scene)), WEIR_OK);
}

static uint32_t add(WeirScene *scene, const char *kind, const char *target)
{
    char path[64];
    uint32_t k = scene->probe_count;
    snprintf(path, sizeof path, "probes[%u].kind", k);
    CHECK_SCENE(scene, weir_scene_set_string(scene, path, kind), WEIR_OK);
    snprintf(path, sizeof path, "probes[%u].rate", k);
    CHECK_SCENE(scene, weir_scene_set_number(scene, path, 1e5), WEIR_OK); // at every update
    snprintf(path, sizeof path, "probes[%u].target", k);
    if (target) CHECK_SCENE(scene, weir_scene_set_string(scene, path, target), WEIR_OK);
    return k;
}

// Every kind: in the fluid, at its border, at the domain's, across it, and where there is none.
static void add_all(WeirScene *scene)
{
    static const double points[][3] = {
        {-2.8, 7.15, 1.2}, {-2.99, 7.01, 1.01}, {-2.6, 7.35, 1.3}, {-2.2, 7.35, 1.18}, {-2.05, 7.55, 1.2}};
    for (int n = 0; n < 5; ++n) {
        set(scene, add(scene, "pressure", NULL), "position", points[n]);
        set(scene, add(scene, "velocity", NULL), "position", points[n]);
        set(scene, add(scene, "height", NULL), "position", points[n]);
    }
    add(scene, "force", "domain");
    add(scene, "force", "body");
    set(scene, add(scene, "front", NULL), "direction", (double[]){2, 0, 0});
    set(scene, add(scene, "front", NULL), "direction", (double[]){-1, -2, 0.5});
    uint32_t whole = add(scene, "mass", NULL), part = add(scene, "mass", NULL);
    set(scene, whole, "min", (double[]){-9, 6, 0});
    set(scene, whole, "max", (double[]){1, 9, 2});
    set(scene, part, "min", (double[]){-2.87, 7.03, 1.1});
    set(scene, part, "max", (double[]){-2.71, 7.17, 1.2});
}

// The last sample of each against the state. Counts the numbers that say something.
static uint32_t check_samples(const WeirProbes *probes, WeirSim *sim)
{
    const WeirScene *scene = weir_sim_scene(sim);
    WeirState state;
    CHECK_SIM(sim, weir_sim_state(sim, &state), WEIR_OK);
    uint32_t telling = 0;
    for (uint32_t k = 0; k < weir_probes_count(probes); ++k) {
        const WeirProbePiece *piece = &scene->probe[k];
        WeirProbeSeries series = weir_probe_series(probes, k);
        uint32_t solid = 0, components = weir_probe_components(piece, scene->dimension);
        double wanted[3];
        if (piece->kind == WEIR_PROBE_FORCE) assert_true(weir_probe_target(scene, piece->target, &solid));
        weir_probe_measure(piece, solid, &state, weir_sim_parameters(sim), weir_sim_constants(sim), wanted);
        assert_true(series.count > 0);
        CHECK_NEAR(series.time[series.count - 1], weir_sim_time(sim), 1e-12);
        for (uint32_t axis = 0; axis < components; ++axis) {
            double found = series.values[(series.count - 1) * components + axis];
            if (isnan(wanted[axis])) assert_true(isnan(found));
            if (isnan(wanted[axis])) continue;
            bool is_single = piece->kind == WEIR_PROBE_FRONT; // the rest is summed in double, in one order
            CHECK_NEAR(found, wanted[axis], is_single ? 1e-6 * fabs(wanted[axis]) : 0);
            telling += wanted[axis] != 0.0;
        }
    }
    return telling;
}

static void measure_the_state(const WeirBackend *backend)
{
    for (uint32_t dimension = 2; dimension <= 3; ++dimension) {
        WeirScene *scene = weir_test_everything(dimension);
        add_all(scene);
        WeirSim *sim = weir_test_sim(scene, backend, 1);
        WeirProbes *probes = weir_probes_create(sim);
        assert_non_null(probes);
        for (int n = 0; n < 4; ++n) {
            CHECK_SIM(sim, weir_probes_update(probes, sim), WEIR_OK);
            assert_true(check_samples(probes, sim) >= 16);
            // The lines of heights follow gravity.
            const double aside[3] = {-6, -3, 1};
            if (n == 2) CHECK_SIM(sim, weir_sim_set_parameter(sim, "gravity", aside, dimension), WEIR_OK);
            weir_test_step(sim, 25);
        }
        weir_probes_destroy(probes);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// Each alone, so that no other one looks at the same fluid.
static void measure_across_periodic_borders(const WeirBackend *backend)
{
    static const char *const kinds[] = {"pressure", "velocity", "height"};
    static const double places[][3] = {{-2.005, 7.1, 0}, {-2.99, 7.1, 0}, {-2.998, 7.5, 0}};
    for (uint32_t k = 0; k < 3; ++k) {
        WeirScene *scene = weir_test_everything(2);
        CHECK_SCENE(scene, weir_scene_set_string(scene, "domain.periodic", "x"), WEIR_OK);
        weir_test_box(scene, -2.06, 7, -2, 7.3); // and the rest beyond the border
        set(scene, add(scene, kinds[k], NULL), "position", places[k]);
        WeirSim *sim = weir_test_sim(scene, backend, 1);
        WeirProbes *probes = weir_probes_create(sim);
        assert_non_null(probes);
        for (int n = 0; n < 2; ++n) {
            weir_test_step(sim, 15);
            CHECK_SIM(sim, weir_probes_update(probes, sim), WEIR_OK);
            assert_true(check_samples(probes, sim) > 0);
        }
        weir_probes_destroy(probes);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
}

// With samples and without, in other orders, the run is the same.
static void change_nothing(const WeirBackend *backend)
{
    uint64_t hash[2];
    for (int sampled = 0; sampled < 2; ++sampled) {
        WeirScene *scene = weir_test_everything(2);
        if (sampled) add_all(scene);
        WeirSim *sim = weir_test_sim(scene, backend, 1);
        WeirProbes *probes = weir_probes_create(sim);
        assert_non_null(probes);
        for (int n = 0; n < 5; ++n) {
            weir_test_step(sim, 7);
            CHECK_SIM(sim, weir_probes_update(probes, sim), WEIR_OK);
            if (n == 1) weir_test_diagnose(sim, 0);
        }
        hash[sampled] = weir_test_hash(sim);
        weir_probes_destroy(probes);
        weir_sim_destroy(sim);
        weir_scene_destroy(scene);
    }
    assert_true(hash[0] == hash[1]);
}

static const WeirSharedTest tests[] = {
    WEIR_SHARED_TEST(measure_the_state),
    WEIR_SHARED_TEST(measure_across_periodic_borders),
    WEIR_SHARED_TEST(change_nothing),
};
extern const WeirSharedGroup weir_shared_probes;
WEIR_SHARED_GROUP(probes, tests);
