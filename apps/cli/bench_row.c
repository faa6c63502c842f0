#include "bench_row.h"
#include "output.h"
#include "setup.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

enum {
    MAX_REPETITIONS = 64,
    ANEW_BATCH = 256, // steps; the fluid of a batch is still much as it started
    MAX_BATCH = 1024,
    STIRRED_BATCH = 256, // of a fluid that calms down: so many of these and no more, on a fast machine too
    STIRRED_REPETITIONS = 7,
    SHORT_STIRRED_BATCH = 32, // where the others would take STIRRED_PATIENCE times as long as there is
    STIRRED_PATIENCE = 30,
    SETTLING_STEPS = 200, // of a fluid whose batches follow one another, before the first
};

typedef struct Measurement {
    WeirSim *sim;
    const WeirBenchCase *bench_case; // NULL: a scene file
    bool anew;                       // every batch starts from the same fluid
    bool stirred;                    // the fluid calms down
    const WeirBenchEffort *effort;
    double times[MAX_REPETITIONS]; // s per step
    uint32_t count;
} Measurement;

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static WeirStatus start_anew(const Measurement *m)
{
    WeirStatus status = weir_sim_reset(m->sim);
    return status || !m->bench_case ? status : weir_bench_prepare(m->bench_case, m->sim);
}

// Wall seconds of `steps` steps; negative if something failed.
static double time_steps(const Measurement *m, uint32_t steps)
{
    if (m->anew && (start_anew(m) || weir_sim_step(m->sim, 1) || weir_sim_wait(m->sim))) return -1.0;
    double start = weir_wall_time();
    if (weir_sim_step(m->sim, steps) || weir_sim_wait(m->sim) || weir_sim_poll(m->sim)) return -1.0;
    return weir_wall_time() - start;
}

// On a GPU, which makes lists every few steps: some in every batch.
static bool has_fixed_steps(const Measurement *m)
{
    return m->stirred && weir_sim_threads(m->sim) == 0;
}

// Steps of a batch of stirred fluid, always the same ones: how fast it is hangs on how long it has calmed down. Before them the
// device wakes: the clock of an idle one is low.
static uint32_t warm_up_stirred(const Measurement *m, double *batch)
{
    double end = weir_wall_time() + 0.3 * m->effort->seconds;
    do *batch = time_steps(m, SHORT_STIRRED_BATCH);
    while (*batch >= 0.0 && weir_wall_time() < end);
    double all = *batch * (STIRRED_REPETITIONS * STIRRED_BATCH / SHORT_STIRRED_BATCH);
    uint32_t steps = all > STIRRED_PATIENCE * m->effort->seconds ? SHORT_STIRRED_BATCH : STIRRED_BATCH;
    if (*batch >= 0.0) *batch = start_anew(m) ? -1.0 : time_steps(m, 2 * steps - 1);
    return steps;
}

// Steps of a batch: doubled until it takes a tenth of the time to spend, which warms up as well. Negative batch time:
// something failed.
static uint32_t warm_up(const Measurement *m, double *batch)
{
    double wish = 0.1 * m->effort->seconds, end = weir_wall_time() + 10.0 * m->effort->seconds;
    uint32_t most = m->anew ? ANEW_BATCH : m->stirred ? STIRRED_BATCH : MAX_BATCH, steps = 1;
    if (has_fixed_steps(m)) return warm_up_stirred(m, batch);
    *batch = time_steps(m, steps);
    while (*batch >= 0.0 && *batch < wish && steps < most) {
        steps = 2 * steps < most ? 2 * steps : most;
        *batch = time_steps(m, steps);
    }
    while (!m->anew && *batch >= 0.0 && weir_wall_time() < end &&
           weir_sim_step_count(m->sim) < SETTLING_STEPS)
        *batch = time_steps(m, steps);
    return steps;
}

