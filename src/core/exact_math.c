#include "core/exact_math.h"

#include <math.h>

double weir_seventh_root(double x)
{
    if (!(x > 0.0)) return 0.0;
    double root = x > 1.0 ? x : 1.0; // Newton from above falls monotonically
    for (int n = 0; n < 500; ++n) {
        double square = root * root, sixth = square * square * square;
        double next = root - (root - x / sixth) / 7.0;
        if (!(next < root)) break;
        root = next;
    }
    return root;
}

void weir_sine_cosine(double angle, double *sine, double *cosine)
{
    // pi/2 in two parts, the first with trailing zeros, so that the reduction keeps its digits.
    static const double high = 1.57079632673412561417, low = 6.07710050650619224932e-11;
    double quarters = floor(angle / (0.5 * WEIR_PI) + 0.5);
    double x = (angle - quarters * high) - quarters * low, x2 = x * x, s = 0.0, c = 0.0;
    for (int n = 10; n >= 1; --n) { // Horner on the series
        s = (1.0 - s) * x2 / (double)(2 * n * (2 * n + 1));
        c = (1.0 - c) * x2 / (double)((2 * n - 1) * 2 * n);
    }
    s = x * (1.0 - s);
    c = 1.0 - c;
    int quarter = (int)(quarters - 4.0 * floor(quarters / 4.0));
    *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
}

double weir_exponential(double x)
{
    if (x < -700.0) return 0.0;
    if (x > 700.0) return INFINITY;
    static const double ln2_high = 0.69314718036912381649, ln2_low = 1.90821492927058770002e-10;
    double twos = floor(x / (ln2_high + ln2_low) + 0.5);
    double r = (x - twos * ln2_high) - twos * ln2_low, sum = 1.0;
    for (int n = 16; n >= 1; --n) sum = 1.0 + r * sum / (double)n;
    return ldexp(sum, (int)twos);
}

void weir_basis(const double w[3], double u[3], double v[3])
{
    // Cross product with the axis that w leans to least.
    int least = fabs(w[0]) <= fabs(w[1]) ? 0 : 1;
    if (fabs(w[2]) < fabs(w[least])) least = 2;
    double axis[3] = {least == 0, least == 1, least == 2};
    for (int k = 0; k < 3; ++k)
        u[k] = axis[(k + 1) % 3] * w[(k + 2) % 3] - axis[(k + 2) % 3] * w[(k + 1) % 3];
    double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    for (int k = 0; k < 3; ++k) u[k] /= length;
    for (int k = 0; k < 3; ++k) v[k] = w[(k + 1) % 3] * u[(k + 2) % 3] - w[(k + 2) % 3] * u[(k + 1) % 3];
}
