// The passes and buffers of `wcsph`.
#include "core/grid.h"
#include "gpu/sums.h"
#include "gpu/wcsph.h"

#include <stdio.h>

#define SHADER(name) extern const char weir_wgsl_##name[];
SHADER(common_uniforms)
SHADER(common_index)
SHADER(common_plane)
SHADER(common_space)
SHADER(common_state)
SHADER(common_rotation)
SHADER(common_cells)
SHADER(common_smoothing)
SHADER(common_liquid)
SHADER(common_drift)
SHADER(common_finish)
SHADER(common_clock)
SHADER(common_step_end)
SHADER(common_start)
SHADER(common_bodies)
SHADER(common_emitters)
SHADER(common_lists)
SHADER(common_near)
SHADER(common_seen)
SHADER(common_neighbors)
SHADER(common_contact)
SHADER(common_sorting)
SHADER(common_sums)
SHADER(solve_scan_reduce)
SHADER(solve_scan_write)
SHADER(wcsph_begin)
SHADER(wcsph_begin_read)
SHADER(wcsph_drift)
SHADER(wcsph_vacancies)
SHADER(wcsph_emit)
SHADER(wcsph_count)
SHADER(wcsph_scatter)
SHADER(wcsph_neighbors)
SHADER(wcsph_load)
SHADER(wcsph_store)
SHADER(wcsph_walls)
SHADER(wcsph_forces)
SHADER(wcsph_solid_forces)
SHADER(wcsph_solids)
SHADER(wcsph_time_step)
SHADER(wcsph_finish)
SHADER(wcsph_first_step)
SHADER(wcsph_health)
SHADER(wcsph_diagnose)
SHADER(wcsph_gather)

