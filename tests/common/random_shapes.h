// Random walls for tests: star polygons, and meshes of divided octahedra with corners at random distances. The origin is
// inside, 0.5 (polygon) or 0.4 (mesh) away from the surface's corners at least.
#pragma once

#include "common/build.h"

// Adds the piece `list`[0], "walls" or "bodies".
void weir_test_random_polygon(WeirScene *scene, const char *list, WeirRandom *random);
void weir_test_random_mesh(WeirScene *scene, const char *list, WeirRandom *random);
