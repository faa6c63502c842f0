#include "core/scene_keys.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Short names for the table: fields of the owner's struct, limits.
#define AT(Type, field)          .offset = offsetof(Type, field)
#define HAS(Type, field)         .has_offset = offsetof(Type, field) + 1
#define COORDINATES              .low = -WEIR_COORDINATE_LIMIT, .high = WEIR_COORDINATE_LIMIT
#define SPEEDS                   .low = -WEIR_SPEED_LIMIT, .high = WEIR_SPEED_LIMIT
#define LENGTH                   .low = 0.0, .high = WEIR_COORDINATE_LIMIT, .above = true
#define TIME                     .low = 0.0, .high = 1e6
#define SHAPE(Type, key, Object) .offset = offsetof(Type, shape), .object = Object, .shape = key

// The five shapes of a piece.
#define SHAPE_KEYS(Owner, Type)                                                                                \
    {Owner, "box", WEIR_KEY_OBJECT, SHAPE(Type, WEIR_SHAPE_BOX, WEIR_OWNER_BOX),                               \
     .help = "A box along the axes."},                                                                         \
        {Owner, "ball", WEIR_KEY_OBJECT, SHAPE(Type, WEIR_SHAPE_BALL, WEIR_OWNER_BALL),                        \
         .help = "A ball; a disc in 2D."},                                                                     \
        {Owner, "cylinder", WEIR_KEY_OBJECT, SHAPE(Type, WEIR_SHAPE_CYLINDER, WEIR_OWNER_CYLINDER),            \
         .help = "A round cylinder with flat ends; 3D only."},                                                 \
        {Owner,           "polygon",                                                                           \
         WEIR_KEY_POINTS, SHAPE(Type, WEIR_SHAPE_POLYGON, 0),                                                  \
         COORDINATES,     .help = "Corners [x, y] in order, either way round, closed by itself; 2D only. m."}, \
        {Owner, "mesh", WEIR_KEY_OBJECT, SHAPE(Type, WEIR_SHAPE_MESH, WEIR_OWNER_MESH),                        \
         .help = "A closed triangle mesh; 3D only."}

// What walls and bodies share.
#define SOLID_KEYS(Owner)                                                                                    \
    {Owner, "name", WEIR_KEY_NAME, AT(WeirSolidPiece, name), .help = "For probes and reports."},             \
        SHAPE_KEYS(Owner, WeirSolidPiece),                                                                   \
        {Owner, "no_slip", WEIR_KEY_BOOLEAN, AT(WeirSolidPiece, no_slip),                                    \
         .help = "true: the fluid sticks to it; false: it slides. true if not given."},                      \
        {Owner,                                                                                              \
         "motion",                                                                                           \
         WEIR_KEY_OBJECT,                                                                                    \
         AT(WeirSolidPiece, motion),                                                                         \
         HAS(WeirSolidPiece, is_driven),                                                                     \
         .object = WEIR_OWNER_MOTION,                                                                        \
         .help = "Moves it as prescribed: constant velocities, an oscillation or a table."}

