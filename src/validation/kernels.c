// Smoothing kernels by themselves, and the density of a lattice with them.
#include "validation/analytic.h"
#include "validation/measure.h"

#include "core/smoothing.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_lattice_density_scene[], weir_case_lattice_density_scene_3d[];

enum { KERNELS = 3, DIMENSIONS = 3, INTERVALS = 4000 };
static const char *const kernel_names[KERNELS] = {"wendland", "cubic", "quintic"};
static const double support = 0.03; // m: nothing depends on it

// Integral of W over all space, by Simpson's rule in shells.
static double integral(uint32_t kernel, uint32_t dimension)
{
    double sum = 0.0, step = support / INTERVALS;
    for (int k = 0; k <= INTERVALS; ++k) {
        double r = k * step, shell = dimension == 1   ? 2.0
                                     : dimension == 2 ? 2.0 * weir_pi * r
                                                      : 4.0 * weir_pi * r * r;
        double share = k == 0 || k == INTERVALS ? 1.0 : k % 2 ? 4.0 : 2.0;
        sum += share * shell * weir_smoothing_value(kernel, dimension, r, support);
    }
    return sum * step / 3.0;
}

// Largest difference between the gradient in use and that of the values, over the largest gradient.
static double gradient_error(uint32_t kernel, uint32_t dimension)
{
    double error = 0.0, largest = 0.0, step = 1e-5 * support;
    for (int k = 1; k < 500; ++k) {
        double r = support * k / 500.0;
        double slope = (weir_smoothing_value(kernel, dimension, r + step, support) -
                        weir_smoothing_value(kernel, dimension, r - step, support)) /
                       (2.0 * step);
        double used = r * weir_smoothing_gradient(kernel, dimension, r, support);
        error = fmax(error, fabs(used - slope));
        largest = fmax(largest, fabs(slope));
    }
    return error / largest;
}

// How much of W or its gradient there is where there should be nothing: outside the support, or below zero.
static double support_error(uint32_t kernel, uint32_t dimension)
{
    double error = 0.0, height = weir_smoothing_value(kernel, dimension, 0.0, support);
    for (int k = 0; k <= 1500; ++k) {
        double r = support * k / 1000.0, w = weir_smoothing_value(kernel, dimension, r, support);
        double slope = r * weir_smoothing_gradient(kernel, dimension, r, support);
        error = fmax(error, k < 1000 ? -w / height : fabs(w) / height);
        error = fmax(error, k < 1000 ? slope * support / height : fabs(slope) * support / height);
    }
    return error;
}

