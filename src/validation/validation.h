// What cases and the engine that runs them share. A case plans its runs, measures samples of a run's state and at
// the end judges what it measured. It never steps a simulation itself, so that one code serves the command line,
// the page and tests with made-up states.
#pragma once

#include "core/scene.h"
#include "core/sim.h"
#include "weir/weir_validation.h"

enum { WEIR_MAX_RUNS = 12, WEIR_MAX_GATES = 32, WEIR_MAX_CURVES = 128 };

// A state at the time of a measurement.
typedef struct WeirSample {
    double time; // s
    const WeirState *state;
    const WeirParameters *parameters;
    const WeirConstants *constants;
    const WeirScene *scene;
} WeirSample;

typedef struct WeirCaseRun {
    WeirRunInfo info;
    const char *path; // scene value that distinguishes the run, "parameters.viscosity"; NULL: none
    double value;     // of `path`
    int variant;      // meaning is the case's
    bool complete;    // reached its end
} WeirCaseRun;

typedef struct WeirCase {
    WeirCaseInfo info;
    size_t data_size; // of the case's own struct, v->data, zeroed at the start
    // Adds the runs of v->resolution by weir_plan_run(); NULL: none.
    void (*plan)(WeirValidation *v);
    // Changes the simulation at the start of the present run, for example disturbs it; NULL: nothing.
    WeirStatus (*begin)(WeirValidation *v, WeirSim *sim);
    // Measures; v->run is the present run. Called at time 0 and then every interval.
    void (*sample)(WeirValidation *v, const WeirSample *sample);
    // Adds the gates.
    void (*judge)(WeirValidation *v);
} WeirCase;

typedef struct WeirCurveData {
    WeirCurve info;
    double *x, *y;
    uint32_t capacity;
} WeirCurveData;

struct WeirValidation {
    const WeirCase *the_case;
    WeirResolution resolution;
    WeirCaseRun runs[WEIR_MAX_RUNS];
    WeirGate gates[WEIR_MAX_GATES];
    WeirCurveData curves[WEIR_MAX_CURVES];
    uint32_t run_count, gate_count, curve_count;
    uint32_t run; // present one
    uint64_t samples;
    bool begun, is_set_up, run_is_done, out_of_memory; // is_set_up: the case has changed what it wants to
    WeirMessage error;
    void *data;
};

// ---- For plan() ----

// Adds a run; `scene_file` is its path and `scene_text` the embedded content. Returns it for further settings.
WeirCaseRun *weir_plan_run(WeirValidation *v, const char *label, const char *scene_file,
                           const char *scene_text, double spacing, double end_time, double interval);
// coarse, normal or fine value for the present resolution.
double weir_by_resolution(const WeirValidation *v, double coarse, double normal, double fine);
// A gate's limit: coarse has its own, normal and fine share one.
double weir_limit(const WeirValidation *v, double coarse, double normal);

// ---- For sample() and judge() ----

// Index of a new curve; names are copied. With "time" as x_name and so on: see WeirCurve.
uint32_t weir_curve_add(WeirValidation *v, const char *plot, const char *name, const char *x_name,
                        const char *x_unit, const char *y_name, const char *y_unit, bool is_reference);
void weir_curve_push(WeirValidation *v, uint32_t curve, double x, double y);
// y at `x` by linear interpolation; NaN outside the curve.
double weir_curve_at(const WeirValidation *v, uint32_t curve, double x);
void weir_gate_add(WeirValidation *v, const char *name, const char *unit, WeirGateKind kind, double value,
                   double reference, double limit);
// Feeds a sample as weir_validation_advance() does: for tests with made-up states.
void weir_validation_feed(WeirValidation *v, uint32_t run, const WeirSample *sample);

// Numbers of a CSV text: comment lines start with #, the first other line is a header. Fills up to `capacity` rows of
// `columns` numbers (NaN where a cell is empty or missing) and returns how many there are.
uint32_t weir_reference_read(const char *text, uint32_t columns, double *rows, uint32_t capacity);

// The cases, in the order of docs/validation.md.
extern const WeirCase weir_case_kernels, weir_case_lattice_density, weir_case_hydrostatic_2d,
    weir_case_hydrostatic_3d, weir_case_hydrostatic_shapes, weir_case_settled_tank, weir_case_floating_box,
    weir_case_taylor_green, weir_case_poiseuille, weir_case_couette, weir_case_standing_wave,
    weir_case_elliptical_drop, weir_case_oscillating_drop, weir_case_rotating_square, weir_case_free_drop,
    weir_case_dam_break, weir_case_column_collapse, weir_case_kleefsman, weir_case_lid_cavity,
    weir_case_solitary_wave;
