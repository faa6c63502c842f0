// Functions that give the same bits on every machine: made of + - * / and sqrt alone, where libraries differ in
// the last place. For what a scene starts with, so not for speed.
#pragma once

#define WEIR_PI 3.14159265358979323846

// x^(1/7) for x > 0; 0 for x <= 0.
double weir_seventh_root(double x);
// Sine and cosine of an angle in rad; |angle| below 1e8.
void weir_sine_cosine(double angle, double *sine, double *cosine);
// e^x; 0 below -700, infinite above 700.
double weir_exponential(double x);
// Orthonormal u, v beside the unit vector w, right-handed.
void weir_basis(const double w[3], double u[3], double v[3]);
