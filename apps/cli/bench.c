// weir bench: the tutorial's table natively, for every backend, neighbour search and thread count; and the
// cases and suites that speed is tracked by (docs/performance.md).
#include "backend.h"
#include "bench_output.h"
#include "bench_suite.h"
#include "commands.h"
#include "setup.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { MAX_ITEMS = 32, MAX_RUNS = 66, SUITE_REPETITIONS = 5 };

typedef struct BenchOptions {
    const char *counts, *backends, *search, *threads, *bench_case, *scene, *suite, *compare;
    WeirCount repetitions;
    double seconds, scale;
    WeirCliDevice device;
    bool json, csv, passes;
} BenchOptions;

// What to measure: every combination of these.
typedef struct Plan {
    uint32_t counts[MAX_ITEMS], threads[MAX_ITEMS];
    size_t count_count, thread_count;
    bool cpu, gpu, gpu_must; // gpu_must: asked for by name
    bool grid, all_pairs;
    const WeirBenchCase *bench_case;
    const WeirBenchSuite *suite;
    WeirBenchEffort effort;
} Plan;

typedef struct Bench {
    BenchOptions options;
    Plan plan;
    WeirBenchFormat format;
    WeirCliBackend gpu;
    json_t *rows, *earlier; // earlier: of --compare
    bool header_printed;
    // Of a suite: the item measured, its runs so far, and seconds per particle of all runs of all items.
    const WeirBenchItem *item;
    uint32_t run;
    double times[MAX_ITEMS][MAX_RUNS];
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

static bool is_together(const char *one, const char *one_is, const char *other, const char *other_is)
{
    if (!one || !other) return false;
    fprintf(stderr, "weir bench: %s and %s are both given; must be one of them\n", one_is, other_is);
    return true;
}

// What to measure, of three ways to say it.
static bool choose_what(const BenchOptions *options, Plan *plan)
{
    if (is_together(options->suite, "--suite", options->scene, "--scene") ||
        is_together(options->suite, "--suite", options->bench_case, "--case") ||
        is_together(options->suite, "--suite", options->counts, "--counts")) {
        return false;
    }
    if (options->scene && (options->counts || options->bench_case)) {
        fprintf(stderr, "weir bench: --scene is measured as it is; leave out --counts and --case\n");
        return false;
    }
    if (options->scale > 0.0 && !options->suite) {
        fprintf(stderr, "weir bench: --scale is for --suite; give --counts instead\n");
        return false;
    }
    plan->bench_case = weir_bench_case(options->bench_case ? options->bench_case : "article");
    plan->suite = options->suite ? weir_bench_suite(options->suite) : NULL;
    return true;
}

static bool choose_search(const BenchOptions *options, Plan *plan)
{
    bool table = plan->bench_case->kind == WEIR_BENCH_ARTICLE && !options->scene && !plan->suite;
    const char *search = options->search ? options->search : table ? "all_pairs,grid" : "grid";
    return parse_pair("--search", search, (const char *const[2]){"all_pairs", "grid"}, &plan->all_pairs,
                      &plan->grid);
}

static bool make_plan(Bench *bench)
{
    const BenchOptions *options = &bench->options;
    Plan *plan = &bench->plan;
    if (!choose_what(options, plan) || !choose_search(options, plan)) return false;
    bool article = plan->bench_case->kind == WEIR_BENCH_ARTICLE;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    char threads[32] = "1";
    if (cores > 1)
        snprintf(threads, sizeof threads, plan->suite ? "%.0s%ld" : "%s,%ld", "1",
                 cores < 1024 ? cores : 1024);
    const char *counts = options->counts ? options->counts
                         : article       ? "1000,5000,10000,32768"
                                         : "32768,100000,1000000";
    plan->cpu = plan->gpu = true;
    plan->gpu_must = options->backends != NULL;
    plan->effort = (WeirBenchEffort){options->seconds, 1};
    if (plan->suite) plan->effort.repetitions = SUITE_REPETITIONS;
    if (options->repetitions.is_set) plan->effort.repetitions = (uint32_t)options->repetitions.value;
    return parse_counts("--counts", counts, 1, 1u << 28, plan->counts, &plan->count_count) &&
           parse_counts("--threads", options->threads ? options->threads : threads, 1, 1024, plan->threads,
                        &plan->thread_count) &&
           (!options->backends || parse_pair("--backends", options->backends,
                                             (const char *const[2]){"cpu", "gpu"}, &plan->cpu, &plan->gpu));
}

// ---- Measuring ----

// Time per particle over that of the item that this one is measured against, on the same backend and threads.
static void set_relative(Bench *bench, WeirBenchRow *row)
{
    if (!bench->item || bench->run >= MAX_RUNS) return;
    double time = row->ms_per_step / row->particles;
    bench->times[bench->item - bench->plan.suite->items][bench->run] = time;
    if (bench->item->against < 0) return;
    double reference = bench->times[bench->item->against][bench->run];
    if (reference > 0.0) row->relative = time / reference;
}

static void print_passes(const WeirBenchRow *row)
{
    for (uint32_t k = 0; k < row->pass_count; ++k)
        printf("    %-16s %10.4g ms\n", row->passes[k].name, row->passes[k].milliseconds);
}

static void add_row(Bench *bench, WeirBenchRow *row)
{
    set_relative(bench, row);
    json_array_append_new(bench->rows, weir_bench_row_json(row));
    weir_bench_print(row, bench->format, !bench->header_printed);
    bench->header_printed = true;
    if (bench->options.passes && bench->format == WEIR_BENCH_TABLE) print_passes(row);
}

static WeirStatus measure_backend(Bench *bench, WeirScene *scene, const WeirBenchCase *bench_case,
                                  const WeirSimOptions *options)
{
    const char *const names[2] = {"all_pairs", "grid"};
    const bool wanted[2] = {bench->plan.all_pairs, bench->plan.grid};
    bool has_choice = strcmp(weir_scene_method(scene), "mueller") == 0;
    for (int k = 0; k < 2; ++k) {
        WeirBenchRow row = {0};
        if (!wanted[k]) continue;
        if (has_choice) weir_scene_set_parameter_text(scene, "search", names[k]);
        WeirStatus status = weir_bench_measure(scene, bench_case, options, &bench->plan.effort, &row);
        if (status) return status;
        add_row(bench, &row);
        ++bench->run;
    }
    return WEIR_OK;
}

// A suite runs on the GPU, and on the CPU only where there is none or by name.
static WeirStatus measure_scene(Bench *bench, WeirScene *scene, const WeirBenchCase *bench_case)
{
    const Plan *plan = &bench->plan;
    bool cpu = plan->cpu && !(plan->suite && bench->gpu.gpu && !plan->gpu_must);
    WeirStatus status = WEIR_OK;
    bench->run = 0;
    for (size_t k = 0; cpu && !status && k < plan->thread_count; ++k) {
        WeirSimOptions options = {.backend = weir_cpu_backend(), .threads = plan->threads[k]};
        status = measure_backend(bench, scene, bench_case, &options);
    }
    WeirSimOptions options = {.backend = bench->gpu.backend};
    if (bench->gpu.gpu && !status) status = measure_backend(bench, scene, bench_case, &options);
    return status;
}

static int measure_case(Bench *bench, const WeirBenchCase *bench_case, uint32_t count)
{
    int exit_status = WEIR_EXIT_INPUT;
    WeirScene *scene = weir_bench_scene(bench_case, count);
    if (!scene || weir_scene_check(scene)) {
        fprintf(stderr, "weir bench: %s, %u particles: %s\n", bench_case->name, count,
                scene ? weir_scene_error(scene) : "memory ran out");
    } else {
        WeirStatus status = measure_scene(bench, scene, bench_case);
        exit_status = weir_cli_exit_status(status);
        // What does not fit is left out of a suite.
        if (bench->plan.suite && status == WEIR_ERROR_MEMORY) exit_status = WEIR_EXIT_DONE;
    }
    weir_scene_destroy(scene);
    return exit_status;
}

// A case that fails does not keep the others from being measured.
static int measure_suite(Bench *bench)
{
    const WeirBenchSuite *suite = bench->plan.suite;
    double scale = bench->options.scale > 0.0 ? bench->options.scale : 1.0;
    int worst = WEIR_EXIT_DONE;
    for (size_t k = 0; k < suite->item_count; ++k) {
        bench->item = &suite->items[k];
        double count = fmin(fmax(1.0, floor(scale * bench->item->count + 0.5)), 2e8);
        int exit_status = measure_case(bench, weir_bench_case(bench->item->name), (uint32_t)count);
        if (exit_status != WEIR_EXIT_DONE) worst = exit_status;
    }
    return worst;
}

static int measure_all(Bench *bench)
{
    int exit_status = WEIR_EXIT_DONE;
    if (bench->plan.suite) return measure_suite(bench);
    if (bench->options.scene) {
        WeirScene *scene =
            weir_cli_load_scene(bench->options.scene, "bench", &(WeirTextList){0}, NULL, &exit_status);
        if (scene) exit_status = weir_cli_exit_status(measure_scene(bench, scene, NULL));
        weir_scene_destroy(scene);
        return exit_status;
    }
    for (size_t k = 0; exit_status == WEIR_EXIT_DONE && k < bench->plan.count_count; ++k)
        exit_status = measure_case(bench, bench->plan.bench_case, bench->plan.counts[k]);
    return exit_status;
}

// ---- The command ----

// Without --backends a GPU is measured if there is a real one.
static bool open_gpu(Bench *bench)
{
    char message[512];
    if (!bench->plan.gpu) return true;
    WeirStatus status = weir_cli_backend_open(&bench->gpu, bench->plan.gpu_must ? "gpu" : "auto",
                                              bench->options.device, message, sizeof message);
    if (status) fprintf(stderr, "weir bench: --backends gpu: %s\n", message);
    if (!status && !bench->gpu.gpu) fprintf(stderr, "weir bench: no GPU here, or only a software one\n");
    return !status;
}

static int measure_and_report(Bench *bench)
{
    if (!open_gpu(bench)) return WEIR_EXIT_FAILED;
    bench->rows = json_array();
    int exit_status = measure_all(bench);
    if (bench->earlier && json_array_size(bench->rows) > 0 &&
        !weir_bench_compare(bench->rows, bench->earlier, bench->options.compare)) {
        exit_status = WEIR_EXIT_FAILED;
    }
    if (bench->format == WEIR_BENCH_JSON) {
        if (!weir_json_print(bench->rows, stdout)) exit_status = WEIR_EXIT_FAILED;
    } else {
        json_decref(bench->rows);
    }
    weir_cli_backend_close(&bench->gpu);
    return exit_status;
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
    const BenchOptions *options = &bench.options;
    if (options->json && options->csv) {
        fprintf(stderr, "weir bench: --json and --csv are both given; must be one of them\n");
        return WEIR_EXIT_INPUT;
    }
    bench.format = options->json ? WEIR_BENCH_JSON : options->csv ? WEIR_BENCH_CSV : WEIR_BENCH_TABLE;
    if (!make_plan(&bench)) return WEIR_EXIT_INPUT;
    if (options->compare && !(bench.earlier = weir_bench_read(options->compare))) return WEIR_EXIT_INPUT;
    exit_status = measure_and_report(&bench);
    json_decref(bench.earlier);
    return exit_status;
}

#define FIELD(field) offsetof(BenchOptions, field)
static const WeirOption bench_options[] = {
    {"--suite", WEIR_OPTION_CHOICE, NULL, WEIR_BENCH_SUITES, FIELD(suite), 0, 0,
     "a list of cases: a minute's worth; the targets; 3D up to 100 M; nasty ones; default supports"},
    {"--scale", WEIR_OPTION_NUMBER, "X", NULL, FIELD(scale), 1e-6, 100, "times the suite's particles; 1"},
    {"--counts", WEIR_OPTION_TEXT, "N,N,...", NULL, FIELD(counts), 0, 0,
     "particles of fluid; article: 1000,5000,10000,32768; others: 32768,100000,1000000"},
    {"--backends", WEIR_OPTION_TEXT, "cpu,gpu", NULL, FIELD(backends), 0, 0,
     "cpu, and gpu if it is a real one; by name: any adapter. Suites: the CPU only without one"},
    {"--search", WEIR_OPTION_TEXT, "all_pairs,grid", NULL, FIELD(search), 0, 0,
     "both; all but the article's table: grid"},
    {"--threads", WEIR_OPTION_TEXT, "N,N,...", NULL, FIELD(threads), 0, 0,
     "on the CPU; 1 and one per core; suites: one per core"},
    {"--list-memory", WEIR_OPTION_NUMBER, "GIB", NULL, FIELD(device.list_memory), 1e-3, 1e6,
     "that neighbour lists may take on the GPU (without them: slower); 8"},
    {"--parallelism", WEIR_OPTION_NUMBER, "N", NULL, FIELD(device.parallelism), 1, 4e9,
     "threads that keep the GPU busy; measured once per device and remembered"},
    {"--case", WEIR_OPTION_CHOICE, NULL, WEIR_BENCH_CASES, FIELD(bench_case), 0, 0,
     "what to measure, see docs/performance.md; article"},
    {"--scene", WEIR_OPTION_TEXT, "FILE", NULL, FIELD(scene), 0, 0, "measure a scene file instead"},
    {"--seconds", WEIR_OPTION_NUMBER, "S", NULL, FIELD(seconds), 0.001, 600, "to spend on a row; 1"},
    {"--repetitions", WEIR_OPTION_COUNT, "N", NULL, FIELD(repetitions), 1, 64,
     "batches of a row at least; 1, suites 5"},
    {"--compare", WEIR_OPTION_TEXT, "FILE", NULL, FIELD(compare), 0, 0,
     "print the speed over that of an earlier --csv or --json; fail on a loss over 10 %"},
    {"--passes", WEIR_OPTION_FLAG, NULL, NULL, FIELD(passes), 0, 0, "milliseconds per pass below each row"},
    {"--json", WEIR_OPTION_FLAG, NULL, NULL, FIELD(json), 0, 0, "print a list of objects"},
    {"--csv", WEIR_OPTION_FLAG, NULL, NULL, FIELD(csv), 0, 0, "print comma-separated values"},
};

const WeirCommand weir_bench_command = {
    .name = "bench",
    .synopsis = "[options]",
    .summary = "measures speed on every backend, for several particle counts",
    .notes =
        "A row is the median of batches of steps after a warm-up; +-% is half the spread of the batches.\n"
        "n: neighbours inside the support; cand.: those that the grid's cells offer. M p-steps/s: millions "
        "of\n"
        "particles times steps per wall second; G pairs/s: times n. B/part.: bytes of memory per particle.\n"
        "real-time: simulated seconds per wall second. relative: time per particle over that of the suite's "
        "box.",
    .options = bench_options,
    .option_count = sizeof bench_options / sizeof bench_options[0],
    .run = bench_command,
};
