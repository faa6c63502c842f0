// A simulation: a scene's particles on a solver, its clock, its health and what may be read of it.
#include "core/sim.h"
#include "core/diagnostics.h"
#include "core/grid.h"
#include "core/neighbor_count.h"
#include "core/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_MAX_STEPS = 64 };
// Steps that weir_sim_run_until() queues between two looks at clock and health.
enum { MOST_QUEUED = 100 };
static const double largest_mach_number = 0.1, largest_density_error = 0.03;
static const double default_max_lag = 0.1; // s: a frame later than this is a stall, not a slow frame

struct WeirSim {
    WeirScene *scene;
    WeirParameters parameters; // as the solver takes them: weir_scene_resolved()
    WeirConstants constants;
    WeirTool tool;
    const WeirBackend *backend;
    WeirSolver *solver;
    WeirStatus status;
    WeirMessage error, warning;
    uint32_t particle_count, fluid_slots, solid_count;
    WeirHealth health;    // as last polled
    uint64_t steps;       // since the last reset
    uint64_t steps_given; // of these, taken before the solver's state was last replaced
    double time;
    double time_given; // the same for the time
    uint32_t max_steps;
    double max_lag;
    double owed; // simulated seconds that the accumulator holds
    bool state_is_current;
    bool motion_is_current;     // of `state` position, velocity and group at least
    bool warned_of_compression; // since the last reset
    WeirState state;
};

static WeirStatus stop(WeirSim *sim, WeirStatus status, const WeirMessage *message)
{
    sim->error = *message;
    return sim->status = status;
}

// A message from the solver that does not stop the run.
static WeirStatus pass_on(WeirSim *sim, WeirStatus status)
{
    if (status == WEIR_OK || status == WEIR_PENDING) return status;
    sim->error = sim->solver->message;
    if (status == WEIR_ERROR_DEVICE) sim->status = status;
    return status;
}

static void make_constants(WeirSim *sim)
{
    const WeirScene *scene = sim->scene;
    sim->parameters = weir_scene_resolved(scene);
    weir_constants_make(&sim->constants, scene, &sim->parameters, sim->particle_count, &sim->tool);
    sim->constants.first_solid = sim->fluid_slots;
    sim->constants.solid_count = sim->solid_count;
}

static WeirStatus start(WeirSim *sim, uint32_t threads)
{
    WeirWorld world;
    WeirStatus status = weir_scene_make_world(sim->scene, &world);
    if (status) return stop(sim, status, &sim->scene->error);
    sim->warning = sim->scene->warning;
    sim->particle_count = world.particles.count;
    sim->fluid_slots = world.particles.fluid_slots;
    sim->solid_count = world.solid_count;
    make_constants(sim);
    WeirSolverSetup setup = {
        .method = sim->scene->method,
        .parameters = sim->parameters,
        .constants = sim->constants,
        .world = &world,
        .threads = threads,
        .probes = sim->scene->probe,
        .probe_count = sim->scene->probe_count,
    };
    WeirMessage message = {""};
    sim->solver = sim->backend->create_solver(sim->backend, &setup, &status, &message);
    weir_world_free(&world);
    return sim->solver ? WEIR_OK : stop(sim, status, &message);
}

WeirSim *weir_sim_create(const WeirScene *scene, const WeirSimOptions *options)
{
    WeirSim *sim = calloc(1, sizeof *sim);
    if (!sim) return NULL;
    WeirSimOptions chosen = options ? *options : (WeirSimOptions){0};
    sim->backend = chosen.backend ? chosen.backend : weir_cpu_backend();
    sim->max_lag = chosen.max_lag > 0.0 ? chosen.max_lag : default_max_lag;
    weir_sim_set_max_steps(sim, chosen.max_steps);
    sim->scene = weir_scene_copy(scene);
    if (!sim->scene) {
        free(sim);
        return NULL;
    }
    start(sim, chosen.threads);
    return sim;
}

void weir_sim_destroy(WeirSim *sim)
{
    if (!sim) return;
    if (sim->solver) sim->solver->interface->destroy(sim->solver);
    weir_scene_destroy(sim->scene);
    free(sim);
}

// ---- What it is ----

WeirStatus weir_sim_status(const WeirSim *sim)
{
    return sim->status;
}

const char *weir_sim_error(const WeirSim *sim)
{
    return sim->error.text;
}

const char *weir_sim_warning(const WeirSim *sim)
{
    return sim->warning.text;
}

