// Drops without walls: the stretching and the oscillating one, the rotating square, and a free one whose momentum,
// angular momentum and energy are watched.
#include "validation/analytic.h"
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

extern const char weir_case_elliptical_drop_scene[], weir_case_oscillating_drop_scene[],
    weir_case_rotating_square_scene[], weir_case_free_drop_scene[], weir_case_free_drop_scene_3d[],
    weir_case_elliptical_drop_reference[];

// Semi-axis of an ellipse of uniform density along an axis, from the variance of the positions: a^2 / 4. The variance of
// the volume of each particle's own square is part of it.
static double semi_axis(const WeirFluidSums *sums, double spacing, uint32_t axis)
{
    return 2.0 * sqrt(sums->spread[axis] + spacing * spacing / 12.0);
}

static void plan_drop(WeirValidation *v, const char *file, const char *text, double cells, double end,
                      double interval)
{
    char label[48];
    snprintf(label, sizeof label, "R/%g", cells);
    weir_plan_run(v, label, file, text, 1.0 / cells, end, interval);
}

// ---- Elliptical drop ----

enum { DROP_TIMES = 3 };
static const double strain = 100.0; // 1/s
static const double drop_times[DROP_TIMES] = {0.0008, 0.0038, 0.0076};
static const double drop_interval = 0.0002;

typedef struct Ellipse {
    uint32_t major, minor;
} Ellipse;

static void plan_elliptical(WeirValidation *v)
{
    Ellipse *ellipse = v->data;
    plan_drop(v, "validation/elliptical_drop/scene.json", weir_case_elliptical_drop_scene,
              weir_by_resolution(v, 30.0, 100.0, 200.0), drop_times[DROP_TIMES - 1], drop_interval);
    ellipse->major = weir_curve_add(v, "Semi-axes", "major", "time", "s", "semi-axis", "m", false);
    ellipse->minor = weir_curve_add(v, "Semi-axes", "minor", "time", "s", "semi-axis", "m", false);
    uint32_t exact[2] = {
        weir_curve_add(v, "Semi-axes", "minor", "time", "s", "semi-axis", "m", true),
        weir_curve_add(v, "Semi-axes", "major", "time", "s", "semi-axis", "m", true),
    };
    for (double t = 0.0; t < drop_times[DROP_TIMES - 1] + 1e-9; t += drop_interval) {
        double axes[2];
        weir_drop_axes(0.0, -strain, 1.0, t, axes);
        for (int k = 0; k < 2; ++k) weir_curve_push(v, exact[k], t, axes[k]);
    }
}

static void sample_elliptical(WeirValidation *v, const WeirSample *sample)
{
    const Ellipse *ellipse = v->data;
    WeirFluidSums sums = weir_fluid_sums(sample);
    double spacing = sample->parameters->particle_spacing;
    weir_curve_push(v, ellipse->minor, sample->time, semi_axis(&sums, spacing, 0));
    weir_curve_push(v, ellipse->major, sample->time, semi_axis(&sums, spacing, 1));
}

static void judge_elliptical(WeirValidation *v)
{
    const Ellipse *ellipse = v->data;
    for (int k = 0; k < DROP_TIMES; ++k) {
        char name[80];
        double axes[2];
        weir_drop_axes(0.0, -strain, 1.0, drop_times[k], axes);
        snprintf(name, sizeof name, "major semi-axis at %g s", drop_times[k]);
        // The last sample may lie a rounding error before the last time.
        double t = drop_times[k] * (1.0 - 1e-7);
        weir_gate_add(v, name, "m", WEIR_GATE_RELATIVE, weir_curve_at(v, ellipse->major, t), axes[1],
                      weir_limit(v, 0.02, 0.01));
    }
}

const WeirCase weir_case_elliptical_drop = {
    .info =
        {"elliptical_drop", "Elliptical drop",
         "A disc of water in a strain flow of 100 1/s stretches to an ellipse: its major semi-axis at three "
         "times, from the second moment of the particles' positions.",
         "Monaghan, J. Comput. Phys. 110 (1994), equations integrated"},
    .data_size = sizeof(Ellipse),
    .plan = plan_elliptical,
    .sample = sample_elliptical,
    .judge = judge_elliptical,
};

