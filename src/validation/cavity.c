// Lid-driven cavity, Re 100, 400 and 1000, against Ghia, Ghia and Shin 1982.
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_lid_cavity_scene[], weir_case_lid_cavity_reference_u[],
    weir_case_lid_cavity_reference_v[];

enum { FLOWS = 3, MAX_ROWS = 20, AVERAGES = 20 };
static const double reynolds[FLOWS] = {100.0, 400.0, 1000.0};

// One of the two lines: u on x = 1/2 or v on y = 1/2.
typedef struct Line {
    double table[4 * MAX_ROWS]; // coordinate, then the three Reynolds numbers
    uint32_t rows;
    double sum[FLOWS][MAX_ROWS]; // of the averaged samples
    uint32_t samples[FLOWS];
} Line;

typedef struct Cavity {
    Line u, v;
    uint32_t speed[FLOWS]; // curves
} Cavity;

static void plan(WeirValidation *v)
{
    static const double end[3][FLOWS] = {{12, 20, 30}, {15, 30, 50}, {15, 30, 50}};
    Cavity *cavity = v->data;
    double cells = weir_by_resolution(v, 32.0, 100.0, 200.0);
    for (int k = 0; k < FLOWS; ++k) {
        char label[48];
        snprintf(label, sizeof label, "Re %g, L/%g", reynolds[k], cells);
        WeirCaseRun *run = weir_plan_run(v, label, "validation/lid_cavity/scene.json",
                                         weir_case_lid_cavity_scene, 1.0 / cells, end[v->resolution][k], 0.1);
        run->path = "parameters.viscosity";
        run->value = 1000.0 / reynolds[k]; // rho U L / Re
        cavity->speed[k] =
            weir_curve_add(v, "Kinetic energy", label, "time", "s", "kinetic energy", "J/m", false);
    }
    cavity->u.rows = weir_reference_read(weir_case_lid_cavity_reference_u, 4, cavity->u.table, MAX_ROWS);
    cavity->v.rows = weir_reference_read(weir_case_lid_cavity_reference_v, 4, cavity->v.table, MAX_ROWS);
}

static void add_to_line(Line *line, const WeirSample *sample, uint32_t flow, bool is_u)
{
    for (uint32_t row = 0; row < line->rows; ++row) {
        double s = line->table[4 * row], velocity[3];
        double point[3] = {is_u ? 0.5 : s, is_u ? s : 0.5, 0.0};
        weir_measure_linear_velocity(sample, point, velocity);
        line->sum[flow][row] += velocity[is_u ? 0 : 1];
    }
    ++line->samples[flow];
}

static void sample(WeirValidation *v, const WeirSample *sample)
{
    Cavity *cavity = v->data;
    weir_curve_push(v, cavity->speed[v->run], sample->time, weir_fluid_sums(sample).kinetic_energy);
    const WeirRunInfo *run = &v->runs[v->run].info;
    if (sample->time < run->end_time - (AVERAGES - 0.5) * run->interval) return;
    add_to_line(&cavity->u, sample, v->run, true);
    add_to_line(&cavity->v, sample, v->run, false);
}

// Root mean square deviation; points that the table leaves out are left out.
static double judge_line(WeirValidation *v, const Line *line, uint32_t flow, bool is_u)
{
    char plot[64];
    double sum2 = 0.0;
    uint32_t count = 0;
    snprintf(plot, sizeof plot, "%s, Re %g", is_u ? "u on x = 1/2" : "v on y = 1/2", reynolds[flow]);
    const char *axis = is_u ? "y" : "x", *component = is_u ? "u" : "v";
    uint32_t measured = weir_curve_add(v, plot, "measured", axis, "m", component, "m/s", false);
    uint32_t reference = weir_curve_add(v, plot, "Ghia et al. 1982", axis, "m", component, "m/s", true);
    for (uint32_t row = 0; row < line->rows; ++row) {
        double value = line->sum[flow][row] / line->samples[flow], exact = line->table[4 * row + 1 + flow];
        weir_curve_push(v, measured, line->table[4 * row], value);
        if (isnan(exact)) continue;
        weir_curve_push(v, reference, line->table[4 * row], exact);
        sum2 += (value - exact) * (value - exact);
        ++count;
    }
    return line->samples[flow] ? sqrt(sum2 / count) : (double)NAN;
}

static void judge(WeirValidation *v)
{
    static const double limits[FLOWS] = {0.015, 0.02, 0.03}, coarse[FLOWS] = {0.06, 0.12, 0.2};
    const Cavity *cavity = v->data;
    for (uint32_t flow = 0; flow < FLOWS; ++flow) {
        char name[80];
        for (int k = 0; k < 2; ++k) {
            snprintf(name, sizeof name, "RMS deviation of %s over the lid's speed, Re %g", k ? "v" : "u",
                     reynolds[flow]);
            weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST,
                          judge_line(v, k ? &cavity->v : &cavity->u, flow, k == 0), NAN,
                          weir_limit(v, coarse[flow], limits[flow]));
        }
    }
}

const WeirCase weir_case_lid_cavity = {
    .info = {"lid_cavity", "Lid-driven cavity, Re 100, 400, 1000",
             "A lid drives the fluid of a square cavity until its flow is steady: velocities on the two "
             "middle lines, "
             "averaged over the last 2 s, against the tables.",
             "Ghia, Ghia, Shin, J. Comput. Phys. 48 (1982)"},
    .data_size = sizeof(Cavity),
    .plan = plan,
    .sample = sample,
    .judge = judge,
};