const char *weir_sim_backend(const WeirSim *sim)
{
    return sim->backend->name;
}

const char *weir_sim_device(const WeirSim *sim)
{
    return sim->solver ? sim->solver->device : "";
}

uint32_t weir_sim_threads(const WeirSim *sim)
{
    return sim->solver ? sim->solver->threads : 0;
}

uint32_t weir_sim_particle_count(const WeirSim *sim)
{
    return sim->particle_count;
}

uint32_t weir_sim_fluid_slots(const WeirSim *sim)
{
    return sim->fluid_slots;
}

uint32_t weir_sim_dimension(const WeirSim *sim)
{
    return sim->scene->dimension;
}

uint64_t weir_sim_step_count(const WeirSim *sim)
{
    return sim->steps;
}

double weir_sim_time(const WeirSim *sim)
{
    return sim->time;
}

const WeirScene *weir_sim_scene(const WeirSim *sim)
{
    return sim->scene;
}

WeirSolver *weir_sim_solver(WeirSim *sim)
{
    return sim->solver;
}

const WeirParameters *weir_sim_parameters(const WeirSim *sim)
{
    return &sim->parameters;
}

const WeirConstants *weir_sim_constants(const WeirSim *sim)
{
    return &sim->constants;
}

// ---- Time ----

// `until`: seconds since the scene's start, INFINITY for none.
static WeirStatus take_steps(WeirSim *sim, uint32_t steps, double until)
{
    if (sim->status) return sim->status;
    if (steps == 0) return WEIR_OK;
    sim->state_is_current = sim->motion_is_current = false;
    double solver_time = until - sim->time_given;
    WeirStatus status = pass_on(sim, sim->solver->interface->step(sim->solver, steps, solver_time));
    if (status) return status;
    if (sim->scene->method == WEIR_METHOD_MUELLER) {
        sim->steps += steps;
        sim->time += steps * (double)sim->parameters.time_step;
    }
    return weir_sim_poll(sim);
}

WeirStatus weir_sim_step(WeirSim *sim, uint32_t steps)
{
    return take_steps(sim, steps, INFINITY);
}

static double current_time_step(const WeirSim *sim)
{
    bool adaptive = sim->health.has_clock && sim->health.time_step > 0.0f;
    return adaptive ? sim->health.time_step : (double)sim->parameters.time_step;
}

// How far before `time` counts as there. Fixed steps end at the one nearest to it.
static double slack_before(const WeirSim *sim, double time)
{
    bool clock = sim->scene->method == WEIR_METHOD_WCSPH;
    return clock ? 1e-9 * fmax(time, 1e-3) : 0.5 * (double)sim->parameters.time_step;
}

WeirStatus weir_sim_step_until(WeirSim *sim, uint32_t steps, double time)
{
    if (sim->status) return sim->status;
    double left = time - sim->time - slack_before(sim, time);
    if (!(left > 0.0)) return WEIR_OK;
    double due = fmax(ceil(left / current_time_step(sim)), 1.0);
    bool clock = sim->scene->method == WEIR_METHOD_WCSPH;
    return take_steps(sim, due < steps ? (uint32_t)due : steps, clock ? time : INFINITY);
}

WeirStatus weir_sim_run_until(WeirSim *sim, double time)
{
    while (!sim->status && sim->time < time - slack_before(sim, time)) {
        // In a browser the steps of the call before may be under way, which could reach `time`.
        WeirStatus status = weir_sim_wait(sim);
        if (status == WEIR_OK) status = weir_sim_step_until(sim, MOST_QUEUED, time);
        if (status == WEIR_OK) status = weir_sim_wait(sim);
        if (status) return status;
    }
    return sim->status;
}

WeirClock weir_sim_clock(const WeirSim *sim)
{
    WeirClock clock = {.step = sim->steps, .time = sim->time, .time_step = current_time_step(sim)};
    clock.sound_speed = clock.max_speed = clock.mach_number = clock.max_density_error = NAN;
    clock.fluid_particles = sim->fluid_slots;
    if (!sim->health.has_clock) return clock;
    clock.sound_speed = sim->constants.sound_speed;
    clock.max_speed = sim->health.max_speed;
    clock.mach_number = clock.max_speed / clock.sound_speed;
    clock.max_density_error = sim->health.max_density_error;
    clock.fluid_particles = sim->health.fluid_particles;
    clock.drained_particles = sim->health.drained_particles;
    clock.lost_particles = sim->health.lost_particles;
    return clock;
}