static bool measure_steps(Measurement *m)
{
    double batch, spent = 0.0, seconds = m->effort->seconds;
    uint32_t steps = warm_up(m, &batch);
    uint32_t least = has_fixed_steps(m) ? STIRRED_REPETITIONS : batch > seconds ? 1 : m->effort->repetitions;
    uint32_t most = m->stirred ? STIRRED_REPETITIONS : MAX_REPETITIONS;
    while (batch >= 0.0 && m->count < most && (m->count < least || spent < seconds)) {
        batch = time_steps(m, steps);
        m->times[m->count++] = batch / steps;
        spent += batch;
    }
    if (batch < 0.0) return false;
    qsort(m->times, m->count, sizeof m->times[0], compare_numbers);
    return true;
}

// Bytes that the process has allocated; 0 where the C library does not tell.
static double allocated_bytes(void)
{
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    struct mallinfo2 info = mallinfo2();
    return (double)info.uordblks + (double)info.hblkhd;
#else
    return 0.0;
#endif
}

static void fill_row(WeirBenchRow *row, const Measurement *m, const WeirNeighborCount *near, double memory)
{
    const WeirSim *sim = m->sim;
    const WeirScene *scene = weir_sim_scene(sim);
    uint32_t n = m->count;
    double step = n % 2 ? m->times[n / 2] : 0.5 * (m->times[n / 2 - 1] + m->times[n / 2]);
    WeirClock clock = weir_sim_clock(sim);
    snprintf(row->scene, sizeof row->scene, "%.63s", weir_scene_title(scene));
    snprintf(row->backend, sizeof row->backend, "%s", weir_sim_backend(sim));
    snprintf(row->device, sizeof row->device, "%s", weir_sim_device(sim));
    weir_cli_choice_name(scene, "search", row->search);
    row->particles = clock.fluid_particles; // walls take part, but are not counted
    row->all = weir_sim_particle_count(sim);
    row->threads = weir_sim_threads(sim);
    row->repetitions = n;
    row->mean_neighbors = near->neighbors;
    row->candidates = near->candidates;
    row->ms_per_step = 1e3 * step;
    row->spread = (m->times[n - 1] - m->times[0]) / step;
    row->particle_steps_per_second = row->particles / step;
    row->pairs_per_second = row->particle_steps_per_second * near->neighbors;
    row->bytes_per_particle = memory > 0.0 ? memory / row->all : NAN;
    row->time_step = clock.time_step;
    row->real_time_factor = clock.time_step / step;
    row->frames_per_second = 1.0 / step;
    row->relative = NAN;
    row->pass_count = weir_sim_pass_times(sim, row->passes, WEIR_BENCH_PASSES);
    if (row->pass_count > WEIR_BENCH_PASSES) row->pass_count = WEIR_BENCH_PASSES;
}

WeirStatus weir_bench_measure(const WeirScene *scene, const WeirBenchCase *bench_case,
                              const WeirSimOptions *options, const WeirBenchEffort *effort, WeirBenchRow *row)
{
    double before = allocated_bytes();
    WeirSim *sim = weir_sim_create(scene, options);
    if (!sim) {
        fprintf(stderr, "weir bench: memory ran out\n");
        return WEIR_ERROR_MEMORY;
    }
    Measurement m = {.sim = sim,
                     .bench_case = bench_case,
                     .anew = !bench_case || weir_bench_starts_anew(bench_case),
                     .stirred = bench_case && weir_bench_is_stirred(bench_case),
                     .effort = effort};
    WeirNeighborCount near = {0};
    WeirStatus status = weir_sim_wait(sim);
    if (!status && !m.anew) status = weir_bench_prepare(bench_case, sim);
    if (!status && !measure_steps(&m)) status = WEIR_ERROR_DEVICE;
    double memory =
        weir_sim_device_memory(sim) > 0 ? (double)weir_sim_device_memory(sim) : allocated_bytes() - before;
    if (!status) status = weir_sim_count_neighbors(sim, 0, &near);
    if (status) {
        fprintf(stderr, "weir bench: %s, %u particles on %s: %s\n", weir_scene_title(scene),
                weir_sim_particle_count(sim), weir_sim_device(sim), weir_sim_error(sim));
        if (weir_sim_status(sim)) status = weir_sim_status(sim);
    } else {
        fill_row(row, &m, &near, memory);
    }
    weir_sim_destroy(sim);
    return status;
}
