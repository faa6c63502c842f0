// From nothing to a ready device, without ever blocking:
//
//   weir_gpu_create --> adapter asked for --> device asked for --> measured --> ready --> lost
//                            (callbacks, run by weir_gpu_poll)
//
// The first error is kept: what follows a lost device or a failed shader is only noise.
#include "gpu/device.h"
#include "gpu/parallelism.h"
#include "gpu/platform.h"
#include "gpu/solvers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

WGPUStringView weir_gpu_text(const char *text)
{
    return (WGPUStringView){text, strlen(text)};
}

// Length of a message that may be empty or 0-terminated, for "%.*s".
static int length_of(WGPUStringView text)
{
    if (!text.data) return 0;
    size_t length = text.length == WGPU_STRLEN ? strlen(text.data) : text.length;
    return length < 400 ? (int)length : 400;
}

static void fail(WeirGpu *gpu, WeirStatus status, const char *what, WGPUStringView text)
{
    if (gpu->status != WEIR_OK && gpu->status != WEIR_PENDING) return;
    const char *data = text.data ? text.data : "";
    gpu->status = weir_fail(&gpu->message, status, "%s%s%.*s", what, length_of(text) ? ": " : "",
                            length_of(text), data);
}

// Frees what is left once nobody can call back any more.
static void free_if_unused(WeirGpu *gpu)
{
    if (gpu->destroyed && (gpu->callbacks == 0 || weir_platform_can_wait())) free(gpu);
}

static void on_lost(WGPUDevice const *device, WGPUDeviceLostReason reason, WGPUStringView text,
                    void *userdata1, void *userdata2)
{
    (void)device, (void)userdata2;
    WeirGpu *gpu = userdata1;
    --gpu->callbacks;
    if (!gpu->destroyed) {
        const char *what = reason == WGPUDeviceLostReason_Destroyed
                               ? "the GPU device was destroyed; make a new one with weir_gpu_create()"
                               : "the GPU device was lost; make a new one with weir_gpu_create()";
        fail(gpu, WEIR_ERROR_DEVICE, what, text);
        return;
    }
    if (!weir_platform_can_wait()) free_if_unused(gpu);
}

static void on_error(WGPUDevice const *device, WGPUErrorType type, WGPUStringView text, void *userdata1,
                     void *userdata2)
{
    (void)device, (void)userdata2;
    WeirGpu *gpu = userdata1;
    if (type == WGPUErrorType_OutOfMemory) {
        fail(gpu, WEIR_ERROR_MEMORY, "the GPU is out of memory; use fewer particles", text);
    } else {
        fail(gpu, WEIR_ERROR_DEVICE, "the GPU refused a command", text);
    }
}

static void on_device(WGPURequestDeviceStatus status, WGPUDevice device, WGPUStringView text, void *userdata1,
                      void *userdata2)
{
    (void)userdata2;
    WeirGpu *gpu = userdata1;
    --gpu->callbacks;
    if (gpu->destroyed) {
        if (device) wgpuDeviceRelease(device);
        free_if_unused(gpu);
        return;
    }
    if (status != WGPURequestDeviceStatus_Success) {
        fail(gpu, WEIR_ERROR_DEVICE, "the GPU gives no device", text);
        return;
    }
    gpu->device = device;
    gpu->queue = wgpuDeviceGetQueue(device);
    gpu->status = WEIR_OK;
}

static bool contains_any(const char *text, const char *const *words)
{
    for (; *words; ++words) {
        if (strstr(text, *words)) return true;
    }
    return false;
}

// Keeps the adapter's name; false if it is one that computes nothing.
static bool describe_adapter(WeirGpu *gpu)
{
    static const char *const software[] = {"llvmpipe",     "lavapipe", "SwiftShader", "swiftshader",
                                           "Basic Render", "WARP",     NULL};
    WGPUAdapterInfo info = {0};
    if (wgpuAdapterGetInfo(gpu->adapter, &info) != WGPUStatus_Success) return true;
    // Browsers hide the device's name and give the vendor and an architecture instead.
    WGPUStringView first = length_of(info.device) ? info.device : info.vendor;
    WGPUStringView second = length_of(info.device) ? (WGPUStringView){NULL, 0} : info.architecture;
    if (!length_of(first)) first = info.description;
    snprintf(gpu->name, sizeof gpu->name, "%.*s%s%.*s", length_of(first), first.data ? first.data : "",
             length_of(first) && length_of(second) ? " " : "", length_of(second),
             second.data ? second.data : "");
    if (!gpu->name[0]) snprintf(gpu->name, sizeof gpu->name, "unnamed GPU");
    char description[128];
    snprintf(description, sizeof description, "%.*s", length_of(info.description),
             info.description.data ? info.description.data : "");
    gpu->software = info.adapterType == WGPUAdapterType_CPU || contains_any(gpu->name, software) ||
                    contains_any(description, software);
    bool computes = info.backendType != WGPUBackendType_Null;
    wgpuAdapterInfoFreeMembers(info);
    return computes;
}

