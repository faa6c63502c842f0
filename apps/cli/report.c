#include "report.h"
#include "output.h"
#include "setup.h"

#include <math.h>

enum { MAX_PASSES = 32 };

static double particle_steps_per_second(const WeirReport *report)
{
    double steps = (double)weir_sim_step_count(report->sim);
    return steps * weir_sim_particle_count(report->sim) / report->wall_time;
}

static double real_time_factor(const WeirReport *report)
{
    return weir_sim_time(report->sim) / report->wall_time;
}

// What wcsph knows of itself: is the fluid nearly incompressible, and where did particles go.
static void print_clock(const WeirClock *clock)
{
    printf("time step      %.4g s is the next one's\n", clock->time_step);
    printf("Mach number    %.3g (%.4g m/s of %.4g m/s)%s\n", clock->mach_number, clock->max_speed,
           clock->sound_speed,
           clock->mach_number > 0.1 ? ": above 0.1, raise expected_speed or sound_speed" : "");
    printf("density change %.3g %% at most%s\n", 100.0 * clock->max_density_error,
           clock->max_density_error > 0.03 ? ": above 3 %, raise expected_speed or sound_speed" : "");
    printf("fluid          %u particles, %u drained, %u left through open sides\n", clock->fluid_particles,
           clock->drained_particles, clock->lost_particles);
}

static void print_diagnostics(const WeirDiagnostics *found, uint32_t dimension)
{
    if (found->mean_neighbors >= 0.0) printf("neighbours     %.1f on average\n", found->mean_neighbors);
    printf("density error  %.3g %% on average, %.3g %% at most\n", 100.0 * found->density_error_mean,
           100.0 * found->density_error_max);
    printf("energy         %.6g J kinetic, %.6g J potential%s\n", found->kinetic_energy,
           found->potential_energy, dimension == 2 ? " (per metre of depth)" : "");
    printf("momentum       %.6g, %.6g", found->momentum[0], found->momentum[1]);
    if (dimension == 3) printf(", %.6g", found->momentum[2]);
    printf(" kg m/s\n");
    printf("largest speed  %.4g m/s\n", found->max_speed);
    printf("lost particles %u\n", found->lost_particles);
    printf("state hash     %016llx\n", (unsigned long long)found->state_hash);
}

void weir_report_text(const WeirReport *report)
{
    const WeirSim *sim = report->sim;
    const WeirScene *scene = weir_sim_scene(sim);
    char search[32], particles[32], steps[32], wall[32];
    unsigned long long step_count = weir_sim_step_count(sim);
    weir_cli_choice_name(scene, "search", search);
    weir_format_count(weir_sim_particle_count(sim), particles);
    weir_format_count(step_count, steps);
    weir_format_seconds(report->wall_time, wall);
    printf("scene          %s%s%s%s\n", report->scene_path, *weir_scene_title(scene) ? " (" : "",
           weir_scene_title(scene), *weir_scene_title(scene) ? ")" : "");
    WeirClock clock = weir_sim_clock(sim);
    bool has_clock = isfinite(clock.sound_speed);
    printf("method         %s, %uD%s%s\n", weir_scene_method(scene), weir_scene_dimension(scene),
           has_clock ? "" : ", ", has_clock ? "" : search);
    printf("device         %s (%s)\n", weir_sim_device(sim), weir_sim_backend(sim));
    printf("particles      %s\n", particles);
    printf("steps          %s of %.4g s: %.6g s simulated, %s\n", steps,
           has_clock && step_count > 0 ? clock.time / (double)step_count : clock.time_step, clock.time,
           report->outcome);
    if (step_count > 0) {
        printf("wall time      %s: real-time factor %.3g, %.4g ms per step, %.3g M particle-steps/s\n", wall,
               real_time_factor(report), 1e3 * report->wall_time / (double)step_count,
               1e-6 * particle_steps_per_second(report));
    }
    if (has_clock) print_clock(&clock);
    if (report->has_diagnostics) print_diagnostics(&report->diagnostics, weir_scene_dimension(scene));
}

