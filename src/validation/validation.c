// Runs a case: plans, prepares scenes, steps to the next measurement, keeps curves and gates.
#include "validation/validation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const WeirCase *const cases[] = {
    &weir_case_kernels,          &weir_case_lattice_density,    &weir_case_hydrostatic_2d,
    &weir_case_hydrostatic_3d,   &weir_case_hydrostatic_shapes, &weir_case_settled_tank,
    &weir_case_floating_box,     &weir_case_taylor_green,       &weir_case_poiseuille,
    &weir_case_couette,          &weir_case_standing_wave,      &weir_case_elliptical_drop,
    &weir_case_oscillating_drop, &weir_case_rotating_square,    &weir_case_free_drop,
    &weir_case_dam_break,        &weir_case_column_collapse,    &weir_case_kleefsman,
    &weir_case_lid_cavity,       &weir_case_solitary_wave,
};
enum { CASE_COUNT = sizeof cases / sizeof cases[0] };

const char *weir_resolution_name(WeirResolution resolution)
{
    static const char *const names[] = {"coarse", "normal", "fine"};
    return (uint32_t)resolution <= WEIR_RESOLUTION_FINE ? names[resolution] : "";
}

uint32_t weir_case_count(void)
{
    return CASE_COUNT;
}

const WeirCaseInfo *weir_case_info(uint32_t index)
{
    return index < CASE_COUNT ? &cases[index]->info : NULL;
}

uint32_t weir_case_find(const char *name)
{
    uint32_t index = 0;
    while (index < CASE_COUNT && strcmp(cases[index]->info.name, name) != 0) ++index;
    return index;
}

// ---- Life ----

WeirValidation *weir_validation_create(uint32_t case_index, WeirResolution resolution)
{
    if (case_index >= CASE_COUNT || (uint32_t)resolution > WEIR_RESOLUTION_FINE) return NULL;
    WeirValidation *v = calloc(1, sizeof *v);
    if (!v) return NULL;
    v->the_case = cases[case_index];
    v->resolution = resolution;
    v->run_is_done = true;
    v->data = calloc(1, v->the_case->data_size + 1);
    if (!v->data) {
        free(v);
        return NULL;
    }
    if (v->the_case->plan) v->the_case->plan(v);
    return v;
}

void weir_validation_destroy(WeirValidation *v)
{
    if (!v) return;
    for (uint32_t k = 0; k < v->curve_count; ++k) {
        free(v->curves[k].x);
        free(v->curves[k].y);
    }
    free(v->data);
    free(v);
}

const WeirCaseInfo *weir_validation_case(const WeirValidation *v)
{
    return &v->the_case->info;
}

WeirResolution weir_validation_resolution(const WeirValidation *v)
{
    return v->resolution;
}

const char *weir_validation_error(const WeirValidation *v)
{
    return v->error.text;
}

uint32_t weir_validation_run_count(const WeirValidation *v)
{
    return v->run_count;
}

const WeirRunInfo *weir_validation_run(const WeirValidation *v, uint32_t run)
{
    return run < v->run_count ? &v->runs[run].info : NULL;
}

bool weir_validation_run_is_done(const WeirValidation *v)
{
    return v->run_is_done;
}

// ---- Planning ----

WeirCaseRun *weir_plan_run(WeirValidation *v, const char *label, const char *scene_file,
                           const char *scene_text, double spacing, double end_time, double interval)
{
    WeirCaseRun *run = &v->runs[v->run_count < WEIR_MAX_RUNS ? v->run_count++ : WEIR_MAX_RUNS - 1];
    *run = (WeirCaseRun){.info = {.scene_file = scene_file,
                                  .scene_text = scene_text,
                                  .spacing = spacing,
                                  .end_time = end_time,
                                  .interval = interval}};
    snprintf(run->info.label, sizeof run->info.label, "%s", label);
    return run;
}

double weir_by_resolution(const WeirValidation *v, double coarse, double normal, double fine)
{
    return v->resolution == WEIR_RESOLUTION_COARSE ? coarse
           : v->resolution == WEIR_RESOLUTION_FINE ? fine
                                                   : normal;
}

double weir_limit(const WeirValidation *v, double coarse, double normal)
{
    return weir_by_resolution(v, coarse, normal, normal);
}

// Steps of a run grow with 1 / spacing and its particles with 1 / spacing^2 at least.
static double cost(const WeirCaseRun *run)
{
    double spacing = run->info.spacing;
    return fmax(run->info.end_time, run->info.interval) / (spacing * spacing * spacing);
}

