// weir bench: the tutorial's table natively, for every backend, neighbour search and thread count; and the
// cases that speed is tracked by (docs/performance.md).
#include "backend.h"
#include "bench_scene.h"
#include "commands.h"
#include "output.h"
#include "setup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    MAX_ITEMS = 32,
    MAX_REPETITIONS = 64,
    MAX_BATCH = 256, // steps; the fluid of a batch is still the scene's start
};

typedef struct BenchOptions {
    const char *counts, *backends, *search, *threads, *bench_case, *scene;
    double seconds;
    bool json, csv;
} BenchOptions;

// What to measure: every combination of these.
typedef struct Plan {
    uint32_t counts[MAX_ITEMS], threads[MAX_ITEMS];
    size_t count_count, thread_count;
    bool cpu, gpu, gpu_must; // gpu_must: asked for by name
    bool grid, all_pairs;
    WeirBenchCase bench_case;
} Plan;

typedef struct Row {
    char scene[64], backend[8], device[128], search[32];
    uint32_t particles, threads;
    double mean_neighbors, ms_per_step, particle_steps_per_second, real_time_factor, frames_per_second;
} Row;

typedef struct Bench {
    BenchOptions options;
    Plan plan;
    WeirCliBackend gpu;
    json_t *rows; // --json prints them all at the end
    bool header_printed;
} Bench;

// ---- Reading the plan ----

static bool parse_counts(const char *option, const char *text, uint64_t minimum, uint64_t maximum,
                         uint32_t *items, size_t *count)
{
    *count = 0;
    for (const char *item = text; item;) {
        size_t length = strcspn(item, ",");
        char word[24];
        uint64_t value;
        snprintf(word, sizeof word, "%.*s", (int)(length < 23 ? length : 23), item);
        if (*count == MAX_ITEMS || !weir_parse_count(word, minimum, maximum, &value)) {
            fprintf(
                stderr,
                "weir bench: %s: '%s' is not allowed; must be at most %d whole numbers from %llu to %llu, "
                "separated by commas\n",
                option, text, MAX_ITEMS, (unsigned long long)minimum, (unsigned long long)maximum);
            return false;
        }
        items[(*count)++] = (uint32_t)value;
        item = item[length] == ',' ? item + length + 1 : NULL;
    }
    return true;
}

// Two switches from a list of their names.
static bool parse_pair(const char *option, const char *text, const char *const names[2], bool *first,
                       bool *second)
{
    *first = *second = false;
    for (const char *item = text; item;) {
        size_t length = strcspn(item, ",");
        bool is_first = strlen(names[0]) == length && strncmp(item, names[0], length) == 0;
        bool is_second = strlen(names[1]) == length && strncmp(item, names[1], length) == 0;
        if (!is_first && !is_second) {
            fprintf(stderr,
                    "weir bench: %s: '%s' is not allowed; must be %s, %s or both, separated by a comma\n",
                    option, text, names[0], names[1]);
            return false;
        }
        *first |= is_first;
        *second |= is_second;
        item = item[length] == ',' ? item + length + 1 : NULL;
    }
    return true;
}

static bool make_plan(Bench *bench)
{
    const BenchOptions *options = &bench->options;
    Plan *plan = &bench->plan;
    static const char *const cases[] = {"article", "n20", "block_2d", "block_3d", "dam_2d", "dam_3d"};
    plan->bench_case = WEIR_BENCH_ARTICLE;
    for (size_t n = 0; options->bench_case && n < sizeof cases / sizeof cases[0]; ++n)
        if (strcmp(options->bench_case, cases[n]) == 0) plan->bench_case = (WeirBenchCase)n;
    bool article = plan->bench_case == WEIR_BENCH_ARTICLE;
    if (options->scene && (options->counts || options->bench_case)) {
        fprintf(stderr, "weir bench: --scene is measured as it is; leave out --counts and --case\n");
        return false;
    }
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    char threads[32] = "1";
    if (cores > 1) snprintf(threads, sizeof threads, "1,%ld", cores < 1024 ? cores : 1024);
    const char *counts = options->counts ? options->counts
                         : article       ? "1000,5000,10000,32768"
                                         : "32768,100000,1000000";
    const char *search = options->search              ? options->search
                         : article && !options->scene ? "all_pairs,grid"
                                                      : "grid";
    plan->cpu = plan->gpu = true;
    plan->gpu_must = options->backends != NULL;
    return parse_counts("--counts", counts, 1, 1u << 28, plan->counts, &plan->count_count) &&
           parse_counts("--threads", options->threads ? options->threads : threads, 1, 1024, plan->threads,
                        &plan->thread_count) &&
           parse_pair("--search", search, (const char *const[2]){"all_pairs", "grid"}, &plan->all_pairs,
                      &plan->grid) &&
           (!options->backends || parse_pair("--backends", options->backends,
                                             (const char *const[2]){"cpu", "gpu"}, &plan->cpu, &plan->gpu));
}

