// SPHERIC test 2: a dam breaks onto a box, 3D, against the measurements at MARIN that Kleefsman et al. 2005 published.
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_kleefsman_scene[], weir_case_kleefsman_reference[],
    weir_case_kleefsman_reference_arrivals[];

enum { MAX_ROWS = 24, HEIGHTS = 4, PRESSURES = 4, ARRIVALS = 3 };
enum { H2 = 1, H4 = 3, P1 = 0 };
// The gate stands at x = 1.992 m, the water to its right; y is up, z across.
static const double gate = 1.992, middle = 0.5, water_depth = 0.55, wet = 0.02; // m
static const double height_places[HEIGHTS] = {0.504, 1.0, 1.496, -0.646}; // from the gate towards the box, m
static const double box_front = 0.8245;                                   // face towards the water, m
static const double pressure_heights[PRESSURES] = {0.021, 0.061, 0.101, 0.141}; // m
static const double interval = 0.005;                                           // s

typedef struct Kleefsman {
    double table[4 * MAX_ROWS]; // t, H4, H2, P1
    uint32_t rows;
    uint32_t heights[HEIGHTS], highest[HEIGHTS], pressures[PRESSURES]; // curves
    double arrivals[ARRIVALS], measured[ARRIVALS];                     // s
    double end_time;
} Kleefsman;

static void add_table(WeirValidation *v, const char *plot, const char *quantity, const char *unit, int column,
                      double factor)
{
    const Kleefsman *data = v->data;
    uint32_t curve = weir_curve_add(v, plot, "experiment", "time", "s", quantity, unit, true);
    for (uint32_t row = 0; row < data->rows; ++row)
        weir_curve_push(v, curve, data->table[4 * row], factor * data->table[4 * row + column]);
}

static void plan(WeirValidation *v)
{
    Kleefsman *data = v->data;
    double cells = weir_by_resolution(v, 9.0, 30.0, 60.0);
    char label[48];
    snprintf(label, sizeof label, "0.55 m/%g", cells);
    data->end_time = weir_by_resolution(v, 1.5, 6.02, 6.02);
    weir_plan_run(v, label, "validation/kleefsman/scene.json", weir_case_kleefsman_scene, water_depth / cells,
                  data->end_time, interval);
    data->rows = weir_reference_read(weir_case_kleefsman_reference, 4, data->table, MAX_ROWS);
    weir_reference_read(weir_case_kleefsman_reference_arrivals, 1, data->arrivals, ARRIVALS);
    for (int k = 0; k < HEIGHTS; ++k) {
        char plot[64];
        snprintf(plot, sizeof plot, "Water height H%d", k + 1);
        data->heights[k] = weir_curve_add(v, plot, "measured", "time", "s", "height", "m", false);
        data->highest[k] = weir_curve_add(v, plot, "highest water", "time", "s", "height", "m", false);
    }
    for (int k = 0; k < PRESSURES; ++k) {
        char plot[64];
        snprintf(plot, sizeof plot, "Pressure P%d", k + 1);
        data->pressures[k] = weir_curve_add(v, plot, "measured", "time", "s", "pressure", "Pa", false);
    }
    add_table(v, "Water height H4", "height", "m", 1, 1.0);
    add_table(v, "Water height H2", "height", "m", 2, 1.0);
    add_table(v, "Pressure P1", "pressure", "Pa", 3, 1e3);
    for (int k = 0; k < ARRIVALS; ++k) data->measured[k] = NAN;
}

static void sample(WeirValidation *v, const WeirSample *sample)
{
    Kleefsman *data = v->data;
    for (int k = 0; k < HEIGHTS; ++k) {
        double x = gate - height_places[k], height = weir_measure_height(sample, x, middle);
        double depth = weir_measure_depth(sample, x, middle);
        weir_curve_push(v, data->heights[k], sample->time, depth);
        weir_curve_push(v, data->highest[k], sample->time, isnan(height) ? 0.0 : height);
        if (k < ARRIVALS && isnan(data->measured[k]) && depth >= wet) data->measured[k] = sample->time;
    }
    for (int k = 0; k < PRESSURES; ++k) {
        double point[3] = {box_front, pressure_heights[k], middle};
        weir_curve_push(v, data->pressures[k], sample->time, weir_measure_pressure(sample, point));
    }
}

