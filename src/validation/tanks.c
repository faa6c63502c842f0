// Still water: columns at rest in 2D and 3D, over a step and a wedge, and a tank that settles after a splash.
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_hydrostatic_2d_scene[], weir_case_hydrostatic_3d_scene[],
    weir_case_hydrostatic_shapes_scene[], weir_case_settled_tank_scene[];

// All tanks stand on y = 0.
typedef struct TankShape {
    double width, depth, thickness; // m; thickness along z, 0 in 2D
} TankShape;

static const TankShape column_2d = {0.45, 0.9, 0.0}, column_3d = {0.3, 0.9, 0.3}, shapes = {1.2, 0.5, 0.0};

typedef struct Tank {
    uint32_t l2, bottom, energy, surface, speed; // curves over time
    double end_time;                             // of the run
} Tank;

static void plan_tank(WeirValidation *v, const char *file, const char *text, double spacing, double end)
{
    Tank *tank = v->data;
    char label[48];
    snprintf(label, sizeof label, "spacing %g m", spacing);
    weir_plan_run(v, label, file, text, spacing, end, 0.1);
    tank->end_time = end;
    tank->l2 = weir_curve_add(v, "Error of the pressure", "L2 error of the profile", "time", "s", "error",
                              "1", false);
    tank->bottom = weir_curve_add(v, "Error of the pressure", "bottom pressure over rho g depth", "time", "s",
                                  "error", "1", false);
    tank->energy = weir_curve_add(v, "Kinetic energy", "kinetic over potential energy", "time", "s",
                                  "energy ratio", "1", false);
    tank->surface = weir_curve_add(v, "Surface", "surface height", "time", "s", "height", "m", false);
    tank->speed = weir_curve_add(v, "Largest speed", "largest speed over sqrt(gH)", "time", "s",
                                 "speed ratio", "1", false);
}

static double surface_height(const WeirSample *sample, const TankShape *shape)
{
    static const double places[3] = {0.4, 0.5, 0.6};
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
        sum += weir_measure_height(sample, places[k] * shape->width, 0.5 * shape->thickness) / 3.0;
    return sum;
}

// Pressure against height at the end, by rows of one spacing.
static void add_profile(WeirValidation *v, const WeirSample *sample, const TankShape *shape, double weight)
{
    enum { ROWS = 400 };
    double pressure[ROWS] = {0.0}, height[ROWS] = {0.0}, spacing = sample->parameters->particle_spacing;
    uint32_t count[ROWS] = {0};
    for (size_t i = 0; i < sample->state->count; ++i) {
        double y = weir_sample_position(sample, i, 1), row = floor(y / spacing);
        if (!weir_sample_is_fluid(sample, i) || !(row >= 0.0 && row < ROWS)) continue;
        pressure[(int)row] += (double)sample->state->pressure[i];
        height[(int)row] += y;
        ++count[(int)row];
    }
    uint32_t measured =
        weir_curve_add(v, "Pressure at the end", "mean of each row", "height", "m", "pressure", "Pa", false);
    uint32_t exact =
        weir_curve_add(v, "Pressure at the end", "rho g (H - y)", "height", "m", "pressure", "Pa", true);
    for (int row = 0; row < ROWS; ++row) {
        if (count[row]) weir_curve_push(v, measured, height[row] / count[row], pressure[row] / count[row]);
    }
    weir_curve_push(v, exact, 0.0, weight * shape->depth);
    weir_curve_push(v, exact, shape->depth, 0.0);
}

static void sample_tank(WeirValidation *v, const WeirSample *sample, const TankShape *shape)
{
    const Tank *tank = v->data;
    double gravity = -(double)sample->parameters->gravity[1],
           weight = sample->parameters->rest_density * gravity;
    double spacing = sample->parameters->particle_spacing;
    double error2 = 0.0, exact2 = 0.0, bottom = 0.0, bottom_exact = 0.0;
    for (size_t i = 0; i < sample->state->count; ++i) {
        if (!weir_sample_is_fluid(sample, i)) continue;
        double y = weir_sample_position(sample, i, 1), exact = weight * (shape->depth - y);
        double p = sample->state->pressure[i];
        error2 += (p - exact) * (p - exact);
        exact2 += exact * exact;
        if (y < spacing) {
            bottom += p;
            bottom_exact += exact;
        }
    }
    WeirFluidSums sums = weir_fluid_sums(sample);
    double potential = sums.mass * gravity * sums.center[1], t = sample->time;
    weir_curve_push(v, tank->l2, t, sqrt(error2 / exact2));
    weir_curve_push(v, tank->bottom, t, bottom / bottom_exact - 1.0);
    weir_curve_push(v, tank->energy, t, sums.kinetic_energy / potential);
    weir_curve_push(v, tank->surface, t, surface_height(sample, shape));
    weir_curve_push(v, tank->speed, t, sums.max_speed / sqrt(gravity * shape->depth));
    if (t >= tank->end_time * (1.0 - 1e-9)) add_profile(v, sample, shape, weight);
}

