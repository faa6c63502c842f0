#include "common/build.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/solver.h"

uint32_t weir_random_next(WeirRandom *random)
{
    random->state ^= random->state >> 12;
    random->state ^= random->state << 25;
    random->state ^= random->state >> 27;
    return (uint32_t)((random->state * 0x2545F4914F6CDD1Du) >> 32);
}

double weir_random_range(WeirRandom *random, double minimum, double maximum)
{
    return minimum + (maximum - minimum) * (weir_random_next(random) / 4294967296.0);
}

WeirScene *weir_test_scene(double particle_spacing, double support_radius, double min, double max)
{
    WeirScene *scene = weir_scene_create();
    assert_non_null(scene);
    weir_test_set(scene, "particle_spacing", particle_spacing);
    weir_test_set(scene, "support_radius", support_radius);
    weir_test_set(scene, "time_step", 0.0005);
    weir_test_gravity(scene, 0, 0);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){min, min, 0}, (double[]){max, max, 0}),
                WEIR_OK);
    return scene;
}

void weir_test_set(WeirScene *scene, const char *parameter, double value)
{
    char path[100];
    assert_true(snprintf(path, sizeof path, "parameters.%s", parameter) < (int)sizeof path);
    CHECK_SCENE(scene, weir_scene_set_number(scene, path, value), WEIR_OK);
}

void weir_test_choose(WeirScene *scene, const char *parameter, const char *choice)
{
    CHECK_SCENE(scene, weir_scene_set_parameter_text(scene, parameter, choice), WEIR_OK);
}

void weir_test_gravity(WeirScene *scene, double x, double y)
{
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, "parameters.gravity", (double[]){x, y}, 2), WEIR_OK);
}

void weir_test_box(WeirScene *scene, double x0, double y0, double x1, double y1)
{
    CHECK_SCENE(scene,
                weir_scene_add_box(scene, (double[]){x0, y0, 0}, (double[]){x1, y1, 0}, (double[]){0, 0, 0}),
                WEIR_OK);
}

void weir_test_ball(WeirScene *scene, double x, double y, double radius, double vx, double vy)
{
    CHECK_SCENE(scene, weir_scene_add_ball(scene, (double[]){x, y, 0}, radius, (double[]){vx, vy, 0}),
                WEIR_OK);
}

WeirSim *weir_test_sim(const WeirScene *scene, const WeirBackend *backend, uint32_t threads)
{
    WeirSim *sim = weir_sim_create(scene, &(WeirSimOptions){.backend = backend, .threads = threads});
    assert_non_null(sim);
    WeirStatus status;
    do status = weir_sim_poll(sim);
    while (status == WEIR_PENDING);
    CHECK_SIM(sim, status, WEIR_OK);
    CHECK_SIM(sim, weir_sim_status(sim), WEIR_OK);
    return sim;
}

WeirScene *weir_test_count_scene(uint32_t count, double size, double particle_spacing, double support_radius)
{
    WeirScene *scene = weir_test_scene(particle_spacing, support_radius, 0, size);
    uint32_t columns = (uint32_t)(size / particle_spacing + 0.01), rows = count / columns;
    double top = rows * particle_spacing;
    if (rows) weir_test_box(scene, 0, 0, columns * particle_spacing, top);
    if (count % columns)
        weir_test_box(scene, 0, top, count % columns * particle_spacing, top + particle_spacing);
    CHECK_SCENE(scene, weir_scene_check(scene), WEIR_OK);
    assert_int_equal(weir_scene_particle_count(scene), count);
    return scene;
}

float *weir_test_read(WeirSim *sim, WeirField field)
{
    size_t capacity =
        (size_t)weir_sim_particle_count(sim) * weir_field_components(field, weir_sim_dimension(sim));
    float *values = malloc(capacity * sizeof *values);
    assert_non_null(values);
    CHECK_SIM(sim, weir_sim_read(sim, field, values, capacity), WEIR_OK);
    return values;
}

