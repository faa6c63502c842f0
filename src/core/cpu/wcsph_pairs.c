// Walls and forces of `wcsph` on the CPU: docs/wcsph.md has the formulas, shaders/wcsph/ the mirrors.
//
// One vector holds neighbouring particles i, every candidate j is broadcast to it (runs.h). A candidate outside the
// support adds exactly 0, so the sums have the same bits for any number of lanes.
//
// Distances are summed in quanta; what scales a whole sum is applied once, at its end. F^ is the kernel's slope
// without its factor: (dW/dr) / r = gradient_factor F^.
#include "core/cpu/wcsph_pairs.h"
#include "core/cpu/pairs.h"
#include "core/cpu/runs.h"

#include <math.h>

// Name of the variant that this compilation makes; the build compiles this file once per instruction set.
#ifndef WEIR_WCSPH_PASSES
#define WEIR_WCSPH_PASSES weir_wcsph_passes_base
#endif
extern const WeirWcsphPasses WEIR_WCSPH_PASSES;

#define INLINE static inline __attribute__((always_inline))

// Known at compile time in each copy of a pass.
typedef struct Variant {
    bool three_dimensional;
    uint32_t kernel;
} Variant;

typedef struct Vector {
    WeirLanes x, y, z;
} Vector;

INLINE Vector load(const float *const array[3], uint32_t i, Variant variant)
{
    Vector v = {weir_lanes_load(array[0] + i), weir_lanes_load(array[1] + i), {0}};
    if (variant.three_dimensional) v.z = weir_lanes_load(array[2] + i);
    return v;
}

INLINE WeirLanes load_numbers(const int32_t *numbers)
{
    return __builtin_convertvector(weir_mask_load(numbers), WeirLanes);
}

// Stores the lanes whose mask is set; in 2D the third component is 0.
INLINE void store_where(float *const array[3], uint32_t begin, Vector v, WeirMask mask)
{
    weir_lanes_store_where(array[0] + begin, v.x, mask);
    weir_lanes_store_where(array[1] + begin, v.y, mask);
    weir_lanes_store_where(array[2] + begin, v.z, mask);
}

INLINE WeirLanes dot(Vector a, Vector b, Variant variant)
{
    WeirLanes sum = a.x * b.x + a.y * b.y;
    return variant.three_dimensional ? sum + a.z * b.z : sum;
}

INLINE Vector scaled(WeirLanes scale, Vector v, Variant variant)
{
    Vector product = {scale * v.x, scale * v.y, {0}};
    if (variant.three_dimensional) product.z = scale * v.z;
    return product;
}

INLINE void add(Vector *sum, Vector v, Variant variant)
{
    sum->x += v.x;
    sum->y += v.y;
    if (variant.three_dimensional) sum->z += v.z;
}

INLINE void add_scaled(Vector *sum, WeirLanes scale, Vector v, Variant variant)
{
    sum->x += scale * v.x;
    sum->y += scale * v.y;
    if (variant.three_dimensional) sum->z += scale * v.z;
}

// x_i - x_j in quanta, exact inside the support.
INLINE Vector offset_to(const WeirWcsphData *data, const WeirMask place[3], uint32_t j, Variant variant)
{
    Vector offset = {__builtin_convertvector(place[0] - data->x[0][j], WeirLanes),
                     __builtin_convertvector(place[1] - data->x[1][j], WeirLanes),
                     {0}};
    if (variant.three_dimensional) offset.z = __builtin_convertvector(place[2] - data->x[2][j], WeirLanes);
    return offset;
}

// a less the vector of j.
INLINE Vector less(Vector a, const float *const array[3], uint32_t j, Variant variant)
{
    Vector v = {a.x - array[0][j], a.y - array[1][j], {0}};
    if (variant.three_dimensional) v.z = a.z - array[2][j];
    return v;
}

INLINE WeirLanes lanes_power4(WeirLanes a)
{
    WeirLanes square = a * a;
    return square * square;
}

// max(a - s, 0)
INLINE WeirLanes rest_to(float a, WeirLanes s)
{
    WeirLanes zero = {0};
    return weir_lanes_max(weir_lanes_fill(a) - s, zero);
}

// W / (shape_unit kernel_factor) at s = r / R: a quarter of Wendland's kernel takes one product less.
static const float shape_unit = 4.0f;

INLINE WeirLanes kernel_shape(WeirLanes s, Variant variant)
{
    if (variant.kernel == WEIR_KERNEL_CUBIC) {
        WeirLanes q = s * 2.0f, far = rest_to(2.0f, q), near = rest_to(1.0f, q);
        return (far * far * far * 0.25f - near * near * near) / shape_unit;
    }
    if (variant.kernel == WEIR_KERNEL_QUINTIC) {
        WeirLanes q = s * 3.0f, a = rest_to(3.0f, q), b = rest_to(2.0f, q), c = rest_to(1.0f, q);
        return (lanes_power4(a) * a - lanes_power4(b) * b * 6.0f + lanes_power4(c) * c * 15.0f) / shape_unit;
    }
    return lanes_power4(rest_to(1.0f, s)) * (s + 1.0f / shape_unit);
}

