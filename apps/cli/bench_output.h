// Rows of `weir bench` as a table, CSV or JSON, and earlier ones read back.
#pragma once

#include "bench_row.h"
#include "output.h"

typedef enum WeirBenchFormat { WEIR_BENCH_TABLE, WEIR_BENCH_CSV, WEIR_BENCH_JSON } WeirBenchFormat;

// The row as an object of the same keys as the columns of CSV, passes as an object of milliseconds.
json_t *weir_bench_row_json(const WeirBenchRow *row);
// JSON is not printed here: its rows make one list at the end.
void weir_bench_print(const WeirBenchRow *row, WeirBenchFormat format, bool header);

// Rows that an earlier run wrote as CSV or JSON: a list of objects, numbers as numbers. NULL after a message.
json_t *weir_bench_read(const char *path);
// Prints the speed of each row over that of the same row (scene, particles, backend, search, threads) in `earlier`, to
// standard error. False if a row lost more than a tenth, or none has an earlier one.
bool weir_bench_compare(const json_t *rows, const json_t *earlier, const char *path);
