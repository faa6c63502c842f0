#include "render/camera.h"

#include <math.h>

// The near plane's distance in units of the camera's from its target: with depth = near / z in float nothing is lost
// by a small one.
static const float near_share = 0.02f;

WeirCameraAxes weir_camera_axes(const WeirView *view, uint32_t width, uint32_t height)
{
    float sy = sinf(view->camera_yaw), cy = cosf(view->camera_yaw);
    float sp = sinf(view->camera_pitch), cp = cosf(view->camera_pitch);
    float focal = 1.0f / tanf(0.5f * view->camera_field_of_view);
    WeirCameraAxes axes = {
        .right = {cy, 0.0f, -sy},
        .up = {-sy * sp, cp, -cy * sp},
        .ahead = {-sy * cp, -sp, -cy * cp},
        .focal = {focal * (float)height / (float)width, focal},
        .shift = {view->camera_shift[0], view->camera_shift[1]},
        .near = near_share * view->camera_distance,
    };
    for (int k = 0; k < 3; k++) {
        axes.eye[k] = view->camera_target[k] - view->camera_distance * axes.ahead[k];
    }
    return axes;
}

void weir_view_matrix(const WeirView *view, uint32_t width, uint32_t height, float matrix[16])
{
    WeirCameraAxes axes = weir_camera_axes(view, width, height);
    float rows[4][4];
    for (int k = 0; k < 3; k++) {
        rows[0][k] = axes.focal[0] * axes.right[k] + axes.shift[0] * axes.ahead[k];
        rows[1][k] = axes.focal[1] * axes.up[k] + axes.shift[1] * axes.ahead[k];
        rows[2][k] = 0.0f;
        rows[3][k] = axes.ahead[k];
    }
    for (int row = 0; row < 4; row++) rows[row][3] = -weir_dot3(rows[row], axes.eye);
    rows[2][3] = axes.near;
    for (int row = 0; row < 4; row++) {
        for (int column = 0; column < 4; column++) matrix[4 * column + row] = rows[row][column];
    }
}

void weir_view_ray(const WeirView *view, uint32_t width, uint32_t height, float x, float y, float origin[3],
                   float direction[3])
{
    WeirCameraAxes axes = weir_camera_axes(view, width, height);
    float clip[2] = {2.0f * x / (float)width - 1.0f, 1.0f - 2.0f * y / (float)height};
    float across = (clip[0] - axes.shift[0]) / axes.focal[0];
    float above = (clip[1] - axes.shift[1]) / axes.focal[1];
    float length = sqrtf(1.0f + across * across + above * above);
    for (int k = 0; k < 3; k++) {
        origin[k] = axes.eye[k];
        direction[k] = (axes.ahead[k] + across * axes.right[k] + above * axes.up[k]) / length;
    }
}
