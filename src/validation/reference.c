#include "validation/validation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// One line's numbers; cells that hold none are NaN.
static void read_line(const char *line, const char *end, uint32_t columns, double *row)
{
    for (uint32_t k = 0; k < columns; ++k) {
        row[k] = NAN;
        if (line > end) continue;
        char *stop;
        double number = strtod(line, &stop);
        if (stop > line && stop <= end) row[k] = number;
        const char *comma = memchr(line, ',', (size_t)(end - line));
        line = comma ? comma + 1 : end + 1;
    }
}

uint32_t weir_reference_read(const char *text, uint32_t columns, double *rows, uint32_t capacity)
{
    uint32_t count = 0;
    bool header_seen = false;
    while (*text) {
        const char *end = strchr(text, '\n');
        if (!end) end = text + strlen(text);
        bool data = end > text && *text != '#' && *text != '\r';
        if (data && header_seen && count < capacity) {
            read_line(text, end, columns, rows + (size_t)count * columns);
            ++count;
        }
        header_seen = header_seen || data;
        text = *end ? end + 1 : end;
    }
    return count;
}
