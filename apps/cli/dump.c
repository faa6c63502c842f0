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

static void write_vector(FILE *file, const float *vector, uint32_t dimension)
{
    for (uint32_t axis = 0; axis < dimension; ++axis) fprintf(file, ",%.9g", (double)vector[axis]);
}

static bool write_rows(FILE *file, const WeirDump *dump)
{
    size_t n = dump->count, d = dump->dimension;
    const float *position = dump->values, *velocity = position + d * n, *density = velocity + d * n;
    const float *pressure = density + n, *group = pressure + n;
    fprintf(file, "id,%s,density,pressure%s\n", d == 3 ? "x,y,z,vx,vy,vz" : "x,y,vx,vy",
            dump->has_group ? ",group" : "");
    for (size_t i = 0; i < n; ++i) {
        fprintf(file, "%zu", i);
        write_vector(file, position + d * i, dump->dimension);
        write_vector(file, velocity + d * i, dump->dimension);
        fprintf(file, ",%.9g,%.9g", (double)density[i], (double)pressure[i]);
        if (dump->has_group) fprintf(file, ",%d", (int)group[i]);
        fputc('\n', file);
        if (ferror(file)) return false;
    }
    return true;
}

bool weir_dump_take(WeirDump *dump, WeirSim *sim, char *message, size_t message_size)
{
    static const WeirField fields[] = {WEIR_FIELD_POSITION, WEIR_FIELD_VELOCITY, WEIR_FIELD_DENSITY,
                                       WEIR_FIELD_PRESSURE, WEIR_FIELD_GROUP};
    size_t count = weir_sim_particle_count(sim), used = 0;
    uint32_t dimension = weir_sim_dimension(sim);
    *dump = (WeirDump){.count = (uint32_t)count,
                       .dimension = dimension,
                       .has_group = strcmp(weir_scene_method(weir_sim_scene(sim)), "wcsph") == 0,
                       .step = weir_sim_step_count(sim),
                       .time = weir_sim_time(sim)};
    dump->values = malloc(((2 * dimension + 3) * count + 1) * sizeof *dump->values);
    if (!dump->values) {
        snprintf(message, message_size, "--dump: memory ran out");
        return false;
    }
    for (size_t k = 0; k < sizeof fields / sizeof fields[0]; ++k) {
        size_t size = count * weir_field_components(fields[k], dimension);
        if (weir_sim_read(sim, fields[k], dump->values + used, size)) {
            snprintf(message, message_size, "--dump: %s", weir_sim_error(sim));
            weir_dump_free(dump);
            return false;
        }
        used += size;
    }
    return true;
}

void weir_dump_free(WeirDump *dump)
{
    free(dump->values);
    dump->values = NULL;
}

bool weir_dump_save(const char *path, const WeirDump *dump, char *message, size_t message_size)
{
    DumpFile file = {0};
    if (!dump_open(&file, path, message, message_size)) return false;
    if (write_rows(file.file, dump) && dump_close(&file)) return true;
    fail(path, message, message_size);
    dump_discard(&file);
    return false;
}

bool weir_dump_write(const char *path, WeirSim *sim, char *message, size_t message_size)
{
    WeirDump dump;
    if (!weir_dump_take(&dump, sim, message, message_size)) return false;
    bool written = weir_dump_save(path, &dump, message, message_size);
    weir_dump_free(&dump);
    return written;
}
