#include "validation/measure.h"
#include "core/probe.h"
#include "core/smoothing.h"

#include <math.h>
#include <stdlib.h>

bool weir_sample_is_fluid(const WeirSample *sample, size_t i)
{
    if (!sample->state->group) return true;
    uint32_t group = sample->state->group[i];
    return !weir_group_is_solid(group) && group != WEIR_GROUP_EMPTY;
}

double weir_sample_position(const WeirSample *sample, size_t i, uint32_t axis)
{
    uint32_t dimension = sample->state->dimension;
    return axis < dimension ? (double)sample->state->position[dimension * i + axis] : 0.0;
}

double weir_sample_velocity(const WeirSample *sample, size_t i, uint32_t axis)
{
    uint32_t dimension = sample->state->dimension;
    return axis < dimension ? (double)sample->state->velocity[dimension * i + axis] : 0.0;
}

// Energy per mass of density rho under p = c^2 (rho - rho0): integral of p / rho^2.
static double elastic(double sound_speed, double rho, double rest)
{
    return sound_speed * sound_speed * (log(rho / rest) + rest / rho - 1.0);
}

static void add_particle(WeirFluidSums *sums, const WeirSample *sample, size_t i)
{
    double m = sample->constants->particle_mass, x[3], v[3], speed2 = 0.0;
    double omega2 = sample->parameters->central_force;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        x[axis] = weir_sample_position(sample, i, axis);
        v[axis] = weir_sample_velocity(sample, i, axis);
        double from_center = x[axis] - (double)sample->constants->center[axis];
        if (axis >= sample->state->dimension) from_center = 0.0;
        speed2 += v[axis] * v[axis];
        sums->center[axis] += x[axis];
        sums->spread[axis] += x[axis] * x[axis];
        sums->min[axis] = fmin(sums->min[axis], x[axis]);
        sums->max[axis] = fmax(sums->max[axis], x[axis]);
        sums->momentum[axis] += m * v[axis];
        sums->potential_energy -= m * (double)sample->parameters->gravity[axis] * x[axis];
        sums->potential_energy += 0.5 * m * omega2 * from_center * from_center;
    }
    double rho = sample->state->density[i], rest = sample->parameters->rest_density;
    ++sums->count;
    sums->mass += m;
    sums->speed_momentum += m * sqrt(speed2);
    sums->angular_momentum += m * (x[0] * v[1] - x[1] * v[0]);
    sums->kinetic_energy += 0.5 * m * speed2;
    sums->elastic_energy += m * elastic(sample->constants->sound_speed, rho, rest);
    sums->max_speed = fmax(sums->max_speed, sqrt(speed2));
    sums->density_deviation += fabs(rho / rest - 1.0);
}