// ---- Measuring ----

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Wall seconds of `steps` steps from the scene's start; negative if something failed. Every batch sees the
// same fluid, however fast the backend is.
static double time_steps(WeirSim *sim, uint32_t steps)
{
    if (weir_sim_reset(sim) || weir_sim_step(sim, 1) || weir_sim_wait(sim)) return -1.0;
    double start = weir_wall_time();
    if (weir_sim_step(sim, steps) || weir_sim_wait(sim) || weir_sim_poll(sim)) return -1.0;
    return weir_wall_time() - start;
}

// Seconds per step: the median of some batches, after a warm-up that doubles its steps until a batch takes a
// tenth of the budget. A step that alone takes longer than the budget is measured once.
static double measure_step(WeirSim *sim, double budget)
{
    uint32_t steps = 1;
    double batch = time_steps(sim, steps), spent = 0.0, times[MAX_REPETITIONS];
    while (batch >= 0.0 && batch < 0.1 * budget && steps < MAX_BATCH) {
        steps = 2 * steps < MAX_BATCH ? 2 * steps : MAX_BATCH;
        batch = time_steps(sim, steps);
    }
    size_t count = 0;
    while (batch >= 0.0 && count < MAX_REPETITIONS && (count == 0 || spent < budget)) {
        batch = time_steps(sim, steps);
        times[count++] = batch / steps;
        spent += batch;
    }
    if (batch < 0.0) return -1.0;
    qsort(times, count, sizeof times[0], compare_numbers);
    return count % 2 ? times[count / 2] : 0.5 * (times[count / 2 - 1] + times[count / 2]);
}

static void fill_row(Row *row, const WeirSim *sim, const WeirDiagnostics *diagnostics, double step)
{
    const WeirScene *scene = weir_sim_scene(sim);
    snprintf(row->scene, sizeof row->scene, "%.63s", weir_scene_title(scene));
    snprintf(row->backend, sizeof row->backend, "%s", weir_sim_backend(sim));
    snprintf(row->device, sizeof row->device, "%s", weir_sim_device(sim));
    weir_cli_choice_name(scene, "search", row->search);
    WeirClock clock = weir_sim_clock(sim);
    row->particles = clock.fluid_particles; // walls take part, but are not counted
    row->threads = weir_sim_threads(sim);
    row->mean_neighbors = diagnostics->mean_neighbors;
    row->ms_per_step = 1e3 * step;
    row->particle_steps_per_second = row->particles / step;
    row->real_time_factor = clock.time_step / step;
    row->frames_per_second = 1.0 / step;
}

static WeirStatus measure_row(const WeirScene *scene, const WeirBackend *backend, uint32_t threads,
                              double budget, Row *row)
{
    WeirSimOptions options = {.backend = backend, .threads = threads};
    WeirDiagnostics diagnostics;
    WeirSim *sim = weir_sim_create(scene, &options);
    if (!sim) {
        fprintf(stderr, "weir bench: memory ran out\n");
        return WEIR_ERROR_MEMORY;
    }
    WeirStatus status = weir_sim_wait(sim);
    double step = status ? -1.0 : measure_step(sim, budget);
    if (!status) status = weir_sim_status(sim);
    if (!status) status = weir_sim_diagnose(sim, true, &diagnostics);
    if (!status && step < 0.0) status = WEIR_ERROR_DEVICE;
    if (status) {
        fprintf(stderr, "weir bench: %u particles on %s: %s\n", weir_sim_particle_count(sim),
                weir_sim_device(sim), weir_sim_error(sim));
    } else {
        fill_row(row, sim, &diagnostics, step);
    }
    weir_sim_destroy(sim);
    return status;
}

