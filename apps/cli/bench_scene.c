#include "bench_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double spacing = 0.01;
static const double sound_speed = 30.0; // m/s, of fluid without weight
static const double full_turn = 6.283185307179586;
enum { PARTICLES_PER_EMITTER = 1000, MOST_EMITTERS = 1024 };

static const WeirBenchCase cases[] = {
    {"article", WEIR_BENCH_ARTICLE, 2, 0.0},
    {"n20", WEIR_BENCH_N20, 2, 2.5},
    {"block_2d", WEIR_BENCH_BLOCK, 2, 2.5},
    {"block_3d", WEIR_BENCH_BLOCK, 3, 2.1},
    {"dam_2d", WEIR_BENCH_DAM, 2, 2.5},
    {"dam_3d", WEIR_BENCH_DAM, 3, 2.1},
    {"splash_2d", WEIR_BENCH_SPLASH, 2, 2.5},
    {"splash_3d", WEIR_BENCH_SPLASH, 3, 2.1},
    {"pool_2d", WEIR_BENCH_POOL, 2, 2.5},
    {"pool_3d", WEIR_BENCH_POOL, 3, 2.1},
    {"box_2d", WEIR_BENCH_BOX, 2, 2.5},
    {"box_3d", WEIR_BENCH_BOX, 3, 2.1},
    {"calm_2d", WEIR_BENCH_CALM, 2, 2.5},
    {"calm_3d", WEIR_BENCH_CALM, 3, 2.1},
    {"box_2d_n45", WEIR_BENCH_BOX, 2, 0.0},
    {"box_3d_n111", WEIR_BENCH_BOX, 3, 0.0},
    {"box_3d_n165", WEIR_BENCH_BOX, 3, 3.46},
    {"corner_2d", WEIR_BENCH_CORNER, 2, 2.5},
    {"corner_3d", WEIR_BENCH_CORNER, 3, 2.1},
    {"far_2d", WEIR_BENCH_FAR, 2, 2.5},
    {"far_3d", WEIR_BENCH_FAR, 3, 2.1},
    {"thin_2d", WEIR_BENCH_THIN, 2, 2.5},
    {"thin_3d", WEIR_BENCH_THIN, 3, 2.1},
    {"emitters_2d", WEIR_BENCH_EMITTERS, 2, 2.5},
    {"emitters_3d", WEIR_BENCH_EMITTERS, 3, 2.1},
    {"compressed_2d", WEIR_BENCH_COMPRESSED, 2, 2.5},
    {"compressed_3d", WEIR_BENCH_COMPRESSED, 3, 2.1},
};

const WeirBenchCase *weir_bench_case(const char *name)
{
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; ++n)
        if (strcmp(cases[n].name, name) == 0) return &cases[n];
    return NULL;
}

bool weir_bench_is_wcsph(const WeirBenchCase *bench_case)
{
    return bench_case->kind >= WEIR_BENCH_BLOCK;
}

bool weir_bench_starts_anew(const WeirBenchCase *bench_case)
{
    return bench_case->kind <= WEIR_BENCH_COMPRESSED;
}

bool weir_bench_is_stirred(const WeirBenchCase *bench_case)
{
    return bench_case->kind == WEIR_BENCH_BOX || bench_case->kind == WEIR_BENCH_CALM;
}

// ---- mueller ----

// Columns of a block of exactly `count` particles, near a share `aspect` of its rows; a prime count
// gives one row.
static uint32_t block_columns(uint32_t count, double aspect)
{
    uint32_t columns = (uint32_t)(sqrt(aspect * count) + 0.5);
    while (columns > 1 && count % columns != 0) --columns;
    return columns > 1 ? columns : count;
}

// The numbers of scenes/article.json.
static void set_article_parameters(WeirScene *scene)
{
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.007);
    weir_scene_set_number(scene, "parameters.support_radius", 0.045);
    weir_scene_set_number(scene, "parameters.rest_density", 1000.0);
    weir_scene_set_number(scene, "parameters.gas_constant", 2000.0);
    weir_scene_set_number(scene, "parameters.viscosity", 0.1);
    weir_scene_set_numbers(scene, "parameters.gravity", (double[]){0.0, -9.81}, 2);
    weir_scene_set_number(scene, "parameters.time_step", 0.0008);
}