WeirFluidSums weir_fluid_sums(const WeirSample *sample)
{
    WeirFluidSums sums = {.min = {INFINITY, INFINITY, INFINITY}, .max = {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < sample->state->count; ++i) {
        if (weir_sample_is_fluid(sample, i)) add_particle(&sums, sample, i);
    }
    for (uint32_t axis = 0; axis < 3; ++axis) {
        sums.center[axis] /= sums.count;
        sums.spread[axis] = sums.spread[axis] / sums.count - sums.center[axis] * sums.center[axis];
    }
    sums.density_deviation /= sums.count;
    return sums;
}

static void measure(const WeirSample *sample, const WeirProbePiece *probe, double values[3])
{
    weir_probe_measure(probe, 0, sample->state, sample->parameters, sample->constants, values);
}

double weir_measure_height(const WeirSample *sample, double x, double z)
{
    WeirProbePiece probe = {.kind = WEIR_PROBE_HEIGHT, .position = {x, 0.0, z}};
    double values[3];
    measure(sample, &probe, values);
    return values[0];
}

double weir_measure_depth(const WeirSample *sample, double x, double z)
{
    uint32_t dimension = sample->state->dimension, kernel = sample->parameters->kernel;
    double depth = 0.0, support = sample->parameters->support_radius;
    for (size_t i = 0; i < sample->state->count; ++i) {
        double dx = weir_sample_position(sample, i, 0) - x;
        double dz = dimension == 3 ? weir_sample_position(sample, i, 2) - z : 0.0;
        if (dx * dx + dz * dz >= support * support || !weir_sample_is_fluid(sample, i)) continue;
        depth += (double)sample->constants->particle_mass / sample->state->density[i] *
                 weir_smoothing_value(kernel, dimension - 1, sqrt(dx * dx + dz * dz), support);
    }
    return depth;
}

double weir_measure_pressure(const WeirSample *sample, const double point[3])
{
    WeirProbePiece probe = {.kind = WEIR_PROBE_PRESSURE, .position = {point[0], point[1], point[2]}};
    double values[3];
    measure(sample, &probe, values);
    return values[0];
}

// Sums of the least-squares plane: moments of w (1, d) (1, d)^T and of w (1, d) v.
typedef struct Plane {
    double matrix[4][4], right[4][3];
} Plane;

static void add_to_plane(Plane *plane, const WeirSample *sample, size_t i, const double point[3])
{
    uint32_t dimension = sample->state->dimension;
    double terms[4] = {1.0, 0.0, 0.0, 0.0}, r2 = 0.0, radius = sample->parameters->support_radius;
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        double d = weir_sample_position(sample, i, axis) - point[axis];
        terms[1 + axis] = d / radius;
        r2 += d * d;
    }
    if (r2 >= radius * radius || !weir_sample_is_fluid(sample, i)) return;
    double w = weir_smoothing_shape(sample->parameters->kernel, sqrt(r2) / radius);
    for (uint32_t row = 0; row <= dimension; ++row) {
        for (uint32_t column = 0; column <= dimension; ++column)
            plane->matrix[row][column] += w * terms[row] * terms[column];
        for (uint32_t axis = 0; axis < dimension; ++axis)
            plane->right[row][axis] += w * terms[row] * weir_sample_velocity(sample, i, axis);
    }
}

void weir_measure_linear_velocity(const WeirSample *sample, const double point[3], double velocity[3])
{
    Plane plane = {{{0.0}}, {{0.0}}};
    uint32_t size = sample->state->dimension + 1;
    for (size_t i = 0; i < sample->state->count; ++i) add_to_plane(&plane, sample, i, point);
    // Elimination from the last row up leaves the value at the point in the first; the matrix is symmetric and
    // positive if there is fluid around.
    for (uint32_t k = size - 1; k > 0; --k) {
        for (uint32_t row = 0; row < k; ++row) {
            double factor = plane.matrix[row][k] / plane.matrix[k][k];
            for (uint32_t column = 0; column < k; ++column)
                plane.matrix[row][column] -= factor * plane.matrix[k][column];
            for (uint32_t axis = 0; axis + 1 < size; ++axis)
                plane.right[row][axis] -= factor * plane.right[k][axis];
        }
    }
    for (uint32_t axis = 0; axis < 3; ++axis)
        velocity[axis] = axis + 1 < size ? plane.right[0][axis] / plane.matrix[0][0] : 0.0;
}

// ---- Clusters: union-find over pairs found in cells of the link's size ----

typedef struct Clusters {
    uint32_t *parent, *next, *head; // head and next: lists per cell, index + 1
    uint32_t cells[2];
    double min[2], link;
} Clusters;

static uint32_t find_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static uint32_t cell_of(const Clusters *clusters, double position, int axis)
{
    double cell = floor((position - clusters->min[axis]) / clusters->link);
    return cell < 0.0 ? 0 : cell >= clusters->cells[axis] ? clusters->cells[axis] - 1 : (uint32_t)cell;
}

static void join_neighbors(Clusters *clusters, const WeirSample *sample, uint32_t i)
{
    double x = weir_sample_position(sample, i, 0), y = weir_sample_position(sample, i, 1);
    double z = weir_sample_position(sample, i, 2), link2 = clusters->link * clusters->link;
    uint32_t column = cell_of(clusters, x, 0), row = cell_of(clusters, y, 1);
    for (uint32_t r = row ? row - 1 : 0; r <= row + 1 && r < clusters->cells[1]; ++r) {
        for (uint32_t c = column ? column - 1 : 0; c <= column + 1 && c < clusters->cells[0]; ++c) {
            for (uint32_t j = clusters->head[r * clusters->cells[0] + c]; j; j = clusters->next[j - 1]) {
                double dx = x - weir_sample_position(sample, j - 1, 0);
                double dy = y - weir_sample_position(sample, j - 1, 1);
                double dz = z - weir_sample_position(sample, j - 1, 2);
                if (dx * dx + dy * dy + dz * dz >= link2) continue;
                clusters->parent[find_root(clusters->parent, i)] = find_root(clusters->parent, j - 1);
            }
        }
    }
}

