// Every key of a scene file but its parameters, once: the setters (scene_path.c), the messages and the JSON
// Schema (apps/cli/schema.c) follow this list.
#pragma once

#include "core/scene.h"

// Objects that hold keys.
typedef enum WeirOwner {
    WEIR_OWNER_DOMAIN,
    WEIR_OWNER_FLUID,
    WEIR_OWNER_WALL,
    WEIR_OWNER_BODY,
    WEIR_OWNER_EMITTER,
    WEIR_OWNER_DRAIN,
    WEIR_OWNER_PROBE,
    WEIR_OWNER_MOTION,
    WEIR_OWNER_BOX,
    WEIR_OWNER_BALL,
    WEIR_OWNER_CYLINDER,
    WEIR_OWNER_MESH,
} WeirOwner;

typedef enum WeirKeyKind {
    WEIR_KEY_NUMBER,    // double
    WEIR_KEY_WHOLE,     // uint32_t
    WEIR_KEY_VECTOR,    // double[3]: a list of 2 or 3 numbers, as the dimension
    WEIR_KEY_SPIN,      // double[3]: a number in 2D, about z; a list of 3 in 3D
    WEIR_KEY_BOOLEAN,   // bool
    WEIR_KEY_NAME,      // char[WEIR_NAME_LENGTH]
    WEIR_KEY_CHOICE,    // int: index of one of `choices`
    WEIR_KEY_AXES,      // bool[3]: letters of axes
    WEIR_KEY_SIDES,     // bool[3][2]: "+y -x"
    WEIR_KEY_POINTS,    // WeirShape: corners of the polygon
    WEIR_KEY_VERTICES,  // WeirMesh
    WEIR_KEY_TRIANGLES, // WeirMesh
    WEIR_KEY_ROWS,      // WeirMotion
    WEIR_KEY_FILE,      // read by the native loader (src/json), which then sets the lists
    WEIR_KEY_OBJECT,    // keys of `object`
} WeirKeyKind;

typedef struct WeirSceneKey {
    WeirOwner owner;
    const char *name;
    WeirKeyKind kind;
    size_t offset;     // of the field in its owner's struct
    size_t has_offset; // of the bool that says that it was given, plus 1; 0: none
    double low, high;  // allowed range of each number; low itself is excluded if `above`
    bool above;
    WeirOwner object;
    WeirShapeKind shape; // that this key chooses for its piece
    const char *choices; // WEIR_KEY_CHOICE: names separated by '|'
    const char *help;
} WeirSceneKey;

extern const WeirSceneKey weir_scene_keys[];
extern const size_t weir_scene_key_count;

// A list of pieces.
typedef struct WeirSceneList {
    const char *name;
    WeirOwner owner;
    size_t offset, count_offset; // in WeirScene
    size_t size;
    uint32_t most;
    const char *item;   // what a piece is called
    const char *wanted; // what each must have
    const char *help;
} WeirSceneList;

enum { WEIR_SCENE_LISTS = 6 };
extern const WeirSceneList weir_scene_lists[WEIR_SCENE_LISTS];

// Coordinates and speeds beyond these are slips of the keyboard.
#define WEIR_COORDINATE_LIMIT 1e5
#define WEIR_SPEED_LIMIT      1e5

// Index of `text` among names separated by '|', -1 if it is none of them.
int weir_choice_index(const char *choices, const char *text);
// Frees what a piece owns.
void weir_piece_free(WeirOwner owner, void *piece);
// Replaces what a copied piece owns by copies; false if memory ran out (the piece owns nothing then).
bool weir_piece_copy_owned(WeirOwner owner, void *piece);