static json_t *passes_json(const WeirSim *sim)
{
    WeirPassTime times[MAX_PASSES];
    uint32_t count = weir_sim_pass_times(sim, times, MAX_PASSES);
    json_t *passes = json_object();
    for (uint32_t k = 0; k < count && k < MAX_PASSES; ++k) {
        json_object_set_new(passes, times[k].name, weir_json_number(times[k].milliseconds));
    }
    return passes;
}

static void add_diagnostics(json_t *object, const WeirDiagnostics *found, uint32_t dimension)
{
    char hash[17];
    json_t *momentum = json_array();
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        json_array_append_new(momentum, weir_json_number(found->momentum[axis]));
    }
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)found->state_hash);
    bool counted = found->mean_neighbors >= 0.0;
    json_object_set_new(object, "mean_neighbors",
                        counted ? weir_json_number(found->mean_neighbors) : json_null());
    json_object_set_new(object, "density_error_mean", weir_json_number(found->density_error_mean));
    json_object_set_new(object, "density_error_max", weir_json_number(found->density_error_max));
    json_object_set_new(object, "kinetic_energy", weir_json_number(found->kinetic_energy));
    json_object_set_new(object, "potential_energy", weir_json_number(found->potential_energy));
    json_object_set_new(object, "momentum", momentum);
    json_object_set_new(object, "max_speed", weir_json_number(found->max_speed));
    json_object_set_new(object, "lost_particles", json_integer(found->lost_particles));
    json_object_set_new(object, "state_hash", json_string(hash));
}

bool weir_report_json(const WeirReport *report)
{
    const WeirSim *sim = report->sim;
    const WeirScene *scene = weir_sim_scene(sim);
    WeirClock clock = weir_sim_clock(sim);
    char search[32];
    weir_cli_choice_name(scene, "search", search);
    json_t *object = json_object();
    json_object_set_new(object, "scene", json_string(report->scene_path));
    json_object_set_new(object, "title", json_string(weir_scene_title(scene)));
    json_object_set_new(object, "outcome", json_string(report->outcome));
    if (*report->error) json_object_set_new(object, "error", json_string(report->error));
    json_object_set_new(object, "method", json_string(weir_scene_method(scene)));
    json_object_set_new(object, "dimension", json_integer(weir_scene_dimension(scene)));
    json_object_set_new(object, "search", json_string(search));
    json_object_set_new(object, "backend", json_string(weir_sim_backend(sim)));
    json_object_set_new(object, "device", json_string(weir_sim_device(sim)));
    json_object_set_new(object, "threads", json_integer(weir_sim_threads(sim)));
    json_object_set_new(object, "particles", json_integer(weir_sim_particle_count(sim)));
    json_object_set_new(object, "steps", json_integer((json_int_t)weir_sim_step_count(sim)));
    json_object_set_new(object, "time", weir_json_number(weir_sim_time(sim)));
    json_object_set_new(object, "time_step", weir_json_float(clock.time_step));
    json_object_set_new(object, "sound_speed", weir_json_number(clock.sound_speed));
    json_object_set_new(object, "mach_number", weir_json_number(clock.mach_number));
    json_object_set_new(object, "max_density_error", weir_json_number(clock.max_density_error));
    json_object_set_new(object, "fluid_particles", json_integer(clock.fluid_particles));
    json_object_set_new(object, "drained_particles", json_integer(clock.drained_particles));
    json_object_set_new(object, "left_particles", json_integer(clock.lost_particles));
    json_object_set_new(object, "stable_time_step", weir_json_number(weir_scene_stable_time_step(scene)));
    json_object_set_new(object, "wall_time", weir_json_number(report->wall_time));
    json_object_set_new(object, "real_time_factor", weir_json_number(real_time_factor(report)));
    json_object_set_new(object, "particle_steps_per_second",
                        weir_json_number(particle_steps_per_second(report)));
    if (report->has_diagnostics) {
        add_diagnostics(object, &report->diagnostics, weir_scene_dimension(scene));
    }
    json_object_set_new(object, "passes", passes_json(sim));
    return weir_json_print(object, stdout);
}