static double largest_share(Clusters *clusters, const WeirSample *sample, uint32_t fluid)
{
    uint32_t largest = 0, count = sample->state->count;
    for (uint32_t i = 0; i < count; ++i) {
        if (!weir_sample_is_fluid(sample, i)) continue;
        uint32_t cell = cell_of(clusters, weir_sample_position(sample, i, 1), 1) * clusters->cells[0] +
                        cell_of(clusters, weir_sample_position(sample, i, 0), 0);
        clusters->next[i] = clusters->head[cell];
        clusters->head[cell] = i + 1;
        join_neighbors(clusters, sample, i);
    }
    for (uint32_t i = 0; i < count; ++i) clusters->next[i] = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (!weir_sample_is_fluid(sample, i)) continue;
        uint32_t size = ++clusters->next[find_root(clusters->parent, i)];
        if (size > largest) largest = size;
    }
    return (double)largest / fluid;
}

double weir_largest_cluster(const WeirSample *sample, double link)
{
    WeirFluidSums sums = weir_fluid_sums(sample);
    if (sums.count == 0) return NAN;
    // Two particles flung far away must not make the grid huge.
    for (int axis = 0; axis < 2; ++axis) link = fmax(link, (sums.max[axis] - sums.min[axis]) / 4096.0);
    Clusters clusters = {.min = {sums.min[0], sums.min[1]}, .link = link};
    for (int axis = 0; axis < 2; ++axis)
        clusters.cells[axis] = (uint32_t)floor((sums.max[axis] - sums.min[axis]) / link) + 1;
    uint32_t count = sample->state->count;
    clusters.parent = malloc(count * sizeof(uint32_t));
    clusters.next = calloc(count, sizeof(uint32_t));
    clusters.head = calloc((size_t)clusters.cells[0] * clusters.cells[1], sizeof(uint32_t));
    double share = NAN;
    if (clusters.parent && clusters.next && clusters.head) {
        for (uint32_t i = 0; i < count; ++i) clusters.parent[i] = i;
        share = largest_share(&clusters, sample, sums.count);
    }
    free(clusters.parent);
    free(clusters.next);
    free(clusters.head);
    return share;
}

// ---- Numbers ----

double weir_fitted_slope(const double *x, const double *y, uint32_t count)
{
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
    for (uint32_t k = 0; k < count; ++k) {
        mean_x += x[k] / count;
        mean_y += y[k] / count;
    }
    for (uint32_t k = 0; k < count; ++k) {
        xx += (x[k] - mean_x) * (x[k] - mean_x);
        xy += (x[k] - mean_x) * (y[k] - mean_y);
    }
    return xy / xx;
}

double weir_curve_mean(const WeirValidation *v, uint32_t curve, double from, double to)
{
    const WeirCurveData *data = &v->curves[curve];
    double sum = 0.0;
    uint32_t count = 0;
    for (uint32_t k = 0; k < data->info.count; ++k) {
        if (data->x[k] < from - 1e-9 || data->x[k] > to + 1e-9) continue;
        sum += data->y[k];
        ++count;
    }
    return count ? sum / count : (double)NAN;
}

double weir_curve_max(const WeirValidation *v, uint32_t curve, double from, double to)
{
    const WeirCurveData *data = &v->curves[curve];
    double largest = NAN;
    for (uint32_t k = 0; k < data->info.count; ++k) {
        if (data->x[k] < from - 1e-9 || data->x[k] > to + 1e-9) continue;
        if (isnan(data->y[k])) return NAN;
        largest = fmax(largest, data->y[k]);
    }
    return largest;
}
