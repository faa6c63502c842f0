// Prescribed motions as tables: constant velocities, oscillations, and rows as given with their rates.
#include "core/exact_math.h"
#include "core/scene_shape.h"
#include "core/world_build.h"

#include <math.h>
#include <stdlib.h>

enum { ROWS_PER_PERIOD = 64 };         // Hermite between them is off by 2e-7 of the amplitude
static const double longest_run = 1e4; // s, of a constant velocity

// ---- Rates of a table: through each inner row the parabola over its neighbours, at the ends one side ----

static float rate_between(double t0, double f0, double t1, double f1, double t2, double f2)
{
    double before = (f1 - f0) / (t1 - t0), after = (f2 - f1) / (t2 - t1);
    return (float)((before * (t2 - t1) + after * (t1 - t0)) / (t2 - t0));
}

static void make_rates(WeirMotionRow *rows, uint32_t count, bool repeats)
{
    for (uint32_t n = 0; n < count && count > 1; ++n) {
        const WeirMotionRow *a = &rows[n > 0 ? n - 1 : 0], *c = &rows[n + 1 < count ? n + 1 : count - 1];
        WeirMotionRow *b = &rows[n];
        double ta = a->time, tc = c->time;
        // A table that repeats goes on from its end to its start.
        bool wraps = repeats && count > 2 && (n == 0 || n + 1 == count);
        if (wraps && n == 0)
            a = &rows[count - 2], ta = (double)b->time - ((double)rows[count - 1].time - a->time);
        if (wraps && n > 0) c = &rows[1], tc = (double)b->time + ((double)c->time - rows[0].time);
        for (int axis = 0; axis < 3; ++axis) {
            double shift[2] = {0.0, 0.0}; // what a period adds
            if (wraps) {
                shift[0] = (double)rows[count - 1].displacement[axis] - rows[0].displacement[axis];
                shift[1] = (double)rows[count - 1].rotation[axis] - rows[0].rotation[axis];
            }
            double sa = n == 0 ? -1.0 : 0.0, sc = n > 0 ? 1.0 : 0.0;
            double da = a->displacement[axis] + sa * shift[0], dc = c->displacement[axis] + sc * shift[0];
            double ra = a->rotation[axis] + sa * shift[1], rc = c->rotation[axis] + sc * shift[1];
            if (a == b || c == b) {
                b->displacement_rate[axis] = (float)((dc - da) / (tc - ta));
                b->rotation_rate[axis] = (float)((rc - ra) / (tc - ta));
                continue;
            }
            b->displacement_rate[axis] = rate_between(ta, da, b->time, b->displacement[axis], tc, dc);
            b->rotation_rate[axis] = rate_between(ta, ra, b->time, b->rotation[axis], tc, rc);
        }
    }
}

// ---- Tables of the three kinds ----

static uint32_t row_count(const WeirMotion *motion)
{
    if (motion->row_count > 0) return motion->row_count;
    return motion->period > 0.0 ? ROWS_PER_PERIOD + 1 : 2;
}

static void fill_rows(const WeirMotion *motion, WeirMotionRow *rows)
{
    if (motion->row_count > 0) {
        for (uint32_t n = 0; n < motion->row_count; ++n) rows[n] = motion->rows[n];
        make_rates(rows, motion->row_count, motion->repeats);
        return;
    }
    uint32_t count = row_count(motion);
    for (uint32_t n = 0; n < count; ++n) {
        double share = (double)n / (double)(count - 1), sine = 0.0, cosine = 1.0;
        bool swings = motion->period > 0.0;
        if (swings) weir_sine_cosine(2.0 * WEIR_PI * (n + 1 == count ? 0.0 : share), &sine, &cosine);
        double time = share * (swings ? motion->period : longest_run);
        rows[n] = (WeirMotionRow){.time = (float)time};
        for (int axis = 0; axis < 3; ++axis) {
            double pace = swings ? 2.0 * WEIR_PI / motion->period : 0.0;
            rows[n].displacement[axis] =
                (float)(swings ? sine * motion->amplitude[axis] : time * motion->velocity[axis]);
            rows[n].rotation[axis] =
                (float)(swings ? sine * motion->angle[axis] : time * motion->angular_velocity[axis]);
            rows[n].displacement_rate[axis] =
                (float)(swings ? pace * cosine * motion->amplitude[axis] : motion->velocity[axis]);
            rows[n].rotation_rate[axis] =
                (float)(swings ? pace * cosine * motion->angle[axis] : motion->angular_velocity[axis]);
        }
    }
}

