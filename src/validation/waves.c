// Standing and solitary waves.
#include "validation/analytic.h"
#include "validation/measure.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_standing_wave_scene[], weir_case_solitary_wave_scene[];

static const double gravity = 9.81; // m/s^2

// ---- Standing wave: wavelength 2 m, depth 1 m ----

static const double wave_depth = 1.0, wavelength = 2.0, wave_reynolds = 250.0;
enum { INVISCID, VISCOUS, WAVE_RUNS };
enum { PERIODS = 4, PEAKS = 6 };

typedef struct Standing {
    uint32_t mode[WAVE_RUNS], energy[WAVE_RUNS]; // curves
} Standing;

static double wavenumber(void)
{
    return 2.0 * weir_pi / wavelength;
}

static double wave_period(void)
{
    return 2.0 * weir_pi / weir_wave_frequency(gravity, wavenumber(), wave_depth);
}

// Kinematic viscosity for Re = H sqrt(g H) / nu.
static double wave_nu(void)
{
    return wave_depth * sqrt(gravity * wave_depth) / wave_reynolds;
}

static double envelope(double t)
{
    return exp(-4.0 * wave_nu() * wavenumber() * wavenumber() * t);
}

static void plan_standing(WeirValidation *v)
{
    static const char *const names[WAVE_RUNS] = {"inviscid", "Re 250"};
    Standing *standing = v->data;
    double spacing = weir_by_resolution(v, 0.04, 0.01, 0.005), period = wave_period();
    for (int k = 0; k < WAVE_RUNS; ++k) {
        double end = k == INVISCID ? (PERIODS + 0.3) * period : (0.5 * PEAKS + 0.1) * period;
        WeirCaseRun *run = weir_plan_run(v, names[k], "validation/standing_wave/scene.json",
                                         weir_case_standing_wave_scene, spacing, end, period / 100.0);
        run->path = "parameters.viscosity";
        run->value = k == INVISCID ? 0.0 : 1000.0 * wave_nu();
        standing->mode[k] =
            weir_curve_add(v, "Velocity of the mode", names[k], "time", "s", "over the start's", "1", false);
        standing->energy[k] =
            weir_curve_add(v, "Kinetic energy", names[k], "time", "s", "over the start's", "1", false);
    }
    uint32_t exact = weir_curve_add(v, "Kinetic energy", "envelope exp(-4 nu k^2 t), Re 250", "time", "s",
                                    "over the start's", "1", true);
    for (int k = 0; k <= 100; ++k) {
        double t = 0.5 * PEAKS * period * k / 100.0;
        weir_curve_push(v, exact, t, envelope(t));
    }
}

// Projection of the velocities on the mode (sin kx cosh ky, -cos kx sinh ky): its strength swings as cos(omega t),
// whatever else the fluid does.
static void sample_standing(WeirValidation *v, const WeirSample *sample)
{
    const Standing *standing = v->data;
    double strength = 0.0, norm = 0.0, k = wavenumber();
    for (size_t i = 0; i < sample->state->count; ++i) {
        if (!weir_sample_is_fluid(sample, i)) continue;
        double x = k * weir_sample_position(sample, i, 0), y = k * weir_sample_position(sample, i, 1);
        double mode[2] = {sin(x) * cosh(y), -cos(x) * sinh(y)};
        for (uint32_t axis = 0; axis < 2; ++axis) {
            strength += weir_sample_velocity(sample, i, axis) * mode[axis];
            norm += mode[axis] * mode[axis];
        }
    }
    weir_curve_push(v, standing->mode[v->run], sample->time, strength / norm);
    weir_curve_push(v, standing->energy[v->run], sample->time, weir_fluid_sums(sample).kinetic_energy);
}

// Values over that of the start, once all are there.
static void normalise(WeirValidation *v, uint32_t curve)
{
    WeirCurveData *data = &v->curves[curve];
    double start = data->info.count ? data->y[0] : 1.0;
    for (uint32_t k = 0; k < data->info.count; ++k) data->y[k] /= start;
}

