// Fields of flow that a piece of fluid can start with, and their pressure.
#include "core/exact_math.h"
#include "core/scene_shape.h"
#include "core/world_build.h"

#include <math.h>

// Sine and cosine of 2 pi x / length.
static void wave(double x, double length, double *sine, double *cosine)
{
    weir_sine_cosine(2.0 * WEIR_PI * x / length, sine, cosine);
}

// u = -U cos(2 pi x/L) sin(2 pi y/L), v = U sin cos, p = -rho U^2/4 (cos(4 pi x/L) + cos(4 pi y/L)): a vortex lattice
// that decays without changing its shape.
static double taylor_green(const WeirScene *scene, double rate, const double *point, double velocity[3])
{
    double length = scene->domain_max[0] - scene->domain_min[0], sx, cx, sy, cy;
    wave(point[0] - scene->domain_min[0], length, &sx, &cx);
    wave(point[1] - scene->domain_min[1], length, &sy, &cy);
    velocity[0] -= rate * cx * sy;
    velocity[1] += rate * sx * cy;
    // cos(2 a) = 1 - 2 sin(a)^2
    return -0.25 * scene->parameters.rest_density * rate * rate * (2.0 - 2.0 * sx * sx - 2.0 * sy * sy);
}

// sin(m a) for m = 1, 3, 5, ... by rotation.
static void odd_sines(double angle, double *sines, int count)
{
    double s, c, s2, c2;
    weir_sine_cosine(angle, &s, &c);
    weir_sine_cosine(2.0 * angle, &s2, &c2);
    for (int n = 0; n < count; ++n) {
        sines[n] = s;
        double next = s * c2 + c * s2;
        c = c * c2 - s * s2;
        s = next;
    }
}

// A square that turns like a rigid body, free of pressure at its sides: the pressure solves
// laplacian p = 2 rho omega^2 (A. Colagrossi, thesis, 2005).
static double rotating_square(const WeirScene *scene, const WeirFluid *fluid, const double *point,
                              double velocity[3])
{
    enum { TERMS = 32 };
    double low[3], high[3], sines[2][TERMS], length[2], omega = fluid->flow_rate, sum = 0.0;
    weir_shape_bounds(&fluid->shape, scene->dimension, low, high);
    for (int axis = 0; axis < 2; ++axis) {
        length[axis] = high[axis] - low[axis];
        odd_sines(WEIR_PI * (point[axis] - low[axis]) / length[axis], sines[axis], TERMS);
    }
    velocity[0] += omega * (point[1] - 0.5 * (low[1] + high[1]));
    velocity[1] -= omega * (point[0] - 0.5 * (low[0] + high[0]));
    for (int i = 0; i < TERMS; ++i) {
        for (int j = 0; j < TERMS; ++j) {
            double m = 2 * i + 1, n = 2 * j + 1, kx = m * WEIR_PI / length[0], ky = n * WEIR_PI / length[1];
            sum += sines[0][i] * sines[1][j] / (m * n * (kx * kx + ky * ky));
        }
    }
    return -32.0 * omega * omega * scene->parameters.rest_density * sum / (WEIR_PI * WEIR_PI);
}

// (-A x, A y) about the piece's middle. A disc whose edge is free of pressure has p = rho (A^2 + Omega^2)/2 (R^2 - r^2)
// at the start, where dA/dt = 0 (J. J. Monaghan, J. Comput. Phys. 110, 1994); Omega^2 is the central force.
static double stretch(const WeirScene *scene, const WeirFluid *fluid, const double *point, double velocity[3])
{
    double low[3], high[3], r2 = 0.0, rate = fluid->flow_rate, radius = fluid->shape.radius;
    weir_shape_bounds(&fluid->shape, scene->dimension, low, high);
    for (int axis = 0; axis < 2; ++axis) {
        double d = point[axis] - 0.5 * (low[axis] + high[axis]);
        velocity[axis] += axis == 0 ? -rate * d : rate * d;
        r2 += d * d;
    }
    if (fluid->shape.kind != WEIR_SHAPE_BALL || scene->dimension != 2) return 0.0;
    double factor =
        0.5 * scene->parameters.rest_density * (rate * rate + (double)scene->parameters.central_force);
    return factor * fmax(radius * radius - r2, 0.0);
}

// Linear waves on depth H with k = 2 pi / L: surface A sin(wt) cos(kx), flat at the start, when the velocity is largest and
// the wave adds no pressure.
static void standing_wave(const WeirScene *scene, const WeirFluid *fluid, const double *point,
                          double velocity[3])
{
    double low[3], high[3], sine, cosine;
    weir_shape_bounds(&fluid->shape, scene->dimension, low, high);
    double length = scene->domain_max[0] - scene->domain_min[0], k = 2.0 * WEIR_PI / length;
    double g = fabs((double)scene->parameters.gravity[1]), depth = high[1] - low[1];
    double top = weir_exponential(k * depth), up = weir_exponential(k * (point[1] - low[1]));
    double sinh_top = 0.5 * (top - 1.0 / top), cosh_top = 0.5 * (top + 1.0 / top);
    double omega = sqrt(g * k * sinh_top / cosh_top), speed = fluid->flow_rate * omega / sinh_top;
    wave(point[0] - scene->domain_min[0], length, &sine, &cosine);
    velocity[0] -= speed * 0.5 * (up + 1.0 / up) * sine;
    velocity[1] += speed * 0.5 * (up - 1.0 / up) * cosine;
}

double weir_flow_at(const WeirScene *scene, const WeirFluid *fluid, const double *point, double velocity[3])
{
    switch (fluid->flow) {
    case WEIR_FLOW_TAYLOR_GREEN:
        return taylor_green(scene, fluid->flow_rate, point, velocity);
    case WEIR_FLOW_ROTATING_SQUARE:
        return rotating_square(scene, fluid, point, velocity);
    case WEIR_FLOW_STRETCH:
        return stretch(scene, fluid, point, velocity);
    case WEIR_FLOW_STANDING_WAVE:
        standing_wave(scene, fluid, point, velocity);
        return 0.0;
    case WEIR_FLOW_NONE:
        break;
    }
    return 0.0;
}
