#include "core/scene_value.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

WeirStatus weir_wrong_type(WeirScene *scene, const char *path, const WeirValue *value, const char *wanted)
{
    if (value->kind == WEIR_VALUE_NUMBER) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is the number %g; must be %s", path,
                         value->numbers[0], wanted);
    }
    if (value->kind == WEIR_VALUE_LIST) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is a list of %zu; must be %s", path,
                         value->count, wanted);
    }
    bool is_text = value->kind == WEIR_VALUE_TEXT;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is %s%.40s%s; must be %s", path,
                     is_text ? "the text \"" : "", value->text, is_text ? "\"" : "", wanted);
}

long weir_path_index(const char *text, const char **end)
{
    if (text[0] != '[' || text[1] < '0' || text[1] > '9') return -1;
    char *stop;
    unsigned long index = strtoul(text + 1, &stop, 10);
    if (*stop != ']' || index > INT_MAX) return -1;
    *end = stop + 1;
    return (long)index;
}

// ---- Single values ----

static WeirStatus check_range(WeirScene *scene, const char *path, const WeirSceneKey *key, double number)
{
    bool inside = number >= key->low && number <= key->high && !(key->above && number == key->low);
    if (inside) return WEIR_OK;
    return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: %g is out of range; allowed is %s%g to %g",
                     path, number, key->above ? "above " : "", key->low, key->high);
}

static WeirStatus set_number(WeirScene *scene, double *field, const WeirSceneKey *key, const char *path,
                             const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_NUMBER) return weir_wrong_type(scene, path, value, "a number");
    WeirStatus status = check_range(scene, path, key, value->numbers[0]);
    if (!status) *field = value->numbers[0];
    return status;
}

static WeirStatus set_whole(WeirScene *scene, uint32_t *field, const WeirSceneKey *key, const char *path,
                            const WeirValue *value)
{
    bool is_whole = value->kind == WEIR_VALUE_NUMBER && floor(value->numbers[0]) == value->numbers[0];
    if (!is_whole) return weir_wrong_type(scene, path, value, "a whole number");
    WeirStatus status = check_range(scene, path, key, value->numbers[0]);
    if (!status) *field = (uint32_t)value->numbers[0];
    return status;
}

// The numbers of a list whose length is right; checked, not copied.
static WeirStatus check_list(WeirScene *scene, const WeirSceneKey *key, const char *path,
                             const WeirValue *value, size_t count)
{
    if (value->kind != WEIR_VALUE_LIST || value->count != count) {
        static const char *const wanted[] = {"a list of 2 numbers, [x, y]", "a list of 3 numbers, [x, y, z]"};
        return weir_wrong_type(scene, path, value, wanted[count == 3]);
    }
    for (size_t k = 0; k < count; ++k) {
        WeirStatus status = check_range(scene, path, key, value->numbers[k]);
        if (status) return status;
    }
    return WEIR_OK;
}

static WeirStatus set_vector(WeirScene *scene, double *field, const WeirSceneKey *key, const char *path,
                             const WeirValue *value)
{
    WeirStatus status = check_list(scene, key, path, value, scene->dimension);
    if (!status) memcpy(field, value->numbers, scene->dimension * sizeof *field);
    return status;
}

static WeirStatus set_spin(WeirScene *scene, double *field, const WeirSceneKey *key, const char *path,
                           const WeirValue *value)
{
    return scene->dimension == 3 ? set_vector(scene, field, key, path, value)
                                 : set_number(scene, &field[2], key, path, value);
}

static WeirStatus set_boolean(WeirScene *scene, bool *field, const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_BOOLEAN) return weir_wrong_type(scene, path, value, "true or false");
    *field = value->numbers[0] != 0.0;
    return WEIR_OK;
}

static WeirStatus set_name(WeirScene *scene, char *field, const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
    size_t length = strlen(value->text);
    if (length == 0 || length >= WEIR_NAME_LENGTH) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: has %zu characters; allowed are 1 to %d",
                         path, length, WEIR_NAME_LENGTH - 1);
    }
    memset(field, 0, WEIR_NAME_LENGTH);
    memcpy(field, value->text, length);
    return WEIR_OK;
}

static WeirStatus set_choice(WeirScene *scene, int *field, const WeirSceneKey *key, const char *path,
                             const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
    int index = weir_choice_index(key->choices, value->text);
    if (index < 0) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: is \"%.40s\"; must be one of %s", path,
                         value->text, key->choices);
    }
    *field = index;
    return WEIR_OK;
}