static void set_n20_parameters(WeirScene *scene)
{
    weir_scene_set_number(scene, "parameters.particle_spacing", spacing);
    weir_scene_set_number(scene, "parameters.support_radius", 2.5 * spacing);
    weir_scene_set_number(scene, "parameters.time_step", 0.5 * weir_scene_stable_time_step(scene));
}

// At rest in the lower left corner of a tank, about to fall apart.
static void make_mueller(WeirScene *scene, WeirBenchKind kind, uint32_t count)
{
    if (kind == WEIR_BENCH_ARTICLE) {
        set_article_parameters(scene);
    } else {
        set_n20_parameters(scene);
    }
    double step[3];
    weir_scene_get_parameter(scene, "particle_spacing", step);
    // As in scenes/article.json, half as wide as high, if that fits its tank of 2 m; else a flat block, which
    // falls slowly enough for the time step.
    double aspect = sqrt(2.0 * count) * step[0] <= 2.0 ? 0.5 : 2.0;
    uint32_t columns = block_columns(count, aspect), rows = count / columns;
    double width = columns * step[0], height = rows * step[0];
    double tank_width = fmax(2.0, 1.5 * width), tank_height = fmax(2.0, 1.5 * height);
    double min[3] = {-0.5 * tank_width, -0.5 * tank_height, 0.0};
    double max[3] = {0.5 * tank_width, 0.5 * tank_height, 0.0};
    weir_scene_set_domain(scene, min, max);
    weir_scene_add_box(scene, min, (double[3]){min[0] + width, min[1] + height, 0.0}, NULL);
}

// ---- wcsph ----

typedef struct Shape {
    double size[3]; // of the fluid, m; whole numbers of spacings
    double min[3], max[3];
} Shape;

static double whole(double spacings)
{
    return spacing * fmax(1.0, floor(spacings + 0.5));
}

// Fluid of about `count` particles with the sides width : height : depth (2D: no depth).
static Shape shape_of(uint32_t dimension, double count, double width, double height, double depth)
{
    bool deep = dimension == 3;
    double unit = deep ? cbrt(count / (width * height * depth)) : sqrt(count / (width * height));
    Shape shape = {.size = {whole(unit * width), whole(unit * height), deep ? whole(unit * depth) : 0.0}};
    memcpy(shape.max, shape.size, sizeof shape.max);
    return shape;
}

static void set_weightless(WeirScene *scene)
{
    weir_scene_set_numbers(scene, "parameters.gravity", (double[]){0.0, 0.0, 0.0}, 3);
    weir_scene_set_number(scene, "parameters.sound_speed", sound_speed);
}

// Fluid in space: domain from -below to above times its sides, nothing but open sides around.
static void float_in(WeirScene *scene, Shape *shape, double below, double above)
{
    bool deep = weir_scene_dimension(scene) == 3;
    for (int axis = 0; axis < (deep ? 3 : 2); ++axis) {
        double rim = fmax(shape->size[axis], 10.0 * spacing); // what is thin gets room too
        shape->min[axis] = -below * rim;
        shape->max[axis] = shape->size[axis] + (above - 1.0) * rim;
    }
    weir_scene_set_string(scene, "domain.open", deep ? "-x +x -y +y -z +z" : "-x +x -y +y");
    set_weightless(scene);
}

static void add_far_particle(WeirScene *scene, const Shape *shape)
{
    double min[3], max[3];
    for (int axis = 0; axis < 3; ++axis) {
        min[axis] = 30.0 * shape->size[axis];
        max[axis] = min[axis] + spacing;
    }
    weir_scene_add_box(scene, min, max, (double[3]){-3.0, 0.0, 0.0});
}

