// Files that a scene names: tables of motion (CSV) and triangle meshes (STL, OBJ).
#pragma once

#include "weir/weir.h"

// Reads `file`, relative to the folder of the scene file `scene_path`, into the list `key` + "rows", where `key` is
// "walls[0].motion.". On failure the message names the file and the line.
WeirStatus weir_file_read_table(WeirScene *scene, const char *key, const char *scene_path, const char *file,
                                char *message, size_t message_size);
// The same for key + "vertices" and key + "triangles" of a mesh.
WeirStatus weir_file_read_mesh(WeirScene *scene, const char *key, const char *scene_path, const char *file,
                               char *message, size_t message_size);
