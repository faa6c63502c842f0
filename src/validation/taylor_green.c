// Taylor-Green vortices, Re 100, in a periodic square of side 1 m: three spacings, lattice and disturbed lattice.
#include "validation/analytic.h"
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

extern const char weir_case_taylor_green_scene[];

enum { LEVELS = 3 };
static const double speed = 1.0, side = 1.0, reynolds = 100.0, final_decay = 0.05;

typedef struct TaylorGreen {
    uint32_t max_speed[2 * LEVELS], error[2 * LEVELS]; // curves
    double l1[2 * LEVELS], exponent[2 * LEVELS];       // at the end; NaN: not reached
    double start_energy[2 * LEVELS];
} TaylorGreen;

static double exponent(void)
{
    return weir_taylor_green_exponent(speed * side / reynolds, side);
}

static void plan(WeirValidation *v)
{
    static const double cells[3][LEVELS] = {{25, 36, 50}, {50, 100, 200}, {100, 200, 400}};
    TaylorGreen *data = v->data;
    double end = log(final_decay) / exponent();
    for (int k = 0; k < 2 * LEVELS; ++k) {
        bool disturbed = k >= LEVELS;
        char label[48];
        double n = cells[v->resolution][k % LEVELS];
        snprintf(label, sizeof label, "L/%g, %s", n, disturbed ? "disturbed" : "lattice");
        WeirCaseRun *run = weir_plan_run(v, label, "validation/taylor_green/scene.json",
                                         weir_case_taylor_green_scene, side / n, end, end / 50.0);
        run->variant = disturbed;
        data->max_speed[k] = weir_curve_add(v, "Decay of the largest speed", label, "time", "s",
                                            "largest speed", "m/s", false);
        data->error[k] = weir_curve_add(v, "L1 error of the velocity", label, "time", "s",
                                        "error over the mean speed", "1", false);
        data->l1[k] = data->exponent[k] = NAN;
    }
    uint32_t exact = weir_curve_add(v, "Decay of the largest speed", "exp(-8 pi^2 t / Re)", "time", "s",
                                    "largest speed", "m/s", true);
    for (int k = 0; k <= 50; ++k)
        weir_curve_push(v, exact, end * k / 50.0, speed * exp(exponent() * end * k / 50.0));
}

// xorshift64*, Vigna 2016.
static double random_unit(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (double)((*state * 0x2545F4914F6CDD1Du) >> 40) / 16777216.0;
}

// Moves each particle by up to a fifth of a spacing per axis and gives it the velocity of its new place.
static WeirStatus begin(WeirValidation *v, WeirSim *sim)
{
    if (!v->runs[v->run].variant) return WEIR_OK;
    WeirState state;
    WeirStatus status = weir_sim_state(sim, &state);
    if (status) return status;
    float *values = malloc(4 * (size_t)state.count * sizeof *values);
    if (!values) return WEIR_ERROR_MEMORY;
    float *position = values, *velocity = values + 2 * (size_t)state.count;
    uint64_t seed = 20261125;
    for (size_t i = 0; i < state.count; ++i) {
        double x[2], u[2];
        for (int axis = 0; axis < 2; ++axis) {
            double shift = 0.4 * (random_unit(&seed) - 0.5) * v->runs[v->run].info.spacing;
            x[axis] = fmin(fmax((double)state.position[2 * i + axis] + shift, 0.0), side);
            position[2 * i + axis] = (float)x[axis];
        }
        weir_taylor_green_velocity(speed, side, 1.0, x[0], x[1], u);
        for (int axis = 0; axis < 2; ++axis) velocity[2 * i + axis] = (float)u[axis];
    }
    status = weir_sim_set_state(sim, position, velocity);
    free(values);
    return status;
}

static void sample(WeirValidation *v, const WeirSample *sample)
{
    TaylorGreen *data = v->data;
    uint32_t run = v->run;
    double decay = exp(exponent() * sample->time), error = 0.0, mean = 0.0;
    for (size_t i = 0; i < sample->state->count; ++i) {
        double u[2];
        weir_taylor_green_velocity(speed, side, decay, weir_sample_position(sample, i, 0),
                                   weir_sample_position(sample, i, 1), u);
        error += hypot(weir_sample_velocity(sample, i, 0) - u[0], weir_sample_velocity(sample, i, 1) - u[1]);
        mean += hypot(u[0], u[1]);
    }
    WeirFluidSums sums = weir_fluid_sums(sample);
    weir_curve_push(v, data->max_speed[run], sample->time, sums.max_speed);
    weir_curve_push(v, data->error[run], sample->time, error / mean);
    if (sample->time == 0.0) data->start_energy[run] = sums.kinetic_energy;
    if (sample->time < v->runs[run].info.end_time * (1.0 - 1e-9)) return;
    data->l1[run] = error / mean;
    data->exponent[run] = log(sums.kinetic_energy / data->start_energy[run]) / (2.0 * sample->time);
}

static double order(const WeirValidation *v, const double *l1, int first)
{
    double x[LEVELS], y[LEVELS];
    for (int k = 0; k < LEVELS; ++k) {
        x[k] = log(v->runs[first + k].info.spacing);
        y[k] = log(l1[first + k]);
    }
    return weir_fitted_slope(x, y, LEVELS);
}

static void judge(WeirValidation *v)
{
    const TaylorGreen *data = v->data;
    static const char *const names[2] = {"lattice", "disturbed"};
    for (int k = 0; k < 2; ++k) {
        char name[80], plot_name[48];
        int first = k * LEVELS, finest = first + LEVELS - 1;
        snprintf(name, sizeof name, "order of convergence, %s", names[k]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_LEAST, order(v, data->l1, first), NAN,
                      weir_limit(v, 1.0, 1.5));
        snprintf(name, sizeof name, "decay exponent at the finest, %s", names[k]);
        weir_gate_add(v, name, "1/s", WEIR_GATE_RELATIVE, data->exponent[finest], exponent(),
                      weir_limit(v, 0.1, 0.02));
        snprintf(name, sizeof name, "L1 error at the finest, %s", names[k]);
        weir_gate_add(v, name, "1", WEIR_GATE_REPORTED, data->l1[finest], NAN, NAN);
        snprintf(plot_name, sizeof plot_name, "%s", names[k]);
        uint32_t curve =
            weir_curve_add(v, "Convergence", plot_name, "spacing", "m", "L1 error at the end", "1", false);
        for (int level = 0; level < LEVELS; ++level)
            weir_curve_push(v, curve, v->runs[first + level].info.spacing, data->l1[first + level]);
    }
}

const WeirCase weir_case_taylor_green = {
    .info = {"taylor_green", "Taylor-Green vortices, Re 100",
             "Vortices decay in a periodic square until their speed is 5 % of the start's, at three "
             "spacings, from "
             "a lattice and from a disturbed one: rate of decay and order of convergence.",
             "exact solution of the Navier-Stokes equations"},
    .data_size = sizeof(TaylorGreen),
    .plan = plan,
    .begin = begin,
    .sample = sample,
    .judge = judge,
};
