// Collects the errors of objects being made and says what they were made for: "pass density: ...".
#pragma once

#include "gpu/device.h"

typedef struct WeirReport WeirReport;

// NULL if memory runs out.
WeirReport *weir_report_create(WeirGpu *gpu);
// Errors may still be under way in a browser: the report then frees itself when the last one arrived.
void weir_report_destroy(WeirReport *report); // NULL is allowed
// What is made between these two calls is made for `label`, a static text.
void weir_report_begin(WeirReport *report);
void weir_report_end(WeirReport *report, const char *label);
// Makes a pipeline for `label` beside the program's own work, in a browser; *pipeline is set before the report is no longer
// pending, unless that fails. WEIR_ERROR_MEMORY, and nothing is under way, if host memory runs out.
WeirStatus weir_report_pipeline(WeirReport *report, const WGPUComputePipelineDescriptor *descriptor,
                                const char *label, WGPUComputePipeline *pipeline);
// True while errors or pipelines may still be under way.
bool weir_report_pending(const WeirReport *report);
// The first error, copied into `message`; WEIR_OK if none is known.
WeirStatus weir_report_check(const WeirReport *report, WeirMessage *message);
