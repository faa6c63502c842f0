#include "common/check.h"

#include <math.h>
#include <string.h>

void weir_test_near(const char *what, double actual, double expected, double tolerance, const char *file,
                    int line)
{
    if (fabs(actual - expected) <= tolerance) return;
    print_error("%s is %.17g, not %.17g within %g\n", what, actual, expected, tolerance);
    _fail(file, line);
}

void weir_test_at_most(const char *what, double actual, double limit, const char *file, int line)
{
    if (actual <= limit) return;
    print_error("%s is %.17g, more than %.17g\n", what, actual, limit);
    _fail(file, line);
}

void weir_test_contains(const char *text, const char *part, const char *file, int line)
{
    if (strstr(text, part)) return;
    print_error("\"%s\" does not contain \"%s\"\n", text, part);
    _fail(file, line);
}

void weir_test_scene_status(const WeirScene *scene, WeirStatus actual, WeirStatus expected, const char *what,
                            const char *file, int line)
{
    if (actual == expected) return;
    print_error("%s gave status %d, not %d: \"%s\"\n", what, (int)actual, (int)expected,
                weir_scene_error(scene));
    _fail(file, line);
}

void weir_test_sim_status(const WeirSim *sim, WeirStatus actual, WeirStatus expected, const char *what,
                          const char *file, int line)
{
    if (actual == expected) return;
    print_error("%s gave status %d, not %d: \"%s\"\n", what, (int)actual, (int)expected, weir_sim_error(sim));
    _fail(file, line);
}
