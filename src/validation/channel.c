// Flow between plates from rest: Poiseuille and Couette, L = 1 m, nu = 0.01 m^2/s, Re = 0.0125.
#include "validation/analytic.h"
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_poiseuille_scene[], weir_case_couette_scene[];

enum { TIMES = 5, POINTS = 60 };
static const double gap = 1.0, nu = 0.01, largest_speed = 1.25e-4;
// Steady to a thousandth after 60 s. Samples every 2 s meet all of these.
static const double times[TIMES] = {2.0, 6.0, 10.0, 20.0, 60.0};
static const double interval = 2.0;

typedef struct Channel {
    double error[TIMES];
} Channel;

// The largest speed of the steady flow is F L^2 / (8 nu).
static double poiseuille(double y, double t)
{
    return weir_poiseuille_speed(8.0 * nu * largest_speed / (gap * gap), nu, gap, y, t);
}

static double couette(double y, double t)
{
    return weir_couette_speed(largest_speed, nu, gap, y, t);
}

static void plan_channel(WeirValidation *v, const char *file, const char *text)
{
    Channel *channel = v->data;
    double cells = weir_by_resolution(v, 40.0, 60.0, 120.0);
    char label[48];
    snprintf(label, sizeof label, "L/%g", cells);
    weir_plan_run(v, label, file, text, gap / cells, times[TIMES - 1], interval);
    for (int k = 0; k < TIMES; ++k) channel->error[k] = NAN;
}

static void sample_channel(WeirValidation *v, const WeirSample *sample, double (*exact)(double y, double t))
{
    Channel *channel = v->data;
    int index = 0;
    while (index < TIMES && fabs(sample->time - times[index]) > 0.25 * interval) ++index;
    if (index == TIMES) return;
    char name[48];
    snprintf(name, sizeof name, "t = %g s", times[index]);
    uint32_t measured = weir_curve_add(v, "Velocity profiles", name, "y", "m", "speed", "m/s", false);
    uint32_t reference = weir_curve_add(v, "Velocity profiles", name, "y", "m", "speed", "m/s", true);
    double error2 = 0.0, exact2 = 0.0, spacing = sample->parameters->particle_spacing;
    for (size_t i = 0; i < sample->state->count; ++i) {
        if (!weir_sample_is_fluid(sample, i)) continue;
        double x = weir_sample_position(sample, i, 0), y = weir_sample_position(sample, i, 1);
        double u = weir_sample_velocity(sample, i, 0), u_exact = exact(y, sample->time);
        error2 += (u - u_exact) * (u - u_exact);
        exact2 += u_exact * u_exact;
        // One column of particles is enough to draw.
        if (x < spacing) weir_curve_push(v, measured, y, u);
    }
    for (int k = 0; k <= POINTS; ++k) {
        double y = gap * k / POINTS;
        weir_curve_push(v, reference, y, exact(y, sample->time));
    }
    channel->error[index] = sqrt(error2 / exact2);
}

static void judge_channel(WeirValidation *v)
{
    const Channel *channel = v->data;
    for (int k = 0; k < TIMES; ++k) {
        char name[80];
        snprintf(name, sizeof name, "L2 error of the profile at %g s", times[k]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, channel->error[k], NAN, weir_limit(v, 0.02, 0.01));
    }
}

static void plan_poiseuille(WeirValidation *v)
{
    plan_channel(v, "validation/poiseuille/scene.json", weir_case_poiseuille_scene);
}

static void sample_poiseuille(WeirValidation *v, const WeirSample *sample)
{
    sample_channel(v, sample, poiseuille);
}

const WeirCase weir_case_poiseuille = {
    .info =
        {"poiseuille", "Poiseuille flow from rest, Re 0.0125",
         "A body force drives fluid between two plates: velocity profiles at five times against the series "
         "solution.",
         "Morris, Fox, Zhu, J. Comput. Phys. 136 (1997)"},
    .data_size = sizeof(Channel),
    .plan = plan_poiseuille,
    .sample = sample_poiseuille,
    .judge = judge_channel,
};

static void plan_couette(WeirValidation *v)
{
    plan_channel(v, "validation/couette/scene.json", weir_case_couette_scene);
}

static void sample_couette(WeirValidation *v, const WeirSample *sample)
{
    sample_channel(v, sample, couette);
}

const WeirCase weir_case_couette = {
    .info = {"couette", "Couette flow from rest, Re 0.0125",
             "The upper one of two plates moves along: velocity profiles at five times against the series "
             "solution.",
             "Morris, Fox, Zhu, J. Comput. Phys. 136 (1997)"},
    .data_size = sizeof(Channel),
    .plan = plan_couette,
    .sample = sample_couette,
    .judge = judge_channel,
};
