#include "json/scene_files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef WEIR_MESHES
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

// The file's path: as given if it is absolute, else in the scene's folder. From malloc.
static char *path_of(const char *scene_path, const char *file)
{
    const char *slash = strrchr(scene_path, '/');
    size_t folder = file[0] != '/' && slash ? (size_t)(slash + 1 - scene_path) : 0;
    char *path = malloc(folder + strlen(file) + 1);
    if (!path) return NULL;
    memcpy(path, scene_path, folder);
    strcpy(path + folder, file);
    return path;
}

static WeirStatus set_list(WeirScene *scene, const char *key, const char *name, const double *numbers,
                           size_t count, char *message, size_t message_size)
{
    char path[320];
    snprintf(path, sizeof path, "%s%s", key, name);
    WeirStatus status = weir_scene_set_numbers(scene, path, numbers, count);
    if (status) snprintf(message, message_size, "%s", weir_scene_error(scene));
    return status;
}

// ---- Tables ----

typedef struct Table {
    double *numbers;
    size_t count, capacity;
} Table;

static bool add_number(Table *table, double number)
{
    if (table->count == table->capacity) {
        size_t wanted = table->capacity ? 2 * table->capacity : 256;
        double *grown = realloc(table->numbers, wanted * sizeof *grown);
        if (!grown) return false;
        table->numbers = grown;
        table->capacity = wanted;
    }
    table->numbers[table->count++] = number;
    return true;
}

// Numbers of a line, separated by commas, semicolons or spaces; -1 if something else is there.
static int read_line(char *line, Table *table)
{
    int found = 0;
    for (char *rest = line;; ++found) {
        rest += strspn(rest, " \t\r\n,;");
        if (*rest == '\0' || *rest == '#') return found;
        char *end;
        double number = strtod(rest, &end);
        if (end == rest || !strchr(" \t\r\n,;#", *end)) return -1;
        if (!add_number(table, number)) return -1;
        rest = end;
    }
}

// All lines; the first may name the columns.
static WeirStatus read_table(FILE *file, const char *path, int columns, Table *table, char *message,
                             size_t size)
{
    char line[1024];
    for (int number = 1; fgets(line, sizeof line, file); ++number) {
        size_t before = table->count;
        int found = read_line(line, table);
        if (found == 0 || found == columns) continue;
        if (found < 0 && number == 1) {
            table->count = before;
            continue;
        }
        static const char *const names[] = {"t, dx, dy, angle", "t, dx, dy, dz, rx, ry, rz"};
        snprintf(message, size, "%s:%d: has %s; must have %d numbers: %s", path, number,
                 found < 0 ? "something that is no number" : "another number of columns", columns,
                 names[columns == 7]);
        return WEIR_ERROR_INPUT;
    }
    return WEIR_OK;
}

WeirStatus weir_file_read_table(WeirScene *scene, const char *key, const char *scene_path, const char *name,
                                char *message, size_t message_size)
{
    char *path = path_of(scene_path, name);
    FILE *file = path ? fopen(path, "r") : NULL;
    if (!file) {
        snprintf(message, message_size, "%sfile: %s: cannot be read: %s", key, path ? path : name,
                 strerror(errno));
        free(path);
        return WEIR_ERROR_INPUT;
    }
    Table table = {0};
    int columns = weir_scene_dimension(scene) == 3 ? 7 : 4;
    WeirStatus status = read_table(file, path, columns, &table, message, message_size);
    fclose(file);
    if (!status && table.count == 0) {
        snprintf(message, message_size, "%sfile: %s: holds no rows", key, path);
        status = WEIR_ERROR_INPUT;
    }
    if (!status) status = set_list(scene, key, "rows", table.numbers, table.count, message, message_size);
    free(table.numbers);
    free(path);
    return status;
}

// ---- Meshes ----

#ifdef WEIR_MESHES
// All meshes of the file in one list; the core joins corners that lie in one place.
static WeirStatus set_mesh(WeirScene *scene, const char *key, const struct aiScene *found, char *message,
                           size_t message_size)
{
    size_t vertices = 0, triangles = 0;
    for (unsigned n = 0; n < found->mNumMeshes; ++n) {
        vertices += found->mMeshes[n]->mNumVertices;
        triangles += found->mMeshes[n]->mNumFaces;
    }
    double *corners = malloc((3 * vertices + 1) * sizeof *corners);
    double *indices = malloc((3 * triangles + 1) * sizeof *indices);
    WeirStatus status = corners && indices ? WEIR_OK : WEIR_ERROR_MEMORY;
    if (status) snprintf(message, message_size, "%sfile: memory ran out", key);
    size_t c = 0, t = 0;
    for (unsigned n = 0; n < found->mNumMeshes && !status; ++n) {
        const struct aiMesh *mesh = found->mMeshes[n];
        size_t first = c / 3;
        for (unsigned v = 0; v < mesh->mNumVertices; ++v) {
            corners[c++] = mesh->mVertices[v].x;
            corners[c++] = mesh->mVertices[v].y;
            corners[c++] = mesh->mVertices[v].z;
        }
        for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
            if (mesh->mFaces[f].mNumIndices != 3) continue; // points and lines bound nothing
            for (int k = 0; k < 3; ++k) indices[t++] = (double)(first + mesh->mFaces[f].mIndices[k]);
        }
    }
    if (!status) status = set_list(scene, key, "vertices", corners, c, message, message_size);
    if (!status) status = set_list(scene, key, "triangles", indices, t, message, message_size);
    free(corners);
    free(indices);
    return status;
}
#endif

WeirStatus weir_file_read_mesh(WeirScene *scene, const char *key, const char *scene_path, const char *file,
                               char *message, size_t message_size)
{
#ifdef WEIR_MESHES
    char *path = path_of(scene_path, file);
    const struct aiScene *found = path ? aiImportFile(path, aiProcess_Triangulate) : NULL;
    WeirStatus status = WEIR_ERROR_INPUT;
    if (found && found->mNumMeshes > 0)
        status = set_mesh(scene, key, found, message, message_size);
    else
        snprintf(message, message_size, "%sfile: %s: cannot be read as a mesh: %.200s", key,
                 path ? path : file, found ? "it holds none" : aiGetErrorString());
    if (found) aiReleaseImport(found);
    free(path);
    return status;
#else
    (void)scene;
    (void)scene_path;
    snprintf(message, message_size, "%sfile: %s: this program was built without mesh files (WEIR_MESHES)",
             key, file);
    return WEIR_ERROR_INPUT;
#endif
}