// Nozzles of four spacings over a pool, eight apart, blowing down; no two have their layers at the same time.
static void add_emitters(WeirScene *scene, const Shape *shape, uint32_t count)
{
    bool deep = weir_scene_dimension(scene) == 3;
    uint32_t across = (uint32_t)(shape->size[0] / (8.0 * spacing) + 1e-6);
    for (uint32_t n = 0; n < count; ++n) {
        double center[3] = {(8.0 * (n % across) + 4.0) * spacing, shape->size[1] + 20.0 * spacing,
                            (8.0 * (n / across) + 4.0) * spacing};
        char path[64];
        snprintf(path, sizeof path, "emitters[%u].center", n);
        weir_scene_set_numbers(scene, path, center, deep ? 3 : 2);
        snprintf(path, sizeof path, "emitters[%u].direction", n);
        weir_scene_set_numbers(scene, path, (double[]){0.0, -1.0, 0.0}, deep ? 3 : 2);
        snprintf(path, sizeof path, "emitters[%u].size", n);
        weir_scene_set_number(scene, path, 4.0 * spacing);
        snprintf(path, sizeof path, "emitters[%u].speed", n);
        weir_scene_set_number(scene, path, 1.0);
        snprintf(path, sizeof path, "emitters[%u].start", n);
        weir_scene_set_number(scene, path, fmod(0.618 * n, 1.0) * spacing);
        snprintf(path, sizeof path, "emitters[%u].capacity", n);
        weir_scene_set_number(scene, path, 200.0);
    }
}

static uint32_t emitter_count(uint32_t particles)
{
    uint32_t count = particles / PARTICLES_PER_EMITTER;
    return count < 1 ? 1 : count > MOST_EMITTERS ? MOST_EMITTERS : count;
}

// A pool as wide as its emitters need.
static Shape emitter_pool(uint32_t dimension, uint32_t particles)
{
    uint32_t count = emitter_count(particles);
    double across = dimension == 3 ? ceil(sqrt(count)) : count;
    double width = 8.0 * across, depth = dimension == 3 ? 8.0 * ceil(count / across) : 1.0;
    return shape_of(dimension, particles, width, fmax(1.0, particles / (width * depth)), depth);
}

static Shape make_shape(WeirScene *scene, const WeirBenchCase *bench_case, uint32_t count)
{
    uint32_t dimension = bench_case->dimension;
    double in_one_percent = dimension == 3 ? 4.641588833612779 : 10.0;
    Shape shape = shape_of(dimension, count, 1.0, 1.0, 1.0);
    switch (bench_case->kind) {
    case WEIR_BENCH_DAM:
    case WEIR_BENCH_SPLASH:
        shape.max[0] *= 2.0;
        shape.max[1] *= 1.5;
        break;
    case WEIR_BENCH_POOL:
        shape = shape_of(dimension, count, 2.0, 0.5, 1.0);
        shape.max[1] = whole(3.0 * shape.size[1] / spacing);
        break;
    case WEIR_BENCH_BOX:
    case WEIR_BENCH_CALM:
        set_weightless(scene);
        break;
    case WEIR_BENCH_CORNER:
        float_in(scene, &shape, 0.0, in_one_percent);
        break;
    case WEIR_BENCH_FAR:
        float_in(scene, &shape, 0.1, 31.0);
        break;
    case WEIR_BENCH_THIN:
        shape = shape_of(dimension, count, 1000.0, 1.0, 1.0);
        float_in(scene, &shape, 0.0, 1.0);
        break;
    case WEIR_BENCH_EMITTERS:
        shape = emitter_pool(dimension, count);
        shape.max[1] += 40.0 * spacing;
        break;
    default: // So little space around a block that its cells stay fine.
        float_in(scene, &shape, 0.1, 1.1);
    }
    return shape;
}