void weir_sim_set_max_steps(WeirSim *sim, uint32_t max_steps)
{
    sim->max_steps = max_steps > 0 ? max_steps : DEFAULT_MAX_STEPS;
}

WeirStatus weir_sim_advance(WeirSim *sim, double wall_seconds, uint32_t *steps_taken)
{
    uint32_t none;
    if (!steps_taken) steps_taken = &none;
    *steps_taken = 0;
    if (sim->status) return sim->status;
    if (!(wall_seconds >= 0.0)) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT, "wall_seconds: %g; must be 0 or more", wall_seconds);
    }
    double scale = sim->parameters.time_scale, dt = current_time_step(sim);
    // Only new time is cut: what is left of the last call is less than a step, and slow motion or a long step
    // must be able to save up for one.
    sim->owed += fmin(wall_seconds, sim->max_lag) * scale;
    double due = floor(sim->owed / dt);
    uint32_t steps = due < sim->max_steps ? (uint32_t)due : sim->max_steps;
    // What was not taken is dropped: a simulation that is too slow must slow down, not fall ever
    // further behind.
    sim->owed = due > sim->max_steps ? 0.0 : sim->owed - steps * dt;
    uint64_t before = sim->steps;
    WeirStatus status = weir_sim_step(sim, steps);
    // Those queued: a device's own count comes later. Where a step failed, those before it.
    *steps_taken = status == WEIR_OK ? steps : (uint32_t)(sim->steps - before);
    return status;
}

// Weakly compressible means a Mach number below 0.1 and densities within 1 %; well above that the flow is another one.
static void warn_of_compression(WeirSim *sim)
{
    double mach = sim->health.max_speed / sim->constants.sound_speed, error = sim->health.max_density_error;
    if (sim->warned_of_compression || !(mach > largest_mach_number || error > largest_density_error)) return;
    sim->warned_of_compression = true;
    weir_fail(
        &sim->warning, WEIR_OK,
        "step %llu: the fluid is too fast or too compressed for its speed of sound: Mach number %.3g (0.1 is "
        "the most "
        "for nearly incompressible flow), density error %.2g %% (3 %%). Raise expected_speed above %.3g m/s",
        (unsigned long long)sim->steps, mach, 100.0 * error,
        fmax(sim->health.max_speed, 0.1 * sim->constants.sound_speed));
}

static WeirStatus blown_up(WeirSim *sim)
{
    const WeirHealth *health = &sim->health;
    const float *place = health->first_bad_position;
    return sim->status =
               weir_fail(&sim->error, WEIR_ERROR_UNSTABLE,
                         "step %llu: the fluid blew up: particle %u near (%g, %g, %g) is faster than "
                         "four times the speed of sound, %.3g m/s, or not finite. %s",
                         (unsigned long long)(sim->steps_given + health->first_bad_step),
                         health->first_bad_id, place[0], place[1], place[2], sim->constants.speed_limit,
                         sim->parameters.stepping ? "Use stepping adaptive, or a smaller time_step"
                                                  : "Lower courant, or raise expected_speed or sound_speed");
}

WeirStatus weir_sim_poll(WeirSim *sim)
{
    if (sim->status) return sim->status;
    WeirHealth health = {0};
    WeirStatus status = sim->solver->interface->poll(sim->solver, &health);
    if (status == WEIR_PENDING) return WEIR_PENDING;
    if (status) return stop(sim, status, &sim->solver->message);
    sim->health = health;
    if (health.has_clock) {
        sim->steps = sim->steps_given + health.steps;
        sim->time = sim->time_given + health.time;
        if (health.bad_particles == 0) warn_of_compression(sim);
    }
    if (health.bad_particles == 0) return WEIR_OK;
    if (health.has_clock) return blown_up(sim);
    const WeirParameters *parameters = &sim->parameters;
    double stable = weir_scene_stable_time_step(sim->scene);
    return sim->status = weir_fail(
               &sim->error, WEIR_ERROR_UNSTABLE,
               "step %llu: the fluid blew up: particles faster than %.3g m/s or not finite. "
               "time_step is %g s; %s %.2g s",
               (unsigned long long)(sim->steps_given + health.first_bad_step), sim->constants.speed_limit,
               parameters->time_step, parameters->time_step > stable ? "use at most" : "try half of it,",
               parameters->time_step > stable ? stable : 0.5 * parameters->time_step);
}

WeirStatus weir_sim_wait(WeirSim *sim)
{
    if (sim->status) return sim->status;
    WeirStatus status = pass_on(sim, sim->solver->interface->wait(sim->solver));
    return status ? status : weir_sim_poll(sim);
}