// Mean period from zero crossings of the mode: the first is at a quarter of a period.
static double measured_period(const WeirValidation *v, uint32_t curve)
{
    const WeirCurveData *data = &v->curves[curve];
    double first = NAN, last = NAN;
    int crossings = 0;
    for (uint32_t k = 1; k < data->info.count; ++k) {
        double before = data->y[k - 1], now = data->y[k];
        if (before * now > 0.0 || before == now) continue;
        last = data->x[k] - (data->x[k] - data->x[k - 1]) * now / (now - before);
        if (crossings == 0) first = last;
        if (++crossings == 2 * PERIODS + 1) break;
    }
    return crossings > 1 ? 2.0 * (last - first) / (crossings - 1) : (double)NAN;
}

// Largest deviation of the energy's peaks, half a period apart, from the envelope.
static double envelope_error(const WeirValidation *v, uint32_t curve)
{
    double worst = 0.0, period = wave_period();
    for (int k = 1; k <= PEAKS; ++k) {
        double t = 0.5 * period * k, peak = weir_curve_max(v, curve, t - 0.1 * period, t + 0.1 * period);
        if (isnan(peak)) return NAN;
        worst = fmax(worst, fabs(peak / envelope(t) - 1.0));
    }
    return worst;
}

static void judge_standing(WeirValidation *v)
{
    const Standing *standing = v->data;
    for (int k = 0; k < WAVE_RUNS; ++k) {
        normalise(v, standing->mode[k]);
        normalise(v, standing->energy[k]);
    }
    weir_gate_add(v, "period, inviscid", "s", WEIR_GATE_RELATIVE,
                  measured_period(v, standing->mode[INVISCID]), wave_period(), weir_limit(v, 0.03, 0.01));
    weir_gate_add(v, "energy peaks against the envelope, Re 250, worst of 6", "1", WEIR_GATE_AT_MOST,
                  envelope_error(v, standing->energy[VISCOUS]), NAN, weir_limit(v, 0.4, 0.1));
}

const WeirCase weir_case_standing_wave = {
    .info = {"standing_wave", "Standing wave",
             "The first standing wave of a basin 2 m long and 1 m deep with smooth walls: its period without "
             "viscosity and the envelope of its kinetic energy at Re = H sqrt(g H) / nu = 250.",
             "linear wave theory; decay: Lighthill, Waves in Fluids (1978)"},
    .data_size = sizeof(Standing),
    .plan = plan_standing,
    .sample = sample_standing,
    .judge = judge_standing,
};

// ---- Solitary wave made by a piston ----

static const double still_depth = 0.25, wave_height = 0.05; // m
enum { GAUGES = 3 };
static const double gauges[GAUGES] = {2.0, 2.75, 3.5}; // m

typedef struct Solitary {
    uint32_t surface[GAUGES]; // curves
    double still
        [GAUGES]; // m; gauges are set to zero in still water, which stands g h^2 / 2 c^2 below its lattice
} Solitary;

static void plan_solitary(WeirValidation *v)
{
    Solitary *solitary = v->data;
    double spacing = still_depth / weir_by_resolution(v, 12.0, 40.0, 80.0);
    char label[48];
    snprintf(label, sizeof label, "h/%g", still_depth / spacing);
    weir_plan_run(v, label, "validation/solitary_wave/scene.json", weir_case_solitary_wave_scene, spacing,
                  4.0, 0.01);
    for (int k = 0; k < GAUGES; ++k) {
        char name[48];
        snprintf(name, sizeof name, "x = %g m", gauges[k]);
        solitary->surface[k] =
            weir_curve_add(v, "Surface", name, "time", "s", "surface over still water", "m", false);
    }
}

static void sample_solitary(WeirValidation *v, const WeirSample *sample)
{
    Solitary *solitary = v->data;
    for (int k = 0; k < GAUGES; ++k) {
        double height = weir_measure_height(sample, gauges[k], 0.0);
        if (sample->time == 0.0) solitary->still[k] = height;
        weir_curve_push(v, solitary->surface[k], sample->time, height - solitary->still[k]);
    }
}

