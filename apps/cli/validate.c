// weir validate: the published cases, each with its numbers beside the reference, and whether its gates hold.
#include "backend.h"
#include "commands.h"
#include "interrupt.h"
#include "output.h"
#include "setup.h"
#include "validate_output.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "json/json_scene.h"

typedef struct ValidateOptions {
    WeirTextList cases;
    const char *backend, *resolution, *out;
    WeirCount threads;
    bool json, list, quiet;
} ValidateOptions;

typedef struct Validate {
    ValidateOptions options;
    WeirResolution resolution;
    WeirCliBackend backend;
    WeirValidateReport report;
    bool failed; // some gate
} Validate;

static int list_cases(void)
{
    for (uint32_t k = 0; k < weir_case_count(); ++k) {
        const WeirCaseInfo *info = weir_case_info(k);
        printf("%-20s %s\n", info->name, info->title);
    }
    return WEIR_EXIT_DONE;
}

static bool known_cases(const WeirTextList *cases)
{
    for (size_t k = 0; k < cases->count; ++k) {
        const char *names[64];
        uint32_t count = weir_case_count();
        if (weir_case_find(cases->items[k]) < count) continue;
        for (uint32_t n = 0; n < count; ++n) names[n] = weir_case_info(n)->name;
        const char *near = weir_suggest(cases->items[k], names, count, sizeof names[0]);
        fprintf(stderr, "weir validate: unknown case '%s'", cases->items[k]);
        if (near) fprintf(stderr, "; did you mean '%s'?", near);
        fprintf(stderr, "\nSee: weir validate --list\n");
        return false;
    }
    return true;
}

// One line that is written over and over, on a terminal only.
static void show_progress(const Validate *command, const WeirValidation *v, const WeirSim *sim, uint32_t run)
{
    if (command->options.quiet || !isatty(STDERR_FILENO)) return;
    const WeirRunInfo *info = weir_validation_run(v, run);
    WeirClock clock = weir_sim_clock(sim);
    fprintf(stderr, "\r\033[K%s %3.0f %%  %s  t %.4g of %.4g s  dt %.3g s  Mach %.2g",
            weir_validation_case(v)->name, 100.0 * weir_validation_progress(v), info->label, clock.time,
            info->end_time, clock.time_step, clock.mach_number);
    fflush(stderr);
}

static void clear_progress(const Validate *command)
{
    if (!command->options.quiet && isatty(STDERR_FILENO)) fprintf(stderr, "\r\033[K");
}

static WeirScene *load_scene(WeirValidation *v, uint32_t run)
{
    const WeirRunInfo *info = weir_validation_run(v, run);
    WeirScene *scene = NULL;
    char message[512];
    if (weir_json_parse_scene(info->scene_text, strlen(info->scene_text), info->scene_file, &scene, message,
                              sizeof message)) {
        weir_validation_abandon(v, message);
        return NULL;
    }
    if (!weir_validation_prepare(v, run, scene)) return scene;
    weir_scene_destroy(scene);
    return NULL;
}

// Steps one run to its end; trouble ends it and is told by the validation.
static void simulate(Validate *command, WeirValidation *v, uint32_t run, WeirValidateRun *result)
{
    WeirSimOptions options = {.backend = command->backend.backend,
                              .threads = (uint32_t)command->options.threads.value};
    WeirScene *scene = load_scene(v, run);
    if (!scene) return;
    WeirSim *sim = weir_sim_create(scene, &options);
    weir_scene_destroy(scene);
    double start = weir_wall_time();
    WeirStatus status = sim ? weir_sim_wait(sim) : WEIR_ERROR_MEMORY;
    if (status) weir_validation_abandon(v, sim ? weir_sim_error(sim) : "memory ran out");
    if (!status) status = weir_validation_begin(v, run, sim);
    while (!status && !weir_validation_run_is_done(v) && !weir_cli_interrupted()) {
        status = weir_validation_advance(v, sim);
        show_progress(command, v, sim, run);
    }
    clear_progress(command);
    if (sim) {
        WeirClock clock = weir_sim_clock(sim);
        *result =
            (WeirValidateRun){weir_sim_particle_count(sim), clock.step, clock.time, weir_wall_time() - start};
        snprintf(command->report.device, sizeof command->report.device, "%s", weir_sim_device(sim));
    }
    weir_sim_destroy(sim);
}