// F^ at s.
INLINE WeirLanes kernel_slope(WeirLanes s, Variant variant)
{
    if (variant.kernel == WEIR_KERNEL_CUBIC) {
        WeirLanes q = s * 2.0f, far = rest_to(2.0f, q), near = rest_to(1.0f, q);
        return (far * far * 0.75f - near * near * 3.0f) / weir_lanes_max(q, weir_lanes_fill(1e-6f));
    }
    if (variant.kernel == WEIR_KERNEL_QUINTIC) {
        WeirLanes q = s * 3.0f, a = rest_to(3.0f, q), b = rest_to(2.0f, q), c = rest_to(1.0f, q);
        WeirLanes sum = lanes_power4(a) - lanes_power4(b) * 6.0f + lanes_power4(c) * 15.0f;
        return sum * 5.0f / weir_lanes_max(q, weir_lanes_fill(1e-6f));
    }
    WeirLanes rest = rest_to(1.0f, s);
    return rest * rest * rest;
}

// F^ / rho_j at s; `weight`: (1 - s) / rho_j.
INLINE WeirLanes weighted_slope(WeirLanes s, WeirLanes weight, WeirLanes inverse_density, Variant variant)
{
    if (variant.kernel != WEIR_KERNEL_WENDLAND) return kernel_slope(s, variant) * inverse_density;
    WeirLanes rest = rest_to(1.0f, s);
    return rest * rest * weight;
}

INLINE void load_place(const WeirWcsphData *data, uint32_t begin, const WeirRun *run, WeirMask place[3])
{
    for (int axis = 0; axis < 3; ++axis)
        place[axis] = weir_mask_load(data->x[axis] + begin) - run->shift[axis];
}

// Is any of the particles of a kind that a pass works on?
static bool any_set(const float *flag, uint32_t begin, uint32_t count)
{
    for (uint32_t i = begin; i < begin + count; ++i) {
        if (flag[i] != 0.0f) return true;
    }
    return false;
}

static bool any_solid(const float *is_fluid, uint32_t begin, uint32_t count)
{
    for (uint32_t i = begin; i < begin + count; ++i) {
        if (is_fluid[i] == 0.0f) return true;
    }
    return false;
}

// The lanes of a group whose flag is set.
INLINE WeirMask chosen(const float *flag, uint32_t begin, uint32_t lanes)
{
    return (WeirMask)(weir_lanes_load(flag + begin) != (WeirLanes){0}) & weir_mask_first(lanes);
}

enum { MOST_SEEN = 64 };

// Notes which of the next MOST_SEEN candidates, or up to `end`, are within the support of any lane (others would add 0 to all), and how
// far they are. Without a branch: where half of them are, as in 3D, no processor guesses which in disordered fluid. Returns how many.
INLINE uint32_t note_seen(const WeirWcsphData *data, WeirLanes support2, const WeirMask place[3],
                          uint32_t begin, uint32_t end, bool fluid_alone, Variant variant,
                          uint32_t seen[MOST_SEEN], WeirLanes r2[MOST_SEEN])
{
    uint32_t count = 0;
    if (end - begin > MOST_SEEN) end = begin + MOST_SEEN;
    if (fluid_alone && !any_set(data->is_fluid, begin, end - begin))
        return 0; // most of what a wall has around it
    for (uint32_t j = begin; j < end; ++j) {
        Vector x = offset_to(data, place, j, variant);
        seen[count] = j;
        r2[count] = dot(x, x, variant);
        count += weir_lanes_any_below(r2[count], support2) & (!fluid_alone | (data->is_fluid[j] != 0.0f));
    }
    return count;
}

// ---- walls: what solid particles see of the fluid (Adami, Hu, Adams 2012) ----

typedef struct WallSums {
    WeirLanes weight, pressure; // sum of W, of W p
    Vector mean, moment;        // sum of W v, of W rho x
} WallSums;

// What candidate j, fluid, adds.
INLINE void add_seen(const WeirWcsphData *data, const WeirMask place[3], uint32_t j, WeirLanes r2,
                     Variant variant, WallSums *sums)
{
    WeirLanes w = kernel_shape(weir_lanes_sqrt(r2) * data->constants->inverse_support, variant);
    sums->weight += w;
    sums->pressure += w * data->pressure[j];
    sums->mean.x += w * data->velocity[0][j];
    sums->mean.y += w * data->velocity[1][j];
    if (variant.three_dimensional) sums->mean.z += w * data->velocity[2][j];
    add_scaled(&sums->moment, w * (data->excess[j] + data->parameters->rest_density),
               offset_to(data, place, j, variant), variant);
}