static const WeirBufferInfo buffers[WEIR_WCSPH_BUFFER_TOTAL] = {
    [WEIR_WCSPH_parameters] = {"parameters", "buffer parameters", true, false, NULL, NULL},
    [WEIR_WCSPH_constants] = {"constants", "buffer constants", true, false, NULL, NULL},
    [WEIR_WCSPH_solid_table] = {"solid_table", "buffer solid_table", true, false, NULL, NULL},
    [WEIR_WCSPH_emitters] = {"emitters", "buffer emitters", true, false, NULL, NULL},
    [WEIR_WCSPH_drains] = {"drains", "buffer drains", true, false, NULL, NULL},
#define WEIR_PARTS(name, element, written)                                                                   \
    [WEIR_WCSPH_##name] = {#name, "buffer " #name, false, false, element, written},
#define WEIR_SIZES(name)  [WEIR_WCSPH_##name] = {#name, "buffer " #name, false, true, NULL, NULL},
#define WEIR_BUFFER(name) WEIR_PARTS(name, NULL, NULL)
    WEIR_WCSPH_BUFFERS
#undef WEIR_BUFFER
#undef WEIR_SIZES
#undef WEIR_PARTS
};

#define BIT(name) (1u << WEIR_WCSPH_##name)
enum { PARTICLES = BIT(coordinate) | BIT(motion) };
enum { SEARCH = BIT(cell_start) | BIT(neighbor_list) };
enum { FORCES_READS = SEARCH | BIT(solid_state) };
enum { FORCES_WRITES = PARTICLES | BIT(kicked) | BIT(step_end) | BIT(control) };
enum { SUM_READS = BIT(kicked) | BIT(solid_particle) | BIT(solid_state) | BIT(blocks) };

// How shaders reach the particles and their lists (parts.h). Eight at once, or place and motion together, take one choice of
// the part.
#define COPY "constants.particle_count"
static const WeirPartFunction functions[] = {
    {"coordinate_at(k: u32) -> vec4i", "return $coordinate[#];", COPY, BIT(coordinate), 0},
    {"coordinate_block(k: u32) -> array<vec4i, 8>",
     "return array($coordinate[#], $coordinate[# + 1u], $coordinate[# + 2u], $coordinate[# + 3u], "
     "$coordinate[# + 4u], $coordinate[# + 5u], $coordinate[# + 6u], $coordinate[# + 7u]);",
     COPY, BIT(coordinate), 0},
    {"motion_at(k: u32) -> vec4f", "return $motion[#];", COPY, BIT(motion), 0},
    {"particle_at(k: u32) -> Particle", "return Particle($coordinate[#], $motion[#]);", COPY, PARTICLES, 0},
    {"kicked_at(k: u32) -> vec4f", "return $kicked[#];", COPY, BIT(kicked), 0},
    {"set_coordinate(k: u32, to: vec4i)", "$coordinate[#] = to; return;", COPY, 0, BIT(coordinate)},
    {"set_motion(k: u32, to: vec4f)", "$motion[#] = to; return;", COPY, 0, BIT(motion)},
    {"set_kicked(k: u32, to: vec4f)", "$kicked[#] = to; return;", COPY, 0, BIT(kicked)},
    {"list_chunk(k: u32) -> vec2u", "return $neighbor_list[#];", "2u * LIST_SHARE", BIT(neighbor_list), 0},
    {"set_list_part(k: u32, to: vec4u)", "$neighbor_list[#] = to; return;", "LIST_SHARE", 0,
     BIT(neighbor_list)},
    {NULL, NULL, NULL, 0, 0},
};
#undef COPY

static const char *const sums_part[] = {weir_wgsl_common_sums, NULL};
static const char *const clock_part[] = {weir_wgsl_common_clock, weir_wgsl_common_emitters, NULL};
static const char *const begin_part[] = {weir_wgsl_common_clock, weir_wgsl_common_emitters,
                                         weir_wgsl_common_bodies, weir_wgsl_common_step_end, NULL};
static const char *const bodies_part[] = {weir_wgsl_common_clock, weir_wgsl_common_emitters,
                                          weir_wgsl_common_bodies, NULL};
static const char *const drift_part[] = {weir_wgsl_common_drift, NULL};
static const char *const finish_part[] = {weir_wgsl_common_drift, weir_wgsl_common_finish, NULL};
static const char *const sorting_part[] = {weir_wgsl_common_sorting, NULL};
static const char *const lists_part[] = {weir_wgsl_common_lists, weir_wgsl_common_near, NULL};
static const char *const walls_part[] = {
    weir_wgsl_common_clock, weir_wgsl_common_emitters,  weir_wgsl_common_step_end,
    weir_wgsl_common_start, weir_wgsl_common_lists,     weir_wgsl_common_near,
    weir_wgsl_common_seen,  weir_wgsl_common_neighbors, NULL};
static const char *const start_part[] = {weir_wgsl_common_clock, weir_wgsl_common_emitters,
                                         weir_wgsl_common_step_end, weir_wgsl_common_start, NULL};
static const char *const forces_part[] = {weir_wgsl_common_clock,
                                          weir_wgsl_common_emitters,
                                          weir_wgsl_common_step_end,
                                          weir_wgsl_common_start,
                                          weir_wgsl_common_lists,
                                          weir_wgsl_common_near,
                                          weir_wgsl_common_neighbors,
                                          weir_wgsl_common_contact,
                                          weir_wgsl_common_drift,
                                          weir_wgsl_common_finish,
                                          weir_seen_parts,
                                          weir_wgsl_common_seen,
                                          weir_wgsl_common_neighbors,
                                          NULL};

#define SOLVE(name)   #name, "pass " #name, weir_wgsl_solve_##name
#define WCSPH(name)   #name, "pass " #name, weir_wgsl_wcsph_##name
#define READING(name) #name, "pass " #name "_read", weir_wgsl_wcsph_##name

static const WeirPassInfo passes[WEIR_WCSPH_PASS_TOTAL] = {
    [WEIR_WCSPH_BEGIN] = {WCSPH(begin), NULL, begin_part, BIT(motion_rows),
                          BIT(control) | BIT(step_end) | BIT(solid_state), WEIR_ITEMS_ONE},
    [WEIR_WCSPH_DRIFT] = {WCSPH(drift), NULL, drift_part,
                          BIT(id) | BIT(step_end) | BIT(solid_state) | BIT(solid_particle),
                          BIT(coordinate) | BIT(motion) | BIT(control), WEIR_ITEMS_PARTICLES},
    [WEIR_WCSPH_VACANCIES] = {WCSPH(vacancies), NULL, clock_part, BIT(coordinate) | BIT(id) | BIT(control),
                              BIT(vacancy), WEIR_ITEMS_SORTING},
    [WEIR_WCSPH_EMIT] = {WCSPH(emit), NULL, clock_part, BIT(nozzle),
                         BIT(vacancy) | BIT(schedule) | BIT(coordinate) | BIT(motion) | BIT(control),
                         WEIR_ITEMS_ONE},
    [WEIR_WCSPH_COUNT] = {WCSPH(count), NULL, sorting_part, BIT(coordinate) | BIT(id) | BIT(control),
                          BIT(cell_count) | BIT(cell_link), WEIR_ITEMS_SORTING},
    [WEIR_WCSPH_SCAN_REDUCE] = {SOLVE(scan_reduce), NULL, sorting_part, BIT(cell_count) | BIT(control),
                                BIT(block_sum), WEIR_ITEMS_CELL_BLOCKS},
    [WEIR_WCSPH_SCAN_WRITE] = {SOLVE(scan_write), NULL, sorting_part, BIT(block_sum) | BIT(control),
                               BIT(cell_count) | BIT(cell_start), WEIR_ITEMS_CELL_BLOCKS},
    [WEIR_WCSPH_SCATTER] = {WCSPH(scatter), NULL, NULL, BIT(id) | BIT(cell_link) | BIT(cell_start),
                            PARTICLES | BIT(sorted_id) | BIT(control), WEIR_ITEMS_SORTING},
    [WEIR_WCSPH_NEIGHBORS] = {WCSPH(neighbors), NULL, lists_part, BIT(coordinate) | BIT(sorted_id),
                              BIT(cell_start) | BIT(neighbor_list) | BIT(solid_particle) | BIT(id) |
                                  BIT(cell_link) | BIT(control),
                              WEIR_ITEMS_SORTING},
    [WEIR_WCSPH_WALLS] = {WCSPH(walls), NULL, walls_part,
                          BIT(coordinate) | SEARCH | BIT(solid_particle) | BIT(solid_state),
                          BIT(motion) | BIT(control) | BIT(step_end), WEIR_ITEMS_SOLID_SHARES},
    [WEIR_WCSPH_FORCES] = {WCSPH(forces), "const FORCES_READ = false;\n", forces_part, FORCES_READS,
                           FORCES_WRITES, WEIR_ITEMS_STEP},
    [WEIR_WCSPH_SOLID_FORCES] = {WCSPH(solid_forces), "const FORCES_READ = false;\n", NULL, SUM_READS,
                                 BIT(solid_sum), WEIR_ITEMS_FREE_BLOCKS},
    [WEIR_WCSPH_SOLIDS] = {WCSPH(solids), NULL, bodies_part, BIT(solid_sum) | BIT(blocks) | BIT(motion_rows),
                           BIT(solid_state) | BIT(control), WEIR_ITEMS_ONE},
    [WEIR_WCSPH_TIME_STEP] = {WCSPH(time_step), NULL, start_part, 0, BIT(control) | BIT(step_end),
                              WEIR_ITEMS_ONE},
    [WEIR_WCSPH_FINISH] = {WCSPH(finish), NULL, finish_part, BIT(solid_particle) | BIT(solid_state),
                           PARTICLES | BIT(control), WEIR_ITEMS_SOLIDS},
    [WEIR_WCSPH_BEGIN_READ] = {WCSPH(begin_read), NULL, clock_part, 0, BIT(control), WEIR_ITEMS_ONE},
    [WEIR_WCSPH_LOAD] = {WCSPH(load), NULL, NULL, BIT(control), PARTICLES, WEIR_ITEMS_PARTICLES},
    [WEIR_WCSPH_STORE] = {WCSPH(store), NULL, NULL, BIT(control), PARTICLES, WEIR_ITEMS_PARTICLES},
    [WEIR_WCSPH_FORCES_READ] = {READING(forces), "const FORCES_READ = true;\n", forces_part, FORCES_READS,
                                FORCES_WRITES, WEIR_ITEMS_SHARES},
    [WEIR_WCSPH_SOLID_FORCES_READ] = {READING(solid_forces), "const FORCES_READ = true;\n", NULL, SUM_READS,
                                      BIT(solid_sum), WEIR_ITEMS_BLOCKS},
    [WEIR_WCSPH_FIRST_STEP] = {WCSPH(first_step), NULL, clock_part, 0, BIT(control), WEIR_ITEMS_ONE},
    [WEIR_WCSPH_HEALTH] = {WCSPH(health), NULL, NULL, BIT(coordinate) | BIT(id), BIT(control),
                           WEIR_ITEMS_ONE},
    [WEIR_WCSPH_DIAGNOSE] = {WCSPH(diagnose), NULL, sums_part, PARTICLES, BIT(fluid_sums), WEIR_ITEMS_SUMS},
    [WEIR_WCSPH_GATHER] = {WCSPH(gather), NULL, NULL, PARTICLES | BIT(id) | BIT(looks),
                           BIT(gathered) | BIT(found), WEIR_ITEMS_SUMS},
};

#define PARTS(dimension)                                                                                     \
    {weir_wgsl_common_uniforms,  weir_wgsl_common_index,    weir_wgsl_common_##dimension,                    \
     weir_wgsl_common_state,     weir_wgsl_common_rotation, weir_wgsl_common_cells,                          \
     weir_wgsl_common_smoothing, weir_wgsl_common_liquid,   NULL}
static const char *const plane_parts[] = PARTS(plane), *const space_parts[] = PARTS(space);

const WeirMethodInfo *weir_gpu_wcsph_method(uint32_t dimension)
{
    static const WeirMethodInfo
        plane = {buffers, passes, WEIR_WCSPH_BUFFER_TOTAL, WEIR_WCSPH_PASS_TOTAL, plane_parts, functions},
        space = {buffers, passes, WEIR_WCSPH_BUFFER_TOTAL, WEIR_WCSPH_PASS_TOTAL, space_parts, functions};
    return dimension == 3 ? &space : &plane;
}

static uint64_t at_least_one(uint64_t count)
{
    return count > 0 ? count : 1;
}

void weir_gpu_wcsph_sizes(const WeirConstants *constants, const WeirWorld *world,
                          const WeirWcsphTraits *traits, WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL])
{
    uint64_t count = constants->particle_count, solid_particles = count - constants->first_solid;
    // The empty slots' cell, and beyond it the count of all.
    uint64_t cells = weir_padded_cells((uint64_t)constants->cell_count + 1);
    uint64_t solids = at_least_one(traits->solid_count);
    sizes[WEIR_WCSPH_parameters].bytes = sizeof(WeirParameters);
    sizes[WEIR_WCSPH_constants].bytes = sizeof(WeirConstants);
    sizes[WEIR_WCSPH_solid_table].bytes = solids * sizeof(WeirSolid);
    sizes[WEIR_WCSPH_emitters].bytes = at_least_one(traits->emitter_count) * sizeof(WeirEmitter);
    sizes[WEIR_WCSPH_drains].bytes =
        at_least_one(traits->drain_group_count + traits->drain_count) * sizeof(WeirDrain);
    // coordinate_block() may load seven beyond the last one. Both of one size: they come apart together.
    sizes[WEIR_WCSPH_coordinate] = sizes[WEIR_WCSPH_motion] = (WeirBufferSize){16 * count, 3, 7 * 16};
    sizes[WEIR_WCSPH_neighbor_list] = weir_gpu_wcsph_list_size(traits);
    sizes[WEIR_WCSPH_id].bytes = 4 * count;
    sizes[WEIR_WCSPH_sorted_id].bytes = 4 * count;
    sizes[WEIR_WCSPH_cell_count].bytes = 4 * cells;
    uint64_t ordered = traits->dimension == 3 && traits->solid_count > 0 ? count : solid_particles;
    sizes[WEIR_WCSPH_cell_start].bytes = 4 * (cells + ordered);  // common/lists.wgsl
    sizes[WEIR_WCSPH_cell_link].bytes = 4 * (cells + 1 + count); // common/cells.wgsl
    sizes[WEIR_WCSPH_block_sum].bytes = 4 * (cells / WEIR_SCAN_BLOCK);
    sizes[WEIR_WCSPH_kicked] = (WeirBufferSize){16 * count, traits->free_solids ? 2 : 1, 0};
    sizes[WEIR_WCSPH_solid_state].bytes = 3 * solids * sizeof(WeirSolidState);
    sizes[WEIR_WCSPH_solid_particle].bytes = 16 * at_least_one(solid_particles);
    sizes[WEIR_WCSPH_blocks].bytes = 16 * at_least_one(traits->block_count);
    sizes[WEIR_WCSPH_solid_sum].bytes = 64 * at_least_one(traits->block_count);
    sizes[WEIR_WCSPH_motion_rows].bytes = at_least_one(world->motion_count) * sizeof(WeirMotionRow);
    // Slots by id, the blocks' counts, what is found for one layer of each emitter.
    uint64_t slots = constants->first_solid, blocks = slots / WEIR_VACANCY_BLOCK + 1;
    sizes[WEIR_WCSPH_vacancy].bytes =
        traits->emitter_count > 0 ? 4 * (slots + blocks + world->point_count) : 16;
    sizes[WEIR_WCSPH_nozzle].bytes = 16 * at_least_one(world->point_count);
    sizes[WEIR_WCSPH_schedule].bytes = 16 * at_least_one(traits->emitter_count);
    sizes[WEIR_WCSPH_fluid_sums].bytes = weir_sums_bytes(constants->particle_count);
    weir_gpu_wcsph_probe_sizes(traits, sizes);
    sizes[WEIR_WCSPH_step_end].bytes = 2 * 16 * WEIR_SORT_SIZES + 4 * count;
    sizes[WEIR_WCSPH_control].bytes = sizeof(WeirWcsphControl);
}

