// cmocka and the few checks that it lacks: floating point with a stated tolerance, and text inside a message.
#pragma once

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "weir/weir.h"

// |actual - expected| <= tolerance; NaN never passes.
#define CHECK_NEAR(actual, expected, tolerance)                                                              \
    weir_test_near(#actual, actual, expected, tolerance, __FILE__, __LINE__)
// actual <= limit; NaN never passes.
#define CHECK_AT_MOST(actual, limit) weir_test_at_most(#actual, actual, limit, __FILE__, __LINE__)
#define CHECK_CONTAINS(text, part)   weir_test_contains(text, part, __FILE__, __LINE__)
// The status, with the message of the scene or simulation when it is another one.
#define CHECK_SCENE(scene, call, status)                                                                     \
    weir_test_scene_status(scene, call, status, #call, __FILE__, __LINE__)
#define CHECK_SIM(sim, call, status) weir_test_sim_status(sim, call, status, #call, __FILE__, __LINE__)

void weir_test_near(const char *what, double actual, double expected, double tolerance, const char *file,
                    int line);
void weir_test_at_most(const char *what, double actual, double limit, const char *file, int line);
void weir_test_contains(const char *text, const char *part, const char *file, int line);
void weir_test_scene_status(const WeirScene *scene, WeirStatus actual, WeirStatus expected, const char *what,
                            const char *file, int line);
void weir_test_sim_status(const WeirSim *sim, WeirStatus actual, WeirStatus expected, const char *what,
                          const char *file, int line);