// ---- Oscillating drop ----

static const double omega = 1.0, sigma = 0.5; // 1/s
enum { PERIODS = 5 };

typedef struct Oscillation {
    uint32_t horizontal, vertical;
} Oscillation;

static void plan_oscillating(WeirValidation *v)
{
    Oscillation *oscillation = v->data;
    double period = weir_drop_period(omega, sigma, 1.0), end = 1.02 * PERIODS * period;
    plan_drop(v, "validation/oscillating_drop/scene.json", weir_case_oscillating_drop_scene,
              weir_by_resolution(v, 20.0, 50.0, 100.0), end, period / 100.0);
    oscillation->horizontal = weir_curve_add(v, "Semi-axes", "along x", "time", "s", "semi-axis", "m", false);
    oscillation->vertical = weir_curve_add(v, "Semi-axes", "along y", "time", "s", "semi-axis", "m", false);
    uint32_t exact = weir_curve_add(v, "Semi-axes", "along x", "time", "s", "semi-axis", "m", true);
    for (int k = 0; k <= 500; ++k) {
        double axes[2], t = end * k / 500.0;
        weir_drop_axes(omega, sigma, 1.0, t, axes);
        weir_curve_push(v, exact, t, axes[0]);
    }
}

static void sample_oscillating(WeirValidation *v, const WeirSample *sample)
{
    const Oscillation *oscillation = v->data;
    WeirFluidSums sums = weir_fluid_sums(sample);
    double spacing = sample->parameters->particle_spacing;
    weir_curve_push(v, oscillation->horizontal, sample->time, semi_axis(&sums, spacing, 0));
    weir_curve_push(v, oscillation->vertical, sample->time, semi_axis(&sums, spacing, 1));
}

// Mean time between upward crossings of horizontal - vertical; the start is one.
static double oscillation_period(const WeirValidation *v)
{
    const Oscillation *oscillation = v->data;
    const WeirCurveData *a = &v->curves[oscillation->horizontal], *b = &v->curves[oscillation->vertical];
    double last = NAN;
    int crossings = 0;
    for (uint32_t k = 2; k < a->info.count && crossings < PERIODS; ++k) {
        double before = a->y[k - 1] - b->y[k - 1], now = a->y[k] - b->y[k];
        if (!(before < 0.0 && now >= 0.0)) continue;
        last = a->x[k] - (a->x[k] - a->x[k - 1]) * now / (now - before);
        ++crossings;
    }
    return crossings ? last / crossings : (double)NAN;
}

static void judge_oscillating(WeirValidation *v)
{
    const Oscillation *oscillation = v->data;
    double period = weir_drop_period(omega, sigma, 1.0), largest = weir_drop_largest_axis(omega, sigma, 1.0);
    double peak = weir_curve_max(v, oscillation->horizontal, (PERIODS - 1) * period, PERIODS * period);
    weir_gate_add(v, "period", "s", WEIR_GATE_RELATIVE, oscillation_period(v), period,
                  weir_limit(v, 0.03, 0.01));
    weir_gate_add(v, "loss of amplitude in five periods", "1", WEIR_GATE_AT_MOST,
                  1.0 - (peak - 1.0) / (largest - 1.0), NAN, weir_limit(v, 0.2, 0.05));
    weir_gate_add(v, "largest semi-axis in the fifth period", "m", WEIR_GATE_REPORTED, peak, largest, NAN);
}

const WeirCase weir_case_oscillating_drop = {
    .info =
        {"oscillating_drop", "Oscillating drop in a central force",
         "A disc that a central force holds together is set in oscillation: its period, and how much of the "
         "amplitude (largest semi-axis - 1) is left in the fifth period.",
         "Monaghan, Rafiee, Int. J. Numer. Meth. Fluids 71 (2013), equations integrated"},
    .data_size = sizeof(Oscillation),
    .plan = plan_oscillating,
    .sample = sample_oscillating,
    .judge = judge_oscillating,
};