// Height and time of a gauge's crest, by the parabola through the samples within a tenth of its height.
static void find_crest(const WeirValidation *v, uint32_t curve, double *time, double *height)
{
    const WeirCurveData *data = &v->curves[curve];
    uint32_t top = 0;
    *time = *height = NAN;
    for (uint32_t k = 1; k < data->info.count; ++k)
        if (data->y[k] > data->y[top]) top = k;
    if (data->info.count < 5) return;
    // Least squares of y = a + b s + c s^2, s = t - t_top.
    double m[5] = {0.0}, r[3] = {0.0};
    for (uint32_t k = 0; k < data->info.count; ++k) {
        double s = data->x[k] - data->x[top];
        if (fabs(s) > 0.15) continue;
        for (int p = 0; p < 5; ++p) m[p] += pow(s, p);
        for (int p = 0; p < 3; ++p) r[p] += data->y[k] * pow(s, p);
    }
    double det = m[0] * (m[2] * m[4] - m[3] * m[3]) - m[1] * (m[1] * m[4] - m[2] * m[3]) +
                 m[2] * (m[1] * m[3] - m[2] * m[2]);
    double a = (r[0] * (m[2] * m[4] - m[3] * m[3]) - m[1] * (r[1] * m[4] - m[3] * r[2]) +
                m[2] * (r[1] * m[3] - m[2] * r[2])) /
               det;
    double b = (m[0] * (r[1] * m[4] - m[3] * r[2]) - r[0] * (m[1] * m[4] - m[3] * m[2]) +
                m[2] * (m[1] * r[2] - r[1] * m[2])) /
               det;
    double c = (m[0] * (m[2] * r[2] - r[1] * m[3]) - m[1] * (m[1] * r[2] - r[1] * m[2]) +
                r[0] * (m[1] * m[3] - m[2] * m[2])) /
               det;
    *time = data->x[top] - 0.5 * b / c;
    *height = a - 0.25 * b * b / c;
}

// The theory's surface at a gauge, from the time of the measured crest there.
static void add_theory(WeirValidation *v, int gauge, double crest)
{
    char name[64];
    snprintf(name, sizeof name, "theory, x = %g m", gauges[gauge]);
    uint32_t curve = weir_curve_add(v, "Surface", name, "time", "s", "surface over still water", "m", true);
    double speed = weir_solitary_speed(gravity, still_depth, wave_height);
    for (int k = -40; k <= 40; ++k) {
        double t = 0.02 * k;
        weir_curve_push(v, curve, crest + t, weir_solitary_surface(still_depth, wave_height, speed * t));
    }
}

static void judge_solitary(WeirValidation *v)
{
    const Solitary *solitary = v->data;
    double times[GAUGES], heights[GAUGES];
    for (int k = 0; k < GAUGES; ++k) {
        find_crest(v, solitary->surface[k], &times[k], &heights[k]);
        if (isfinite(times[k])) add_theory(v, k, times[k]);
    }
    for (int k = 0; k < GAUGES; ++k) {
        char name[80];
        snprintf(name, sizeof name, "height of the crest at x = %g m", gauges[k]);
        weir_gate_add(v, name, "m", WEIR_GATE_RELATIVE, heights[k], wave_height, weir_limit(v, 0.15, 0.03));
    }
    weir_gate_add(v, "speed of the crest between the gauges", "m/s", WEIR_GATE_RELATIVE,
                  weir_fitted_slope(times, gauges, GAUGES),
                  weir_solitary_speed(gravity, still_depth, wave_height), weir_limit(v, 0.05, 0.03));
}

const WeirCase weir_case_solitary_wave = {
    .info = {"solitary_wave", "Solitary wave made by a piston",
             "A piston makes a solitary wave of height 50 mm on water 0.25 m deep: height and speed of its "
             "crest, "
             "from gauges at three places, against Rayleigh's wave.",
             "Rayleigh 1876; piston: Guizien and Barthelemy, J. Hydraul. Res. 40 (2002)"},
    .data_size = sizeof(Solitary),
    .plan = plan_solitary,
    .sample = sample_solitary,
    .judge = judge_solitary,
};
