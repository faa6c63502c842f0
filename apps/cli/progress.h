// Progress of a run on standard error: a bar on a terminal, one line per second otherwise.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef struct WeirProgress {
    bool enabled, terminal, drawn;
    double start, last_print; // wall seconds
    uint64_t steps;           // of the whole run...
    double end_time;          // ...or, if this is not 0, its simulated time, s
} WeirProgress;

void weir_progress_begin(WeirProgress *progress, bool enabled, uint64_t steps, double end_time);
// Prints if it is time to; cheap otherwise.
void weir_progress_update(WeirProgress *progress, uint64_t step, double time);
// Removes the bar, so that what follows starts on a clean line.
void weir_progress_end(WeirProgress *progress);