double weir_validation_progress(const WeirValidation *v)
{
    double all = 0.0, done = 0.0;
    for (uint32_t k = 0; k < v->run_count; ++k) {
        const WeirCaseRun *run = &v->runs[k];
        double share = k < v->run ? 1.0 : 0.0;
        if (k == v->run && v->begun) {
            double time = (double)(v->samples > 0 ? v->samples - 1 : 0) * run->info.interval;
            share = v->run_is_done ? 1.0 : fmin(time / fmax(run->info.end_time, 1e-12), 1.0);
        }
        all += cost(run);
        done += share * cost(run);
    }
    return all > 0.0 ? done / all : 1.0;
}

// ---- Running ----

static WeirStatus refuse(WeirValidation *v, WeirStatus status, const char *what)
{
    return weir_fail(&v->error, status, "%.48s: %.400s", v->runs[v->run].info.label, what);
}

WeirStatus weir_validation_prepare(WeirValidation *v, uint32_t run, WeirScene *scene)
{
    if (run >= v->run_count) return weir_fail(&v->error, WEIR_ERROR_INPUT, "run %u: there is none", run);
    const WeirCaseRun *planned = &v->runs[run];
    WeirStatus status = weir_scene_set_number(scene, "parameters.particle_spacing", planned->info.spacing);
    if (!status && planned->path) status = weir_scene_set_number(scene, planned->path, planned->value);
    if (!status) status = weir_scene_check(scene);
    return status
               ? weir_fail(&v->error, status, "%.48s: %.400s", planned->info.label, weir_scene_error(scene))
               : WEIR_OK;
}

void weir_validation_feed(WeirValidation *v, uint32_t run, const WeirSample *sample)
{
    v->run = run;
    v->the_case->sample(v, sample);
}

static WeirStatus take_sample(WeirValidation *v, WeirSim *sim)
{
    WeirState state;
    WeirStatus status = weir_sim_state(sim, &state);
    if (status == WEIR_PENDING) return status;
    if (status) {
        v->run_is_done = true;
        return refuse(v, status, weir_sim_error(sim));
    }
    WeirCaseRun *run = &v->runs[v->run];
    WeirSample sample = {weir_sim_time(sim), &state, weir_sim_parameters(sim), weir_sim_constants(sim),
                         weir_sim_scene(sim)};
    weir_validation_feed(v, v->run, &sample);
    if (v->out_of_memory) {
        v->run_is_done = true;
        return refuse(v, WEIR_ERROR_MEMORY, "no memory for curves");
    }
    ++v->samples;
    run->complete = v->run_is_done = sample.time >= run->info.end_time * (1.0 - 1e-9);
    return WEIR_OK;
}

WeirStatus weir_validation_begin(WeirValidation *v, uint32_t run, WeirSim *sim)
{
    if (run >= v->run_count) return weir_fail(&v->error, WEIR_ERROR_INPUT, "run %u: there is none", run);
    if (!v->begun || v->run != run || v->samples > 0) {
        v->run = run;
        v->samples = 0;
        v->begun = true;
        v->run_is_done = v->is_set_up = false;
    }
    WeirStatus status = WEIR_OK;
    if (!v->is_set_up && v->the_case->begin) status = v->the_case->begin(v, sim);
    if (status == WEIR_PENDING) return status;
    if (status) {
        v->run_is_done = true;
        return refuse(v, status, weir_sim_error(sim));
    }
    v->is_set_up = true;
    return take_sample(v, sim);
}

WeirStatus weir_validation_advance(WeirValidation *v, WeirSim *sim)
{
    if (v->run_is_done) return WEIR_OK;
    const WeirRunInfo *run = &v->runs[v->run].info;
    WeirStatus status = weir_sim_run_until(sim, fmin((double)v->samples * run->interval, run->end_time));
    if (status == WEIR_PENDING) return status;
    if (status) {
        v->run_is_done = true;
        return refuse(v, status, weir_sim_error(sim));
    }
    return take_sample(v, sim);
}

void weir_validation_abandon(WeirValidation *v, const char *message)
{
    v->run_is_done = true;
    if (message) weir_fail(&v->error, WEIR_ERROR_INPUT, "%.480s", message);
}

// ---- Curves ----