static bool validate_case(Validate *command, uint32_t index)
{
    WeirValidation *v = weir_validation_create(index, command->resolution);
    WeirValidateRun runs[64] = {{0}};
    char told[512] = "";
    if (!v) {
        fprintf(stderr, "weir validate: memory ran out\n");
        return false;
    }
    double start = weir_wall_time();
    for (uint32_t run = 0; run < weir_validation_run_count(v) && run < 64 && !weir_cli_interrupted(); ++run) {
        char before[sizeof told];
        snprintf(before, sizeof before, "%s", weir_validation_error(v));
        simulate(command, v, run, &runs[run]);
        snprintf(told, sizeof told, "%s", weir_validation_error(v));
        if (strcmp(told, before) != 0 && !command->options.quiet)
            fprintf(stderr, "weir validate: %s: %s\n", weir_validation_case(v)->name, told);
    }
    if (!weir_validation_judge(v)) command->failed = true;
    bool written = weir_validate_add_case(&command->report, v, runs, weir_wall_time() - start);
    if (!command->options.json && !command->options.quiet)
        weir_validate_print_case(v, weir_wall_time() - start);
    weir_validation_destroy(v);
    return written;
}

static int validate_all(Validate *command)
{
    const WeirTextList *wanted = &command->options.cases;
    size_t count = wanted->count ? wanted->count : weir_case_count();
    if (!weir_validate_begin(&command->report, command->options.out,
                             weir_resolution_name(command->resolution), command->options.backend))
        return WEIR_EXIT_FAILED;
    bool written = true;
    for (size_t k = 0; k < count && written && !weir_cli_interrupted(); ++k) {
        written = validate_case(command, wanted->count ? weir_case_find(wanted->items[k]) : (uint32_t)k);
    }
    written = weir_validate_end(&command->report, command->options.json) && written;
    if (weir_cli_interrupted()) return WEIR_EXIT_INTERRUPTED;
    return written && !command->failed ? WEIR_EXIT_DONE : WEIR_EXIT_FAILED;
}

static int run_command(int argument_count, char **arguments)
{
    Validate command = {.options = {.backend = "auto", .resolution = "normal"}};
    const char *none;
    int exit_status;
    if (!weir_options_parse(&weir_validate_command, argument_count, arguments, &command.options, &none,
                            &exit_status)) {
        return exit_status;
    }
    if (command.options.list) return list_cases();
    if (!known_cases(&command.options.cases)) return WEIR_EXIT_INPUT;
    while (strcmp(weir_resolution_name(command.resolution), command.options.resolution) != 0)
        ++command.resolution;
    if (!weir_cli_backend_choose(&command.backend, command.options.backend, (WeirCliDevice){0}, "validate"))
        return WEIR_EXIT_FAILED;
    weir_cli_catch_interrupt();
    exit_status = validate_all(&command);
    weir_cli_backend_close(&command.backend);
    return exit_status;
}

#define FIELD(field) offsetof(ValidateOptions, field)
static const WeirOption validate_options[] = {
    {"--backend", WEIR_OPTION_CHOICE, NULL, "auto|cpu|gpu", FIELD(backend), 0, 0,
     "auto (the default): the GPU if it is a real one"},
    {"--resolution", WEIR_OPTION_CHOICE, NULL, "coarse|normal|fine", FIELD(resolution), 0, 0,
     "normal is the default; coarse has gates of its own"},
    {"--threads", WEIR_OPTION_COUNT, "N", NULL, FIELD(threads), 0, 1024,
     "threads on the CPU; 0 (the default): one per core"},
    {"--out", WEIR_OPTION_TEXT, "DIR", NULL, FIELD(out), 0, 0,
     "write results.json and CASE.csv (curves) into DIR, made if missing"},
    {"--json", WEIR_OPTION_FLAG, NULL, NULL, FIELD(json), 0, 0, "print one JSON object instead of tables"},
    {"--list", WEIR_OPTION_FLAG, NULL, NULL, FIELD(list), 0, 0, "name the cases and end"},
    {"--quiet", WEIR_OPTION_FLAG, NULL, NULL, FIELD(quiet), 0, 0, "no progress and no tables"},
};

const WeirCommand weir_validate_command = {
    .name = "validate",
    .synopsis = "[CASE...] [options]",
    .summary = "simulates published cases and compares them with their references (all if none is named)",
    .notes = "Exit status: 0 all gates passed, 1 a gate failed or a run broke off, 2 bad input, 130 ended by "
             "Ctrl-C.\n"
             "Cases, gates and parameters: docs/validation.md",
    .takes_list = true,
    .list_offset = FIELD(cases),
    .options = validate_options,
    .option_count = sizeof validate_options / sizeof validate_options[0],
    .run = run_command,
};
