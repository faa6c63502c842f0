// Validation: published cases with a reference, a gate and curves, measured the same way for every backend.
//
//   WeirValidation *v = weir_validation_create(weir_case_find("taylor_green"), WEIR_RESOLUTION_NORMAL);
//   for (uint32_t run = 0; run < weir_validation_run_count(v); ++run) {
//       load a WeirScene from weir_validation_run(v, run)->scene_text (JSON);
//       weir_validation_prepare(v, run, scene);
//       WeirSim *sim = weir_sim_create(scene, &options);
//       weir_validation_begin(v, run, sim);
//       while (!weir_validation_run_is_done(v)) weir_validation_advance(v, sim);
//   }
//   weir_validation_judge(v);
//
// Nothing in here allocates a device or prints; all values are SI. docs/validation.md explains cases and gates.
#pragma once

#include "weir/weir.h"

#ifdef __cplusplus
extern "C" {
#endif

// Each resolution has one particle spacing per case and one set of solver parameters for all cases.
typedef enum WeirResolution {
    WEIR_RESOLUTION_COARSE, // minutes on two CPU cores; gates of its own
    WEIR_RESOLUTION_NORMAL, // the gates of docs/validation.md
    WEIR_RESOLUTION_FINE,   // half the spacing, the same gates
} WeirResolution;
// "coarse", "normal" or "fine".
const char *weir_resolution_name(WeirResolution resolution);

typedef struct WeirCaseInfo {
    const char *name;    // of its folder in validation/ and on the command line
    const char *title;   // for people
    const char *summary; // one or two sentences: what is compared with what
    const char *source;  // of the reference
} WeirCaseInfo;

uint32_t weir_case_count(void);
// NULL if index >= weir_case_count().
const WeirCaseInfo *weir_case_info(uint32_t index);
// Index of the case of that name; weir_case_count() if there is none.
uint32_t weir_case_find(const char *name);

// One simulation of a case. A case has none (kernels), one, or several (resolutions, Reynolds numbers).
typedef struct WeirRunInfo {
    char label[48];         // "spacing 1/50, disturbed"
    const char *scene_file; // "validation/NAME/scene.json"
    const char *scene_text; // the file's content, ended by a 0
    double spacing;         // m
    double end_time;        // s of simulated time
    double interval;        // s between two measurements
} WeirRunInfo;

// How a gate judges its value. NaN never passes.
typedef enum WeirGateKind {
    WEIR_GATE_AT_MOST,  // value <= limit
    WEIR_GATE_AT_LEAST, // value >= limit
    WEIR_GATE_RELATIVE, // |value / reference - 1| <= limit
    WEIR_GATE_REPORTED, // no gate: a figure that readers want to see beside the others
} WeirGateKind;

typedef struct WeirGate {
    char name[80];
    char unit[16]; // of value and reference, "1" for none
    WeirGateKind kind;
    double value;
    double reference; // NaN: none
    double limit;
    bool passed;
} WeirGate;

// A measured or reference curve. Curves of one `plot` belong into one picture.
typedef struct WeirCurve {
    char plot[64], name[64];
    char x_name[32], x_unit[16], y_name[48], y_unit[16];
    bool is_reference;
    uint32_t count;
    const double *x, *y; // valid until the next call that changes the validation
} WeirCurve;

typedef struct WeirValidation WeirValidation;

// NULL if memory runs out or there is no such case.
WeirValidation *weir_validation_create(uint32_t case_index, WeirResolution resolution);
void weir_validation_destroy(WeirValidation *validation); // NULL is allowed
const WeirCaseInfo *weir_validation_case(const WeirValidation *validation);
WeirResolution weir_validation_resolution(const WeirValidation *validation);
// Message of the last call that failed or of what stopped a run; "" if none.
const char *weir_validation_error(const WeirValidation *validation);

uint32_t weir_validation_run_count(const WeirValidation *validation);
// NULL if run >= weir_validation_run_count().
const WeirRunInfo *weir_validation_run(const WeirValidation *validation, uint32_t run);
// Sets in `scene`, loaded from the run's text, its spacing and what distinguishes this run from the others.
WeirStatus weir_validation_prepare(WeirValidation *validation, uint32_t run, WeirScene *scene);
// Begins run `run`, in order, on a simulation of the prepared scene at time 0, and takes the first measurement.
// WEIR_PENDING: call again (browser).
WeirStatus weir_validation_begin(WeirValidation *validation, uint32_t run, WeirSim *sim);
// Simulates until the next measurement and takes it. WEIR_PENDING: call again (browser). An error ends the run;
// its gates then fail.
WeirStatus weir_validation_advance(WeirValidation *validation, WeirSim *sim);
bool weir_validation_run_is_done(const WeirValidation *validation);
// Ends the present run without success, for example because its scene or device could not be had.
void weir_validation_abandon(WeirValidation *validation, const char *message);
// Share of all runs' simulated work that is done, 0 to 1 (steps grow with resolution; an estimate).
double weir_validation_progress(const WeirValidation *validation);

// Computes the gates from what the runs gave; cases without runs measure here. Returns true if all passed.
bool weir_validation_judge(WeirValidation *validation);
uint32_t weir_validation_gate_count(const WeirValidation *validation);
const WeirGate *weir_validation_gate(const WeirValidation *validation, uint32_t index); // NULL past the end
// Curves grow while a run goes on.
uint32_t weir_validation_curve_count(const WeirValidation *validation);
WeirCurve weir_validation_curve(const WeirValidation *validation, uint32_t index); // count 0 past the end

#ifdef __cplusplus
}
#endif