// ---- State and parameters ----

static WeirStatus replace_state(WeirSim *sim, const WeirParticles *particles)
{
    sim->state_is_current = sim->motion_is_current = false;
    WeirStatus status = pass_on(sim, sim->solver->interface->set_state(sim->solver, particles));
    if (status) return status;
    sim->steps_given = sim->steps;
    sim->time_given = sim->time;
    sim->health = (WeirHealth){0};
    if (sim->status == WEIR_ERROR_UNSTABLE) sim->status = WEIR_OK;
    return WEIR_OK;
}

WeirStatus weir_sim_reset(WeirSim *sim)
{
    if (!sim->solver || sim->status == WEIR_ERROR_DEVICE) return sim->status;
    WeirWorld world;
    WeirStatus status = weir_scene_make_world(sim->scene, &world);
    if (status) {
        sim->error = sim->scene->error;
        return status;
    }
    sim->steps = 0;
    sim->time = sim->owed = 0.0;
    sim->warned_of_compression = false;
    sim->warning = sim->scene->warning;
    status = replace_state(sim, &world.particles);
    weir_world_free(&world);
    return status;
}

static WeirStatus check_state(WeirSim *sim, const float *positions, const float *velocities)
{
    const WeirConstants *constants = &sim->constants;
    uint32_t dimension = sim->scene->dimension;
    float slack = weir_domain_slack(&sim->parameters, constants);
    for (size_t k = 0; k < dimension * (size_t)sim->fluid_slots; ++k) {
        size_t axis = k % dimension;
        float low = constants->domain_min[axis] - slack, high = constants->domain_max[axis] + slack;
        if (!(positions[k] >= low && positions[k] <= high)) {
            return weir_fail(&sim->error, WEIR_ERROR_INPUT,
                             "positions: particle %zu has %c = %g; the domain allows %g to %g", k / dimension,
                             "xyz"[axis], (double)positions[k], (double)low, (double)high);
        }
        if (!isfinite(velocities[k])) {
            return weir_fail(&sim->error, WEIR_ERROR_INPUT,
                             "velocities: particle %zu has v%c = %g; must be finite", k / dimension,
                             "xyz"[axis], (double)velocities[k]);
        }
    }
    return WEIR_OK;
}

WeirStatus weir_sim_set_state(WeirSim *sim, const float *positions, const float *velocities)
{
    if (!sim->solver || sim->status == WEIR_ERROR_DEVICE) return sim->status;
    WeirStatus status = check_state(sim, positions, velocities);
    if (status) return status;
    WeirWorld world;
    status = weir_scene_make_world(sim->scene, &world);
    if (status) return stop(sim, status, &sim->scene->error);
    size_t floats = sim->scene->dimension * (size_t)sim->fluid_slots;
    for (size_t k = 0; k < floats; ++k) world.particles.position[k] = positions[k];
    memcpy(world.particles.velocity, velocities, floats * sizeof *velocities);
    status = replace_state(sim, &world.particles);
    weir_world_free(&world);
    return status;
}

// In a browser a solver that waits for its pipelines takes no changes.
static bool is_starting(WeirSim *sim)
{
    return weir_sim_poll(sim) == WEIR_PENDING;
}

static WeirStatus configure(WeirSim *sim)
{
    return pass_on(sim, sim->solver->interface->configure(sim->solver, &sim->parameters, &sim->constants));
}

WeirStatus weir_sim_set_parameter(WeirSim *sim, const char *name, const double *values, size_t count)
{
    if (!sim->solver) return sim->status;
    int index = weir_parameter_find(name);
    if (index < 0) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT,
                         "%.60s: no such parameter; see `weir params` or docs/parameters.md", name);
    }
    if (!weir_parameter_info((uint32_t)index)->live) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT,
                         "%s: cannot change while a simulation runs; change the scene and start it again",
                         name);
    }
    WeirParameters changed = sim->scene->parameters;
    WeirStatus status = weir_parameter_set(&changed, (uint32_t)index, name, values, count, &sim->error);
    if (status) return status;
    if (is_starting(sim)) return WEIR_PENDING;
    sim->state_is_current = sim->motion_is_current = false;
    sim->scene->parameters = changed;
    make_constants(sim);
    weir_scene_advise(sim->scene);
    sim->warning = sim->scene->warning;
    return configure(sim);
}

