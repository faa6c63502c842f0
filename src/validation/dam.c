// Columns of water that collapse in a tank, 2D: the front against Martin and Moyce 1952 and against the data of
// DualSPHysics' example.
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_dam_break_scene[], weir_case_dam_break_reference[],
    weir_case_dam_break_reference_far[], weir_case_column_collapse_scene[],
    weir_case_column_collapse_reference[];

enum { MAX_ROWS = 64 };

typedef struct Dam {
    uint32_t front; // curve: scaled time, scaled front
    double rows[2 * MAX_ROWS];
    uint32_t row_count;
    double time_scale, length_scale; // what time and front are divided by
} Dam;

static void plan_dam(WeirValidation *v, const char *file, const char *text, const char *reference,
                     double spacing, double time_scale, double length_scale, double end)
{
    Dam *dam = v->data;
    char label[48];
    dam->row_count = weir_reference_read(reference, 2, dam->rows, MAX_ROWS);
    dam->time_scale = time_scale;
    dam->length_scale = length_scale;
    snprintf(label, sizeof label, "spacing %g m", spacing);
    weir_plan_run(v, label, file, text, spacing, end * time_scale, end * time_scale / 200.0);
}

static void add_reference(WeirValidation *v, const char *plot, const char *name, const char *x_name,
                          const char *x_unit, const char *y_name, const char *y_unit, const char *text)
{
    double rows[2 * MAX_ROWS];
    uint32_t count = weir_reference_read(text, 2, rows, MAX_ROWS);
    uint32_t curve = weir_curve_add(v, plot, name, x_name, x_unit, y_name, y_unit, true);
    for (uint32_t k = 0; k < count; ++k) weir_curve_push(v, curve, rows[2 * k], rows[2 * k + 1]);
}

static void sample_dam(WeirValidation *v, const WeirSample *sample)
{
    const Dam *dam = v->data;
    WeirFluidSums sums = weir_fluid_sums(sample);
    double front = sums.max[0] + 0.5 * (double)sample->parameters->particle_spacing;
    weir_curve_push(v, dam->front, sample->time / dam->time_scale, front / dam->length_scale);
}

// Deviation of the front from the table, with the table's times less `delay`: the largest, or the root mean square.
static double deviation(const WeirValidation *v, double delay, bool largest)
{
    const Dam *dam = v->data;
    double most = 0.0, sum2 = 0.0;
    for (uint32_t k = 0; k < dam->row_count; ++k) {
        double error = weir_curve_at(v, dam->front, dam->rows[2 * k] - delay) / dam->rows[2 * k + 1] - 1.0;
        if (isnan(error)) return NAN;
        most = fmax(most, fabs(error));
        sum2 += error * error;
    }
    return largest ? most : sqrt(sum2 / dam->row_count);
}

// ---- Martin and Moyce ----

static const double column_width = 0.05715; // a, m
static const double gravity = 9.81;         // m/s^2
static const double gate_delay = 0.175;     // in units of sqrt(a / 2g)

static void plan_martin_moyce(WeirValidation *v)
{
    Dam *dam = v->data;
    plan_dam(v, "validation/dam_break/scene.json", weir_case_dam_break_scene, weir_case_dam_break_reference,
             column_width / weir_by_resolution(v, 24.0, 80.0, 160.0), sqrt(column_width / (2.0 * gravity)),
             column_width, weir_by_resolution(v, 3.2, 9.4, 9.4));
    dam->front = weir_curve_add(v, "Front", "front", "t sqrt(2g/a)", "1", "x / a", "1", false);
    add_reference(v, "Front", "Martin and Moyce 1952", "t sqrt(2g/a)", "1", "x / a", "1",
                  weir_case_dam_break_reference);
    add_reference(v, "Front", "the same, continued (PySPH)", "t sqrt(2g/a)", "1", "x / a", "1",
                  weir_case_dam_break_reference_far);
}

static void judge_martin_moyce(WeirValidation *v)
{
    weir_gate_add(v, "front, largest deviation, gate delay 0.175", "1", WEIR_GATE_AT_MOST,
                  deviation(v, gate_delay, true), NAN, weir_limit(v, 0.10, 0.03));
    weir_gate_add(v, "front, RMS deviation, gate delay 0.175", "1", WEIR_GATE_REPORTED,
                  deviation(v, gate_delay, false), NAN, NAN);
    weir_gate_add(v, "front, largest deviation, no delay", "1", WEIR_GATE_REPORTED, deviation(v, 0.0, true),
                  NAN, NAN);
    weir_gate_add(v, "front, RMS deviation, no delay", "1", WEIR_GATE_REPORTED, deviation(v, 0.0, false), NAN,
                  NAN);
}

const WeirCase weir_case_dam_break = {
    .info = {"dam_break", "Dam break, Martin and Moyce 1952",
             "A column a = 57 mm wide and 2a high collapses on a dry floor: the front at 13 times. The gate "
             "that held "
             "the water took time to open; the usual delay of 0.175 sqrt(a/2g) is added to the simulated "
             "time, and "
             "the comparison without it is reported beside.",
             "Martin, Moyce, Phil. Trans. R. Soc. A 244 (1952), n^2 = 2, digitised in the Lethe repository"},
    .data_size = sizeof(Dam),
    .plan = plan_martin_moyce,
    .sample = sample_dam,
    .judge = judge_martin_moyce,
};

// ---- Collapse of a 1 x 2 m column ----

static void plan_collapse(WeirValidation *v)
{
    Dam *dam = v->data;
    plan_dam(v, "validation/column_collapse/scene.json", weir_case_column_collapse_scene,
             weir_case_column_collapse_reference, weir_by_resolution(v, 0.04, 0.01, 0.005), 1.0, 1.0, 0.72);
    dam->front = weir_curve_add(v, "Front", "front", "time", "s", "x", "m", false);
    add_reference(v, "Front", "example data of DualSPHysics", "time", "s", "x", "m",
                  weir_case_column_collapse_reference);
}

static void judge_collapse(WeirValidation *v)
{
    weir_gate_add(v, "front, largest deviation", "1", WEIR_GATE_AT_MOST, deviation(v, 0.0, true), NAN,
                  weir_limit(v, 0.15, 0.03));
    weir_gate_add(v, "front, RMS deviation", "1", WEIR_GATE_REPORTED, deviation(v, 0.0, false), NAN, NAN);
    // a = 1 m.
    double delay = gate_delay * sqrt(1.0 / (2.0 * gravity));
    weir_gate_add(v, "front, largest deviation, gate delay 0.040 s", "1", WEIR_GATE_REPORTED,
                  deviation(v, delay, true), NAN, NAN);
}

const WeirCase weir_case_column_collapse = {
    .info = {"column_collapse", "Collapse of a 1 x 2 m column",
             "A column 1 m wide and 2 m high collapses in a tank 4 m long: the front at 14 times.",
             "Koshizuka, Oka 1996, as in DualSPHysics' example data"},
    .data_size = sizeof(Dam),
    .plan = plan_collapse,
    .sample = sample_dam,
    .judge = judge_collapse,
};
