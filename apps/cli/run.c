// weir run: a scene without a window, with progress, a summary and, if asked for, the particles as CSV.
#include "backend.h"
#include "commands.h"
#include "dump.h"
#include "interrupt.h"
#include "output.h"
#include "probe_file.h"
#include "progress.h"
#include "report.h"
#include "setup.h"

#include <math.h>
#include <string.h>

typedef struct RunOptions {
    const char *backend, *search, *dump, *probe_out;
    WeirCount threads, steps;
    double time;
    WeirCliDevice device;
    WeirTextList set;
    bool json, quiet;
} RunOptions;

typedef struct Run {
    RunOptions options;
    const char *scene_path;
    WeirScene *scene;
    WeirCliBackend backend;
    WeirSim *sim;
    WeirProbes *probes; // NULL: none are to be written
    WeirDump last_good; // state of a moment ago, if one is to be written
    double last_good_wall;
    uint64_t steps;  // to take; of a run by time with adaptive steps, 0
    double end_time; // of such a run, s
    double wall_time;
    WeirStatus status; // of the steps
    bool interrupted;
} Run;

static const double default_time = 1.0; // s, if neither --steps nor --time is given
static const double batch_time = 0.05;  // wall s between two looks at the clock and the signal
static const uint32_t largest_batch = 1u << 20;
static const double keep_interval = 1.0; // wall s between two copies of the last good state

// Fixed steps of `mueller` are counted beforehand; `wcsph` runs to a time, whatever steps that takes.
static void plan_length(Run *run)
{
    double seconds = run->options.time > 0.0 ? run->options.time : default_time;
    if (run->options.steps.is_set) {
        run->steps = run->options.steps.value;
    } else if (strcmp(weir_scene_method(run->scene), "wcsph") == 0) {
        run->end_time = seconds;
    } else {
        double exact = seconds / weir_cli_number(run->scene, "time_step"), whole = round(exact);
        // The step is a float32: 0.4 s of 0.0008 s are 500 steps and not 501.
        run->steps = (uint64_t)(fabs(exact - whole) <= 1e-6 * exact + 1e-9 ? whole : ceil(exact));
    }
}

static bool open_simulation(Run *run, int *exit_status)
{
    *exit_status = WEIR_EXIT_FAILED;
    if (!weir_cli_backend_choose(&run->backend, run->options.backend, run->options.device, "run"))
        return false;
    WeirSimOptions options = {.backend = run->backend.backend,
                              .threads = (uint32_t)run->options.threads.value};
    run->sim = weir_sim_create(run->scene, &options);
    WeirStatus status = run->sim ? weir_sim_wait(run->sim) : WEIR_ERROR_MEMORY;
    if (!status) return true;
    fprintf(stderr, "weir run: %s: %s\n", run->scene_path,
            run->sim ? weir_sim_error(run->sim) : "memory ran out");
    // A scene that does not fit the memory is an input that cannot be run here.
    *exit_status = status == WEIR_ERROR_MEMORY ? WEIR_EXIT_INPUT : weir_cli_exit_status(status);
    return false;
}

static bool is_done(const Run *run)
{
    // As near as weir_sim_step_until() goes.
    if (run->end_time > 0.0)
        return weir_sim_time(run->sim) >= run->end_time - 1e-9 * fmax(run->end_time, 1e-3);
    return weir_sim_step_count(run->sim) >= run->steps;
}

// Steps of a batch: none beyond the run's end, nor beyond a probe's next sample.
static uint32_t batch_steps(const Run *run, double batch)
{
    double left = (double)(run->steps - weir_sim_step_count(run->sim)), steps = fmin(batch, left);
    if (run->probes) {
        WeirClock clock = weir_sim_clock(run->sim);
        double due = ceil((weir_probes_next_time(run->probes) - clock.time) / clock.time_step - 1e-6);
        steps = fmin(steps, fmax(due, 1.0));
    }
    return (uint32_t)fmax(steps, 1.0);
}