INLINE void walls_group(const WeirWcsphData *data, const WeirLaneGroup *group, uint32_t begin,
                        Variant variant)
{
    const WeirConstants *constants = data->constants;
    WeirLanes support2 = weir_lanes_fill(1.0f / (constants->inverse_support * constants->inverse_support));
    WallSums sums = {0};
    for (uint32_t n = 0; n < group->run_count; ++n) {
        WeirMask place[3];
        load_place(data, begin, &group->run[n], place);
        for (uint32_t first = group->run[n].begin; first < group->run[n].end; first += MOST_SEEN) {
            uint32_t seen[MOST_SEEN];
            WeirLanes r2[MOST_SEEN];
            uint32_t count =
                note_seen(data, support2, place, first, group->run[n].end, true, variant, seen, r2);
            for (uint32_t k = 0; k < count; ++k) add_seen(data, place, seen[k], r2[k], variant, &sums);
        }
    }
    for (uint32_t lane = 0; lane < group->lanes; ++lane) {
        uint32_t i = begin + lane;
        if (data->is_fluid[i] != 0.0f) continue;
        float total = shape_unit * sums.weight[lane], inverse = total > 1e-12f ? shape_unit / total : 0.0f;
        float scale = inverse * data->constants->quantum;
        data->weight[i] = inverse > 0.0f ? total : 0.0f;
        data->pressure[i] = sums.pressure[lane] * inverse;
        data->seen_velocity[0][i] = sums.mean.x[lane] * inverse;
        data->seen_velocity[1][i] = sums.mean.y[lane] * inverse;
        data->seen_velocity[2][i] = sums.mean.z[lane] * inverse;
        data->extrapolated[0][i] = sums.moment.x[lane] * scale;
        data->extrapolated[1][i] = sums.moment.y[lane] * scale;
        data->extrapolated[2][i] = sums.moment.z[lane] * scale;
    }
}

// ---- forces ----

// A last barrier keeps fast fluid out of walls. Nearer than 0.85 spacings, where fluid at rest hardly comes, solid
// particles repel it; nearer than two they brake what approaches faster than a tenth of the speed of sound, more
// than the method is valid for: so that nothing leaks at the speed of sound, and slower flow feels nothing. In one step neither
// takes more than half of the overlap and of the approach: a particle between a body and a wall is thrown back by both.
// Spray, with less than half of its support filled (a flat surface has more), forgets tension within h / c0: stretched for
// good, it would pull at whatever it meets. Ragged fluid forgets pressure that neither weight nor motion explain: oscillations
// of a few particles would gain energy by the Laplacian of full fluid.
static const float spray_limit = 0.5f, ragged_limit = 0.75f, ragged_time = 10.0f; // times: h / c0
// Where the support is full the density follows the particles' real volume, so slowly that sound does not notice: within
// volume_time h / c0.
static const float full_support = 0.98f, volume_time = 1000.0f;
// More than a tenth too many particles make themselves felt at once. Time: h / c0.
static const float crowded_limit = 1.1f, crowded_time = 10.0f;
static const float barrier_range = 0.85f, barrier_strength = 4.0f;
static const float brake_range = 2.0f, brake_strength = 2.4f, brake_limit = 0.1f, barrier_share = 0.5f;
static const float start_pace = 1000.0f; // before the first step: no bound

// Without it fourth powers of kernels are denormal near the edge of the support, on which processors are slow.
static const float clustering_unit = 1048576.0f;

// The sums of `forces`, without their factors.
typedef struct ForceSums {
    Vector pressure;      // sum p_j / rho_j F^ x
    Vector gradient;      // sum 1 / rho_j F^ x
    Vector clustering;    // sum 1 / rho_j (clustering_unit kernel_shape)^4 F^ x
    Vector viscous;       // sum 1 / rho_j F^ (v . x) / r^2 x, between fluid
    Vector laminar;       // sum 1 / rho_j F^ v, between fluid
    Vector friction;      // the same between fluid and no-slip solids
    Vector barrier;       // sum of barrier and brake along x / r, between fluid and solid
    WeirLanes surface;    // sum 1 / rho_j F^ r^2
    WeirLanes filling;    // sum 1 / rho_j kernel_shape
    WeirLanes divergence; // sum 1 / rho_j F^ v . x where the particles are at the end of the step
    WeirLanes laplacian;  // sum 1 / rho_j (1 - s) (p_j - p_i), between fluid
    Vector moment;        // sum 1 / rho_j (1 - s) x, between fluid
} ForceSums;

// Of a lane and a candidate.
typedef struct Distance {
    WeirLanes r2;         // r^2 and a quantum, so that it can be divided by; quanta
    WeirLanes inverse_r2; // 1 / r2
    WeirLanes s;          // r / R
} Distance;

// What the terms of a lane and candidate j share.
typedef struct Pair {
    Distance distance;
    Vector x, v;                       // x_i - x_j, quanta; v_i - v_j, m/s
    WeirLanes inverse_density, weight; // 1 / rho_j; (1 - s) / rho_j
    WeirLanes approach;                // v . x
} Pair;

