#include "validate_output.h"
#include "output.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

static bool fail(const char *path)
{
    fprintf(stderr, "weir validate: --out %s: cannot be written: %s\n", path, strerror(errno));
    return false;
}

bool weir_validate_begin(WeirValidateReport *report, const char *folder, const char *resolution,
                         const char *backend)
{
    char date[32] = "";
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc)) strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    *report = (WeirValidateReport){.folder = folder, .object = json_object(), .cases = json_array()};
    json_object_set_new(report->object, "version", json_string(WEIR_VERSION));
    json_object_set_new(report->object, "date", json_string(date));
    json_object_set_new(report->object, "resolution", json_string(resolution));
    json_object_set_new(report->object, "backend", json_string(backend));
    if (!folder || mkdir(folder, 0777) == 0 || errno == EEXIST) return true;
    json_decref(report->object);
    json_decref(report->cases);
    return fail(folder);
}

// ---- One case ----

static const char *kind_name(WeirGateKind kind)
{
    static const char *const names[] = {"at_most", "at_least", "relative", "reported"};
    return names[kind];
}

static json_t *gates_json(const WeirValidation *v)
{
    json_t *gates = json_array();
    for (uint32_t k = 0; k < weir_validation_gate_count(v); ++k) {
        const WeirGate *gate = weir_validation_gate(v, k);
        json_t *item = json_object();
        json_object_set_new(item, "name", json_string(gate->name));
        json_object_set_new(item, "kind", json_string(kind_name(gate->kind)));
        json_object_set_new(item, "unit", json_string(gate->unit));
        json_object_set_new(item, "value", weir_json_number(gate->value));
        json_object_set_new(item, "reference", weir_json_number(gate->reference));
        json_object_set_new(item, "limit", weir_json_number(gate->limit));
        json_object_set_new(item, "passed", json_boolean(gate->passed));
        json_array_append_new(gates, item);
    }
    return gates;
}

static json_t *runs_json(const WeirValidation *v, const WeirValidateRun *runs)
{
    json_t *list = json_array();
    for (uint32_t k = 0; k < weir_validation_run_count(v); ++k) {
        const WeirRunInfo *info = weir_validation_run(v, k);
        json_t *item = json_object();
        json_object_set_new(item, "label", json_string(info->label));
        json_object_set_new(item, "spacing", weir_json_number(info->spacing));
        json_object_set_new(item, "particles", json_integer(runs[k].particles));
        json_object_set_new(item, "steps", json_integer((json_int_t)runs[k].steps));
        json_object_set_new(item, "time", weir_json_number(runs[k].time));
        json_object_set_new(item, "wall_time", weir_json_number(runs[k].wall_time));
        json_array_append_new(list, item);
    }
    return list;
}

// Rows plot, name, x, y: curves have different lengths.
static bool write_curves(const char *folder, const WeirValidation *v)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s.csv", folder, weir_validation_case(v)->name);
    FILE *file = fopen(path, "w");
    if (!file) return fail(path);
    fprintf(file, "plot,curve,reference,x name,x unit,y name,y unit,x,y\n");
    for (uint32_t k = 0; k < weir_validation_curve_count(v); ++k) {
        WeirCurve curve = weir_validation_curve(v, k);
        for (uint32_t n = 0; n < curve.count; ++n) {
            fprintf(file, "\"%s\",\"%s\",%d,\"%s\",\"%s\",\"%s\",\"%s\",%.7g,%.7g\n", curve.plot, curve.name,
                    curve.is_reference, curve.x_name, curve.x_unit, curve.y_name, curve.y_unit, curve.x[n],
                    curve.y[n]);
        }
    }
    bool good = !ferror(file);
    return (fclose(file) == 0 && good) || fail(path);
}

static bool all_passed(const WeirValidation *v)
{
    bool all = weir_validation_gate_count(v) > 0;
    for (uint32_t k = 0; k < weir_validation_gate_count(v); ++k)
        all = all && weir_validation_gate(v, k)->passed;
    return all;
}

bool weir_validate_add_case(WeirValidateReport *report, const WeirValidation *v, const WeirValidateRun *runs,
                            double wall_time)
{
    const WeirCaseInfo *info = weir_validation_case(v);
    json_t *object = json_object();
    json_object_set_new(object, "name", json_string(info->name));
    json_object_set_new(object, "title", json_string(info->title));
    json_object_set_new(object, "summary", json_string(info->summary));
    json_object_set_new(object, "source", json_string(info->source));
    json_object_set_new(object, "passed", json_boolean(all_passed(v)));
    if (*weir_validation_error(v))
        json_object_set_new(object, "error", json_string(weir_validation_error(v)));
    json_object_set_new(object, "wall_time", weir_json_number(wall_time));
    json_object_set_new(object, "gates", gates_json(v));
    json_object_set_new(object, "runs", runs_json(v, runs));
    json_array_append_new(report->cases, object);
    return !report->folder || write_curves(report->folder, v);
}

// ---- Printing ----

static void print_limit(const WeirGate *gate, char text[48])
{
    switch (gate->kind) {
    case WEIR_GATE_AT_MOST:
        snprintf(text, 48, "<= %.4g", gate->limit);
        return;
    case WEIR_GATE_AT_LEAST:
        snprintf(text, 48, ">= %.4g", gate->limit);
        return;
    case WEIR_GATE_RELATIVE:
        snprintf(text, 48, "within %.3g %%", 100.0 * gate->limit);
        return;
    case WEIR_GATE_REPORTED:
        snprintf(text, 48, "reported");
        return;
    }
}

void weir_validate_print_case(const WeirValidation *v, double wall_time)
{
    const WeirCaseInfo *info = weir_validation_case(v);
    char wall[32];
    weir_format_seconds(wall_time, wall);
    printf("%s: %s (%s, %s)\n", info->name, info->title, weir_resolution_name(weir_validation_resolution(v)),
           wall);
    for (uint32_t k = 0; k < weir_validation_gate_count(v); ++k) {
        const WeirGate *gate = weir_validation_gate(v, k);
        char limit[48], reference[32] = "-";
        print_limit(gate, limit);
        if (isfinite(gate->reference)) snprintf(reference, sizeof reference, "%.5g", gate->reference);
        const char *word = gate->kind == WEIR_GATE_REPORTED ? "" : gate->passed ? "pass" : "FAIL";
        printf("  %-4s %-52s %12.5g %-6s reference %-10s %s\n", word, gate->name, gate->value,
               strcmp(gate->unit, "1") == 0 ? "" : gate->unit, reference, limit);
    }
    fflush(stdout);
}

// ---- The end ----

static bool write_results(const char *folder, json_t *object)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/results.json", folder);
    FILE *file = fopen(path, "w");
    if (!file) return fail(path);
    bool written = weir_json_print(json_incref(object), file);
    return (fclose(file) == 0 && written) || fail(path);
}

bool weir_validate_end(WeirValidateReport *report, bool print)
{
    bool good = true;
    json_object_set_new(report->object, "device", json_string(report->device));
    json_object_set_new(report->object, "cases", report->cases);
    if (report->folder) good = write_results(report->folder, report->object);
    if (print) good = weir_json_print(json_incref(report->object), stdout) && good;
    json_decref(report->object);
    return good;
}