const WeirSceneKey weir_scene_keys[] = {
    {WEIR_OWNER_DOMAIN, "min", WEIR_KEY_VECTOR, AT(WeirScene, domain_min), COORDINATES,
     .help = "Lowest corner, m."},
    {WEIR_OWNER_DOMAIN, "max", WEIR_KEY_VECTOR, AT(WeirScene, domain_max), COORDINATES,
     .help = "Highest corner, m."},
    {WEIR_OWNER_DOMAIN, "periodic", WEIR_KEY_AXES, AT(WeirScene, periodic),
     .help = "wcsph: axes along which space repeats: what leaves on one side enters on the other."},
    {WEIR_OWNER_DOMAIN, "open", WEIR_KEY_SIDES, AT(WeirScene, open),
     .help = "wcsph: sides without wall, separated by spaces; what passes them is lost."},
    {WEIR_OWNER_DOMAIN, "free_slip", WEIR_KEY_BOOLEAN, AT(WeirScene, free_slip_sides),
     .help = "wcsph: true lets the fluid slide along the domain's own walls. false if not given."},

    SHAPE_KEYS(WEIR_OWNER_FLUID, WeirFluid),
    {WEIR_OWNER_FLUID, "velocity", WEIR_KEY_VECTOR, AT(WeirFluid, velocity), SPEEDS,
     .help = "Velocity at the start, m/s; at rest if not given."},
    {WEIR_OWNER_FLUID, "flow", WEIR_KEY_CHOICE, AT(WeirFluid, flow),
     .choices = "none|taylor_green|rotating_square|stretch|standing_wave",
     .help = "wcsph: a field of velocity at the start, with its pressure; docs/scene.md."},
    {WEIR_OWNER_FLUID, "flow_rate", WEIR_KEY_NUMBER, AT(WeirFluid, flow_rate), SPEEDS,
     .help = "Strength of the flow: m/s, rad/s, 1/s or m, as the flow needs."},
    {WEIR_OWNER_FLUID, "hydrostatic", WEIR_KEY_BOOLEAN, AT(WeirFluid, hydrostatic),
     .help = "wcsph: true starts it under the pressure of its own weight. true if not given."},

    SOLID_KEYS(WEIR_OWNER_WALL),
    {WEIR_OWNER_WALL, "inside", WEIR_KEY_BOOLEAN, AT(WeirSolidPiece, inside),
     .help = "true: the fluid is inside the shape and the wall around it. false if not given."},
    {WEIR_OWNER_WALL, "surface_velocity", WEIR_KEY_VECTOR, AT(WeirSolidPiece, surface_velocity), SPEEDS,
     .help = "Velocity of the surface of a wall that stays where it is, as of a belt or a lid, m/s."},

    SOLID_KEYS(WEIR_OWNER_BODY),
    {WEIR_OWNER_BODY, "density", WEIR_KEY_NUMBER, AT(WeirSolidPiece, density), .low = 1e-3, .high = 1e5,
     .help = "Density, kg/m^3; needed unless it is driven."},
    {WEIR_OWNER_BODY, "velocity", WEIR_KEY_VECTOR, AT(WeirSolidPiece, velocity), SPEEDS,
     .help = "Velocity of its centre of mass at the start, m/s."},
    {WEIR_OWNER_BODY, "angular_velocity", WEIR_KEY_SPIN, AT(WeirSolidPiece, angular_velocity), SPEEDS,
     .help = "Angular velocity at the start, rad/s: a number in 2D, [x, y, z] in 3D."},
    {WEIR_OWNER_BODY, "fixed", WEIR_KEY_AXES, AT(WeirSolidPiece, fixed),
     .help = "Axes along which it cannot move."},
    {WEIR_OWNER_BODY, "fixed_rotation", WEIR_KEY_AXES, AT(WeirSolidPiece, fixed_rotation),
     .help = "Axes about which it cannot turn; in 2D it turns about z."},

    {WEIR_OWNER_EMITTER, "center", WEIR_KEY_VECTOR, AT(WeirEmitterPiece, center),
     HAS(WeirEmitterPiece, has_center), COORDINATES, .help = "Middle of the nozzle, m."},
    {WEIR_OWNER_EMITTER, "direction", WEIR_KEY_VECTOR, AT(WeirEmitterPiece, direction), COORDINATES,
     .help = "Where it blows; any length."},
    {WEIR_OWNER_EMITTER, "size", WEIR_KEY_NUMBER, AT(WeirEmitterPiece, size), LENGTH,
     .help = "Width of the nozzle; its diameter in 3D, m."},
    {WEIR_OWNER_EMITTER, "speed", WEIR_KEY_NUMBER, AT(WeirEmitterPiece, speed), .low = 0.0,
     .high = WEIR_SPEED_LIMIT, .above = true, .help = "Speed of the fluid, m/s; or flow_rate."},
    {WEIR_OWNER_EMITTER, "flow_rate", WEIR_KEY_NUMBER, AT(WeirEmitterPiece, flow_rate), .low = 0.0,
     .high = 1e9, .above = true, .help = "Volume per second, m^3/s; m^2/s in 2D; or speed."},
    {WEIR_OWNER_EMITTER, "start", WEIR_KEY_NUMBER, AT(WeirEmitterPiece, start), TIME,
     .help = "When it opens, s; at once if not given."},
    {WEIR_OWNER_EMITTER, "stop", WEIR_KEY_NUMBER, AT(WeirEmitterPiece, stop), TIME, .above = true,
     .help = "When it closes, s; never if not given."},
    {WEIR_OWNER_EMITTER, "capacity", WEIR_KEY_WHOLE, AT(WeirEmitterPiece, capacity), .low = 1.0, .high = 1e8,
     .help = "Slots kept free for its particles; chosen from the domain if not given."},

    {WEIR_OWNER_DRAIN, "min", WEIR_KEY_VECTOR, AT(WeirDrainPiece, min), HAS(WeirDrainPiece, has_min),
     COORDINATES, .help = "Lowest corner, m."},
    {WEIR_OWNER_DRAIN, "max", WEIR_KEY_VECTOR, AT(WeirDrainPiece, max), HAS(WeirDrainPiece, has_max),
     COORDINATES, .help = "Highest corner, m."},

    {WEIR_OWNER_PROBE, "name", WEIR_KEY_NAME, AT(WeirProbePiece, name), .help = "For tables and plots."},
    {WEIR_OWNER_PROBE, "kind", WEIR_KEY_CHOICE, AT(WeirProbePiece, kind), HAS(WeirProbePiece, has_kind),
     .choices = "pressure|velocity|height|force|front|mass", .help = "What it measures."},
    {WEIR_OWNER_PROBE, "position", WEIR_KEY_VECTOR, AT(WeirProbePiece, position),
     HAS(WeirProbePiece, has_position), COORDINATES,
     .help = "Where, m: pressure, velocity, height (the line through it along gravity)."},
    {WEIR_OWNER_PROBE, "direction", WEIR_KEY_VECTOR, AT(WeirProbePiece, direction), COORDINATES,
     .help = "front: which way; any length, +x if not given."},
    {WEIR_OWNER_PROBE, "min", WEIR_KEY_VECTOR, AT(WeirProbePiece, min), HAS(WeirProbePiece, has_min),
     COORDINATES, .help = "mass: lowest corner, m."},
    {WEIR_OWNER_PROBE, "max", WEIR_KEY_VECTOR, AT(WeirProbePiece, max), HAS(WeirProbePiece, has_max),
     COORDINATES, .help = "mass: highest corner, m."},
    {WEIR_OWNER_PROBE, "target", WEIR_KEY_NAME, AT(WeirProbePiece, target),
     .help = "force: name of the wall or body; \"domain\" for the domain's own walls."},
    {WEIR_OWNER_PROBE, "rate", WEIR_KEY_NUMBER, AT(WeirProbePiece, rate), .low = 0.0, .high = 1e6,
     .above = true, .help = "Samples per simulated second; 100 if not given."},

    {WEIR_OWNER_MOTION, "velocity", WEIR_KEY_VECTOR, AT(WeirMotion, velocity), SPEEDS,
     .help = "Constant velocity, m/s."},
    {WEIR_OWNER_MOTION, "angular_velocity", WEIR_KEY_SPIN, AT(WeirMotion, angular_velocity), SPEEDS,
     .help = "Constant angular velocity, rad/s: a number in 2D, [x, y, z] in 3D."},
    {WEIR_OWNER_MOTION, "amplitude", WEIR_KEY_VECTOR, AT(WeirMotion, amplitude), COORDINATES,
     .help = "Of an oscillation amplitude sin(2 pi t / period), m."},
    {WEIR_OWNER_MOTION, "angle", WEIR_KEY_SPIN, AT(WeirMotion, angle), .low = -100.0, .high = 100.0,
     .help = "The same for an angle, rad: a number in 2D, angle times axis [x, y, z] in 3D."},
    {WEIR_OWNER_MOTION, "period", WEIR_KEY_NUMBER, AT(WeirMotion, period), .low = 0.0, .high = 1e6,
     .above = true, .help = "Of the oscillation, s."},
    {WEIR_OWNER_MOTION, "pivot", WEIR_KEY_VECTOR, AT(WeirMotion, pivot), HAS(WeirMotion, has_pivot),
     COORDINATES, .help = "Point that it turns about, m; the middle of its shape if not given."},
    {WEIR_OWNER_MOTION, "rows", WEIR_KEY_ROWS, .offset = 0,
     .help = "Table [t, dx, dy, angle], in 3D [t, dx, dy, dz, rx, ry, rz]: s, m from the start, rad; smooth "
             "between rows."},
    {WEIR_OWNER_MOTION, "file", WEIR_KEY_FILE, .offset = 0,
     .help = "CSV file with the columns of rows, relative to the scene file; command line only."},
    {WEIR_OWNER_MOTION, "repeats", WEIR_KEY_BOOLEAN, AT(WeirMotion, repeats),
     .help = "true: the table starts anew after its last row. false if not given."},

    {WEIR_OWNER_BOX, "min", WEIR_KEY_VECTOR, AT(WeirShape, min), HAS(WeirShape, has_min), COORDINATES,
     .help = "Lowest corner, m."},
    {WEIR_OWNER_BOX, "max", WEIR_KEY_VECTOR, AT(WeirShape, max), HAS(WeirShape, has_max), COORDINATES,
     .help = "Highest corner, m."},
    {WEIR_OWNER_BALL, "center", WEIR_KEY_VECTOR, AT(WeirShape, center), HAS(WeirShape, has_center),
     COORDINATES, .help = "Centre, m."},
    {WEIR_OWNER_BALL, "radius", WEIR_KEY_NUMBER, AT(WeirShape, radius), HAS(WeirShape, has_radius), LENGTH,
     .help = "Radius, m."},
    {WEIR_OWNER_CYLINDER, "from", WEIR_KEY_VECTOR, AT(WeirShape, from), HAS(WeirShape, has_from), COORDINATES,
     .help = "One end of the axis, m."},
    {WEIR_OWNER_CYLINDER, "to", WEIR_KEY_VECTOR, AT(WeirShape, to), HAS(WeirShape, has_to), COORDINATES,
     .help = "The other end of the axis, m."},
    {WEIR_OWNER_CYLINDER, "radius", WEIR_KEY_NUMBER, AT(WeirShape, radius), HAS(WeirShape, has_radius),
     LENGTH, .help = "Radius, m."},
    {WEIR_OWNER_MESH, "vertices", WEIR_KEY_VERTICES, AT(WeirShape, mesh), COORDINATES,
     .help = "Corners [x, y, z]."},
    {WEIR_OWNER_MESH, "triangles", WEIR_KEY_TRIANGLES, AT(WeirShape, mesh), .low = 0.0, .high = 4294967294.0,
     .help = "Three indices of corners each, counter-clockwise seen from outside."},
    {WEIR_OWNER_MESH, "file", WEIR_KEY_FILE, .offset = 0,
     .help = "STL or OBJ file, relative to the scene file; command line only."},
    {WEIR_OWNER_MESH, "scale", WEIR_KEY_NUMBER, AT(WeirShape, mesh.scale), .low = 0.0, .high = 1e6,
     .above = true, .help = "The corners are multiplied by it; 1 if not given."},
    {WEIR_OWNER_MESH, "translate", WEIR_KEY_VECTOR, AT(WeirShape, mesh.translate), COORDINATES,
     .help = "Then moved by it, m."},
};
const size_t weir_scene_key_count = sizeof weir_scene_keys / sizeof weir_scene_keys[0];