bool weir_sim_is_changing(const WeirSim *sim)
{
    return sim->solver && sim->solver->changing;
}

static WeirStatus check_tool(WeirSim *sim, const WeirTool *tool)
{
    if ((uint32_t)tool->kind > WEIR_TOOL_STIR) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT, "tool.kind: %d; must be a WeirToolKind",
                         (int)tool->kind);
    }
    bool finite = isfinite(tool->strength);
    for (int axis = 0; axis < 3; ++axis)
        finite = finite && isfinite(tool->position[axis]) && isfinite(tool->velocity[axis]);
    if (!finite) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT,
                         "tool: position, velocity and strength must be finite");
    }
    if (tool->kind != WEIR_TOOL_NONE && !(tool->radius > 0.0f && isfinite(tool->radius))) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT, "tool.radius: %g m; must be above 0 and finite",
                         tool->radius);
    }
    return WEIR_OK;
}

WeirStatus weir_sim_set_tool(WeirSim *sim, const WeirTool *tool)
{
    if (!sim->solver) return sim->status;
    WeirStatus status = tool ? check_tool(sim, tool) : WEIR_OK;
    if (status) return status;
    if (is_starting(sim)) return WEIR_PENDING;
    sim->tool = tool ? *tool : (WeirTool){0};
    weir_constants_set_tool(&sim->constants, &sim->tool);
    return configure(sim);
}

// `motion`: position, velocity and group alone are wanted.
static WeirStatus read_state(WeirSim *sim, bool motion, WeirState *state)
{
    if (!sim->solver) return sim->status;
    const WeirSolverInterface *interface = sim->solver->interface;
    motion = motion && interface->read_motion;
    if (!sim->state_is_current && !(motion && sim->motion_is_current)) {
        WeirStatus status = motion ? interface->read_motion(sim->solver, &sim->state) : WEIR_OK;
        if (status == WEIR_ERROR_UNSTABLE) motion = false;
        if (!motion) status = interface->read(sim->solver, &sim->state);
        if (status) return pass_on(sim, status);
        sim->state.step += sim->steps_given;
        sim->motion_is_current = sim->state.step == sim->steps;
        sim->state_is_current = !motion && sim->motion_is_current;
    }
    *state = sim->state;
    return WEIR_OK;
}

WeirStatus weir_sim_state(WeirSim *sim, WeirState *state)
{
    return read_state(sim, false, state);
}

uint32_t weir_field_components(WeirField field, uint32_t dimension)
{
    return (uint32_t)field <= WEIR_FIELD_ACCELERATION ? dimension : 1;
}

WeirStatus weir_sim_read(WeirSim *sim, WeirField field, float *values, size_t capacity)
{
    size_t floats = (size_t)sim->particle_count * weir_field_components(field, sim->scene->dimension);
    if ((uint32_t)field > WEIR_FIELD_GROUP) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT, "field: %d; must be a WeirField", (int)field);
    }
    if (capacity < floats) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT, "capacity: %zu floats; %zu are needed", capacity,
                         floats);
    }
    bool motion = field == WEIR_FIELD_POSITION || field == WEIR_FIELD_VELOCITY || field == WEIR_FIELD_GROUP;
    WeirState state = {0};
    WeirStatus status = read_state(sim, motion, &state);
    if (status) return status;
    if (field == WEIR_FIELD_GROUP) {
        for (uint32_t i = 0; i < state.count; ++i) {
            uint32_t group = state.group ? state.group[i] : WEIR_GROUP_FLUID;
            bool empty = group == WEIR_GROUP_EMPTY;
            values[i] = empty ? -1.0f : weir_group_is_solid(group) ? (float)group : 0.0f;
        }
        return WEIR_OK;
    }
    const float *const fields[] = {
        [WEIR_FIELD_POSITION] = state.position,         [WEIR_FIELD_VELOCITY] = state.velocity,
        [WEIR_FIELD_ACCELERATION] = state.acceleration, [WEIR_FIELD_DENSITY] = state.density,
        [WEIR_FIELD_PRESSURE] = state.pressure,
    };
    memcpy(values, fields[field], floats * sizeof *values);
    return WEIR_OK;
}

WeirStatus weir_sim_read_motion(WeirSim *sim, float *positions, float *velocities, size_t capacity)
{
    size_t floats = (size_t)sim->particle_count * sim->scene->dimension;
    if (capacity < floats) {
        return weir_fail(&sim->error, WEIR_ERROR_INPUT, "capacity: %zu floats; %zu are needed", capacity,
                         floats);
    }
    WeirState state = {0};
    WeirStatus status = read_state(sim, true, &state);
    if (status) return status;
    memcpy(positions, state.position, floats * sizeof *positions);
    memcpy(velocities, state.velocity, floats * sizeof *velocities);
    return WEIR_OK;
}