static void request_device(WeirGpu *gpu)
{
    static const WGPUFeatureName timestamp_query = WGPUFeatureName_TimestampQuery;
    gpu->timestamps = !gpu->options.no_timestamps && wgpuAdapterHasFeature(gpu->adapter, timestamp_query);
    WGPUDeviceDescriptor descriptor = {
        .label = weir_gpu_text("weir"),
        .requiredFeatureCount = gpu->timestamps,
        .requiredFeatures = &timestamp_query,
        .requiredLimits = &gpu->limits,
        .defaultQueue.label = weir_gpu_text("weir"),
        .deviceLostCallbackInfo = {.mode = WGPUCallbackMode_AllowProcessEvents,
                                   .callback = on_lost,
                                   .userdata1 = gpu},
        .uncapturedErrorCallbackInfo = {.callback = on_error, .userdata1 = gpu},
    };
    gpu->callbacks += 2; // the device, and some day its loss
    wgpuAdapterRequestDevice(gpu->adapter, &descriptor,
                             (WGPURequestDeviceCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                             .callback = on_device,
                                                             .userdata1 = gpu});
}

static void on_adapter(WGPURequestAdapterStatus status, WGPUAdapter adapter, WGPUStringView text,
                       void *userdata1, void *userdata2)
{
    (void)userdata2;
    WeirGpu *gpu = userdata1;
    --gpu->callbacks;
    if (gpu->destroyed) {
        if (adapter) wgpuAdapterRelease(adapter);
        free_if_unused(gpu);
        return;
    }
    if (status != WGPURequestAdapterStatus_Success || !adapter) {
        fail(gpu, WEIR_ERROR_DEVICE, "no GPU was found; use the CPU backend or install a Vulkan driver",
             text);
        return;
    }
    gpu->adapter = adapter;
    if (!describe_adapter(gpu)) {
        fail(gpu, WEIR_ERROR_DEVICE,
             "only a Null adapter was found, which computes nothing; use the CPU backend",
             (WGPUStringView){NULL, 0});
        return;
    }
    if (wgpuAdapterGetLimits(adapter, &gpu->limits) != WGPUStatus_Success) {
        fail(gpu, WEIR_ERROR_DEVICE, "the GPU does not tell its limits", (WGPUStringView){NULL, 0});
        return;
    }
    gpu->max_groups =
        gpu->limits.maxComputeWorkgroupsPerDimension - 2; // up to two more: weir_pass_dispatch_turn()
    request_device(gpu);
}

WeirGpu *weir_gpu_create(const WeirGpuOptions *options)
{
    WeirGpu *gpu = calloc(1, sizeof *gpu);
    if (!gpu) return NULL;
    if (options) gpu->options = *options;
    if (gpu->options.parallelism_device)
        snprintf(gpu->told_device, sizeof gpu->told_device, "%s", gpu->options.parallelism_device);
    gpu->options.parallelism_device = NULL; // the caller's
    gpu->status = WEIR_PENDING;
    gpu->backend = (WeirGpuBackend){{.name = "gpu", .create_solver = weir_gpu_create_solver}, gpu};
    gpu->instance = weir_platform_create_instance();
    if (!gpu->instance) {
        fail(gpu, WEIR_ERROR_DEVICE, "WebGPU is not available here; use the CPU backend",
             (WGPUStringView){NULL, 0});
        return gpu;
    }
    WGPURequestAdapterOptions request = {
        .featureLevel = WGPUFeatureLevel_Core,
        .powerPreference =
            gpu->options.low_power ? WGPUPowerPreference_LowPower : WGPUPowerPreference_HighPerformance,
    };
    ++gpu->callbacks;
    wgpuInstanceRequestAdapter(gpu->instance, &request,
                               (WGPURequestAdapterCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                                .callback = on_adapter,
                                                                .userdata1 = gpu});
    return gpu;
}