// What is the same for all candidates of a group.
typedef struct ForceLanes {
    float inverse_support;
    float barrier_pace;                          // one spacing per step, over the speed of sound
    bool viscous, laminar, friction, clustering; // terms that are not switched off
    WeirLanes support2, stick, barrier, barrier_reach, pressure, inverse_density;
    Vector seen_velocity, velocity;
} ForceLanes;

static float barrier_pace(const WeirWcsphData *data)
{
    float dt = 2.0f * data->second_half * data->constants->quantum;
    float sound_way = data->constants->sound_speed * dt;
    return sound_way > 0.0f ? data->parameters->particle_spacing / sound_way : start_pace;
}

INLINE ForceLanes force_lanes(const WeirWcsphData *data, uint32_t begin, Variant variant)
{
    const WeirConstants *constants = data->constants;
    float spacing = data->parameters->particle_spacing * constants->inverse_quantum;
    return (ForceLanes){
        .inverse_support = constants->inverse_support,
        .viscous = constants->viscosity_factor != 0.0f,
        .laminar = constants->laminar_factor != 0.0f,
        .friction = constants->friction_factor != 0.0f,
        .clustering = data->parameters->shifting != 0.0f,
        .barrier_pace = barrier_pace(data),
        .barrier_reach =
            weir_lanes_fill(1.00001f * spacing * (barrier_range > brake_range ? barrier_range : brake_range)),
        .support2 = weir_lanes_fill(1.0f / (constants->inverse_support * constants->inverse_support)),
        .stick = weir_lanes_load(data->stick + begin),
        .barrier = weir_lanes_load(data->barrier + begin),
        .pressure = weir_lanes_load(data->pressure + begin),
        .inverse_density = weir_lanes_load(data->inverse_density + begin),
        .seen_velocity = load((const float *const *)data->seen_velocity, begin, variant),
        .velocity = load(data->velocity, begin, variant),
    };
}

// Between fluid and solid; nothing beyond `barrier_reach`.
INLINE void add_barrier(const WeirWcsphData *data, const ForceLanes *own, uint32_t j, Vector x,
                        WeirLanes distance, Variant variant, Vector *sum)
{
    const WeirConstants *constants = data->constants;
    const WeirLanes zero = {0};
    if (!weir_lanes_any_below(distance, own->barrier_reach)) return;
    float spacing = data->parameters->particle_spacing * constants->inverse_quantum;
    float range = barrier_range * spacing, inverse_brake = 1.0f / (brake_range * spacing);
    Vector v = less(own->velocity, data->velocity, j, variant); // the solid's own, not the mirrored one
    WeirLanes r = weir_lanes_max(distance, weir_lanes_fill(range / 3.0f));
    WeirLanes push = weir_lanes_max(range / r - 1.0f, zero) * barrier_strength;
    WeirLanes near = rest_to(1.0f, r * inverse_brake) * (brake_strength / data->parameters->courant);
    WeirLanes approach = dot(v, x, variant) / r * (-1.0f / constants->sound_speed);
    float share = barrier_share * own->barrier_pace;
    WeirLanes overlap = weir_lanes_max(range - r, zero) * (own->barrier_pace / spacing);
    push = weir_lanes_min(push, share * (overlap + weir_lanes_max(approach, zero)));
    near = weir_lanes_min(near, weir_lanes_fill(share));
    push = (push + near * weir_lanes_max(approach - brake_limit, zero)) * (own->barrier * data->barrier[j]);
    add_scaled(sum, push / r, x, variant);
}

// F^ where the step ends; of Wendland's kernel, q^3 with q = 1 - s, to first order, which saves a root. `growth`: of r^2, over
// second_half.
INLINE WeirLanes slope_at_end(const WeirWcsphData *data, const ForceLanes *own, const Pair *pair,
                              WeirLanes growth, Variant variant)
{
    const WeirLanes zero = {0};
    if (variant.kernel == WEIR_KERNEL_CUBIC || variant.kernel == WEIR_KERNEL_QUINTIC) {
        WeirLanes end2 = weir_lanes_max(pair->distance.r2 + data->second_half * growth, zero);
        WeirLanes slope = kernel_slope(weir_lanes_sqrt(end2) * own->inverse_support, variant);
        return weir_lanes_select((WeirMask)(pair->distance.r2 < own->support2), slope, zero);
    }
    WeirLanes q = rest_to(1.0f, pair->distance.s);
    WeirLanes end = q - 1.5f * data->second_half * (pair->distance.s * pair->distance.inverse_r2) * growth;
    return q * q * weir_lanes_min(weir_lanes_max(end, zero), weir_lanes_fill(1.0f));
}