// Mean of a curve around a table's time: +-10 ms for heights, +-5 ms for pressures, as the table was made.
static double window(const WeirValidation *v, uint32_t curve, double t, double half)
{
    return weir_curve_mean(v, curve, t - half, t + half);
}

static double height_error(const WeirValidation *v, uint32_t curve, int column)
{
    const Kleefsman *data = v->data;
    double sum2 = 0.0;
    uint32_t count = 0;
    for (uint32_t row = 0; row < data->rows; ++row) {
        double t = data->table[4 * row], error = window(v, curve, t, 0.01) - data->table[4 * row + column];
        if (t > data->end_time) continue;
        if (isnan(error)) return NAN;
        sum2 += error * error;
        ++count;
    }
    return sqrt(sum2 / count) / water_depth;
}

// Impulses from 0.4 to 1.4 s, the first second after the water meets the box: of all samples of the simulation, of its
// windows at the table's times, and of the table, by trapezoids.
static void impulses(const WeirValidation *v, double *all, double *windows, double *reference)
{
    const Kleefsman *data = v->data;
    const WeirCurveData *curve = &v->curves[data->pressures[P1]];
    double first = 0.4 - 1e-9, last = 1.4 + 1e-9;
    *all = *windows = *reference = 0.0;
    for (uint32_t k = 1; k < curve->info.count; ++k) {
        if (curve->x[k - 1] < first || curve->x[k] > last) continue;
        *all += 0.5 * (curve->x[k] - curve->x[k - 1]) * (curve->y[k - 1] + curve->y[k]);
    }
    if (curve->info.count == 0 || curve->x[curve->info.count - 1] < 1.4) *all = NAN;
    for (uint32_t row = 1; row < data->rows; ++row) {
        const double *before = &data->table[4 * (row - 1)], *now = &data->table[4 * row];
        if (now[0] > last) return;
        double step = now[0] - before[0];
        *reference += 0.5 * step * 1e3 * (before[3] + now[3]);
        *windows += 0.5 * step *
                    (window(v, data->pressures[P1], before[0], 0.005) +
                     window(v, data->pressures[P1], now[0], 0.005));
    }
}

static void judge(WeirValidation *v)
{
    const Kleefsman *data = v->data;
    double all, windows, reference;
    weir_gate_add(v, "H2, RMS deviation over 0.55 m", "1", WEIR_GATE_AT_MOST,
                  height_error(v, data->heights[H2], 2), NAN, weir_limit(v, 0.15, 0.05));
    weir_gate_add(v, "H4, RMS deviation over 0.55 m", "1", WEIR_GATE_AT_MOST,
                  height_error(v, data->heights[H4], 1), NAN, weir_limit(v, 0.1, 0.05));
    weir_gate_add(v, "H2, the same of the highest water", "1", WEIR_GATE_REPORTED,
                  height_error(v, data->highest[H2], 2), NAN, NAN);
    weir_gate_add(v, "H4, the same of the highest water", "1", WEIR_GATE_REPORTED,
                  height_error(v, data->highest[H4], 1), NAN, NAN);
    for (int k = 0; k < ARRIVALS; ++k) {
        char name[80];
        snprintf(name, sizeof name, "arrival at H%d", k + 1);
        weir_gate_add(v, name, "s", WEIR_GATE_RELATIVE, data->measured[k], data->arrivals[k],
                      weir_limit(v, 0.3, 0.03));
    }
    impulses(v, &all, &windows, &reference);
    weir_gate_add(v, "P1, impulse per area of the first second after impact", "Pa s", WEIR_GATE_RELATIVE, all,
                  reference, weir_limit(v, 0.5, 0.1));
    weir_gate_add(v, "the same, of the table's five windows alone", "Pa s", WEIR_GATE_REPORTED, windows,
                  reference, NAN);
}

const WeirCase weir_case_kleefsman = {
    .info =
        {"kleefsman", "SPHERIC 2: dam break onto a box, 3D",
         "Water 0.55 m deep breaks out of a third of a tank and meets a box: water heights, arrivals and the "
         "pressure on the box against the experiment.",
         "Kleefsman et al., J. Comput. Phys. 206 (2005), measured at MARIN; SPHERIC test 2"},
    .data_size = sizeof(Kleefsman),
    .plan = plan,
    .sample = sample,
    .judge = judge,
};
