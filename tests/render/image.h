// A picture on the device that can be read back.
#pragma once

#include "gpu/gpu.h"

typedef struct WeirImage {
    WeirGpu *gpu;
    WGPUTextureFormat format; // 8-bit RGBA or BGRA
    uint32_t width, height, row_bytes;
    WGPUTexture texture;
    WGPUTextureView view; // target for weir_renderer_draw()
    WGPUBuffer buffer;
    uint8_t *pixels; // RGBA, width * height * 4 bytes, top row first; filled by weir_image_read()
} WeirImage;

// False if the device or memory fails.
bool weir_image_create(WeirImage *image, WeirGpu *gpu, WGPUTextureFormat format, uint32_t width,
                       uint32_t height);
bool weir_image_read(WeirImage *image);
void weir_image_destroy(WeirImage *image);
// The first bytes of a buffer that can be copied from. False if the device fails.
bool weir_buffer_read(WeirGpu *gpu, WGPUBuffer source, void *data, size_t bytes);