void weir_gpu_destroy(WeirGpu *gpu)
{
    if (!gpu) return;
    gpu->destroyed = true;
    ++gpu->callbacks; // this one: the instance's release may run all others, and the last one frees
    weir_parallelism_destroy(gpu->measuring);
    weir_pipelines_release(&gpu->pipelines);
    if (gpu->queue) wgpuQueueRelease(gpu->queue);
    if (gpu->device) {
        wgpuDeviceDestroy(gpu->device);
        wgpuDeviceRelease(gpu->device);
    }
    if (gpu->adapter) wgpuAdapterRelease(gpu->adapter);
    if (gpu->instance) wgpuInstanceRelease(gpu->instance);
    --gpu->callbacks;
    free_if_unused(gpu);
}

WeirStatus weir_gpu_poll(WeirGpu *gpu)
{
    if (gpu->instance) wgpuInstanceProcessEvents(gpu->instance);
    if (gpu->status == WEIR_OK && !weir_parallelism_poll(gpu)) return WEIR_PENDING;
    return gpu->status;
}

WeirStatus weir_gpu_wait(WeirGpu *gpu)
{
    while (weir_gpu_poll(gpu) == WEIR_PENDING) {
        if (!weir_platform_wait(gpu)) break;
    }
    return gpu->status;
}

const char *weir_gpu_error(const WeirGpu *gpu)
{
    return gpu->message.text;
}

const char *weir_gpu_device(const WeirGpu *gpu)
{
    return gpu->name;
}

bool weir_gpu_is_software(const WeirGpu *gpu)
{
    return gpu->software;
}

const WeirBackend *weir_gpu_backend(WeirGpu *gpu)
{
    return gpu->status == WEIR_OK && gpu->parallelism > 0 ? &gpu->backend.base : NULL;
}

uint32_t weir_gpu_parallelism(const WeirGpu *gpu)
{
    return gpu->parallelism;
}

uint64_t weir_gpu_memory(const WeirGpu *gpu)
{
    return gpu->memory;
}

WGPUDevice weir_gpu_wgpu_device(WeirGpu *gpu)
{
    return gpu->device;
}

WGPUQueue weir_gpu_wgpu_queue(WeirGpu *gpu)
{
    return gpu->queue;
}

WGPUInstance weir_gpu_wgpu_instance(WeirGpu *gpu)
{
    return gpu->instance;
}

WeirStatus weir_gpu_check(const WeirGpu *gpu, WeirMessage *message)
{
    if (gpu->status == WEIR_OK) return WEIR_OK;
    *message = gpu->message;
    return gpu->status;
}

WGPUBuffer weir_gpu_create_buffer(WeirGpu *gpu, const char *label, WGPUBufferUsage usage, uint64_t size)
{
    WGPUBufferDescriptor descriptor = {.label = weir_gpu_text(label), .usage = usage, .size = size};
    WGPUBuffer buffer = wgpuDeviceCreateBuffer(gpu->device, &descriptor);
    if (buffer) gpu->memory += size;
    return buffer;
}

void weir_gpu_destroy_buffer(WeirGpu *gpu, WGPUBuffer buffer, uint64_t size)
{
    if (!buffer) return;
    wgpuBufferDestroy(buffer);
    wgpuBufferRelease(buffer);
    gpu->memory -= size;
}

void weir_gpu_submit(WeirGpu *gpu, WGPUCommandEncoder encoder, const char *label)
{
    WGPUCommandBufferDescriptor descriptor = {.label = weir_gpu_text(label)};
    WGPUCommandBuffer commands = wgpuCommandEncoderFinish(encoder, &descriptor);
    wgpuCommandEncoderRelease(encoder);
    if (!commands) return; // the uncaptured error says why
    // wgpu-native aborts the process if commands are submitted to a lost device; recording them
    // told of the loss.
    if (gpu->status == WEIR_OK) weir_platform_submit(gpu, commands);
    wgpuCommandBufferRelease(commands);
}
