#include "core/exact_math.h"

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
