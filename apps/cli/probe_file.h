// What probes measured, as CSV with names and units in the header.
#pragma once

#include "weir/weir_probe.h"

// `path` ends in .csv: one file, a row per sample: probe,kind,unit,time,x,y,z. Otherwise a folder, made if missing, with
// a file per probe: time and its values in columns. Tells before a long run whether it can be written.
bool weir_probe_file_check(const char *path, char *message, size_t message_size);
bool weir_probe_file_write(const char *path, const WeirProbes *probes, char *message, size_t message_size);