// What candidate j does to the density, over those within the support in the middle of the step: the rate belongs to the
// places at the step's end, between two densities.
INLINE void add_rates(const WeirWcsphData *data, const ForceLanes *own, uint32_t j, const Pair *pair,
                      Variant variant, ForceSums *sums)
{
    bool fluid = data->is_fluid[j] != 0.0f;
    Vector v = pair->v;
    WeirLanes approach = pair->approach;
    if (!fluid) {
        v = less(own->velocity, (const float *const *)data->new_velocity, j, variant);
        approach = dot(v, pair->x, variant);
    }
    WeirLanes end_approach = approach + data->second_half * dot(v, v, variant);
    WeirLanes slope = slope_at_end(data, own, pair, approach + end_approach, variant);
    sums->divergence += slope * pair->inverse_density * end_approach;
    if (!fluid) return;
    sums->laplacian += pair->weight * (data->pressure[j] - own->pressure);
    add_scaled(&sums->moment, pair->weight, pair->x, variant);
}

// A solid that stays where it is, as one fluid particle sees it at `offset` = fluid - solid: that particle's pressure and the weight
// of the fluid between them. It never pulls. docs/wcsph.md, "Walls".
typedef struct SeenWall {
    WeirLanes pressure, inverse_density;
} SeenWall;

INLINE SeenWall seen_wall(const WeirWcsphData *data, WeirLanes fluid_pressure, Vector offset, Variant variant)
{
    const WeirLanes zero = {0};
    const float *gravity = data->parameters->gravity, sound = data->constants->sound_speed;
    float rest_density = data->parameters->rest_density, weight = rest_density * data->constants->quantum;
    WeirLanes fall = (weight * gravity[0]) * offset.x + (weight * gravity[1]) * offset.y;
    if (variant.three_dimensional) fall += (weight * gravity[2]) * offset.z;
    WeirLanes pressure = weir_lanes_max(fluid_pressure - fall, zero);
    WeirLanes excess = (pressure - data->parameters->background_pressure) * (1.0f / (sound * sound));
    return (SeenWall){pressure, 1.0f / (excess + rest_density)};
}

// Adds candidate j. `solids`: the lanes are solid particles, on which only the fluid acts. In a group of both the sums of solid
// lanes are nobody's.
INLINE void add_forces(const WeirWcsphData *data, const ForceLanes *own, const WeirMask place[3], uint32_t j,
                       Distance distance, Variant variant, bool solids, ForceSums *sums)
{
    Vector x = offset_to(data, place, j, variant);
    WeirLanes s = distance.s;
    WeirLanes pressure = weir_lanes_fill(data->pressure[j]),
              inverse_density = weir_lanes_fill(data->inverse_density[j]);
    if (data->walls_by_pair && solids) {
        // Here and in pressure_acceleration() what stands for the own values is this pair's.
        Vector back = {-x.x, -x.y, -x.z};
        SeenWall wall = seen_wall(data, pressure, back, variant);
        pressure += wall.pressure;
        inverse_density *= wall.inverse_density / own->inverse_density;
    } else if (data->walls_by_pair && data->is_fluid[j] == 0.0f) {
        SeenWall wall = seen_wall(data, own->pressure, x, variant);
        pressure = wall.pressure;
        inverse_density = wall.inverse_density;
    }
    WeirLanes weight = rest_to(1.0f, s) * inverse_density;
    WeirLanes slope = weighted_slope(s, weight, inverse_density, variant);
    Vector v = less(own->seen_velocity, (const float *const *)data->seen_velocity, j, variant);
    Vector slant = scaled(slope, x, variant);
    WeirLanes approach = dot(v, x, variant);
    add_scaled(&sums->pressure, pressure, slant, variant);
    add(&sums->gradient, slant, variant);
    if (data->is_fluid[j] != 0.0f && !solids) {
        if (own->viscous) add_scaled(&sums->viscous, approach * distance.inverse_r2, slant, variant);
        if (own->laminar) add_scaled(&sums->laminar, slope, v, variant);
    } else {
        if (own->friction) add_scaled(&sums->friction, slope * (own->stick * data->stick[j]), v, variant);
        add_barrier(data, own, j, x, weir_lanes_sqrt(distance.r2), variant, &sums->barrier);
    }
    WeirLanes shape = kernel_shape(s, variant);
    sums->filling += shape * inverse_density;
    if (solids) return;
    sums->surface += slope * distance.r2;
    if (own->clustering) add_scaled(&sums->clustering, lanes_power4(shape * clustering_unit), slant, variant);
    Pair pair = {distance, x, v, inverse_density, weight, approach};
    add_rates(data, own, j, &pair, variant, sums);
}

