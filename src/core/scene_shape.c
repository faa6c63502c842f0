#include "core/scene_shape.h"

#include <string.h>

const char *weir_shape_missing(const WeirShape *shape)
{
    if (shape->kind == WEIR_SHAPE_NONE) return "box or ball";
    if (shape->kind == WEIR_SHAPE_BOX && !shape->has_max) return "box.max";
    if (shape->kind == WEIR_SHAPE_BOX && !shape->has_min) return "box.min";
    if (shape->kind == WEIR_SHAPE_BALL && !shape->has_radius) return "ball.radius";
    if (shape->kind == WEIR_SHAPE_BALL && !shape->has_center) return "ball.center";
    return NULL;
}

void weir_shape_bounds(const WeirShape *shape, uint32_t dimension, double low[3], double high[3])
{
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        bool is_ball = shape->kind == WEIR_SHAPE_BALL;
        low[axis] = is_ball ? shape->center[axis] - shape->radius : shape->min[axis];
        high[axis] = is_ball ? shape->center[axis] + shape->radius : shape->max[axis];
    }
}

bool weir_shape_contains(const WeirShape *shape, uint32_t dimension, const double *point)
{
    double distance2 = 0.0;
    for (uint32_t axis = 0; axis < dimension; ++axis) {
        if (shape->kind == WEIR_SHAPE_BOX &&
            !(point[axis] >= shape->min[axis] && point[axis] <= shape->max[axis]))
            return false;
        double d = point[axis] - shape->center[axis];
        distance2 += d * d;
    }
    return shape->kind == WEIR_SHAPE_BOX || distance2 <= shape->radius * shape->radius;
}
