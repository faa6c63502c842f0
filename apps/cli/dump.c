#include "dump.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Where the data goes: a temporary file beside the target, or the target itself if it is a device or a pipe.
typedef struct DumpFile {
    FILE *file;
    bool direct;
    char target[PATH_MAX]; // symbolic links resolved, so that the rename replaces the file and not the link
    char opened[PATH_MAX + 8];
} DumpFile;

static bool fail(const char *path, char *message, size_t message_size)
{
    snprintf(message, message_size, "--dump %.200s: cannot be written: %s", path, strerror(errno));
    return false;
}

static bool dump_open(DumpFile *dump, const char *path, char *message, size_t message_size)
{
    struct stat info;
    bool exists = stat(path, &info) == 0;
    errno = 0;
    if (exists && S_ISDIR(info.st_mode)) errno = EISDIR;
    if (strlen(path) >= PATH_MAX) errno = ENAMETOOLONG;
    if (errno) return fail(path, message, message_size);
    dump->direct = exists && !S_ISREG(info.st_mode);
    if (dump->direct || !exists || !realpath(path, dump->target)) strcpy(dump->target, path);
    snprintf(dump->opened, sizeof dump->opened, "%s%s", dump->target, dump->direct ? "" : ".tmp");
    dump->file = fopen(dump->opened, "w");
    return dump->file || fail(path, message, message_size);
}

static void dump_discard(DumpFile *dump)
{
    if (dump->file) fclose(dump->file);
    if (!dump->direct) unlink(dump->opened);
}

// Everything to the disk, then the new name.
static bool dump_close(DumpFile *dump)
{
    bool written = fflush(dump->file) == 0 && !ferror(dump->file);
    // Pipes and terminals have nothing to synchronise and say EINVAL.
    if (written && !dump->direct) written = fsync(fileno(dump->file)) == 0;
    int error = errno;
    bool closed = fclose(dump->file) == 0;
    dump->file = NULL;
    if (!written) {
        errno = error;
        return false;
    }
    return closed && (dump->direct || rename(dump->opened, dump->target) == 0);
}

bool weir_dump_probe(const char *path, char *message, size_t message_size)
{
    DumpFile dump = {0};
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode)) return true;
    if (!dump_open(&dump, path, message, message_size)) return false;
    dump_discard(&dump);
    return true;
}

static bool write_rows(FILE *file, uint32_t count, const float *position, const float *velocity,
                       const float *density, const float *pressure)
{
    fprintf(file, "id,x,y,vx,vy,density,pressure\n");
    for (uint32_t i = 0; i < count; ++i) {
        const float *x = &position[2 * (size_t)i], *v = &velocity[2 * (size_t)i];
        fprintf(file, "%u,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", i, (double)x[0], (double)x[1], (double)v[0],
                (double)v[1], (double)density[i], (double)pressure[i]);
        if (ferror(file)) return false;
    }
    return true;
}

// Reads the four fields into one allocation of 6 floats per particle; NULL with a message.
static float *read_fields(WeirSim *sim, char *message, size_t message_size)
{
    static const WeirField fields[] = {WEIR_FIELD_POSITION, WEIR_FIELD_VELOCITY, WEIR_FIELD_DENSITY,
                                       WEIR_FIELD_PRESSURE};
    size_t count = weir_sim_particle_count(sim), used = 0;
    float *values = malloc((6 * count + 1) * sizeof *values);
    if (!values) {
        snprintf(message, message_size, "--dump: memory ran out");
        return NULL;
    }
    for (size_t k = 0; k < 4; ++k) {
        size_t size = count * weir_field_components(fields[k], weir_sim_dimension(sim));
        if (weir_sim_read(sim, fields[k], values + used, size)) {
            snprintf(message, message_size, "--dump: %s", weir_sim_error(sim));
            free(values);
            return NULL;
        }
        used += size;
    }
    return values;
}

bool weir_dump_write(const char *path, WeirSim *sim, char *message, size_t message_size)
{
    DumpFile dump = {0};
    uint32_t count = weir_sim_particle_count(sim);
    float *values = read_fields(sim, message, message_size);
    if (!values) return false;
    if (!dump_open(&dump, path, message, message_size)) {
        free(values);
        return false;
    }
    size_t n = count;
    bool written = write_rows(dump.file, count, values, values + 2 * n, values + 4 * n, values + 5 * n) &&
                   dump_close(&dump);
    free(values);
    if (!written) {
        fail(path, message, message_size);
        dump_discard(&dump);
    }
    return written;
}
