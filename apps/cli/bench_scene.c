#include "bench_scene.h"

#include <math.h>

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
    weir_scene_set_number(scene, "parameters.particle_spacing", 0.01);
    weir_scene_set_number(scene, "parameters.support_radius", 0.025);
    weir_scene_set_number(scene, "parameters.time_step", 0.5 * weir_scene_stable_time_step(scene));
}

bool weir_bench_is_wcsph(WeirBenchCase bench_case)
{
    return bench_case >= WEIR_BENCH_BLOCK_2D;
}

// Square or cubic fluid of about `count` particles.
static void make_wcsph(WeirScene *scene, WeirBenchCase bench_case, uint32_t count)
{
    bool deep = bench_case == WEIR_BENCH_BLOCK_3D || bench_case == WEIR_BENCH_DAM_3D;
    bool dam = bench_case == WEIR_BENCH_DAM_2D || bench_case == WEIR_BENCH_DAM_3D;
    static const double spacing = 0.01;
    static const char *const titles[] = {"block_2d", "block_3d", "dam_2d", "dam_3d"};
    double side = spacing * fmax(1.0, floor((deep ? cbrt(count) : sqrt(count)) + 0.5));
    // So little space around a block that its cells stay fine.
    double low = dam ? 0.0 : -0.1 * side, wide = dam ? 2.0 * side : 1.1 * side;
    double high = dam ? 1.5 * side : wide;
    weir_scene_set_string(scene, "title", titles[bench_case - WEIR_BENCH_BLOCK_2D]);
    weir_scene_set_string(scene, "method", "wcsph");
    weir_scene_set_number(scene, "dimension", deep ? 3 : 2);
    weir_scene_set_number(scene, "parameters.particle_spacing", spacing);
    weir_scene_set_number(scene, "parameters.support_radius", (deep ? 2.1 : 2.5) * spacing);
    weir_scene_set_domain(scene, (double[3]){low, low, low}, (double[3]){wide, high, dam ? side : wide});
    if (!dam) {
        weir_scene_set_string(scene, "domain.open", deep ? "-x +x -y +y -z +z" : "-x +x -y +y");
        weir_scene_set_numbers(scene, "parameters.gravity", (double[]){0.0, 0.0, 0.0}, 3);
        weir_scene_set_number(scene, "parameters.sound_speed", 30.0);
    }
    weir_scene_add_box(scene, (double[3]){0.0, 0.0, 0.0}, (double[3]){side, side, side}, NULL);
}

WeirScene *weir_bench_scene(WeirBenchCase bench_case, uint32_t count)
{
    WeirScene *scene = weir_scene_create();
    if (!scene) return NULL;
    if (weir_bench_is_wcsph(bench_case)) {
        make_wcsph(scene, bench_case, count);
        return scene;
    }
    if (bench_case == WEIR_BENCH_ARTICLE) {
        set_article_parameters(scene);
    } else {
        set_n20_parameters(scene);
    }
    double spacing[3];
    weir_scene_get_parameter(scene, "particle_spacing", spacing);
    // As in scenes/article.json, half as wide as high, if that fits its tank of 2 m; else a flat block, which
    // falls slowly enough for the time step.
    double aspect = sqrt(2.0 * count) * spacing[0] <= 2.0 ? 0.5 : 2.0;
    uint32_t columns = block_columns(count, aspect), rows = count / columns;
    double width = columns * spacing[0], height = rows * spacing[0];
    double tank_width = fmax(2.0, 1.5 * width), tank_height = fmax(2.0, 1.5 * height);
    double min[3] = {-0.5 * tank_width, -0.5 * tank_height, 0.0};
    double max[3] = {0.5 * tank_width, 0.5 * tank_height, 0.0};
    weir_scene_set_string(scene, "title", bench_case == WEIR_BENCH_ARTICLE ? "article" : "n20");
    weir_scene_set_domain(scene, min, max);
    weir_scene_add_box(scene, min, (double[3]){min[0] + width, min[1] + height, 0.0}, NULL);
    return scene;
}
