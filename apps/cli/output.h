// Small helpers that commands share: JSON values, times, the wall clock.
#pragma once

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

// Wall time in seconds from an arbitrary start.
double weir_wall_time(void);

// A JSON number; null if it is not finite, which JSON has no word for.
json_t *weir_json_number(double value);
// A float32 as the shortest decimal number that reads back as the same float: 0.0008, not 0.000800000038.
json_t *weir_json_float(double value);
// Prints the value and a line end, then releases it. False if memory ran out.
bool weir_json_print(json_t *value, FILE *file);

// "3.2 s", "4 min 05 s", "2 h 07 min"
void weir_format_seconds(double seconds, char text[32]);
// "32,768"
void weir_format_count(unsigned long long count, char text[32]);
// What float32 `value` was written as, see weir_json_float().
void weir_format_float(double value, char text[32]);