// ---- Printing ----

static json_t *row_json(const Row *row)
{
    return json_pack("{s:s, s:I, s:s, s:s, s:s, s:I, s:f, s:f, s:f, s:f, s:f}", "scene", row->scene,
                     "particles", (json_int_t)row->particles, "backend", row->backend, "device", row->device,
                     "search", row->search, "threads", (json_int_t)row->threads, "mean_neighbors",
                     row->mean_neighbors, "ms_per_step", row->ms_per_step, "particle_steps_per_second",
                     row->particle_steps_per_second, "real_time_factor", row->real_time_factor,
                     "frames_per_second", row->frames_per_second);
}

static void print_csv_row(const Row *row, bool header)
{
    if (header) {
        printf("scene,particles,backend,device,search,threads,mean_neighbors,ms_per_step,"
               "particle_steps_per_second,real_time_factor,frames_per_second\n");
    }
    printf("\"%s\",%u,%s,\"%s\",%s,%u,%.1f,%.6g,%.6g,%.4g,%.4g\n", row->scene, row->particles, row->backend,
           row->device, row->search, row->threads, row->mean_neighbors, row->ms_per_step,
           row->particle_steps_per_second, row->real_time_factor, row->frames_per_second);
}

static void print_table_row(const Row *row, bool header)
{
    if (header) {
        printf("%10s  %-7s %-9s %7s %10s %11s %15s %9s %9s  %s\n", "particles", "backend", "search",
               "threads", "neighbours", "ms/step", "M p-steps/s", "real-time", "frames/s", "device");
    }
    printf("%10u  %-7s %-9s %7u %10.1f %11.4g %15.4g %9.3g %9.4g  %s\n", row->particles, row->backend,
           row->search, row->threads, row->mean_neighbors, row->ms_per_step,
           1e-6 * row->particle_steps_per_second, row->real_time_factor, row->frames_per_second, row->device);
}

static void print_row(Bench *bench, const Row *row)
{
    bool header = !bench->header_printed;
    bench->header_printed = true;
    if (bench->options.json) {
        json_array_append_new(bench->rows, row_json(row));
    } else if (bench->options.csv) {
        print_csv_row(row, header);
    } else {
        print_table_row(row, header);
    }
    fflush(stdout);
}

// ---- The command ----

static WeirStatus measure_backend(Bench *bench, WeirScene *scene, const WeirBackend *backend,
                                  uint32_t threads)
{
    const char *const names[2] = {"all_pairs", "grid"};
    const bool wanted[2] = {bench->plan.all_pairs, bench->plan.grid};
    for (int k = 0; k < 2; ++k) {
        Row row = {0};
        if (!wanted[k]) continue;
        if (!weir_bench_is_wcsph(bench->plan.bench_case))
            weir_scene_set_parameter_text(scene, "search", names[k]);
        WeirStatus status = measure_row(scene, backend, threads, bench->options.seconds, &row);
        if (status) return status;
        print_row(bench, &row);
    }
    return WEIR_OK;
}

static WeirStatus measure_scene(Bench *bench, WeirScene *scene)
{
    WeirStatus status = WEIR_OK;
    for (size_t k = 0; bench->plan.cpu && !status && k < bench->plan.thread_count; ++k) {
        status = measure_backend(bench, scene, weir_cpu_backend(), bench->plan.threads[k]);
    }
    if (bench->gpu.gpu && !status) status = measure_backend(bench, scene, bench->gpu.backend, 0);
    return status;
}

static int measure_all(Bench *bench)
{
    int exit_status = WEIR_EXIT_DONE;
    if (bench->options.scene) {
        WeirScene *scene =
            weir_cli_load_scene(bench->options.scene, "bench", &(WeirTextList){0}, NULL, &exit_status);
        if (scene) exit_status = weir_cli_exit_status(measure_scene(bench, scene));
        weir_scene_destroy(scene);
        return exit_status;
    }
    for (size_t k = 0; exit_status == WEIR_EXIT_DONE && k < bench->plan.count_count; ++k) {
        WeirScene *scene = weir_bench_scene(bench->plan.bench_case, bench->plan.counts[k]);
        if (!scene || weir_scene_check(scene)) {
            fprintf(stderr, "weir bench: %u particles: %s\n", bench->plan.counts[k],
                    scene ? weir_scene_error(scene) : "memory ran out");
            exit_status = WEIR_EXIT_INPUT;
        } else {
            exit_status = weir_cli_exit_status(measure_scene(bench, scene));
        }
        weir_scene_destroy(scene);
    }
    return exit_status;
}

