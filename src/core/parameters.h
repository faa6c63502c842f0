// The two structs that every pass reads, expanded from params.inl and constants.inl. They are copied byte by
// byte into uniform buffers: WGSL declares the same fields in the same order (weir_wgsl_structs).
#pragma once

#include <stdalign.h>
#include <stddef.h>

#include "core/message.h"
#include "weir/weir.h"

typedef struct WeirParameters {
#define WEIR_VECTOR(name, unit, x, y, z, minimum, maximum, method, live, help) alignas(16) float name[4];
#define WEIR_NUMBER(name, unit, value, minimum, maximum, method, live, help)   float name;
#define WEIR_CHOICE(name, names, value, method, live, help)                    uint32_t name;
#include "core/params.inl"
} WeirParameters;

typedef struct WeirConstants {
#define WEIR_CONSTANT_VECTOR(name, help) alignas(16) float name[4];
#define WEIR_CONSTANT_PLACE(name, help)  alignas(16) int32_t name[4];
#define WEIR_CONSTANT_NUMBER(name, help) float name;
#define WEIR_CONSTANT_COUNT(name, help)  uint32_t name;
#include "core/constants.inl"
} WeirConstants;

// The values of the choices in params.inl, by index.
enum { WEIR_KERNELS_CONSISTENT, WEIR_KERNELS_TUTORIAL };
enum { WEIR_SEARCH_GRID, WEIR_SEARCH_ALL_PAIRS };
enum { WEIR_KERNEL_WENDLAND, WEIR_KERNEL_CUBIC, WEIR_KERNEL_QUINTIC };
enum { WEIR_EQUATION_LINEAR, WEIR_EQUATION_TAIT };
enum { WEIR_TENSION_CONTROL_OFF, WEIR_TENSION_CONTROL_ON };
enum { WEIR_WALL_FUNCTION_OFF, WEIR_WALL_FUNCTION_ON };
enum { WEIR_STEPPING_ADAPTIVE, WEIR_STEPPING_FIXED };

// WGSL text of `struct Parameters` and `struct Constants`, prepended to every shader.
extern const char weir_wgsl_structs[];

void weir_parameters_default(WeirParameters *parameters);
// Index of a parameter in the list, -1 if there is none of that name.
int weir_parameter_find(const char *name);
// Values as numbers: 1, 3 for a vector, the index of a choice. Returns how many.
uint32_t weir_parameter_get(const WeirParameters *parameters, uint32_t index, double values[3]);
// Checks and sets; `path` is the name that messages use. A vector takes 2 or 3 numbers.
WeirStatus weir_parameter_set(WeirParameters *parameters, uint32_t index, const char *path,
                              const double *values, size_t count, WeirMessage *message);
WeirStatus weir_parameter_set_choice(WeirParameters *parameters, uint32_t index, const char *path,
                                     const char *choice, WeirMessage *message);
WeirStatus weir_parameter_set_text(WeirParameters *parameters, uint32_t index, const char *text,
                                   WeirMessage *message);

// How many particles of the resting lattice lie within so many supports of one: as many as fit into that circle or ball.
double weir_lattice_neighbors(const WeirParameters *parameters, uint32_t dimension, double supports);

// Replaces the tool alone. `tool` NULL: none.
void weir_constants_set_tool(WeirConstants *constants, const WeirTool *tool);