static WeirStatus bad_axes(WeirScene *scene, const char *path, const WeirValue *value, const char *example)
{
    return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                     "%.80s: is \"%.40s\"; must be some of the %u axes, each once, as in \"%s\"", path,
                     value->text, scene->dimension, example);
}

// "xz"; "fixed_rotation" of 2D names z, which is no axis of the plane.
static WeirStatus set_axes(WeirScene *scene, bool *field, const WeirSceneKey *key, const char *path,
                           const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
    bool about_z = scene->dimension == 2 && strcmp(key->name, "fixed_rotation") == 0;
    bool axes[3] = {false, false, false};
    for (const char *letter = value->text; *letter; ++letter) {
        int axis = *letter - 'x';
        bool known = axis >= 0 && axis < (int)scene->dimension;
        if (about_z) known = axis == 2;
        if (!known || axes[axis]) return bad_axes(scene, path, value, about_z ? "z" : "xy");
        axes[axis] = true;
    }
    memcpy(field, axes, sizeof axes);
    return WEIR_OK;
}

static WeirStatus set_sides(WeirScene *scene, bool (*field)[2], const char *path, const WeirValue *value)
{
    if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
    bool sides[3][2] = {{false}};
    const char *text = value->text;
    while (*text) {
        if (*text == ' ') {
            ++text;
            continue;
        }
        int axis = text[1] - 'x';
        bool known = (text[0] == '-' || text[0] == '+') && axis >= 0 && axis < (int)scene->dimension;
        if (!known || (text[2] != ' ' && text[2] != '\0') || sides[axis][text[0] == '+']) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                             "%.80s: is \"%.40s\"; must be some sides, each once, as in \"+y -x\"", path,
                             value->text);
        }
        sides[axis][text[0] == '+'] = true;
        text += 2;
    }
    memcpy(field, sides, sizeof sides);
    return WEIR_OK;
}

// ---- Lists of points, triangles and rows: one item, "[3]", or all at once as a flat list ----

// Room for item `count`; arrays grow by powers of two.
static bool reserve(void *memory, uint32_t *capacity, size_t count, size_t size)
{
    void **array = memory;
    if (count <= *capacity) return true;
    size_t wanted = *capacity ? *capacity : 8;
    while (wanted < count) wanted *= 2;
    void *grown = realloc(*array, wanted * size);
    if (!grown) return false;
    *array = grown;
    *capacity = (uint32_t)wanted;
    return true;
}

typedef struct ItemList {
    void *array; // address of the pointer
    uint32_t *count, *capacity;
    size_t size;      // bytes of an item
    size_t numbers;   // numbers of an item
    const char *item; // what it is called
} ItemList;

static ItemList list_of(const WeirScene *scene, void *owner, const WeirSceneKey *key)
{
    WeirShape *shape = (WeirShape *)((char *)owner + key->offset);
    WeirMesh *mesh = (WeirMesh *)((char *)owner + key->offset);
    WeirMotion *motion = (WeirMotion *)((char *)owner + key->offset);
    switch (key->kind) {
    case WEIR_KEY_POINTS:
        return (ItemList){&shape->points, &shape->point_count, &shape->point_capacity, 2 * sizeof(double), 2,
                          "corners"};
    case WEIR_KEY_VERTICES:
        return (ItemList){&mesh->vertices, &mesh->vertex_count, &mesh->vertex_capacity, 3 * sizeof(double), 3,
                          "vertices"};
    case WEIR_KEY_TRIANGLES:
        return (ItemList){
            &mesh->triangles, &mesh->triangle_count, &mesh->triangle_capacity, 3 * sizeof(uint32_t), 3,
            "triangles"};
    default:
        return (ItemList){&motion->rows,
                          &motion->row_count,
                          &motion->row_capacity,
                          sizeof(WeirMotionRow),
                          scene->dimension == 3 ? 7 : 4,
                          "rows"};
    }
}

static WeirStatus check_item(WeirScene *scene, const WeirSceneKey *key, const char *path,
                             const double *numbers, size_t count)
{
    static const WeirSceneKey row = {.low = -1e6, .high = 1e6};
    for (size_t k = 0; k < count; ++k) {
        WeirStatus status = check_range(scene, path, key->kind == WEIR_KEY_ROWS ? &row : key, numbers[k]);
        if (status) return status;
        if (key->kind == WEIR_KEY_TRIANGLES && floor(numbers[k]) != numbers[k]) {
            return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: %g is no index; must be a whole number",
                             path, numbers[k]);
        }
    }
    return WEIR_OK;
}