// Solids are the domain's sides, if any is closed, then walls, then bodies.
static const WeirSolidPiece *piece_of(const WeirScene *scene, uint32_t solid)
{
    uint32_t sides = weir_has_sides(scene) ? 1 : 0;
    if (solid < sides) return NULL;
    uint32_t n = solid - sides;
    return n < scene->wall_count ? &scene->wall[n] : &scene->body[n - scene->wall_count];
}

WeirStatus weir_build_motions(WeirBuild *build)
{
    WeirWorld *world = build->world;
    for (uint32_t s = 0; s < world->solid_count; ++s) {
        const WeirSolidPiece *piece = piece_of(build->scene, s);
        if (!piece || !piece->is_driven) continue;
        world->solids[s].motion_first = world->motion_count;
        world->solids[s].motion_count = row_count(&piece->motion);
        world->solids[s].motion_repeats = piece->motion.repeats || piece->motion.period > 0.0;
        world->motion_count += world->solids[s].motion_count;
    }
    if (world->motion_count == 0) return WEIR_OK;
    world->motion = calloc(world->motion_count, sizeof *world->motion);
    if (!world->motion) return weir_fail(&build->scene->error, WEIR_ERROR_MEMORY, "motion: memory ran out");
    for (uint32_t s = 0; s < world->solid_count; ++s) {
        if (world->solids[s].motion_count > 0)
            fill_rows(&piece_of(build->scene, s)->motion, &world->motion[world->solids[s].motion_first]);
    }
    return WEIR_OK;
}

// ---- Speed ----

static double norm(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

// Farthest that the shape reaches from where it turns.
static double reach_of(const WeirSolidPiece *piece, uint32_t dimension)
{
    double low[3], high[3], sum = 0.0;
    weir_shape_bounds(&piece->shape, dimension, low, high);
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        double at = piece->motion.has_pivot ? piece->motion.pivot[axis] : 0.5 * (low[axis] + high[axis]);
        double far = fmax(fabs(high[axis] - at), fabs(at - low[axis]));
        sum += far * far;
    }
    return sqrt(sum);
}

double weir_solid_speed(const WeirSolidPiece *piece, uint32_t dimension)
{
    const WeirMotion *motion = &piece->motion;
    double reach = reach_of(piece, dimension), speed = norm(piece->surface_velocity);
    speed = fmax(speed, norm(piece->velocity) + reach * norm(piece->angular_velocity));
    if (!piece->is_driven) return speed;
    speed = fmax(speed, norm(motion->velocity) + reach * norm(motion->angular_velocity));
    if (motion->period > 0.0) {
        double pace = 2.0 * WEIR_PI / motion->period;
        speed = fmax(speed, pace * (norm(motion->amplitude) + reach * norm(motion->angle)));
    }
    for (uint32_t n = 1; n < motion->row_count; ++n) {
        const WeirMotionRow *a = &motion->rows[n - 1], *b = &motion->rows[n];
        double way[3], turn[3], time = (double)b->time - a->time;
        for (int axis = 0; axis < 3; ++axis) {
            way[axis] = (double)b->displacement[axis] - a->displacement[axis];
            turn[axis] = (double)b->rotation[axis] - a->rotation[axis];
        }
        if (time > 0.0) speed = fmax(speed, (norm(way) + reach * norm(turn)) / time);
    }
    return speed;
}