static void make_wcsph(WeirScene *scene, const WeirBenchCase *bench_case, uint32_t count)
{
    weir_scene_set_string(scene, "method", "wcsph");
    weir_scene_set_number(scene, "dimension", bench_case->dimension);
    weir_scene_set_number(scene, "parameters.particle_spacing", spacing);
    weir_scene_set_number(scene, "parameters.support_radius", bench_case->support * spacing);
    Shape shape = make_shape(scene, bench_case, count);
    weir_scene_set_domain(scene, shape.min, shape.max);
    weir_scene_add_box(scene, (double[3]){0.0, 0.0, 0.0}, shape.size, NULL);
    if (bench_case->kind == WEIR_BENCH_FAR) add_far_particle(scene, &shape);
    if (bench_case->kind == WEIR_BENCH_EMITTERS) add_emitters(scene, &shape, emitter_count(count));
}

WeirScene *weir_bench_scene(const WeirBenchCase *bench_case, uint32_t count)
{
    WeirScene *scene = weir_scene_create();
    if (!scene) return NULL;
    weir_scene_set_string(scene, "title", bench_case->name);
    if (weir_bench_is_wcsph(bench_case)) {
        make_wcsph(scene, bench_case, count);
    } else {
        make_mueller(scene, bench_case->kind, count);
    }
    return scene;
}

// ---- From the start to what is measured ----

// A lattice of vortices of about 16 spacings, which no side of the box cuts: u = U sin kx cos ky, v = -U cos kx sin ky.
static void stir(const WeirSim *sim, double speed, const float *position, float *velocity)
{
    double min[3], max[3];
    weir_scene_domain(weir_sim_scene(sim), min, max);
    double k[2];
    for (int axis = 0; axis < 2; ++axis) {
        double waves = fmax(1.0, floor((max[axis] - min[axis]) / (32.0 * spacing) + 0.5));
        k[axis] = full_turn * waves / (max[axis] - min[axis]);
    }
    size_t dimension = weir_sim_dimension(sim);
    for (size_t i = 0; i < weir_sim_fluid_slots(sim); ++i) {
        double x = k[0] * (position[dimension * i] - min[0]);
        double y = k[1] * (position[dimension * i + 1] - min[1]);
        velocity[dimension * i] = (float)(speed * sin(x) * cos(y));
        velocity[dimension * i + 1] = (float)(-speed * k[0] / k[1] * cos(x) * sin(y));
    }
}

// To three times the density.
static void compress(const WeirSim *sim, float *position)
{
    size_t floats = (size_t)weir_sim_dimension(sim) * weir_sim_fluid_slots(sim);
    double scale = weir_sim_dimension(sim) == 3 ? cbrt(1.0 / 3.0) : sqrt(1.0 / 3.0);
    for (size_t k = 0; k < floats; ++k) position[k] = (float)(scale * position[k]);
}

static WeirStatus replace_state(const WeirBenchCase *bench_case, WeirSim *sim)
{
    size_t floats = (size_t)weir_sim_dimension(sim) * weir_sim_particle_count(sim);
    float *position = malloc(floats * sizeof *position), *velocity = calloc(floats, sizeof *velocity);
    WeirStatus status = position && velocity ? WEIR_OK : WEIR_ERROR_MEMORY;
    if (!status) status = weir_sim_read(sim, WEIR_FIELD_POSITION, position, floats);
    if (!status) {
        if (bench_case->kind == WEIR_BENCH_COMPRESSED) {
            compress(sim, position);
        } else {
            double mach = bench_case->kind == WEIR_BENCH_CALM ? 1.0 / 30.0 : 0.1;
            stir(sim, mach * sound_speed, position, velocity);
        }
        status = weir_sim_set_state(sim, position, velocity);
    }
    free(position);
    free(velocity);
    return status;
}

WeirStatus weir_bench_prepare(const WeirBenchCase *bench_case, WeirSim *sim)
{
    if (weir_bench_is_stirred(bench_case) || bench_case->kind == WEIR_BENCH_COMPRESSED)
        return replace_state(bench_case, sim);
    if (bench_case->kind != WEIR_BENCH_SPLASH) return WEIR_OK;
    // The front is at the other side after about 1.5 sqrt(H/g).
    double min[3], max[3];
    weir_scene_domain(weir_sim_scene(sim), min, max);
    return weir_sim_run_until(sim, 2.5 * sqrt(max[1] / 1.5 / 9.81));
}