uint32_t weir_gpu_wcsph_settings(const WeirParameters *parameters, const WeirConstants *constants,
                                 const WeirWcsphTraits *traits, char settings[WEIR_SETTINGS_LENGTH])
{
    size_t length = 0;
#define APPEND(...)         length += (size_t)snprintf(settings + length, WEIR_SETTINGS_LENGTH - length, __VA_ARGS__)
#define FLAG(name, value)   APPEND("const " name " = %s;\n", (value) ? "true" : "false")
#define NUMBER(name, value) APPEND("const " name " = %uu;\n", value)
    NUMBER("KERNEL", parameters->kernel);
    FLAG("TAIT", parameters->equation_of_state == WEIR_EQUATION_TAIT);
    FLAG("SHIFTING", parameters->shifting > 0.0f);
    FLAG("LAMINAR", constants->laminar_factor > 0.0f);
    FLAG("FRICTION", constants->friction_factor > 0.0f);
    FLAG("VISCOUS", constants->viscosity_factor > 0.0f);
    FLAG("TENSION_CONTROL", parameters->tension_control == WEIR_TENSION_CONTROL_ON);
    FLAG("FIXED_STEP", parameters->stepping == WEIR_STEPPING_FIXED);
    FLAG("PERIODIC_X", constants->period_x > 0);
    FLAG("PERIODIC_Y", constants->period_y > 0);
    FLAG("PERIODIC_Z", traits->dimension == 3 && constants->period_z > 0);
    FLAG("FOLDED_X", weir_grid_folds_columns(constants));
    FLAG("HAS_SOLIDS", traits->solid_count > 0);
    FLAG("MOVING_SOLIDS", traits->moving_solids);
    FLAG("FREE_SOLIDS", traits->free_solids);
    FLAG("SLIP_SOLIDS", traits->slip_solids);
    FLAG("CAN_EMPTY", traits->can_empty);
    FLAG("ONE_PASS", traits->one_pass);
    FLAG("LISTS", traits->list_parts > 0);
    NUMBER("LIST_PARTS", traits->list_parts);
    FLAG("MARKS_MIXED", traits->marks_mixed);
    NUMBER("LIST_SHARE", traits->list_shares > 1 ? 128 * (traits->list_parts + 1) * traits->list_blocks : 0);
    NUMBER("LANES", traits->lanes);
    NUMBER("ROW_HEIGHT", traits->row_height);
    NUMBER("LAYER_HEIGHT", traits->layer_height);
    NUMBER("LIST_INTERVAL", traits->list_interval);
    NUMBER("LIST_LIFE", traits->list_life);
    NUMBER("SORT_INTERVAL", traits->sort_interval);
    NUMBER("SORT_SIZES", (uint32_t)WEIR_SORT_SIZES);
    NUMBER("SORT_LISTS", (uint32_t)WEIR_SORT_LISTS);
    NUMBER("EMISSION_INTERVAL", traits->emission_interval);
    APPEND("const LEAST_ALLOWANCE = %u.0;\nconst MOST_ALLOWANCE = %u.0;\n", traits->least_allowance,
           traits->most_allowance);
    APPEND("const MOST_STRAY = %u.0;\n", traits->most_stray);
    APPEND("const FASTEST_SURFACE = %.9e;\n", (double)traits->fastest_surface);
    NUMBER("SOLID_COUNT", traits->solid_count > 0 ? traits->solid_count : 1);
    NUMBER("FREE_BLOCKS", traits->free_block_count);
    NUMBER("EMITTER_COUNT", traits->emitter_count);
    NUMBER("EMITTERS", traits->emitter_count > 0 ? traits->emitter_count : 1);
    NUMBER("VACANCY_BLOCK", (uint32_t)WEIR_VACANCY_BLOCK);
    uint32_t drains = traits->drain_group_count + traits->drain_count;
    NUMBER("DRAINS", drains > 0 ? drains : 1);
    NUMBER("DRAIN_GROUPS", traits->drain_group_count);
    NUMBER("DRAIN_GROUP", (uint32_t)WEIR_DRAIN_GROUP);
    NUMBER("MOST_LOOKS", (uint32_t)WEIR_MAX_PROBES);
#undef NUMBER
#undef FLAG
#undef APPEND
#define PASS(name) (1u << WEIR_WCSPH_##name)
    uint32_t needed = PASS(BEGIN) | PASS(DRIFT) | PASS(COUNT) | PASS(SCAN_REDUCE) | PASS(SCAN_WRITE) |
                      PASS(SCATTER) | PASS(NEIGHBORS) | PASS(FORCES) | PASS(BEGIN_READ) | PASS(FORCES_READ) |
                      PASS(LOAD) | PASS(STORE) | PASS(FIRST_STEP) | PASS(HEALTH) | PASS(DIAGNOSE);
    if (traits->probe_count > 0) needed |= PASS(GATHER);
    if (traits->emitter_count > 0) needed |= PASS(VACANCIES) | PASS(EMIT);
    if (traits->solid_count > 0) needed |= PASS(WALLS) | PASS(SOLID_FORCES_READ);
    if (traits->solid_count == 0 && !traits->one_pass) needed |= PASS(TIME_STEP);
    if (traits->free_solids) needed |= PASS(SOLID_FORCES);
    if (traits->moving_solids) needed |= PASS(SOLIDS) | PASS(FINISH);
#undef PASS
    return needed;
}