// Means and largest values of the last second.
static double mean_at_end(const WeirValidation *v, uint32_t curve)
{
    double end = ((const Tank *)v->data)->end_time;
    return weir_curve_mean(v, curve, end - 1.0, end);
}

static double max_at_end(const WeirValidation *v, uint32_t curve)
{
    double end = ((const Tank *)v->data)->end_time;
    return weir_curve_max(v, curve, end - 1.0, end);
}

static double surface_drift(const WeirValidation *v)
{
    const Tank *tank = v->data;
    double start = weir_curve_mean(v, tank->surface, 0.0, 0.0);
    return fabs(mean_at_end(v, tank->surface) - start) / v->runs[0].info.spacing;
}

// ---- Hydrostatic column, 2D ----

static void plan_2d(WeirValidation *v)
{
    plan_tank(v, "validation/hydrostatic_2d/scene.json", weir_case_hydrostatic_2d_scene,
              weir_by_resolution(v, 0.03, 0.01, 0.005), 10.0);
}

static void sample_2d(WeirValidation *v, const WeirSample *sample)
{
    sample_tank(v, sample, &column_2d);
}

static void judge_2d(WeirValidation *v)
{
    const Tank *tank = v->data;
    weir_gate_add(v, "pressure profile, L2 error", "1", WEIR_GATE_AT_MOST, mean_at_end(v, tank->l2), NAN,
                  weir_limit(v, 0.03, 0.01));
    weir_gate_add(v, "bottom pressure, error", "1", WEIR_GATE_AT_MOST, fabs(mean_at_end(v, tank->bottom)),
                  NAN, weir_limit(v, 0.03, 0.01));
    weir_gate_add(v, "drift of the surface in spacings", "1", WEIR_GATE_AT_MOST, surface_drift(v), NAN, 0.2);
    weir_gate_add(v, "kinetic over potential energy", "1", WEIR_GATE_AT_MOST, max_at_end(v, tank->energy),
                  NAN, weir_limit(v, 1e-5, 1e-6));
}

const WeirCase weir_case_hydrostatic_2d = {
    .info =
        {"hydrostatic_2d", "Hydrostatic column, 2D",
         "Water 0.9 m deep stands for 10 s; its pressure must be rho g (H - y), its surface must not drift "
         "and it must come to rest. Values are those of the last second.",
         "hydrostatics"},
    .data_size = sizeof(Tank),
    .plan = plan_2d,
    .sample = sample_2d,
    .judge = judge_2d,
};

// ---- Hydrostatic column, 3D ----

static void plan_3d(WeirValidation *v)
{
    plan_tank(v, "validation/hydrostatic_3d/scene.json", weir_case_hydrostatic_3d_scene,
              weir_by_resolution(v, 0.06, 0.02, 0.01), 3.1);
}

static void sample_3d(WeirValidation *v, const WeirSample *sample)
{
    sample_tank(v, sample, &column_3d);
}

static void judge_3d(WeirValidation *v)
{
    const Tank *tank = v->data;
    weir_gate_add(v, "pressure profile, L2 error", "1", WEIR_GATE_AT_MOST, mean_at_end(v, tank->l2), NAN,
                  weir_limit(v, 0.05, 0.015));
    weir_gate_add(v, "bottom pressure, error", "1", WEIR_GATE_REPORTED, fabs(mean_at_end(v, tank->bottom)),
                  NAN, NAN);
    weir_gate_add(v, "drift of the surface in spacings", "1", WEIR_GATE_REPORTED, surface_drift(v), NAN, NAN);
}