WeirDiagnostics weir_test_diagnose(WeirSim *sim, uint32_t flags)
{
    WeirDiagnostics diagnostics;
    CHECK_SIM(sim, weir_sim_diagnose(sim, flags, &diagnostics), WEIR_OK);
    return diagnostics;
}

void weir_test_step(WeirSim *sim, uint32_t steps)
{
    CHECK_SIM(sim, weir_sim_step(sim, steps), WEIR_OK);
    CHECK_SIM(sim, weir_sim_wait(sim), WEIR_OK);
    CHECK_SIM(sim, weir_sim_poll(sim), WEIR_OK);
}

void weir_test_set_state(WeirSim *sim, const float *positions, const float *velocities)
{
    CHECK_SIM(sim, weir_sim_set_state(sim, positions, velocities), WEIR_OK);
}

uint64_t weir_test_hash(WeirSim *sim)
{
    return weir_test_diagnose(sim, WEIR_DIAGNOSE_HASH).state_hash;
}

WeirScene *weir_test_dam(void)
{
    WeirScene *scene = weir_test_scene(0.02, 0.05, 0, 1);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_box(scene, 0, 0, 0.4, 0.4);
    return scene;
}

WeirScene *weir_test_drops(void)
{
    WeirScene *scene = weir_test_scene(0.02, 0.05, 0, 1);
    weir_test_ball(scene, 0.35, 0.47, 0.14, 1, 0);
    weir_test_ball(scene, 0.65, 0.53, 0.14, -1, 0.25);
    return scene;
}

void weir_test_box_of(WeirScene *scene, const char *piece, const double min[3], const double max[3])
{
    char path[64];
    uint32_t dimension = weir_scene_dimension(scene);
    snprintf(path, sizeof path, "%s.min", piece);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, min, dimension), WEIR_OK);
    snprintf(path, sizeof path, "%s.max", piece);
    CHECK_SCENE(scene, weir_scene_set_numbers(scene, path, max, dimension), WEIR_OK);
}

WeirScene *weir_test_everything(uint32_t dimension)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    weir_test_set(scene, "particle_spacing", dimension == 2 ? 0.02 : 0.04);
    weir_test_set(scene, "sound_speed", 30);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){-3, 7, 1}, (double[]){-2, 7.6, 1.36}),
                WEIR_OK);
    CHECK_SCENE(scene,
                weir_scene_add_box(scene, (double[]){-3, 7, 1}, (double[]){-2.6, 7.4, 1.36},
                                   (double[]){0.5, -0.25, 0.125}),
                WEIR_OK);
    weir_test_box_of(scene, "walls[0].box", (double[]){-2.5, 7, 1}, (double[]){-2.4, 7.1, 1.36});
    weir_test_box_of(scene, "bodies[0].box", (double[]){-2.52, 7.2, 1.08}, (double[]){-2.4, 7.32, 1.28});
    CHECK_SCENE(scene, weir_scene_set_number(scene, "bodies[0].density", 500), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_string(scene, "bodies[0].name", "body"), WEIR_OK);
    CHECK_SCENE(scene,
                weir_scene_set_numbers(scene, "emitters[0].center", (double[]){-2.2, 7.4, 1.18}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene,
                weir_scene_set_numbers(scene, "emitters[0].direction", (double[]){0, -1, 0}, dimension),
                WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "emitters[0].size", 0.12), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "emitters[0].speed", 3), WEIR_OK);
    weir_test_box_of(scene, "drains[0]", (double[]){-2.3, 7.1, 1}, (double[]){-2.1, 7.3, 1.36});
    return scene;
}

WeirScene *weir_test_tank(uint32_t dimension, double width, double height, double spacing)
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", dimension), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){width, height, height}),
                WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    return scene;
}

void weir_test_fill(WeirScene *scene, double x0, double x1, double height)
{
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){x0, 0, 0}, (double[]){x1, height, height}, NULL),
                WEIR_OK);
}