#define LIST(array, count)                                                                                   \
    .offset = offsetof(WeirScene, array), .count_offset = offsetof(WeirScene, count),                        \
    .size = sizeof((WeirScene *)0)->array[0]

const WeirSceneList weir_scene_lists[WEIR_SCENE_LISTS] = {
    {"fluid", WEIR_OWNER_FLUID, LIST(fluid, fluid_count), .most = WEIR_MAX_FLUIDS, .item = "pieces of fluid",
     .wanted = "box or ball",
     .help = "Pieces of fluid, filled with particles on a lattice of parameters.particle_spacing; they lie "
             "inside the domain and do not overlap."},
    {"walls", WEIR_OWNER_WALL, LIST(wall, wall_count), .most = WEIR_MAX_WALLS, .item = "walls",
     .wanted = "a shape", .help = "wcsph: walls of particles beside the domain's own sides."},
    {"bodies", WEIR_OWNER_BODY, LIST(body, body_count), .most = WEIR_MAX_BODIES, .item = "bodies",
     .wanted = "a shape and density", .help = "wcsph: rigid bodies, moved by the fluid or driven."},
    {"emitters", WEIR_OWNER_EMITTER, LIST(emitter, emitter_count), .most = WEIR_MAX_EMITTERS,
     .item = "emitters", .wanted = "center, direction, size and speed",
     .help = "wcsph: nozzles that fluid comes out of."},
    {"drains", WEIR_OWNER_DRAIN, LIST(drain, drain_count), .most = WEIR_MAX_DRAINS, .item = "drains",
     .wanted = "min and max", .help = "wcsph: boxes in which fluid leaves the simulation."},
    {"probes", WEIR_OWNER_PROBE, LIST(probe, probe_count), .most = WEIR_MAX_PROBES, .item = "probes",
     .wanted = "kind", .help = "Numbers measured while it runs."},
};