const WeirCase weir_case_hydrostatic_3d = {
    .info =
        {"hydrostatic_3d", "Hydrostatic column, 3D",
         "Water 0.9 m deep stands for 10 sqrt(H/g) = 3.1 s in a square well; pressure as in 2D. Values are "
         "means of the last second.",
         "hydrostatics"},
    .data_size = sizeof(Tank),
    .plan = plan_3d,
    .sample = sample_3d,
    .judge = judge_3d,
};

// ---- Over a step and a wedge ----

static void plan_shapes(WeirValidation *v)
{
    plan_tank(v, "validation/hydrostatic_shapes/scene.json", weir_case_hydrostatic_shapes_scene,
              weir_by_resolution(v, 0.02, 0.01, 0.005), 5.0);
}

static void sample_shapes(WeirValidation *v, const WeirSample *sample)
{
    sample_tank(v, sample, &shapes);
}

static void judge_shapes(WeirValidation *v)
{
    const Tank *tank = v->data;
    weir_gate_add(v, "pressure, L2 error", "1", WEIR_GATE_AT_MOST, mean_at_end(v, tank->l2), NAN,
                  weir_limit(v, 0.06, 0.02));
    weir_gate_add(v, "largest residual speed over sqrt(gH)", "1", WEIR_GATE_AT_MOST,
                  max_at_end(v, tank->speed), NAN, weir_limit(v, 0.02, 0.005));
}

const WeirCase weir_case_hydrostatic_shapes = {
    .info = {"hydrostatic_shapes", "Still water over a step and a wedge",
             "Water 0.5 m deep over a step and a wedge of 45 degrees stands for 5 s: hydrostatic pressure "
             "everywhere and no current along slopes and in corners. Values are those of the last second.",
             "hydrostatics"},
    .data_size = sizeof(Tank),
    .plan = plan_shapes,
    .sample = sample_shapes,
    .judge = judge_shapes,
};

// ---- Settled tank ----

typedef struct Splash {
    uint32_t density, volume;
    double end_time;
} Splash;

static const double splash_width = 1.0, splash_volume = 0.25; // m, m^2

static void plan_splash(WeirValidation *v)
{
    Splash *splash = v->data;
    double spacing = weir_by_resolution(v, 0.025, 0.01, 0.005);
    char label[48];
    snprintf(label, sizeof label, "spacing %g m", spacing);
    splash->end_time = weir_by_resolution(v, 8.0, 12.0, 12.0);
    weir_plan_run(v, label, "validation/settled_tank/scene.json", weir_case_settled_tank_scene, spacing,
                  splash->end_time, 0.1);
    splash->density =
        weir_curve_add(v, "Density error", "mean |rho / rho0 - 1|", "time", "s", "error", "1", false);
    splash->volume =
        weir_curve_add(v, "Volume", "under the surface, over the start's", "time", "s", "ratio", "1", false);
}

static void sample_splash(WeirValidation *v, const WeirSample *sample)
{
    enum { PLACES = 20 };
    const Splash *splash = v->data;
    double area = 0.0;
    for (int k = 0; k < PLACES; ++k) {
        // A support radius clear of the walls, where the probe's sum lacks fluid; the rest stands for the whole.
        double clear = sample->parameters->support_radius;
        double x = clear + (splash_width - 2.0 * clear) * (k + 0.5) / PLACES;
        area += weir_measure_height(sample, x, 0.0) * splash_width / PLACES;
    }
    weir_curve_push(v, splash->density, sample->time, weir_fluid_sums(sample).density_deviation);
    weir_curve_push(v, splash->volume, sample->time, area / splash_volume);
}

static void judge_splash(WeirValidation *v)
{
    const Splash *splash = v->data;
    double from = splash->end_time - 2.0, to = splash->end_time;
    weir_gate_add(v, "mean density error", "1", WEIR_GATE_AT_MOST,
                  weir_curve_mean(v, splash->density, from, to), NAN, 0.01);
    weir_gate_add(v, "volume over that of the start", "1", WEIR_GATE_RELATIVE,
                  weir_curve_mean(v, splash->volume, from, to), 1.0, weir_limit(v, 0.06, 0.01));
}

const WeirCase weir_case_settled_tank = {
    .info = {"settled_tank", "Tank that settles after a splash",
             "A column of 0.5 x 0.5 m falls apart in a tank 1 m wide and comes to rest: its density and the "
             "volume "
             "under its surface must be what they were. Values are means of the last 2 s.",
             "conservation of volume"},
    .data_size = sizeof(Splash),
    .plan = plan_splash,
    .sample = sample_splash,
    .judge = judge_splash,
};