static void store_item(const WeirSceneKey *key, void *item, const double *numbers, size_t count)
{
    if (key->kind == WEIR_KEY_TRIANGLES) {
        for (int k = 0; k < 3; ++k) ((uint32_t *)item)[k] = (uint32_t)numbers[k];
    } else if (key->kind == WEIR_KEY_ROWS) {
        WeirMotionRow row = {.time = (float)numbers[0]};
        uint32_t axes = count == 7 ? 3 : 2;
        for (uint32_t k = 0; k < axes; ++k) row.displacement[k] = (float)numbers[1 + k];
        if (axes == 2) row.rotation[2] = (float)numbers[3];
        for (uint32_t k = 0; axes == 3 && k < 3; ++k) row.rotation[k] = (float)numbers[4 + k];
        *(WeirMotionRow *)item = row;
    } else {
        memcpy(item, numbers, count * sizeof *numbers);
    }
}

static WeirStatus wrong_item(WeirScene *scene, const char *path, const WeirValue *value, const ItemList *list)
{
    static const char *const wanted[] = {[2] = "a list of 2 numbers, [x, y]",
                                         [3] = "a list of 3 numbers",
                                         [4] = "a list of 4 numbers, [t, dx, dy, angle]",
                                         [7] = "a list of 7 numbers, [t, dx, dy, dz, rx, ry, rz]"};
    return weir_wrong_type(scene, path, value, wanted[list->numbers]);
}

static WeirStatus set_items(WeirScene *scene, void *owner, const WeirSceneKey *key, const char *path,
                            const char *rest, const WeirValue *value)
{
    enum { MOST_ITEMS = 1 << 26 };
    ItemList list = list_of(scene, owner, key);
    const char *end = rest;
    bool all = *rest == '\0';
    long first = all ? 0 : weir_path_index(rest, &end);
    if (first < 0 || *end != '\0') {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: unknown key; the %s are numbered [0], [1]",
                         path, list.item);
    }
    if (all && value->kind != WEIR_VALUE_LIST) return weir_wrong_type(scene, path, value, "a list of lists");
    if (value->kind != WEIR_VALUE_LIST || value->count == 0 || value->count % list.numbers != 0 ||
        (!all && value->count != list.numbers)) {
        return wrong_item(scene, path, value, &list);
    }
    size_t items = value->count / list.numbers;
    if ((size_t)first + items > MOST_ITEMS || first > (long)*list.count) {
        return weir_fail(&scene->error, WEIR_ERROR_INPUT, "%.80s: %s are made in order, the next is [%u]",
                         path, list.item, *list.count);
    }
    WeirStatus status = check_item(scene, key, path, value->numbers, value->count);
    if (status) return status;
    if (!reserve(list.array, list.capacity, (size_t)first + items, list.size)) {
        return weir_fail(&scene->error, WEIR_ERROR_MEMORY, "%.80s: memory ran out", path);
    }
    for (size_t n = 0; n < items; ++n) {
        store_item(key, *(char **)list.array + ((size_t)first + n) * list.size,
                   value->numbers + n * list.numbers, list.numbers);
    }
    if (all || (size_t)first + 1 > *list.count) *list.count = (uint32_t)(first + items);
    return WEIR_OK;
}

WeirStatus weir_field_set(WeirScene *scene, void *owner, const WeirSceneKey *key, const char *path,
                          const char *rest, const WeirValue *value)
{
    void *field = (char *)owner + key->offset;
    switch (key->kind) {
    case WEIR_KEY_NUMBER:
        return set_number(scene, field, key, path, value);
    case WEIR_KEY_WHOLE:
        return set_whole(scene, field, key, path, value);
    case WEIR_KEY_VECTOR:
        return set_vector(scene, field, key, path, value);
    case WEIR_KEY_SPIN:
        return set_spin(scene, field, key, path, value);
    case WEIR_KEY_BOOLEAN:
        return set_boolean(scene, field, path, value);
    case WEIR_KEY_NAME:
        return set_name(scene, field, path, value);
    case WEIR_KEY_CHOICE:
        return set_choice(scene, field, key, path, value);
    case WEIR_KEY_AXES:
        return set_axes(scene, field, key, path, value);
    case WEIR_KEY_SIDES:
        return set_sides(scene, field, path, value);
    case WEIR_KEY_FILE:
        if (value->kind != WEIR_VALUE_TEXT) return weir_wrong_type(scene, path, value, "a text");
        return weir_fail(&scene->error, WEIR_ERROR_INPUT,
                         "%.80s: \"%.60s\": files are read by the command line only; give %s here instead",
                         path, value->text,
                         key->owner == WEIR_OWNER_MESH ? "vertices and triangles" : "rows");
    default:
        return set_items(scene, owner, key, path, rest, value);
    }
}
