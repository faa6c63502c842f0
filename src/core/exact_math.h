// Functions that give the same bits on every machine: made of + - * / and sqrt alone, where libraries differ in
// the last place. For what a scene starts with, so not for speed.
#pragma once

// x^(1/7) for x > 0; 0 for x <= 0.
double weir_seventh_root(double x);
