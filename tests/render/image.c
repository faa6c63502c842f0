#include "image.h"

#include <stdlib.h>
#include <string.h>

bool weir_image_create(WeirImage *image, WeirGpu *gpu, WGPUTextureFormat format, uint32_t width,
                       uint32_t height)
{
    *image = (WeirImage){.gpu = gpu, .format = format, .width = width, .height = height};
    image->row_bytes = (width * 4 + 255) / 256 * 256; // copies from textures need rows of 256 bytes
    WGPUDevice device = weir_gpu_wgpu_device(gpu);
    image->texture =
        wgpuDeviceCreateTexture(device, &(WGPUTextureDescriptor){.usage = WGPUTextureUsage_RenderAttachment |
                                                                          WGPUTextureUsage_CopySrc,
                                                                 .dimension = WGPUTextureDimension_2D,
                                                                 .size = {width, height, 1},
                                                                 .format = format,
                                                                 .mipLevelCount = 1,
                                                                 .sampleCount = 1});
    image->buffer = wgpuDeviceCreateBuffer(
        device, &(WGPUBufferDescriptor){.usage = WGPUBufferUsage_CopyDst | WGPUBufferUsage_MapRead,
                                        .size = (uint64_t)image->row_bytes * height});
    image->pixels = malloc((size_t)width * height * 4);
    if (!image->texture || !image->buffer || !image->pixels) return false;
    image->view = wgpuTextureCreateView(image->texture, NULL);
    return image->view != NULL;
}

typedef struct MapResult {
    bool done, good;
} MapResult;

static void mapped(WGPUMapAsyncStatus status, WGPUStringView message, void *result, void *unused)
{
    (void)message;
    (void)unused;
    *(MapResult *)result = (MapResult){.done = true, .good = status == WGPUMapAsyncStatus_Success};
}

static void copy_rows(WeirImage *image, const uint8_t *rows)
{
    bool swap =
        image->format == WGPUTextureFormat_BGRA8Unorm || image->format == WGPUTextureFormat_BGRA8UnormSrgb;
    for (uint32_t y = 0; y < image->height; y++) {
        uint8_t *to = image->pixels + (size_t)y * image->width * 4;
        memcpy(to, rows + (size_t)y * image->row_bytes, (size_t)image->width * 4);
        for (uint32_t x = 0; swap && x < image->width; x++) {
            uint8_t blue = to[4 * x];
            to[4 * x] = to[4 * x + 2];
            to[4 * x + 2] = blue;
        }
    }
}

// NULL if the device fails.
static const void *map(WeirGpu *gpu, WGPUBuffer buffer, size_t bytes)
{
    MapResult result = {.done = false};
    wgpuBufferMapAsync(buffer, WGPUMapMode_Read, 0, bytes,
                       (WGPUBufferMapCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                   .callback = mapped,
                                                   .userdata1 = &result});
    while (!result.done) {
        // The device's poll moves work on, the instance's events bring the answer.
        if (weir_gpu_poll(gpu) != WEIR_OK) return NULL;
        wgpuInstanceProcessEvents(weir_gpu_wgpu_instance(gpu));
    }
    return result.good ? wgpuBufferGetConstMappedRange(buffer, 0, bytes) : NULL;
}

static void submit(WeirGpu *gpu, WGPUCommandEncoder encoder)
{
    WGPUCommandBuffer commands = wgpuCommandEncoderFinish(encoder, NULL);
    wgpuQueueSubmit(weir_gpu_wgpu_queue(gpu), 1, &commands);
    wgpuCommandBufferRelease(commands);
    wgpuCommandEncoderRelease(encoder);
}

bool weir_image_read(WeirImage *image)
{
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(weir_gpu_wgpu_device(image->gpu), NULL);
    WGPUTexelCopyTextureInfo source = {.texture = image->texture, .aspect = WGPUTextureAspect_All};
    WGPUTexelCopyBufferInfo target = {
        .buffer = image->buffer, .layout = {.bytesPerRow = image->row_bytes, .rowsPerImage = image->height}};
    WGPUExtent3D size = {image->width, image->height, 1};
    wgpuCommandEncoderCopyTextureToBuffer(encoder, &source, &target, &size);
    submit(image->gpu, encoder);
    size_t bytes = (size_t)image->row_bytes * image->height;
    const uint8_t *rows = map(image->gpu, image->buffer, bytes);
    if (rows) copy_rows(image, rows);
    wgpuBufferUnmap(image->buffer);
    return rows != NULL;
}

bool weir_buffer_read(WeirGpu *gpu, WGPUBuffer source, void *data, size_t bytes)
{
    WGPUDevice device = weir_gpu_wgpu_device(gpu);
    WGPUBuffer buffer = wgpuDeviceCreateBuffer(
        device,
        &(WGPUBufferDescriptor){.usage = WGPUBufferUsage_CopyDst | WGPUBufferUsage_MapRead, .size = bytes});
    if (!buffer) return false;
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(device, NULL);
    wgpuCommandEncoderCopyBufferToBuffer(encoder, source, 0, buffer, 0, bytes);
    submit(gpu, encoder);
    const void *found = map(gpu, buffer, bytes);
    if (found) memcpy(data, found, bytes);
    wgpuBufferUnmap(buffer);
    wgpuBufferRelease(buffer);
    return found != NULL;
}

void weir_image_destroy(WeirImage *image)
{
    if (image->view) wgpuTextureViewRelease(image->view);
    if (image->texture) wgpuTextureRelease(image->texture);
    if (image->buffer) wgpuBufferRelease(image->buffer);
    free(image->pixels);
    *image = (WeirImage){.pixels = NULL};
}