// ---- Rotating square ----

static const double square_end = 2.0; // omega t, omega = 1 1/s, side 1 m, rho 1000

typedef struct Square {
    uint32_t pressure;
    double connected;
} Square;

static void plan_square(WeirValidation *v)
{
    Square *square = v->data;
    plan_drop(v, "validation/rotating_square/scene.json", weir_case_rotating_square_scene,
              weir_by_resolution(v, 40.0, 100.0, 200.0), square_end, 0.01);
    square->pressure =
        weir_curve_add(v, "Pressure in the middle", "measured", "time", "s", "pressure", "Pa", false);
    square->connected = NAN;
}

static void sample_square(WeirValidation *v, const WeirSample *sample)
{
    Square *square = v->data;
    WeirFluidSums sums = weir_fluid_sums(sample);
    weir_curve_push(v, square->pressure, sample->time, weir_measure_pressure(sample, sums.center));
    if (sample->time < square_end * (1.0 - 1e-9)) return;
    square->connected = weir_largest_cluster(sample, 2.0 * (double)sample->parameters->particle_spacing);
    uint32_t shape = weir_curve_add(v, "Particles at omega t = 2", "particles", "x", "m", "y", "m", false);
    // A picture needs no more than some thousand points.
    uint32_t stride = 1 + sums.count / 3000;
    for (size_t i = 0; i < sample->state->count; i += stride)
        weir_curve_push(v, shape, weir_sample_position(sample, i, 0), weir_sample_position(sample, i, 1));
}

static void judge_square(WeirValidation *v)
{
    const Square *square = v->data;
    double exact = weir_rotating_square_pressure(1000.0, 1.0, 1.0, 0.5, 0.5);
    weir_gate_add(v, "pressure in the middle, mean up to omega t = 0.1", "Pa", WEIR_GATE_RELATIVE,
                  weir_curve_mean(v, square->pressure, 0.0, 0.1), exact, weir_limit(v, 0.1, 0.05));
    weir_gate_add(v, "share of particles in one piece at omega t = 2", "1", WEIR_GATE_AT_LEAST,
                  square->connected, NAN, weir_limit(v, 0.98, 0.99));
}

const WeirCase weir_case_rotating_square = {
    .info = {"rotating_square", "Rotating square of fluid",
             "A square of fluid turns like a rigid body and grows arms under negative pressure: the pressure "
             "in its "
             "middle at the start, and whether the arms hold (gaps below two spacings) at omega t = 2.",
             "Colagrossi, thesis, Rome 2005; Le Touze et al., Int. J. Numer. Meth. Fluids 73 (2013)"},
    .data_size = sizeof(Square),
    .plan = plan_square,
    .sample = sample_square,
    .judge = judge_square,
};

// ---- Free drop: a square that turns, and a cube ----

enum { FREE_2D, FREE_3D, FREE_RUNS };
static const char *const free_names[FREE_RUNS] = {"2D", "3D"};

typedef struct Free {
    uint32_t momentum, angular, energy; // curves
    double start[3], start_angular, start_energy, scale;
    double momentum_drift, angular_drift, energy_growth; // largest so far
    uint64_t start_step, steps;
} Free;

static const double free_end = 1.0;

static void plan_free(WeirValidation *v)
{
    plan_drop(v, "validation/free_drop/scene.json", weir_case_free_drop_scene,
              weir_by_resolution(v, 40.0, 100.0, 200.0), free_end, 0.02);
    plan_drop(v, "validation/free_drop/scene_3d.json", weir_case_free_drop_scene_3d,
              weir_by_resolution(v, 15.0, 40.0, 80.0), free_end, 0.02);
    for (int run = 0; run < FREE_RUNS; ++run) {
        Free *data = (Free *)v->data + run;
        char name[80];
        snprintf(name, sizeof name, "change over sum m |v|, %s", free_names[run]);
        data->momentum = weir_curve_add(v, "Momentum", name, "time", "s", "change", "1", false);
        snprintf(name, sizeof name, "change over the start's, %s", free_names[run]);
        data->angular = weir_curve_add(v, "Angular momentum", name, "time", "s", "change", "1", false);
        snprintf(name, sizeof name, "kinetic and elastic, over the start's, %s", free_names[run]);
        data->energy = weir_curve_add(v, "Energy", name, "time", "s", "ratio", "1", false);
    }
}

