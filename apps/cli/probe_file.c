#include "probe_file.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool fail(const char *path, char *message, size_t message_size)
{
    snprintf(message, message_size, "--probe-out %.200s: cannot be written: %s", path, strerror(errno));
    return false;
}

static bool is_file(const char *path)
{
    struct stat info;
    size_t length = strlen(path);
    if (stat(path, &info) == 0) return !S_ISDIR(info.st_mode);
    return length > 4 && strcmp(path + length - 4, ".csv") == 0;
}

bool weir_probe_file_check(const char *path, char *message, size_t message_size)
{
    if (is_file(path)) {
        bool existed = access(path, F_OK) == 0;
        FILE *file = fopen(path, "a");
        if (!file) return fail(path, message, message_size);
        fclose(file);
        if (!existed) unlink(path);
        return true;
    }
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && access(path, W_OK) == 0)) return true;
    return fail(path, message, message_size);
}

static const char *const axes[3] = {"x", "y", "z"};

// Names may hold anything; what a file name or a CSV cell cannot hold becomes an underscore.
static void clean_name(const char *name, char text[64])
{
    size_t k = 0;
    for (; name[k] && k < 63; ++k) {
        char c = name[k];
        bool plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || strchr("-_.= ", c);
        text[k] = plain && !(k == 0 && c == '.') ? c : '_';
    }
    text[k] = '\0';
}

// Fills up to `columns` values with empty cells.
static void write_rows(FILE *file, const WeirProbes *probes, uint32_t index, const char *prefix,
                       uint32_t columns)
{
    WeirProbeInfo info = weir_probe_info(probes, index);
    WeirProbeSeries series = weir_probe_series(probes, index);
    for (uint32_t n = 0; n < series.count; ++n) {
        fprintf(file, "%s%.9g", prefix, series.time[n]);
        for (uint32_t k = 0; k < info.components; ++k)
            fprintf(file, ",%.9g", series.values[(size_t)n * info.components + k]);
        for (uint32_t k = info.components; k < columns; ++k) fputc(',', file);
        fputc('\n', file);
    }
}

static bool close_file(FILE *file, const char *path, char *message, size_t message_size)
{
    bool good = fflush(file) == 0 && !ferror(file);
    int error = errno;
    if (fclose(file) == 0 && good) return true;
    if (!good) errno = error;
    return fail(path, message, message_size);
}

static bool write_probe(const char *folder, const WeirProbes *probes, uint32_t index, char *message,
                        size_t message_size)
{
    char path[PATH_MAX], name[64];
    WeirProbeInfo info = weir_probe_info(probes, index);
    clean_name(info.name, name);
    snprintf(path, sizeof path, "%s/%s.csv", folder, name);
    FILE *file = fopen(path, "w");
    if (!file) return fail(path, message, message_size);
    fprintf(file, "time / s");
    for (uint32_t k = 0; k < info.components; ++k)
        fprintf(file, ",%s%s%s / %s", info.kind, info.components > 1 ? " " : "",
                info.components > 1 ? axes[k] : "", info.unit);
    fputc('\n', file);
    write_rows(file, probes, index, "", info.components);
    return close_file(file, path, message, message_size);
}

bool weir_probe_file_write(const char *path, const WeirProbes *probes, char *message, size_t message_size)
{
    if (!is_file(path)) {
        for (uint32_t k = 0; k < weir_probes_count(probes); ++k) {
            if (!write_probe(path, probes, k, message, message_size)) return false;
        }
        return true;
    }
    FILE *file = fopen(path, "w");
    if (!file) return fail(path, message, message_size);
    fprintf(file, "probe,kind,unit,time / s,value or x,y,z\n");
    for (uint32_t k = 0; k < weir_probes_count(probes); ++k) {
        WeirProbeInfo info = weir_probe_info(probes, k);
        char name[64], prefix[128];
        clean_name(info.name, name);
        snprintf(prefix, sizeof prefix, "%s,%s,%s,", name, info.kind, info.unit);
        write_rows(file, probes, k, prefix, 3);
    }
    return close_file(file, path, message, message_size);
}
