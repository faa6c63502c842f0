// The sampler: a series per probe of the scene, each at its own rate.
#include "core/probe.h"
#include "core/sim.h"
#include "core/world_build.h"
#include "weir/weir_probe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct Series {
    double *time, *values;
    uint32_t count, capacity, components;
    uint32_t solid; // of a force probe
    uint64_t due;   // index of the next sample: it is taken at due / rate
    char name[WEIR_NAME_LENGTH + 8];
} Series;

struct WeirProbes {
    const WeirScene *scene; // the simulation's
    uint32_t count;
    Series series[WEIR_MAX_PROBES];
};

bool weir_probe_target(const WeirScene *scene, const char *name, uint32_t *solid)
{
    uint32_t next = 0;
    bool closed = weir_has_sides(scene);
    *solid = 0;
    if (closed && strcmp(name, "domain") == 0) return true;
    next += closed;
    for (uint32_t k = 0; k < scene->wall_count; ++k, ++next) {
        *solid = next;
        if (strcmp(scene->wall[k].name, name) == 0) return true;
    }
    for (uint32_t k = 0; k < scene->body_count; ++k, ++next) {
        *solid = next;
        if (strcmp(scene->body[k].name, name) == 0) return true;
    }
    return false;
}

WeirProbes *weir_probes_create(const WeirSim *sim)
{
    WeirProbes *probes = calloc(1, sizeof *probes);
    if (!probes) return NULL;
    const WeirScene *scene = probes->scene = weir_sim_scene(sim);
    probes->count = scene->probe_count;
    for (uint32_t k = 0; k < probes->count; ++k) {
        const WeirProbePiece *piece = &scene->probe[k];
        Series *series = &probes->series[k];
        series->components = weir_probe_components(piece, scene->dimension);
        if (piece->kind == WEIR_PROBE_FORCE) weir_probe_target(scene, piece->target, &series->solid);
        if (*piece->name) {
            strcpy(series->name, piece->name);
        } else {
            snprintf(series->name, sizeof series->name, "probe %u", k + 1);
        }
    }
    return probes;
}

void weir_probes_destroy(WeirProbes *probes)
{
    if (!probes) return;
    for (uint32_t k = 0; k < probes->count; ++k) {
        free(probes->series[k].time);
        free(probes->series[k].values);
    }
    free(probes);
}

uint32_t weir_probes_count(const WeirProbes *probes)
{
    return probes->count;
}

WeirProbeInfo weir_probe_info(const WeirProbes *probes, uint32_t index)
{
    static const char *const kinds[] = {"pressure", "velocity", "height", "force", "front", "mass"};
    static const char *const units[] = {"Pa", "m/s", "m", "N", "m", "kg"};
    if (index >= probes->count) return (WeirProbeInfo){.name = "", .kind = "", .unit = ""};
    const WeirProbePiece *piece = &probes->scene->probe[index];
    bool flat = probes->scene->dimension == 2;
    WeirProbeInfo info = {
        .name = probes->series[index].name,
        .kind = kinds[piece->kind],
        .unit = units[piece->kind],
        .components = probes->series[index].components,
        .rate = piece->rate,
    };
    // In the plane these are per metre of depth.
    if (flat && piece->kind == WEIR_PROBE_FORCE) info.unit = "N/m";
    if (flat && piece->kind == WEIR_PROBE_MASS) info.unit = "kg/m";
    return info;
}

WeirProbeSeries weir_probe_series(const WeirProbes *probes, uint32_t index)
{
    if (index >= probes->count) return (WeirProbeSeries){0};
    const Series *series = &probes->series[index];
    return (WeirProbeSeries){series->count, series->time, series->values};
}

void weir_probes_clear(WeirProbes *probes)
{
    for (uint32_t k = 0; k < probes->count; ++k) {
        probes->series[k].count = 0;
        probes->series[k].due = 0;
    }
}

static double due_time(const WeirProbes *probes, uint32_t k)
{
    return (double)probes->series[k].due / probes->scene->probe[k].rate;
}

double weir_probes_next_time(const WeirProbes *probes)
{
    double next = INFINITY;
    for (uint32_t k = 0; k < probes->count; ++k) next = fmin(next, due_time(probes, k));
    return next;
}

static bool make_room(Series *series)
{
    if (series->count < series->capacity) return true;
    uint32_t capacity = series->capacity ? 2 * series->capacity : 64;
    double *time = realloc(series->time, capacity * sizeof *time);
    if (time) series->time = time;
    double *values = realloc(series->values, (size_t)capacity * series->components * sizeof *values);
    if (values) series->values = values;
    if (!time || !values) return false;
    series->capacity = capacity;
    return true;
}

static void measure(const WeirProbes *probes, uint32_t k, const WeirSim *sim, const WeirGathered *from,
                    double values[3])
{
    const WeirProbePiece *piece = &probes->scene->probe[k];
    const WeirParameters *parameters = weir_sim_parameters(sim);
    const WeirConstants *constants = weir_sim_constants(sim);
    if (from->found && (piece->kind == WEIR_PROBE_FRONT || piece->kind == WEIR_PROBE_MASS))
        values[0] = weir_probe_value(piece, from->found[k], parameters, constants);
    else
        weir_probe_measure(piece, probes->series[k].solid, &from->state, parameters, constants, values);
}

// How far from its time a sample may be taken.
static double slack_at(const WeirProbes *probes, const WeirSim *sim, double now)
{
    // Fixed steps of `mueller` end at the one nearest to a sample's time.
    bool nearest = probes->scene->method == WEIR_METHOD_MUELLER;
    return nearest ? 0.5 * (double)weir_sim_parameters(sim)->time_step : 1e-9 * fmax(now, 1e-3);
}

WeirStatus weir_probes_update(WeirProbes *probes, WeirSim *sim)
{
    double now = weir_sim_time(sim);
    if (weir_probes_next_time(probes) > now + slack_at(probes, sim, now)) return WEIR_OK;
    WeirGathered gathered = {0};
    WeirStatus status = weir_sim_gather(sim, &gathered);
    if (status) return status;
    // In a browser the simulation may have gone on since the copy was started.
    now = weir_sim_time_of(sim, &gathered.state);
    double slack = slack_at(probes, sim, now);
    for (uint32_t k = 0; k < probes->count; ++k) {
        Series *series = &probes->series[k];
        if (due_time(probes, k) > now + slack) continue;
        if (!make_room(series)) return WEIR_ERROR_MEMORY;
        double values[3];
        measure(probes, k, sim, &gathered, values);
        series->time[series->count] = now;
        memcpy(&series->values[(size_t)series->count * series->components], values,
               series->components * sizeof *values);
        ++series->count;
        // Samples that were stepped over are not made up.
        series->due = (uint64_t)floor((now + slack) * probes->scene->probe[k].rate) + 1;
    }
    return WEIR_OK;
}

WeirStatus weir_probes_run_until(WeirProbes *probes, WeirSim *sim, double time)
{
    for (;;) {
        WeirStatus status = weir_probes_update(probes, sim);
        if (status) return status;
        double next = weir_probes_next_time(probes);
        if (next > time) return weir_sim_run_until(sim, time);
        status = weir_sim_run_until(sim, next);
        if (status) return status;
    }
}