// |sum of grad W| V on a square lattice with 3 spacings per support radius, over 1/R: 0 by symmetry.
static double lattice_gradient(uint32_t kernel, uint32_t dimension)
{
    double sum[3] = {0.0, 0.0, 0.0}, spacing = support / 3.0, volume = pow(spacing, dimension);
    for (int k = dimension > 2 ? -3 : 0; k <= (dimension > 2 ? 3 : 0); ++k) {
        for (int j = dimension > 1 ? -3 : 0; j <= (dimension > 1 ? 3 : 0); ++j) {
            for (int i = -3; i <= 3; ++i) {
                double r = spacing * sqrt(i * i + j * j + k * k);
                double f = weir_smoothing_gradient(kernel, dimension, r, support) * volume * spacing;
                sum[0] += f * i;
                sum[1] += f * j;
                sum[2] += f * k;
            }
        }
    }
    return support * sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

static void add_kernel_curve(WeirValidation *v, uint32_t kernel)
{
    uint32_t curve =
        weir_curve_add(v, "Kernels in 2D", kernel_names[kernel], "r / R", "1", "W R^2", "1", false);
    for (int k = 0; k <= 100; ++k) {
        double w = weir_smoothing_value(kernel, 2, support * k / 100.0, support);
        weir_curve_push(v, curve, k / 100.0, w * support * support);
    }
}

static void judge_kernels(WeirValidation *v)
{
    for (uint32_t kernel = 0; kernel < KERNELS; ++kernel) {
        char name[80];
        double worst = 0.0, slope = 0.0, compact = 0.0, sum = 0.0;
        for (uint32_t dimension = 1; dimension <= DIMENSIONS; ++dimension) {
            worst = fmax(worst, fabs(integral(kernel, dimension) - 1.0));
            slope = fmax(slope, gradient_error(kernel, dimension));
            compact = fmax(compact, support_error(kernel, dimension));
            sum = fmax(sum, lattice_gradient(kernel, dimension));
        }
        snprintf(name, sizeof name, "%s: integral less 1, worst of 1D to 3D", kernel_names[kernel]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, worst, NAN, 1e-4);
        snprintf(name, sizeof name, "%s: gradient against differences of W", kernel_names[kernel]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, slope, NAN, 1e-6);
        snprintf(name, sizeof name, "%s: outside the support or below zero", kernel_names[kernel]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, compact, NAN, 1e-12);
        snprintf(name, sizeof name, "%s: sum of gradients on a lattice", kernel_names[kernel]);
        weir_gate_add(v, name, "1", WEIR_GATE_AT_MOST, sum, NAN, 1e-12);
        add_kernel_curve(v, kernel);
    }
}

const WeirCase weir_case_kernels = {
    .info =
        {"kernels", "Smoothing kernels, 1D to 3D",
         "Every kernel of the library: its integral is 1, its gradient is that of its values, it is nowhere "
         "negative and ends at its support, and gradients cancel on a lattice.",
         "definitions"},
    .judge = judge_kernels,
};

// ---- Lattice density ----

enum { LATTICES = 2 };

typedef struct Lattice {
    double error[LATTICES][KERNELS]; // largest |rho / rho0 - 1|
} Lattice;

static void plan_lattice(WeirValidation *v)
{
    Lattice *lattice = v->data;
    double spacing = weir_by_resolution(v, 0.05, 0.025, 0.0125);
    weir_plan_run(v, "2D", "validation/lattice_density/scene.json", weir_case_lattice_density_scene, spacing,
                  0.0, 1.0);
    weir_plan_run(v, "3D", "validation/lattice_density/scene_3d.json", weir_case_lattice_density_scene_3d,
                  0.05, 0.0, 1.0);
    for (int run = 0; run < LATTICES; ++run) {
        for (int kernel = 0; kernel < KERNELS; ++kernel) lattice->error[run][kernel] = NAN;
    }
}

// Density of particle `i` as a sum over all, in a periodic box.
static double summed_density(const WeirSample *sample, uint32_t kernel, size_t i)
{
    uint32_t dimension = sample->state->dimension;
    double radius = sample->parameters->support_radius, sum = 0.0;
    for (size_t j = 0; j < sample->state->count; ++j) {
        double r2 = 0.0;
        for (uint32_t axis = 0; axis < dimension; ++axis) {
            double period = (double)sample->constants->domain_max[axis] - sample->constants->domain_min[axis];
            double d = weir_sample_position(sample, i, axis) - weir_sample_position(sample, j, axis);
            d -= period * floor(d / period + 0.5);
            r2 += d * d;
        }
        if (r2 < radius * radius) sum += weir_smoothing_value(kernel, dimension, sqrt(r2), radius);
    }
    return sum * (double)sample->constants->particle_mass;
}

static void sample_lattice(WeirValidation *v, const WeirSample *sample)
{
    Lattice *lattice = v->data;
    // All particles of a periodic lattice are alike; some are enough.
    size_t stride = 1 + sample->state->count / 64;
    for (uint32_t kernel = 0; kernel < KERNELS; ++kernel) {
        double worst = 0.0;
        for (size_t i = 0; i < sample->state->count; i += stride) {
            double rho = summed_density(sample, kernel, i);
            worst = fmax(worst, fabs(rho / (double)sample->parameters->rest_density - 1.0));
        }
        lattice->error[v->run][kernel] = worst;
    }
}

static void judge_lattice(WeirValidation *v)
{
    const Lattice *lattice = v->data;
    for (int run = 0; run < LATTICES; ++run) {
        for (int kernel = 0; kernel < KERNELS; ++kernel) {
            char name[80];
            snprintf(name, sizeof name, "%s, %s: density less rho0", run ? "3D" : "2D", kernel_names[kernel]);
            weir_gate_add(
                v, name, "1", kernel == WEIR_KERNEL_WENDLAND ? WEIR_GATE_AT_MOST : WEIR_GATE_REPORTED,
                lattice->error[run][kernel], NAN, kernel == WEIR_KERNEL_WENDLAND ? 0.005 : (double)NAN);
        }
    }
}

const WeirCase weir_case_lattice_density = {
    .info = {"lattice_density", "Density of a lattice at rest, 2D and 3D",
             "The particles that a scene starts with, in a periodic box: the density summed with the "
             "solver's kernel "
             "and mass is the rest density.",
             "definition of the particle mass"},
    .data_size = sizeof(Lattice),
    .plan = plan_lattice,
    .sample = sample_lattice,
    .judge = judge_lattice,
};