// Who is seen first, then the roots and quotients of all of them, then their terms: a processor that waits for a candidate's root
// looks no farther ahead than two candidates.
INLINE void add_run(const WeirWcsphData *data, const ForceLanes *own, const WeirMask place[3],
                    const WeirRun *run, Variant variant, bool solids, ForceSums *sums)
{
    for (uint32_t begin = run->begin; begin < run->end; begin += MOST_SEEN) {
        uint32_t seen[MOST_SEEN];
        WeirLanes r2[MOST_SEEN];
        Distance distance[MOST_SEEN];
        uint32_t count = note_seen(data, own->support2, place, begin, run->end, solids, variant, seen, r2);
        for (uint32_t n = 0; n < count; ++n) {
            WeirLanes square = r2[n] + 1.0f;
            distance[n] = (Distance){square, 1.0f / square, weir_lanes_sqrt(square) * own->inverse_support};
        }
        for (uint32_t n = 0; n < count; ++n)
            add_forces(data, own, place, seen[n], distance[n], variant, solids, sums);
    }
}

INLINE ForceSums sum_forces(const WeirWcsphData *data, const WeirLaneGroup *group, uint32_t begin,
                            Variant variant, bool solids)
{
    ForceLanes own = force_lanes(data, begin, variant);
    ForceSums sums = {0};
    for (const WeirRun *run = group->run; run < group->run + group->run_count; ++run) {
        WeirMask place[3];
        load_place(data, begin, run, place);
        add_run(data, &own, place, run, variant, solids, &sums);
    }
    return sums;
}

// By pressure. `inside`: lanes of fluid whose support is full, where tension control makes a negative pressure act by its
// difference.
INLINE Vector pressure_acceleration(const WeirWcsphData *data, const ForceSums *sums, uint32_t begin,
                                    WeirMask inside, Variant variant, bool solids)
{
    const WeirConstants *constants = data->constants;
    const WeirLanes zero = {0};
    WeirLanes own = data->walls_by_pair && solids ? zero : weir_lanes_load(data->pressure + begin);
    if (data->parameters->tension_control == WEIR_TENSION_CONTROL_ON)
        own = weir_lanes_select(inside & (WeirMask)(own < zero), -own, own);
    WeirLanes scale = -(constants->particle_mass * weir_lanes_load(data->inverse_density + begin) *
                        constants->gradient_factor) *
                      constants->quantum;
    Vector a = {{0}, {0}, {0}};
    WeirLanes *sum = &a.x;
    const WeirLanes *p = &sums->pressure.x, *g = &sums->gradient.x;
    for (int axis = 0; axis < (variant.three_dimensional ? 3 : 2); ++axis)
        sum[axis] = scale * (p[axis] + own * g[axis]);
    return a;
}

// By viscosity and the barrier. For lanes `inside` laminar viscosity has Morris' form.
INLINE void add_viscous_forces(const WeirWcsphData *data, const ForceSums *sums, uint32_t begin,
                               WeirMask inside, Variant variant, Vector *acceleration)
{
    const WeirConstants *constants = data->constants;
    const WeirLanes zero = {0};
    WeirLanes common = constants->particle_mass * weir_lanes_load(data->inverse_density + begin) *
                       constants->gradient_factor;
    WeirLanes friction = common * constants->friction_factor;
    WeirLanes laminar = weir_lanes_select(inside, common * constants->laminar_factor, zero);
    WeirLanes viscous = common * weir_lanes_select(inside, weir_lanes_fill(constants->artificial_factor),
                                                   weir_lanes_fill(constants->viscosity_factor));
    float sound = constants->sound_speed;
    float barrier = sound * sound / data->parameters->particle_spacing;
    WeirLanes *sum = &acceleration->x;
    const WeirLanes *v = &sums->viscous.x, *l = &sums->laminar.x, *f = &sums->friction.x,
                    *b = &sums->barrier.x;
    for (int axis = 0; axis < (variant.three_dimensional ? 3 : 2); ++axis)
        sum[axis] += viscous * v[axis] + laminar * l[axis] + friction * f[axis] + barrier * b[axis];
}

// Acceleration that the pointer tool adds to a particle: falls off linearly to zero at the tool's radius.
static void add_tool(const WeirWcsphData *data, uint32_t i)
{
    const WeirConstants *constants = data->constants;
    float offset[3], distance2 = 0.0f;
    for (int axis = 0; axis < (int)constants->dimension; ++axis) {
        float place = constants->origin[axis] + (float)data->x[axis][i] * constants->quantum;
        offset[axis] = place - constants->tool_position[axis];
        distance2 += offset[axis] * offset[axis];
    }
    float distance = sqrtf(distance2);
    if (!(distance < constants->tool_radius)) return;
    float strength = constants->tool_strength * (1.0f - distance / constants->tool_radius);
    for (int axis = 0; axis < (int)constants->dimension; ++axis) {
        if (constants->tool_kind == WEIR_TOOL_STIR) {
            data->acceleration[axis][i] +=
                strength * (constants->tool_velocity[axis] - data->velocity[axis][i]);
        } else if (distance > 0.0f) {
            float outward = strength * offset[axis] / distance;
            data->acceleration[axis][i] += constants->tool_kind == WEIR_TOOL_PULL ? -outward : outward;
        }
    }
}

