// What `weir validate` leaves: a table per case, one JSON object, CSV files of curves.
#pragma once

#include <jansson.h>

#include "weir/weir_validation.h"

typedef struct WeirValidateRun {
    uint32_t particles;
    uint64_t steps;
    double time, wall_time; // s
} WeirValidateRun;

typedef struct WeirValidateReport {
    json_t *object, *cases;
    const char *folder; // NULL: no files
    char device[128];
} WeirValidateReport;

// Makes `folder` (NULL: none) if it is missing. False after a message on standard error.
bool weir_validate_begin(WeirValidateReport *report, const char *folder, const char *resolution,
                         const char *backend);
// Adds a judged case; writes its curves. `runs` holds one per run. False after a message.
bool weir_validate_add_case(WeirValidateReport *report, const WeirValidation *v, const WeirValidateRun *runs,
                            double wall_time);
void weir_validate_print_case(const WeirValidation *v, double wall_time);
// Writes results.json, prints the object if `print`, and frees the report. False after a message.
bool weir_validate_end(WeirValidateReport *report, bool print);
