// weir run: a scene without a window, with progress, a summary and, if asked for, the particles as CSV.
#include "backend.h"
#include "commands.h"
#include "dump.h"
#include "output.h"
#include "progress.h"
#include "report.h"
#include "setup.h"

#include <math.h>
#include <signal.h>
#include <string.h>

typedef struct RunOptions {
    const char *backend, *search, *dump;
    WeirCount threads, steps;
    double time;
    WeirTextList set;
    bool json, quiet;
} RunOptions;

typedef struct Run {
    RunOptions options;
    const char *scene_path;
    WeirScene *scene;
    WeirCliBackend backend;
    WeirSim *sim;
    uint64_t steps;
    double wall_time;
    WeirStatus status; // of the steps
    bool interrupted;
} Run;

static const double default_time = 1.0; // s, if neither --steps nor --time is given
static const double batch_time = 0.05;  // wall s between two looks at the clock and the signal
static const uint32_t largest_batch = 1u << 20;

// The one thing that a signal handler may touch.
static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

// The first Ctrl-C asks for an end, the second one ends the program.
static void catch_signals(void)
{
    struct sigaction action = {.sa_handler = request_stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static uint64_t step_count(const Run *run)
{
    if (run->options.steps.is_set) return run->options.steps.value;
    double seconds = run->options.time > 0.0 ? run->options.time : default_time;
    double exact = seconds / weir_cli_number(run->scene, "time_step"), whole = round(exact);
    // The step is a float32: 0.4 s of 0.0008 s are 500 steps and not 501.
    return (uint64_t)(fabs(exact - whole) <= 1e-6 * exact + 1e-9 ? whole : ceil(exact));
}

static bool open_simulation(Run *run, int *exit_status)
{
    char message[512];
    WeirStatus status = weir_cli_backend_open(&run->backend, run->options.backend, message, sizeof message);
    if (status) {
        fprintf(stderr, "weir run: --backend %s: %s\n", run->options.backend, message);
        *exit_status = WEIR_EXIT_FAILED;
        return false;
    }
    WeirSimOptions options = {.backend = run->backend.backend,
                              .threads = (uint32_t)run->options.threads.value};
    run->sim = weir_sim_create(run->scene, &options);
    if (run->sim) status = weir_sim_wait(run->sim);
    if (run->sim && !status) return true;
    fprintf(stderr, "weir run: %s: %s\n", run->scene_path,
            run->sim ? weir_sim_error(run->sim) : "memory ran out");
    // A scene that does not fit the memory is an input that cannot be run here.
    bool memory = !run->sim || status == WEIR_ERROR_MEMORY;
    *exit_status = memory ? WEIR_EXIT_INPUT : weir_cli_exit_status(status);
    return false;
}

// Batches of about batch_time: the clock, the terminal and the device's queue are looked at rarely enough to
// cost nothing, and often enough for Ctrl-C.
static void advance(Run *run)
{
    WeirProgress progress;
    uint64_t done = 0;
    double batch = 1.0, start = weir_wall_time();
    weir_progress_begin(&progress, !run->options.quiet, run->steps);
    while (done < run->steps && !stop_requested) {
        uint64_t left = run->steps - done;
        uint32_t steps = left < (uint64_t)batch ? (uint32_t)left : (uint32_t)batch;
        double batch_start = weir_wall_time();
        run->status = weir_sim_step(run->sim, steps);
        if (!run->status) run->status = weir_sim_wait(run->sim);
        if (!run->status) run->status = weir_sim_poll(run->sim);
        run->wall_time = weir_wall_time() - start;
        if (run->status) break;
        done += steps;
        double growth = batch_time / fmax(weir_wall_time() - batch_start, 1e-6);
        batch = fmin(fmax(steps * fmin(growth, 4.0), 1.0), largest_batch);
        weir_progress_update(&progress, done, weir_sim_time(run->sim));
    }
    run->interrupted = !run->status && done < run->steps;
    weir_progress_end(&progress);
}

// The end of a run that began: summary, dump, exit status.
static int finish(Run *run)
{
    char message[512];
    WeirReport report = {.scene_path = run->scene_path, .sim = run->sim, .wall_time = run->wall_time};
    int exit_status = run->interrupted ? WEIR_EXIT_INTERRUPTED : WEIR_EXIT_DONE;
    report.outcome = run->status ? "failed" : run->interrupted ? "interrupted" : "done";
    snprintf(message, sizeof message, "%s", run->status ? weir_sim_error(run->sim) : "");
    report.has_diagnostics = weir_sim_diagnose(run->sim, !run->status, &report.diagnostics) == WEIR_OK;
    if (!run->status && !report.has_diagnostics) {
        report.outcome = "failed";
        snprintf(message, sizeof message, "%s", weir_sim_error(run->sim));
    } else if (!run->status && report.diagnostics.lost_particles > 0) {
        report.outcome = "failed";
        snprintf(message, sizeof message, "%u particles are lost; please report this scene",
                 report.diagnostics.lost_particles);
    }
    report.error = message;
    if (*message) {
        fprintf(stderr, "weir run: %s: %s\n", run->scene_path, message);
        exit_status = WEIR_EXIT_FAILED;
    } else if (run->options.dump && !weir_dump_write(run->options.dump, run->sim, message, sizeof message)) {
        fprintf(stderr, "weir run: %s\n", message);
        report.outcome = "failed";
        exit_status = WEIR_EXIT_FAILED;
    }
    if (run->options.json) {
        weir_report_json(&report);
    } else if (!run->options.quiet) {
        weir_report_text(&report);
    }
    return exit_status;
}

static int simulate(Run *run)
{
    int exit_status;
    char message[512];
    run->scene =
        weir_cli_load_scene(run->scene_path, "run", &run->options.set, run->options.search, &exit_status);
    if (!run->scene) return exit_status;
    run->steps = step_count(run);
    if (run->options.dump && !weir_dump_probe(run->options.dump, message, sizeof message)) {
        fprintf(stderr, "weir run: %s\n", message);
        return WEIR_EXIT_FAILED;
    }
    if (!open_simulation(run, &exit_status)) return exit_status;
    const char *advice = weir_sim_warning(run->sim);
    if (*advice && strcmp(advice, weir_scene_warning(run->scene)) != 0) {
        fprintf(stderr, "weir run: warning: %s\n", advice);
    }
    advance(run);
    return finish(run);
}

static int run_command(int argument_count, char **arguments)
{
    Run run = {.options = {.backend = "auto"}};
    int exit_status;
    if (!weir_options_parse(&weir_run_command, argument_count, arguments, &run.options, &run.scene_path,
                            &exit_status)) {
        return exit_status;
    }
    if (run.options.steps.is_set && run.options.time > 0.0) {
        fprintf(stderr, "weir run: --steps and --time are both given; must be one of them\n");
        return WEIR_EXIT_INPUT;
    }
    catch_signals();
    exit_status = simulate(&run);
    weir_sim_destroy(run.sim);
    weir_cli_backend_close(&run.backend);
    weir_scene_destroy(run.scene);
    return exit_status;
}

#define FIELD(field) offsetof(RunOptions, field)
static const WeirOption run_options[] = {
    {"--backend", WEIR_OPTION_CHOICE, NULL, "auto|cpu|gpu", FIELD(backend), 0, 0,
     "auto (the default): the GPU if it is a real one"},
    {"--threads", WEIR_OPTION_COUNT, "N", NULL, FIELD(threads), 0, 1024,
     "threads on the CPU; 0 (the default): one per core"},
    {"--steps", WEIR_OPTION_COUNT, "N", NULL, FIELD(steps), 0, 1e15, "steps to take; 0 measures the start"},
    {"--time", WEIR_OPTION_NUMBER, "S", NULL, FIELD(time), 1e-7, 1e9,
     "simulated seconds instead; 1 if neither is given"},
    {"--set", WEIR_OPTION_LIST, "NAME=VALUE", NULL, FIELD(set), 0, 0,
     "change a parameter (weir params); may be repeated"},
    {"--search", WEIR_OPTION_CHOICE, NULL, "grid|all_pairs", FIELD(search), 0, 0,
     "the same as --set search=..."},
    {"--dump", WEIR_OPTION_TEXT, "FILE.csv", NULL, FIELD(dump), 0, 0,
     "write id,x,y,vx,vy,density,pressure at the end"},
    {"--json", WEIR_OPTION_FLAG, NULL, NULL, FIELD(json), 0, 0,
     "print one JSON object instead of the summary"},
    {"--quiet", WEIR_OPTION_FLAG, NULL, NULL, FIELD(quiet), 0, 0, "no progress and no summary"},
};

const WeirCommand weir_run_command = {
    .name = "run",
    .synopsis = "SCENE [options]",
    .summary = "simulates a scene file and says what became of it",
    .notes =
        "Exit status: 0 done, 1 the run failed (blow-up, lost particle, device, full disk), 2 bad input,\n"
        "130 ended by Ctrl-C, after the summary and the dump of the steps done.",
    .positional = "SCENE",
    .options = run_options,
    .option_count = sizeof run_options / sizeof run_options[0],
    .run = run_command,
};
