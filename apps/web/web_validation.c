// Adapters for validation. JavaScript calls what takes and gives scalars only by its own name.
#include "web.h"
#include "weir/weir_validation.h"

#include <stdio.h>

// 0: name, 1: title, 2: summary, 3: source; NULL past the last case.
WEIR_WEB(weir_web_case_text)
const char *weir_web_case_text(uint32_t index, uint32_t which)
{
    const WeirCaseInfo *info = weir_case_info(index);
    if (!info) return NULL;
    const char *texts[] = {info->name, info->title, info->summary, info->source};
    return which < 4 ? texts[which] : NULL;
}

// 0: label, 1: the scene as JSON.
WEIR_WEB(weir_web_run_text)
const char *weir_web_run_text(const WeirValidation *validation, uint32_t run, uint32_t which)
{
    const WeirRunInfo *info = weir_validation_run(validation, run);
    if (!info) return NULL;
    return which == 0 ? info->label : info->scene_text;
}

// Fills spacing, end time and interval.
WEIR_WEB(weir_web_run_numbers)
void weir_web_run_numbers(const WeirValidation *validation, uint32_t run, double values[3])
{
    const WeirRunInfo *info = weir_validation_run(validation, run);
    values[0] = info ? info->spacing : 0.0;
    values[1] = info ? info->end_time : 0.0;
    values[2] = info ? info->interval : 0.0;
}

// Fills name and unit (their addresses), kind, value, reference, limit, passed.
WEIR_WEB(weir_web_gate)
void weir_web_gate(const WeirValidation *validation, uint32_t index, double values[7])
{
    const WeirGate *gate = weir_validation_gate(validation, index);
    if (!gate) return;
    values[0] = (double)(uintptr_t)gate->name;
    values[1] = (double)(uintptr_t)gate->unit;
    values[2] = gate->kind;
    values[3] = gate->value;
    values[4] = gate->reference;
    values[5] = gate->limit;
    values[6] = gate->passed;
}

enum { WEIR_WEB_CURVE_TEXT = 320 }; // bytes of the texts of a curve

// Writes the curve's texts, one a line: plot, name, x name, x unit, y name, y unit; fills is_reference, count and
// the addresses of x and y.
WEIR_WEB(weir_web_curve)
void weir_web_curve(const WeirValidation *validation, uint32_t index, char text[WEIR_WEB_CURVE_TEXT],
                    double values[4])
{
    WeirCurve curve = weir_validation_curve(validation, index);
    snprintf(text, WEIR_WEB_CURVE_TEXT, "%s\n%s\n%s\n%s\n%s\n%s", curve.plot, curve.name, curve.x_name,
             curve.x_unit, curve.y_name, curve.y_unit);
    values[0] = curve.is_reference;
    values[1] = curve.count;
    values[2] = (double)(uintptr_t)curve.x;
    values[3] = (double)(uintptr_t)curve.y;
}