// `time` as a solver gives it.
static double time_of(const WeirSim *sim, uint64_t step, double time)
{
    if (time >= 0.0) return sim->time_given + time;
    return sim->time - (double)(sim->steps - step) * sim->parameters.time_step;
}

double weir_sim_time_of(const WeirSim *sim, const WeirState *state)
{
    return time_of(sim, state->step, state->time);
}

WeirStatus weir_sim_gather(WeirSim *sim, WeirGathered *gathered)
{
    if (sim->solver && sim->solver->interface->gather && sim->scene->probe_count > 0) {
        WeirStatus status = sim->solver->interface->gather(sim->solver, gathered);
        gathered->state.step += sim->steps_given;
        if (status != WEIR_ERROR_UNSTABLE) return pass_on(sim, status);
    }
    gathered->found = NULL;
    return weir_sim_state(sim, &gathered->state);
}

static WeirStatus diagnose_there(WeirSim *sim, WeirDiagnostics *diagnostics)
{
    WeirDiagnosticSums sums;
    WeirStatus status = sim->solver->interface->diagnose(sim->solver, &sums);
    if (status == WEIR_ERROR_UNSTABLE) return status;
    if (status) return pass_on(sim, status);
    weir_diagnose_sums(&sums, &sim->parameters, &sim->constants, diagnostics);
    diagnostics->step = sim->steps_given + sums.step;
    diagnostics->time = time_of(sim, diagnostics->step, sums.time);
    return WEIR_OK;
}

WeirStatus weir_sim_diagnose(WeirSim *sim, uint32_t flags, WeirDiagnostics *diagnostics)
{
    if (flags == 0 && sim->solver && sim->solver->interface->diagnose) {
        WeirStatus status = diagnose_there(sim, diagnostics);
        if (status != WEIR_ERROR_UNSTABLE) return status;
    }
    WeirState state;
    WeirStatus status = weir_sim_state(sim, &state);
    if (status) return status;
    status = weir_diagnose(&state, &sim->parameters, &sim->constants, flags, diagnostics);
    if (status) return weir_fail(&sim->error, status, "no memory to count neighbours");
    diagnostics->step = state.step;
    diagnostics->time = weir_sim_time_of(sim, &state);
    return WEIR_OK;
}

uint32_t weir_sim_pass_times(const WeirSim *sim, WeirPassTime *times, uint32_t capacity)
{
    return sim->solver ? sim->solver->interface->pass_times(sim->solver, times, capacity) : 0;
}

double weir_sim_step_time(const WeirSim *sim)
{
    enum { MOST = 64 };
    if (!sim->solver) return 0.0;
    if (sim->solver->interface->step_time) return sim->solver->interface->step_time(sim->solver);
    WeirPassTime times[MOST];
    uint32_t count = weir_sim_pass_times(sim, times, MOST);
    double sum = 0.0;
    for (uint32_t n = 0; n < count && n < MOST; ++n) sum += times[n].milliseconds;
    return sum;
}

WeirStatus weir_sim_count_neighbors(WeirSim *sim, uint32_t particles, WeirNeighborCount *found)
{
    static const uint32_t enough = 1024;
    WeirState state;
    WeirStatus status = weir_sim_state(sim, &state);
    if (status) return status;
    const WeirConstants *constants = &sim->constants;
    if (constants->period_x || constants->period_y || constants->period_z) {
        WeirDiagnostics all;
        status = weir_sim_diagnose(sim, WEIR_DIAGNOSE_NEIGHBORS, &all);
        *found = (WeirNeighborCount){weir_sim_clock(sim).fluid_particles, all.mean_neighbors, NAN};
        return status;
    }
    status = weir_count_neighbors(&state, &sim->parameters, constants, particles ? particles : enough, found);
    if (status) return weir_fail(&sim->error, status, "no memory to count neighbours");
    if (sim->scene->method == WEIR_METHOD_MUELLER && sim->parameters.search == WEIR_SEARCH_ALL_PAIRS)
        found->candidates = state.count - 1.0;
    return WEIR_OK;
}

uint64_t weir_sim_device_memory(const WeirSim *sim)
{
    return sim->solver ? sim->solver->memory : 0;
}