// Scenes know no field that turns in 3D: 1 rad/s about z is added to the cube's velocity.
static WeirStatus begin_free(WeirValidation *v, WeirSim *sim)
{
    if (v->run != FREE_3D) return WEIR_OK;
    WeirState state;
    WeirStatus status = weir_sim_state(sim, &state);
    if (status) return status;
    float *velocity = malloc(3 * (size_t)state.count * sizeof *velocity);
    if (!velocity) return WEIR_ERROR_MEMORY;
    for (size_t i = 0; i < state.count; ++i) {
        velocity[3 * i] = state.velocity[3 * i] + state.position[3 * i + 1];
        velocity[3 * i + 1] = state.velocity[3 * i + 1] - state.position[3 * i];
        velocity[3 * i + 2] = state.velocity[3 * i + 2];
    }
    status = weir_sim_set_state(sim, state.position, velocity);
    free(velocity);
    return status;
}

static void start_free(Free *data, const WeirFluidSums *sums, const WeirSample *sample)
{
    for (int axis = 0; axis < 3; ++axis) data->start[axis] = sums->momentum[axis];
    data->scale = sums->speed_momentum;
    data->start_angular = sums->angular_momentum;
    data->start_energy = sums->kinetic_energy + sums->elastic_energy;
    data->start_step = sample->state->step;
    data->momentum_drift = data->angular_drift = data->energy_growth = 0.0;
}

static void sample_free(WeirValidation *v, const WeirSample *sample)
{
    Free *data = (Free *)v->data + v->run;
    WeirFluidSums sums = weir_fluid_sums(sample);
    if (sample->time == 0.0) start_free(data, &sums, sample);
    double change2 = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        change2 += (sums.momentum[axis] - data->start[axis]) * (sums.momentum[axis] - data->start[axis]);
    double momentum = sqrt(change2) / data->scale;
    double angular = fabs(sums.angular_momentum / data->start_angular - 1.0);
    double energy = (sums.kinetic_energy + sums.elastic_energy) / data->start_energy;
    data->steps = sample->state->step - data->start_step;
    data->momentum_drift = fmax(data->momentum_drift, momentum / fmax((double)data->steps, 1.0));
    data->angular_drift = fmax(data->angular_drift, angular);
    data->energy_growth = fmax(data->energy_growth, energy - 1.0);
    weir_curve_push(v, data->momentum, sample->time, momentum);
    weir_curve_push(v, data->angular, sample->time, angular);
    weir_curve_push(v, data->energy, sample->time, energy);
}

static void judge_free(WeirValidation *v)
{
    for (int run = 0; run < FREE_RUNS; ++run) {
        const Free *data = (const Free *)v->data + run;
        bool measured = data->steps > 0;
        char name[80];
        snprintf(name, sizeof name, "change of momentum per step over sum m |v|, %s", free_names[run]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, measured ? data->momentum_drift : (double)NAN, NAN,
                      1e-7);
        snprintf(name, sizeof name, "change of angular momentum, %s", free_names[run]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, measured ? data->angular_drift : (double)NAN, NAN,
                      weir_limit(v, 2e-3, 1e-3));
        snprintf(name, sizeof name, "growth of energy above the start's, %s", free_names[run]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, measured ? data->energy_growth : (double)NAN, NAN,
                      1e-4);
    }
}

const WeirCase weir_case_free_drop = {
    .info =
        {"free_drop", "Free drops without walls",
         "A square (2D) and a cube (3D) of fluid fly and turn in empty space: momentum to the round-off of "
         "float32 (6e-8) per step, angular momentum, and energy, which may only fall.",
         "conservation laws"},
    .data_size = FREE_RUNS * sizeof(Free),
    .plan = plan_free,
    .begin = begin_free,
    .sample = sample_free,
    .judge = judge_free,
};