// Without --backends a GPU is measured if there is a real one.
static bool open_gpu(Bench *bench)
{
    char message[512];
    if (!bench->plan.gpu) return true;
    WeirStatus status =
        weir_cli_backend_open(&bench->gpu, bench->plan.gpu_must ? "gpu" : "auto", message, sizeof message);
    if (status) fprintf(stderr, "weir bench: --backends gpu: %s\n", message);
    if (!status && !bench->gpu.gpu) fprintf(stderr, "weir bench: no GPU here, or only a software one\n");
    return !status;
}

static int bench_command(int argument_count, char **arguments)
{
    Bench bench = {.options = {.seconds = 1.0}};
    const char *positional;
    int exit_status;
    if (!weir_options_parse(&weir_bench_command, argument_count, arguments, &bench.options, &positional,
                            &exit_status)) {
        return exit_status;
    }
    if (bench.options.json && bench.options.csv) {
        fprintf(stderr, "weir bench: --json and --csv are both given; must be one of them\n");
        return WEIR_EXIT_INPUT;
    }
    if (!make_plan(&bench)) return WEIR_EXIT_INPUT;
    if (!open_gpu(&bench)) return WEIR_EXIT_FAILED;
    if (bench.options.json) bench.rows = json_array();
    exit_status = measure_all(&bench);
    if (bench.options.json && !weir_json_print(bench.rows, stdout)) exit_status = WEIR_EXIT_FAILED;
    weir_cli_backend_close(&bench.gpu);
    return exit_status;
}

#define FIELD(field) offsetof(BenchOptions, field)
static const WeirOption bench_options[] = {
    {"--counts", WEIR_OPTION_TEXT, "N,N,...", NULL, FIELD(counts), 0, 0,
     "particles of fluid; article: 1000,5000,10000,32768; others: 32768,100000,1000000"},
    {"--backends", WEIR_OPTION_TEXT, "cpu,gpu", NULL, FIELD(backends), 0, 0,
     "cpu, and gpu if it is a real one; by name: any adapter"},
    {"--search", WEIR_OPTION_TEXT, "all_pairs,grid", NULL, FIELD(search), 0, 0,
     "both; all but article: grid"},
    {"--threads", WEIR_OPTION_TEXT, "N,N,...", NULL, FIELD(threads), 0, 0, "on the CPU; 1 and one per core"},
    {"--case", WEIR_OPTION_CHOICE, NULL, "article|n20|block_2d|block_3d|dam_2d|dam_3d", FIELD(bench_case), 0,
     0, "the tutorial's parameters; about 20 neighbours; wcsph without and with walls"},
    {"--scene", WEIR_OPTION_TEXT, "FILE", NULL, FIELD(scene), 0, 0, "measure a scene file instead"},
    {"--seconds", WEIR_OPTION_NUMBER, "S", NULL, FIELD(seconds), 0.001, 600, "to spend on a row; 1"},
    {"--json", WEIR_OPTION_FLAG, NULL, NULL, FIELD(json), 0, 0, "print a list of objects"},
    {"--csv", WEIR_OPTION_FLAG, NULL, NULL, FIELD(csv), 0, 0, "print comma-separated values"},
};

const WeirCommand weir_bench_command = {
    .name = "bench",
    .synopsis = "[options]",
    .summary = "measures speed on every backend, for several particle counts",
    .notes =
        "A row is the median of batches of at most 256 steps from the scene's start, after a warm-up.\n"
        "M p-steps/s: millions of particles times steps per wall second. real-time: simulated seconds per\n"
        "wall second. frames/s: at one step per frame.",
    .options = bench_options,
    .option_count = sizeof bench_options / sizeof bench_options[0],
    .run = bench_command,
};
