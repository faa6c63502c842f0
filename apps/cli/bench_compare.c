// Rows of an earlier run, and what became faster or slower since.
#include "bench_output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COLUMNS = 64, LINE_LENGTH = 8192 };
static const double largest_loss = 0.1;

static const char *const text_columns[] = {"scene", "backend", "device", "search", "passes"};

static bool is_text(const char *column)
{
    for (size_t k = 0; k < sizeof text_columns / sizeof text_columns[0]; ++k)
        if (strcmp(column, text_columns[k]) == 0) return true;
    return false;
}

// ---- Reading ----

// Cuts a line of CSV into fields, in place. Returns their number.
static size_t split_line(char *line, char *fields[MAX_COLUMNS])
{
    size_t count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *at = line; at && count < MAX_COLUMNS;) {
        bool quoted = *at == '"';
        char *end = quoted ? strchr(at + 1, '"') : NULL;
        fields[count++] = quoted ? at + 1 : at;
        if (end) *end = '\0';
        char *comma = strchr(end ? end + 1 : at, ',');
        if (comma) *comma = '\0';
        at = comma ? comma + 1 : NULL;
    }
    return count;
}

static json_t *field_json(const char *column, const char *field)
{
    char *end;
    double number = strtod(field, &end);
    if (is_text(column)) return json_string(field);
    return end != field && *end == '\0' ? weir_json_number(number) : json_null();
}

static json_t *read_csv(FILE *file)
{
    char header[LINE_LENGTH], line[LINE_LENGTH], *columns[MAX_COLUMNS], *fields[MAX_COLUMNS];
    do {
        if (!fgets(header, sizeof header, file)) return NULL;
    } while (header[0] == '#');
    size_t column_count = split_line(header, columns);
    json_t *rows = json_array();
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '\n' || line[0] == '#') continue;
        size_t count = split_line(line, fields);
        if (count != column_count) {
            json_decref(rows);
            return NULL;
        }
        json_t *row = json_object();
        for (size_t k = 0; k < count; ++k)
            json_object_set_new(row, columns[k], field_json(columns[k], fields[k]));
        json_array_append_new(rows, row);
    }
    return rows;
}

// Has every row what a comparison needs?
static bool is_complete(const json_t *rows)
{
    size_t k;
    json_t *row;
    if (!json_is_array(rows) || json_array_size(rows) == 0) return false;
    json_array_foreach(rows, k, row)
    {
        if (!json_is_string(json_object_get(row, "scene")) ||
            !json_is_string(json_object_get(row, "backend")) ||
            !json_is_number(json_object_get(row, "particles")) ||
            !(json_number_value(json_object_get(row, "ms_per_step")) > 0.0)) {
            return false;
        }
    }
    return true;
}

json_t *weir_bench_read(const char *path)
{
    FILE *file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "weir bench: --compare %s: cannot be read: %s\n", path, strerror(errno));
        return NULL;
    }
    int first = fgetc(file);
    rewind(file);
    json_t *rows = first == '[' ? json_loadf(file, 0, NULL) : read_csv(file);
    fclose(file);
    if (is_complete(rows)) return rows;
    fprintf(stderr,
            "weir bench: --compare %s: holds no rows of an earlier run; must be written by "
            "`weir bench --csv` or `--json`\n",
            path);
    json_decref(rows);
    return NULL;
}

// ---- Comparing ----

static const char *text_of(const json_t *row, const char *key)
{
    const char *text = json_string_value(json_object_get(row, key));
    return text ? text : "";
}

static double number_of(const json_t *row, const char *key)
{
    return json_number_value(json_object_get(row, key));
}

// Particles may differ a little: those of a tap come one after the other.
static bool is_same(const json_t *a, const json_t *b)
{
    double particles = number_of(a, "particles");
    double apart = number_of(b, "particles") - particles;
    return strcmp(text_of(a, "scene"), text_of(b, "scene")) == 0 &&
           strcmp(text_of(a, "backend"), text_of(b, "backend")) == 0 &&
           strcmp(text_of(a, "search"), text_of(b, "search")) == 0 &&
           number_of(a, "threads") == number_of(b, "threads") &&
           apart * apart <= 1e-4 * particles * particles;
}

static const json_t *find_same(const json_t *rows, const json_t *row)
{
    size_t k;
    json_t *other;
    json_array_foreach(rows, k, other)
    {
        if (is_same(row, other)) return other;
    }
    return NULL;
}

// Time per particle, so that a few more of them are no loss.
static double time_per_particle(const json_t *row)
{
    return number_of(row, "ms_per_step") / number_of(row, "particles");
}

bool weir_bench_compare(const json_t *rows, const json_t *earlier, const char *path)
{
    size_t k, matched = 0, lost = 0;
    json_t *row;
    fprintf(stderr, "speed over that of %s:\n", path);
    json_array_foreach(rows, k, row)
    {
        const json_t *before = find_same(earlier, row);
        fprintf(stderr, "  %-14s %10.0f  %s %-9s %3.0f threads  ", text_of(row, "scene"),
                number_of(row, "particles"), text_of(row, "backend"), text_of(row, "search"),
                number_of(row, "threads"));
        if (!before) {
            fprintf(stderr, "not in the earlier run\n");
            continue;
        }
        double ratio = time_per_particle(before) / time_per_particle(row);
        bool is_loss = ratio < 1.0 - largest_loss,
             moved = strcmp(text_of(row, "device"), text_of(before, "device"));
        fprintf(stderr, "%.3f%s%s%s%s\n", ratio, is_loss ? "  LOSS" : "", moved ? "  (was on " : "",
                moved ? text_of(before, "device") : "", moved ? ")" : "");
        ++matched;
        lost += is_loss;
    }
    if (matched == 0) fprintf(stderr, "weir bench: --compare %s: none of its rows was measured now\n", path);
    if (lost > 0)
        fprintf(stderr, "weir bench: %zu of %zu rows lost more than %.0f %% of their speed\n", lost, matched,
                100.0 * largest_loss);
    return matched > 0 && lost == 0;
}