// Takes one batch of at most `batch` steps. How long it takes may not change the steps themselves: only the run's end and
// the probes' samples shorten one.
static WeirStatus take_batch(const Run *run, double batch)
{
    WeirStatus status;
    if (run->end_time > 0.0) {
        double next = run->probes ? weir_probes_next_time(run->probes) : INFINITY;
        status = weir_sim_step_until(run->sim, (uint32_t)batch, fmin(next, run->end_time));
    } else {
        status = weir_sim_step(run->sim, batch_steps(run, batch));
    }
    if (!status) status = weir_sim_wait(run->sim);
    if (!status) status = weir_sim_poll(run->sim);
    if (!status && run->probes) status = weir_probes_update(run->probes, run->sim);
    return status;
}

// Keeps a copy of the state, for the dump of a run that blows up later.
static void keep_state(Run *run)
{
    double now = weir_wall_time();
    if (!run->options.dump || now - run->last_good_wall < keep_interval) return;
    char message[256];
    WeirDump fresh;
    run->last_good_wall = now;
    if (!weir_dump_take(&fresh, run->sim, message, sizeof message)) return;
    weir_dump_free(&run->last_good);
    run->last_good = fresh;
}

// Batches of about batch_time: the clock, the terminal and the device's queue are looked at rarely enough to
// cost nothing, and often enough for Ctrl-C.
static void advance(Run *run)
{
    WeirProgress progress;
    double batch = 1.0, start = weir_wall_time();
    weir_progress_begin(&progress, !run->options.quiet, run->steps, run->end_time);
    if (run->probes) run->status = weir_probes_update(run->probes, run->sim);
    while (!run->status && !is_done(run) && !weir_cli_interrupted()) {
        double batch_start = weir_wall_time();
        keep_state(run);
        run->status = take_batch(run, batch);
        run->wall_time = weir_wall_time() - start;
        if (run->status) break;
        double growth = batch_time / fmax(weir_wall_time() - batch_start, 1e-6);
        batch = fmin(fmax(batch * fmin(growth, 4.0), 1.0), largest_batch);
        weir_progress_update(&progress, weir_sim_step_count(run->sim), weir_sim_time(run->sim));
    }
    run->interrupted = !run->status && !is_done(run);
    weir_progress_end(&progress);
}

// Writes particles and probes as asked for: those of now or, after a failure, of the last good moment.
static bool write_outputs(Run *run, char *message, size_t message_size)
{
    const RunOptions *options = &run->options;
    if (options->dump && run->status && run->last_good.values) {
        if (!weir_dump_save(options->dump, &run->last_good, message, message_size)) return false;
        fprintf(stderr, "weir run: %s holds the last state that was kept, of step %llu, t = %g s\n",
                options->dump, (unsigned long long)run->last_good.step, run->last_good.time);
    } else if (options->dump && !run->status) {
        if (!weir_dump_write(options->dump, run->sim, message, message_size)) return false;
    }
    return !run->probes || weir_probe_file_write(options->probe_out, run->probes, message, message_size);
}

