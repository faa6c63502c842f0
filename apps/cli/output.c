#include "output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

double weir_wall_time(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

json_t *weir_json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

void weir_format_float(double value, char text[32])
{
    for (int digits = 6; digits <= 9; ++digits) {
        snprintf(text, 32, "%.*g", digits, value);
        if (strtof(text, NULL) == (float)value) return;
    }
}

json_t *weir_json_float(double value)
{
    char text[32];
    if (!isfinite(value)) return json_null();
    weir_format_float(value, text);
    return json_real(strtod(text, NULL));
}

bool weir_json_print(json_t *value, FILE *file)
{
    bool done = value && json_dumpf(value, file, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) == 0;
    json_decref(value);
    fputc('\n', file);
    return done;
}

void weir_format_seconds(double seconds, char text[32])
{
    if (!(seconds < 1e6)) {
        snprintf(text, 32, "days");
    } else if (seconds < 10.0) {
        snprintf(text, 32, "%.2g s", seconds);
    } else if (seconds < 99.5) {
        snprintf(text, 32, "%.0f s", seconds);
    } else if (seconds < 3570.0) {
        unsigned whole = (unsigned)(seconds + 0.5);
        snprintf(text, 32, "%u min %02u s", whole / 60, whole % 60);
    } else {
        unsigned minutes = (unsigned)(seconds / 60.0 + 0.5);
        snprintf(text, 32, "%u h %02u min", minutes / 60, minutes % 60);
    }
}

void weir_format_count(unsigned long long count, char text[32])
{
    char digits[24];
    size_t length = (size_t)snprintf(digits, sizeof digits, "%llu", count), used = 0;
    for (size_t k = 0; k < length; ++k) {
        if (k > 0 && (length - k) % 3 == 0) text[used++] = ',';
        text[used++] = digits[k];
    }
    text[used] = '\0';
}
