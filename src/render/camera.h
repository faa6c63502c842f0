// The camera of a picture in 3D.
#pragma once

#include "weir/weir_render.h"

typedef struct WeirCameraAxes {
    float eye[3];                    // m
    float right[3], up[3], ahead[3]; // unit vectors
    float focal[2];                  // clip.xy = focal * view.xy + shift * view.z
    float shift[2];
    float near; // m
} WeirCameraAxes;

WeirCameraAxes weir_camera_axes(const WeirView *view, uint32_t width, uint32_t height);

static inline float weir_dot3(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