uint32_t weir_curve_add(WeirValidation *v, const char *plot, const char *name, const char *x_name,
                        const char *x_unit, const char *y_name, const char *y_unit, bool is_reference)
{
    uint32_t index = v->curve_count < WEIR_MAX_CURVES ? v->curve_count++ : WEIR_MAX_CURVES - 1;
    WeirCurve *curve = &v->curves[index].info;
    snprintf(curve->plot, sizeof curve->plot, "%s", plot);
    snprintf(curve->name, sizeof curve->name, "%s", name);
    snprintf(curve->x_name, sizeof curve->x_name, "%s", x_name);
    snprintf(curve->x_unit, sizeof curve->x_unit, "%s", x_unit);
    snprintf(curve->y_name, sizeof curve->y_name, "%s", y_name);
    snprintf(curve->y_unit, sizeof curve->y_unit, "%s", y_unit);
    curve->is_reference = is_reference;
    return index;
}

void weir_curve_push(WeirValidation *v, uint32_t index, double x, double y)
{
    WeirCurveData *curve = &v->curves[index];
    if (curve->info.count == curve->capacity) {
        uint32_t capacity = curve->capacity ? 2 * curve->capacity : 64;
        double *grown_x = realloc(curve->x, capacity * sizeof(double));
        if (grown_x) curve->x = grown_x;
        double *grown_y = realloc(curve->y, capacity * sizeof(double));
        if (grown_y) curve->y = grown_y;
        if (!grown_x || !grown_y) {
            v->out_of_memory = true;
            return;
        }
        curve->capacity = capacity;
    }
    curve->x[curve->info.count] = x;
    curve->y[curve->info.count++] = y;
}

double weir_curve_at(const WeirValidation *v, uint32_t index, double x)
{
    const WeirCurveData *curve = &v->curves[index];
    for (uint32_t k = 1; k < curve->info.count; ++k) {
        double x0 = curve->x[k - 1], x1 = curve->x[k];
        if (x < x0 || x > x1 || x1 <= x0) continue;
        return curve->y[k - 1] + (curve->y[k] - curve->y[k - 1]) * (x - x0) / (x1 - x0);
    }
    return NAN;
}

uint32_t weir_validation_curve_count(const WeirValidation *v)
{
    return v->curve_count;
}

WeirCurve weir_validation_curve(const WeirValidation *v, uint32_t index)
{
    if (index >= v->curve_count) return (WeirCurve){.count = 0};
    WeirCurve curve = v->curves[index].info;
    curve.x = v->curves[index].x;
    curve.y = v->curves[index].y;
    return curve;
}

// ---- Gates ----

static bool passes(const WeirGate *gate)
{
    switch (gate->kind) {
    case WEIR_GATE_AT_MOST:
        return gate->value <= gate->limit;
    case WEIR_GATE_AT_LEAST:
        return gate->value >= gate->limit;
    case WEIR_GATE_RELATIVE:
        return fabs(gate->value / gate->reference - 1.0) <= gate->limit;
    case WEIR_GATE_REPORTED:
        return true;
    }
    return false;
}

void weir_gate_add(WeirValidation *v, const char *name, const char *unit, WeirGateKind kind, double value,
                   double reference, double limit)
{
    if (v->gate_count == WEIR_MAX_GATES) return;
    WeirGate *gate = &v->gates[v->gate_count++];
    *gate = (WeirGate){.kind = kind, .value = value, .reference = reference, .limit = limit};
    snprintf(gate->name, sizeof gate->name, "%s", name);
    snprintf(gate->unit, sizeof gate->unit, "%s", unit);
    gate->passed = passes(gate);
}

bool weir_validation_judge(WeirValidation *v)
{
    uint32_t complete = 0;
    bool all = true;
    v->gate_count = 0;
    for (uint32_t k = 0; k < v->run_count; ++k) complete += v->runs[k].complete;
    if (complete < v->run_count)
        weir_gate_add(v, "simulations that reached their end", "1", WEIR_GATE_AT_LEAST, complete, NAN,
                      v->run_count);
    v->the_case->judge(v);
    for (uint32_t k = 0; k < v->gate_count; ++k) all = all && v->gates[k].passed;
    return all && v->gate_count > 0;
}

uint32_t weir_validation_gate_count(const WeirValidation *v)
{
    return v->gate_count;
}

const WeirGate *weir_validation_gate(const WeirValidation *v, uint32_t index)
{
    return index < v->gate_count ? &v->gates[index] : NULL;
}
