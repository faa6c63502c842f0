// What a run has to say at its end: a summary for people or one JSON object.
#pragma once

#include "weir/weir.h"

typedef struct WeirReport {
    const char *scene_path;
    const WeirSim *sim;
    const char *outcome;  // "done", "interrupted", "failed"
    const char *error;    // "" if none
    double wall_time;     // s, of the steps alone
    bool has_diagnostics; // false if the state could not be read
    WeirDiagnostics diagnostics;
} WeirReport;

void weir_report_text(const WeirReport *report);
// False if memory ran out.
bool weir_report_json(const WeirReport *report);