// The end of a run that began: summary, dump, exit status.
static int finish(Run *run)
{
    char message[512];
    WeirReport report = {.scene_path = run->scene_path, .sim = run->sim, .wall_time = run->wall_time};
    int exit_status = run->interrupted ? WEIR_EXIT_INTERRUPTED : WEIR_EXIT_DONE;
    report.outcome = run->status ? "failed" : run->interrupted ? "interrupted" : "done";
    snprintf(message, sizeof message, "%s", run->status ? weir_sim_error(run->sim) : "");
    uint32_t flags = WEIR_DIAGNOSE_HASH | (run->status ? 0 : WEIR_DIAGNOSE_NEIGHBORS);
    report.has_diagnostics = weir_sim_diagnose(run->sim, flags, &report.diagnostics) == WEIR_OK;
    if (!run->status && !report.has_diagnostics) {
        report.outcome = "failed";
        snprintf(message, sizeof message, "%s", weir_sim_error(run->sim));
    } else if (!run->status && report.diagnostics.lost_particles > 0) {
        report.outcome = "failed";
        snprintf(message, sizeof message, "%u particles are lost; please report this scene",
                 report.diagnostics.lost_particles);
    }
    report.error = message;
    char trouble[512];
    if (*message) {
        fprintf(stderr, "weir run: %s: %s\n", run->scene_path, message);
        exit_status = WEIR_EXIT_FAILED;
    }
    if (!write_outputs(run, trouble, sizeof trouble)) {
        fprintf(stderr, "weir run: %s\n", trouble);
        if (!*message) report.error = trouble;
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

static bool open_probes(Run *run, int *exit_status)
{
    char message[512] = "memory ran out";
    run->probes = weir_probes_create(run->sim);
    if (run->probes && weir_probes_count(run->probes) == 0) {
        fprintf(stderr, "weir run: --probe-out: %s has no probes\n", run->scene_path);
        *exit_status = WEIR_EXIT_INPUT;
        return false;
    }
    if (run->probes && weir_probe_file_check(run->options.probe_out, message, sizeof message)) return true;
    fprintf(stderr, "weir run: %s\n", message);
    *exit_status = WEIR_EXIT_FAILED;
    return false;
}

static int simulate(Run *run)
{
    int exit_status;
    char message[512];
    run->scene =
        weir_cli_load_scene(run->scene_path, "run", &run->options.set, run->options.search, &exit_status);
    if (!run->scene) return exit_status;
    plan_length(run);
    if (run->options.dump && !weir_dump_probe(run->options.dump, message, sizeof message)) {
        fprintf(stderr, "weir run: %s\n", message);
        return WEIR_EXIT_FAILED;
    }
    if (!open_simulation(run, &exit_status)) return exit_status;
    if (run->options.probe_out && !open_probes(run, &exit_status)) return exit_status;
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
    weir_cli_catch_interrupt();
    exit_status = simulate(&run);
    weir_probes_destroy(run.probes);
    weir_dump_free(&run.last_good);
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
    {"--list-memory", WEIR_OPTION_NUMBER, "GIB", NULL, FIELD(device.list_memory), 1e-3, 1e6,
     "that neighbour lists may take on the GPU (without them: slower); 8"},
    {"--parallelism", WEIR_OPTION_NUMBER, "N", NULL, FIELD(device.parallelism), 1, 4e9,
     "threads that keep the GPU busy; measured once per device and remembered"},
    {"--steps", WEIR_OPTION_COUNT, "N", NULL, FIELD(steps), 0, 1e15, "steps to take; 0 measures the start"},
    {"--time", WEIR_OPTION_NUMBER, "S", NULL, FIELD(time), 1e-7, 1e9,
     "simulated seconds instead; 1 if neither is given"},
    {"--set", WEIR_OPTION_LIST, "NAME=VALUE", NULL, FIELD(set), 0, 0,
     "change a parameter (weir params); may be repeated"},
    {"--search", WEIR_OPTION_CHOICE, NULL, "grid|all_pairs", FIELD(search), 0, 0,
     "the same as --set search=..."},
    {"--dump", WEIR_OPTION_TEXT, "FILE.csv", NULL, FIELD(dump), 0, 0,
     "write id,x,y,vx,vy,density,pressure at the end (wcsph: and group; 3D: and z,vz)"},
    {"--probe-out", WEIR_OPTION_TEXT, "DIR|FILE.csv", NULL, FIELD(probe_out), 0, 0,
     "write what the scene's probes measure: a file each into DIR, or all into FILE.csv"},
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
        "130 ended by Ctrl-C, after the summary and the dump of the steps done. After a blow-up --dump holds "
        "the last\n"
        "state that was kept, a second of wall time before at most.",
    .positional = "SCENE",
    .options = run_options,
    .option_count = sizeof run_options / sizeof run_options[0],
    .run = run_command,
};