INLINE void add_body_forces(const WeirWcsphData *data, uint32_t begin, Vector *acceleration, Variant variant)
{
    const WeirConstants *constants = data->constants;
    WeirLanes *a = &acceleration->x;
    for (int axis = 0; axis < (variant.three_dimensional ? 3 : 2); ++axis) {
        WeirLanes place = constants->origin[axis] + load_numbers(data->x[axis] + begin) * constants->quantum;
        a[axis] += data->parameters->gravity[axis];
        a[axis] -= data->parameters->central_force * (place - constants->center[axis]);
    }
}

// Particle shifting (Sun et al. 2017) where the surface number says that the support is full (Lee et al. 2008).
INLINE Vector shift_of(const WeirWcsphData *data, const ForceSums *sums, WeirMask inside, WeirLanes *rate,
                       Variant variant)
{
    const WeirConstants *constants = data->constants;
    const WeirLanes most = weir_lanes_fill(0.25f * data->flow_speed), zero = {0};
    float gradient = constants->particle_mass * constants->gradient_factor * constants->quantum;
    float factor = -data->parameters->shifting * 4.0f * constants->smoothing_length * data->flow_speed *
                   constants->particle_mass * constants->gradient_factor * constants->quantum;
    const float unit = shape_unit / clustering_unit,
                clustering = unit * unit * unit * unit * constants->clustering_factor;
    const WeirLanes *g = &sums->gradient.x, *c = &sums->clustering.x;
    Vector shift = {{0}, {0}, {0}};
    WeirLanes *u = &shift.x;
    for (int axis = 0; axis < 3; ++axis)
        u[axis] = weir_lanes_select(inside, factor * (g[axis] + clustering * c[axis]), zero);
    WeirLanes length = weir_lanes_sqrt(dot(shift, shift, variant));
    WeirLanes scale = weir_lanes_select((WeirMask)(length > most), most / length, weir_lanes_fill(1.0f));
    for (int axis = 0; axis < 3; ++axis) u[axis] *= scale;
    *rate = 2.0f * gradient * dot(shift, sums->gradient, variant); // of V sum W along the shift
    return shift;
}

// What shifting and the volume that particles fill do to the density, and the return of spray to its rest density.
INLINE WeirLanes shift_rate_of(const WeirWcsphData *data, const ForceSums *sums, uint32_t begin,
                               WeirLanes surface, WeirLanes rate)
{
    const WeirConstants *constants = data->constants;
    const WeirLanes zero = {0};
    float acoustic = constants->acoustic_rate, bulk = (float)constants->dimension;
    WeirLanes filling = constants->particle_mass * (shape_unit * constants->kernel_factor) * sums->filling;
    WeirLanes volume = (filling - constants->lattice_filling) * (acoustic / volume_time);
    WeirLanes full = filling * (full_support * bulk / constants->lattice_filling);
    rate = weir_lanes_select((WeirMask)(surface >= full), rate + volume, rate);
    WeirLanes crowd = filling - crowded_limit * constants->lattice_filling;
    rate += weir_lanes_max(crowd, zero) * (acoustic / crowded_time);
    WeirLanes lack = -weir_lanes_load(data->excess + begin);
    WeirLanes pace = weir_lanes_load(data->inverse_density + begin) * acoustic;
    WeirLanes due = weir_lanes_fill(data->due_excess);
    WeirLanes undue = weir_lanes_max(lack - due, zero) - weir_lanes_max(-lack - due, zero);
    WeirMask ragged = (WeirMask)(surface < ragged_limit * bulk);
    rate = weir_lanes_select(ragged, rate + undue * pace * (1.0f / ragged_time), rate);
    WeirMask spray = (WeirMask)(surface < spray_limit * bulk) & (WeirMask)(lack > zero);
    return weir_lanes_select(spray, lack * pace, rate);
}

// drho/dt for the velocities after the kick, without a second sweep: what the pressure's acceleration `push` is about to add to
// the divergence is the Laplacian of the pressure. The same operator diffuses the density. docs/wcsph.md, "Continuity".
INLINE WeirLanes rate_of(const WeirWcsphData *data, const ForceSums *sums, uint32_t begin, Vector push,
                         WeirLanes shift_rate, Variant variant)
{
    const WeirConstants *constants = data->constants;
    const WeirParameters *parameters = data->parameters;
    const float *gravity = parameters->gravity;
    float compress = constants->particle_mass * constants->gradient_factor * constants->quantum;
    WeirLanes rho = weir_lanes_load(data->excess + begin) + parameters->rest_density, gain = rho * data->dt;
    float diffusion = parameters->density_diffusion * constants->smoothing_length / constants->sound_speed;
    diffusion = fminf(diffusion, constants->diffusion_limit / data->dt - data->dt);
    float weight = diffusion * parameters->rest_density;
    // p_j - p_i less what the gradient of the pressure makes of their distance, which one side alone would keep
    WeirLanes slant = sums->moment.x * (weight * gravity[0] - gain * push.x) +
                      sums->moment.y * (weight * gravity[1] - gain * push.y);
    if (variant.three_dimensional) slant += sums->moment.z * (weight * gravity[2] - gain * push.z);
    WeirLanes spread = (data->dt + diffusion) * sums->laplacian + constants->quantum * slant;
    float pull = data->dt * parameters->central_force * (float)constants->dimension;
    return rho * (compress * sums->divergence + shift_rate + pull) + constants->laplacian_factor * spread;
}

