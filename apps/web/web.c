// Adapters for scenes and simulations. JavaScript owns the memory that it hands over; it comes from
// weir_web_allocate().
#include "web.h"
#include "core/scene.h"
#include "weir/weir.h"

#include <stdlib.h>

WEIR_WEB(weir_web_allocate)
void *weir_web_allocate(size_t size)
{
    return malloc(size);
}

WEIR_WEB(weir_web_free)
void weir_web_free(void *memory)
{
    free(memory);
}

WEIR_WEB(weir_web_version)
const char *weir_web_version(void)
{
    return WEIR_VERSION;
}

// Parameter `index` of the list as JSON, made by the compiler; NULL after the last one.
WEIR_WEB(weir_web_parameter)
const char *weir_web_parameter(uint32_t index)
{
#define WEB_COMMON(name, unit, method, help)                                                                 \
    "{\"name\":\"" #name "\",\"unit\":\"" unit "\",\"help\":\"" help "\",\"method\":\"" method "\","
#define WEIR_VECTOR(name, unit, x, y, z, minimum, maximum, method, live, help)                               \
    WEB_COMMON(name, unit, method, help)                                                                     \
    "\"kind\":\"vector\",\"choices\":\"\",\"default\":[" #x "," #y "," #z "],\"minimum\":" #minimum          \
    ",\"maximum\":" #maximum ",\"live\":" #live "}",
#define WEIR_NUMBER(name, unit, value, minimum, maximum, method, live, help)                                 \
    WEB_COMMON(name, unit, method, help)                                                                     \
    "\"kind\":\"number\",\"choices\":\"\",\"default\":[" #value "],\"minimum\":" #minimum                    \
    ",\"maximum\":" #maximum ",\"live\":" #live "}",
#define WEIR_CHOICE(name, names, value, method, live, help)                                                  \
    WEB_COMMON(name, "1", method, help)                                                                      \
    "\"kind\":\"choice\",\"choices\":\"" names "\",\"default\":[" #value "],\"minimum\":0,\"maximum\":0,"    \
    "\"live\":" #live "}",
    static const char *const list[] = {
#include "core/params.inl"
    };
    return index < sizeof list / sizeof *list ? list[index] : NULL;
}

WEIR_WEB(weir_web_scene_domain)
void weir_web_scene_domain(const WeirScene *scene, double bounds[6])
{
    weir_scene_domain(scene, bounds, bounds + 3);
}

// Particles of fluid alone, without walls and bodies; 0 if the scene is not valid.
WEIR_WEB(weir_web_scene_fluid_count)
uint32_t weir_web_scene_fluid_count(WeirScene *scene)
{
    WeirWorld world = {0};
    if (weir_scene_make_world(scene, &world) != WEIR_OK) return 0;
    uint32_t count = 0;
    for (uint32_t id = 0; id < world.particles.count; id++)
        count += !world.particles.group || world.particles.group[id] == WEIR_GROUP_FLUID;
    weir_world_free(&world);
    return count;
}

WEIR_WEB(weir_web_sim_create)
WeirSim *weir_web_sim_create(const WeirScene *scene, const WeirBackend *backend, uint32_t max_steps,
                             double max_lag)
{
    return weir_sim_create(scene,
                           &(WeirSimOptions){.backend = backend, .max_steps = max_steps, .max_lag = max_lag});
}

WEIR_WEB(weir_web_sim_step_count)
double weir_web_sim_step_count(const WeirSim *sim)
{
    return (double)weir_sim_step_count(sim);
}

// Steps taken, or -status.
WEIR_WEB(weir_web_sim_advance)
int32_t weir_web_sim_advance(WeirSim *sim, double wall_seconds)
{
    uint32_t steps = 0;
    WeirStatus status = weir_sim_advance(sim, wall_seconds, &steps);
    return status == WEIR_OK ? (int32_t)steps : -(int32_t)status;
}

WEIR_WEB(weir_web_sim_set_tool)
WeirStatus weir_web_sim_set_tool(WeirSim *sim, uint32_t kind, float x, float y, float z, float vx, float vy,
                                 float vz, float radius, float strength)
{
    return weir_sim_set_tool(sim, &(WeirTool){.kind = kind,
                                              .position = {x, y, z},
                                              .velocity = {vx, vy, vz},
                                              .radius = radius,
                                              .strength = strength});
}

// Fills 10 numbers in the order of WeirClock.
WEIR_WEB(weir_web_sim_clock)
void weir_web_sim_clock(const WeirSim *sim, double values[10])
{
    WeirClock clock = weir_sim_clock(sim);
    values[0] = (double)clock.step;
    values[1] = clock.time;
    values[2] = clock.time_step;
    values[3] = clock.sound_speed;
    values[4] = clock.max_speed;
    values[5] = clock.mach_number;
    values[6] = clock.max_density_error;
    values[7] = clock.fluid_particles;
    values[8] = clock.drained_particles;
    values[9] = clock.lost_particles;
}

// `flags` of WeirDiagnose. Fills 14 numbers in the order of WeirDiagnostics; the hash comes as its high and low half.
WEIR_WEB(weir_web_sim_diagnose)
WeirStatus weir_web_sim_diagnose(WeirSim *sim, uint32_t flags, double values[14])
{
    WeirDiagnostics found;
    WeirStatus status = weir_sim_diagnose(sim, flags, &found);
    if (status != WEIR_OK) return status;
    const double numbers[14] = {
        (double)found.step,
        found.time,
        found.density_error_mean,
        found.density_error_max,
        found.kinetic_energy,
        found.potential_energy,
        found.momentum[0],
        found.momentum[1],
        found.momentum[2],
        found.max_speed,
        found.mean_neighbors,
        found.lost_particles,
        (double)(found.state_hash >> 32),
        (double)(found.state_hash & 0xFFFFFFFFu),
    };
    for (int k = 0; k < 14; k++) values[k] = numbers[k];
    return status;
}

// Fills pairs of name (its address) and milliseconds; returns the number of passes.
WEIR_WEB(weir_web_sim_pass_times)
uint32_t weir_web_sim_pass_times(const WeirSim *sim, double *pairs, uint32_t capacity)
{
    enum { MOST = 32 };
    WeirPassTime times[MOST];
    uint32_t count = weir_sim_pass_times(sim, times, capacity < MOST ? capacity : MOST);
    if (count > capacity) count = capacity;
    if (count > MOST) count = MOST;
    for (uint32_t k = 0; k < count; k++) {
        pairs[2 * k] = (double)(uintptr_t)times[k].name;
        pairs[2 * k + 1] = times[k].milliseconds;
    }
    return count;
}