int weir_choice_index(const char *choices, const char *text)
{
    size_t length = strlen(text);
    int index = 0;
    for (const char *name = choices; name; ++index) {
        const char *end = strchr(name, '|');
        size_t name_length = end ? (size_t)(end - name) : strlen(name);
        if (name_length == length && strncmp(name, text, length) == 0) return index;
        name = end ? end + 1 : NULL;
    }
    return -1;
}

// ---- Memory that pieces own ----

static WeirShape *shape_of(WeirOwner owner, void *piece)
{
    if (owner == WEIR_OWNER_FLUID) return &((WeirFluid *)piece)->shape;
    if (owner == WEIR_OWNER_WALL || owner == WEIR_OWNER_BODY) return &((WeirSolidPiece *)piece)->shape;
    return NULL;
}

void weir_piece_free(WeirOwner owner, void *piece)
{
    WeirShape *shape = shape_of(owner, piece);
    if (!shape) return;
    free(shape->points);
    free(shape->mesh.vertices);
    free(shape->mesh.triangles);
    if (owner != WEIR_OWNER_FLUID) free(((WeirSolidPiece *)piece)->motion.rows);
}

// Gives *memory a copy of its own; arrays grow by powers of two (scene_path.c), a copy is as long as its content.
static bool copy_array(void *memory, size_t size)
{
    void **array = memory;
    if (!*array) return true;
    void *copy = malloc(size > 0 ? size : 1);
    if (copy) memcpy(copy, *array, size);
    *array = copy;
    return copy != NULL;
}

bool weir_piece_copy_owned(WeirOwner owner, void *piece)
{
    WeirShape *shape = shape_of(owner, piece);
    if (!shape) return true;
    bool copied = copy_array(&shape->points, 2 * shape->point_capacity * sizeof(double));
    copied &= copy_array(&shape->mesh.vertices, 3 * shape->mesh.vertex_capacity * sizeof(double));
    copied &= copy_array(&shape->mesh.triangles, 3 * shape->mesh.triangle_capacity * sizeof(uint32_t));
    if (owner != WEIR_OWNER_FLUID) {
        WeirMotion *motion = &((WeirSolidPiece *)piece)->motion;
        copied &= copy_array(&motion->rows, motion->row_capacity * sizeof(WeirMotionRow));
    }
    return copied;
}
