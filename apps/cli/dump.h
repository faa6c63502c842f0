// Particle data as CSV: id,x,y,vx,vy,density,pressure (3D: z and vz too; wcsph: group too), one line per particle in
// order of id. Nine digits read back as the same float32.
#pragma once

#include "weir/weir.h"

// Tells before a long run whether `path` can be written; leaves nothing behind.
bool weir_dump_probe(const char *path, char *message, size_t message_size);
// Writes to PATH.tmp and renames it when all is on the disk, so that `path` holds all or what it held before.
// A `path` that is no regular file (/dev/stdout, a pipe) is written directly.
bool weir_dump_write(const char *path, WeirSim *sim, char *message, size_t message_size);

// A copy of a simulation's particles on the host.
typedef struct WeirDump {
    float *values; // all positions, velocities, densities, pressures, groups; NULL: none
    uint32_t count, dimension;
    bool has_group;
    uint64_t step;
    double time; // s
} WeirDump;

bool weir_dump_take(WeirDump *dump, WeirSim *sim, char *message, size_t message_size);
// Writes as weir_dump_write().
bool weir_dump_save(const char *path, const WeirDump *dump, char *message, size_t message_size);
void weir_dump_free(WeirDump *dump);