INLINE void fluid_group(const WeirWcsphData *data, const WeirLaneGroup *group, uint32_t begin,
                        Variant variant)
{
    const WeirConstants *constants = data->constants;
    float full =
        -constants->particle_mass * constants->gradient_factor * constants->quantum * constants->quantum;
    ForceSums sums = sum_forces(data, group, begin, variant, false);
    WeirLanes surface = full * sums.surface, rate;
    WeirMask inside = (WeirMask)(surface >= 0.95f * (float)constants->dimension);
    WeirMask fluid = chosen(data->is_fluid, begin, group->lanes);
    Vector push = pressure_acceleration(data, &sums, begin, inside, variant, false), acceleration = push;
    add_viscous_forces(data, &sums, begin, inside, variant, &acceleration);
    add_body_forces(data, begin, &acceleration, variant);
    Vector shift = shift_of(data, &sums, inside, &rate, variant);
    rate = shift_rate_of(data, &sums, begin, surface, rate);
    rate = rate_of(data, &sums, begin, push, rate, variant);
    store_where(data->acceleration, begin, acceleration, fluid);
    store_where(data->shift, begin, shift, fluid);
    weir_lanes_store_where(data->rate + begin, rate, fluid);
    if (constants->tool_kind == WEIR_TOOL_NONE) return;
    for (uint32_t lane = 0; lane < group->lanes; ++lane) {
        if (fluid[lane]) add_tool(data, begin + lane);
    }
}

INLINE void forces_group(const WeirWcsphData *data, const WeirLaneGroup *group, uint32_t begin,
                         Variant variant)
{
    if (any_set(data->is_fluid, begin, group->lanes)) fluid_group(data, group, begin, variant);
    if (any_set(data->needs_force, begin, group->lanes)) {
        ForceSums sums = sum_forces(data, group, begin, variant, true);
        Vector acceleration = pressure_acceleration(data, &sums, begin, (WeirMask){0}, variant, true);
        add_viscous_forces(data, &sums, begin, (WeirMask){0}, variant, &acceleration);
        WeirMask takes = chosen(data->needs_force, begin, group->lanes);
        store_where(data->acceleration, begin, acceleration, takes);
        float scale = data->constants->particle_mass * (shape_unit * data->constants->kernel_factor);
        weir_lanes_store_where(data->wetted + begin, scale * sums.filling, takes);
    }
}

// ---- The passes: one copy of each per dimension and kind of kernel ----

typedef enum Pass { WALLS, FORCES } Pass;

// Does any of the lanes take part? Solid ones want their forces where somebody asks.
INLINE bool takes_part(Pass pass, const WeirWcsphData *data, uint32_t begin, uint32_t count)
{
    if (pass == WALLS) return any_solid(data->is_fluid, begin, count);
    return any_set(data->is_fluid, begin, count) || any_set(data->needs_force, begin, count);
}

INLINE void pass_group(Pass pass, const WeirWcsphData *data, const WeirLaneGroup *group, uint32_t begin,
                       Variant variant)
{
    if (pass == WALLS) walls_group(data, group, begin, variant);
    if (pass == FORCES) forces_group(data, group, begin, variant);
}

INLINE void run_pass(Pass pass, const WeirWcsphData *data, uint32_t begin, uint32_t end)
{
    bool deep = data->constants->dimension == 3;
    uint32_t kernel = data->parameters->kernel;
    for (uint32_t i = begin; i < end;) {
        WeirLaneGroup group;
        weir_take_lanes(data->constants, data->cell_start, data->x, i, end, &group);
        if (takes_part(pass, data, i, group.lanes)) {
            weir_find_runs(data->constants, data->cell_start, &group);
            if (kernel != WEIR_KERNEL_WENDLAND) {
                pass_group(pass, data, &group, i, (Variant){deep, kernel});
            } else if (deep) {
                pass_group(pass, data, &group, i, (Variant){true, WEIR_KERNEL_WENDLAND});
            } else {
                pass_group(pass, data, &group, i, (Variant){false, WEIR_KERNEL_WENDLAND});
            }
        }
        i += group.lanes;
    }
}

static void walls(const WeirWcsphData *data, uint32_t begin, uint32_t end)
{
    run_pass(WALLS, data, begin, end);
}

static void forces(const WeirWcsphData *data, uint32_t begin, uint32_t end)
{
    run_pass(FORCES, data, begin, end);
}

const WeirWcsphPasses WEIR_WCSPH_PASSES = {WEIR_SIMD_NAME, walls, forces};
