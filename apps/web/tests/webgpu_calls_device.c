// Instance, adapter, device, errors, shader messages; and how it all ends.
#include "webgpu_calls.h"

#include <string.h>

static int test_instance(uint32_t step)
{
    (void)step;
    WGPUInstanceFeatureName feature = WGPUInstanceFeatureName_TimedWaitAny;
    WGPUInstanceDescriptor waiting = {.requiredFeatureCount = 1, .requiredFeatures = &feature};
    CHECK(wgpuCreateInstance(&waiting) == NULL); // a browser cannot wait
    WGPUInstance other = wgpuCreateInstance(NULL);
    CHECK(other);
    wgpuInstanceRelease(other);
    world.instance = wgpuCreateInstance(NULL);
    CHECK(world.instance);
    return DONE;
}

static void on_adapter(WGPURequestAdapterStatus status, WGPUAdapter adapter, WGPUStringView message,
                       void *userdata1, void *userdata2)
{
    (void)message, (void)userdata2;
    *(WGPURequestAdapterStatus *)userdata1 = status;
    world.adapter = adapter;
}

static int test_adapter(uint32_t step)
{
    static WGPURequestAdapterStatus status;
    if (step == 0) {
        WGPURequestAdapterOptions options = {.featureLevel = WGPUFeatureLevel_Core,
                                             .powerPreference = WGPUPowerPreference_HighPerformance};
        WGPURequestAdapterCallbackInfo info = {
            .mode = WGPUCallbackMode_AllowSpontaneous, .callback = on_adapter, .userdata1 = &status};
        WGPUFuture first = wgpuInstanceRequestAdapter(world.instance, &options, info);
        CHECK(first.id);
    }
    if (step < 50) { // callbacks of every mode wait for wgpuInstanceProcessEvents()
        CHECK(!status);
        return PENDING;
    }
    wgpuInstanceProcessEvents(world.instance);
    if (!status) return PENDING;
    CHECK(status == WGPURequestAdapterStatus_Success);
    CHECK(world.adapter);
    return DONE;
}

static int test_info(uint32_t step)
{
    (void)step;
    WGPUAdapterInfo info = {0};
    CHECK(wgpuAdapterGetInfo(world.adapter, &info) == WGPUStatus_Success);
    CHECK(info.backendType == WGPUBackendType_WebGPU);
    CHECK(info.adapterType == WGPUAdapterType_CPU || info.adapterType == WGPUAdapterType_Unknown);
    CHECK(info.vendor.data && info.vendor.length == strlen(info.vendor.data) && info.vendor.length > 0);
    CHECK(info.architecture.data && info.architecture.length > 0);
    bool swiftshader = strcmp(info.architecture.data, "swiftshader") == 0;
    CHECK(!swiftshader || info.adapterType == WGPUAdapterType_CPU);
    wgpuAdapterInfoFreeMembers(info);
    return DONE;
}

// Every adapter has at least the limits that the WebGPU standard guarantees; they differ enough from each
// other to show two that are mixed up.
static int test_limits(uint32_t step)
{
    (void)step;
    WGPULimits limits = {0};
    CHECK(wgpuAdapterGetLimits(world.adapter, &limits) == WGPUStatus_Success);
    CHECK(limits.maxTextureDimension1D >= 8192 && limits.maxTextureDimension3D >= 2048);
    CHECK(limits.maxBindGroups >= 4 && limits.maxBindGroups < 64);
    CHECK(limits.maxBindingsPerBindGroup >= 1000);
    CHECK(limits.maxUniformBufferBindingSize >= 65536);
    CHECK(limits.maxStorageBufferBindingSize >= 134217728);
    CHECK(limits.minUniformBufferOffsetAlignment >= 32 && limits.minUniformBufferOffsetAlignment <= 256);
    CHECK(limits.minStorageBufferOffsetAlignment >= 32 && limits.minStorageBufferOffsetAlignment <= 256);
    CHECK(limits.maxVertexBuffers >= 8 && limits.maxVertexBuffers < 256);
    CHECK(limits.maxBufferSize >= 268435456);
    CHECK(limits.maxColorAttachments >= 8 && limits.maxColorAttachments < 64);
    CHECK(limits.maxComputeWorkgroupStorageSize >= 16384);
    CHECK(limits.maxComputeInvocationsPerWorkgroup >= 256);
    CHECK(limits.maxComputeWorkgroupSizeX >= 256 && limits.maxComputeWorkgroupSizeZ >= 64);
    CHECK(limits.maxComputeWorkgroupsPerDimension >= 65535);
    return DONE;
}

static int test_features(uint32_t step)
{
    (void)step;
    CHECK(wgpuAdapterHasFeature(world.adapter, WGPUFeatureName_CoreFeaturesAndLimits));
    CHECK(!wgpuAdapterHasFeature(world.adapter, (WGPUFeatureName)0x7000));
    return DONE;
}

static void on_device(WGPURequestDeviceStatus status, WGPUDevice device, WGPUStringView message,
                      void *userdata1, void *userdata2)
{
    *(WGPURequestDeviceStatus *)userdata1 = status;
    *(WGPUDevice *)userdata2 = device;
    if (message.length > 0) world.error_count++;
}

static void on_lost(WGPUDevice const *device, WGPUDeviceLostReason reason, WGPUStringView message,
                    void *userdata1, void *userdata2)
{
    (void)message, (void)userdata2;
    *(WGPUDeviceLostReason *)userdata1 = reason;
    if (reason == WGPUDeviceLostReason_FailedCreation && *device) world.error_count = -100;
}

static void request_device(const WGPULimits *limits, WGPURequestDeviceStatus *status, WGPUDevice *device,
                           WGPUDeviceLostReason *lost)
{
    static const WGPUFeatureName timestamps = WGPUFeatureName_TimestampQuery;
    WGPUDeviceDescriptor descriptor = {
        .label = weir_test_text("test device"),
        .requiredFeatureCount = wgpuAdapterHasFeature(world.adapter, timestamps),
        .requiredFeatures = &timestamps,
        .requiredLimits = limits,
        .deviceLostCallbackInfo = {.callback = on_lost, .userdata1 = lost},
        .uncapturedErrorCallbackInfo = {.callback = weir_test_on_error},
    };
    WGPURequestDeviceCallbackInfo info = {.callback = on_device, .userdata1 = status, .userdata2 = device};
    wgpuAdapterRequestDevice(world.adapter, &descriptor, info);
}

// More than the adapter has: the device's loss is told as well, as webgpu.h asks for.
static int test_device_refused(uint32_t step)
{
    static WGPURequestDeviceStatus status;
    static WGPUDevice device;
    static WGPUDeviceLostReason lost;
    if (step == 0) {
        WGPULimits limits = WGPU_LIMITS_INIT;
        limits.maxBindGroups = 1000000;
        request_device(&limits, &status, &device, &lost);
    }
    if (!status) return PENDING;
    CHECK(status == WGPURequestDeviceStatus_Error);
    CHECK(!device && world.error_count == 1);
    CHECK(lost == WGPUDeviceLostReason_FailedCreation);
    return DONE;
}

// With the adapter's own limits, as Weir asks for them.
static int test_device(uint32_t step)
{
    static WGPURequestDeviceStatus status;
    static WGPULimits limits;
    if (step == 0) {
        wgpuAdapterGetLimits(world.adapter, &limits);
        request_device(&limits, &status, &world.device, &world.lost);
    }
    if (!status) return PENDING;
    CHECK(status == WGPURequestDeviceStatus_Success);
    CHECK(world.device);
    WGPULimits granted = {0};
    CHECK(wgpuDeviceGetLimits(world.device, &granted) == WGPUStatus_Success);
    CHECK(granted.maxStorageBufferBindingSize == limits.maxStorageBufferBindingSize);
    CHECK(granted.maxComputeInvocationsPerWorkgroup == limits.maxComputeInvocationsPerWorkgroup);
    CHECK(wgpuDeviceHasFeature(world.device, WGPUFeatureName_TimestampQuery) ==
          wgpuAdapterHasFeature(world.adapter, WGPUFeatureName_TimestampQuery));
    world.queue = wgpuDeviceGetQueue(world.device);
    CHECK(world.queue);
    return DONE;
}

// A second handle of the queue is as good as the first.
static int test_queue(uint32_t step)
{
    (void)step;
    WGPUQueue queue = wgpuDeviceGetQueue(world.device);
    CHECK(queue);
    wgpuQueueSubmit(queue, 0, NULL);
    wgpuQueueRelease(queue);
    return DONE;
}

static int test_work_done(uint32_t step)
{
    static uint32_t status;
    if (step == 0) {
        WGPUQueueWorkDoneCallbackInfo info = {.callback = (WGPUQueueWorkDoneCallback)weir_test_on_status,
                                              .userdata1 = &status};
        wgpuQueueOnSubmittedWorkDone(world.queue, info);
    }
    if (!status) return PENDING;
    CHECK(status == WGPUQueueWorkDoneStatus_Success);
    return DONE;
}

typedef struct Scope {
    WGPUPopErrorScopeStatus status;
    WGPUErrorType type;
    bool has_message;
} Scope;

static void on_scope(WGPUPopErrorScopeStatus status, WGPUErrorType type, WGPUStringView message,
                     void *userdata1, void *userdata2)
{
    (void)userdata2;
    *(Scope *)userdata1 = (Scope){status, type, message.length > 0};
}

static int test_error_scopes(uint32_t step)
{
    static Scope outer, inner, empty;
    WGPUPopErrorScopeCallbackInfo info = {.callback = on_scope, .userdata1 = &inner};
    if (step == 0) {
        wgpuDevicePushErrorScope(world.device, WGPUErrorFilter_Validation);
        wgpuDevicePushErrorScope(world.device, WGPUErrorFilter_OutOfMemory);
        wgpuBufferRelease(weir_test_buffer(WGPUBufferUsage_MapRead | WGPUBufferUsage_MapWrite, 16));
        wgpuDevicePopErrorScope(world.device, info); // not for this filter
        info.userdata1 = &outer;
        wgpuDevicePopErrorScope(world.device, info);
        info.userdata1 = &empty;
        wgpuDevicePopErrorScope(world.device, info); // there is none
    }
    if (!outer.status || !inner.status || !empty.status) return PENDING;
    CHECK(inner.status == WGPUPopErrorScopeStatus_Success && inner.type == WGPUErrorType_NoError);
    CHECK(outer.status == WGPUPopErrorScopeStatus_Success && outer.type == WGPUErrorType_Validation);
    CHECK(outer.has_message && !inner.has_message);
    CHECK(empty.status == WGPUPopErrorScopeStatus_Error);
    CHECK(world.error_count == 0); // nothing was left uncaptured
    return DONE;
}

static int test_uncaptured(uint32_t step)
{
    if (step == 0)
        wgpuBufferRelease(weir_test_buffer(WGPUBufferUsage_MapRead | WGPUBufferUsage_MapWrite, 16));
    if (world.error_count == 0) return PENDING;
    CHECK(world.error_count == 1 && world.error_type == WGPUErrorType_Validation);
    CHECK(world.error[0]);
    return DONE;
}

// What the browser refuses with an exception comes as an error of the device with the call's name,
// not as a trap.
static int test_exception(uint32_t step)
{
    static WGPUBuffer buffer;
    if (step == 0) {
        buffer = weir_test_buffer(WGPUBufferUsage_CopyDst, 16);
        wgpuQueueWriteBuffer(world.queue, buffer, 0, "abc", 3); // no multiple of 4
    }
    if (world.error_count == 0) return PENDING;
    CHECK(world.error_count == 1 && strstr(world.error, "write_buffer"));
    wgpuBufferRelease(buffer);
    return DONE;
}

// What webgpu.h knows and the layer does not serve is refused by name.
static int test_refused(uint32_t step)
{
    if (step == 0) {
        WGPUBindGroupLayoutEntry entry = {.sampler = {.type = WGPUSamplerBindingType_Filtering}};
        WGPUBindGroupLayoutDescriptor descriptor = {.entryCount = 1, .entries = &entry};
        wgpuBindGroupLayoutRelease(wgpuDeviceCreateBindGroupLayout(world.device, &descriptor));
    }
    if (world.error_count == 0) return PENDING;
    CHECK(strstr(world.error, "buffers and textures only"));
    return DONE;
}

typedef struct Messages {
    bool done;
    size_t count;
    WGPUCompilationMessageType type;
    uint64_t line;
    bool has_text;
} Messages;

static void on_messages(WGPUCompilationInfoRequestStatus status, const WGPUCompilationInfo *info,
                        void *userdata1, void *userdata2)
{
    (void)userdata2;
    Messages *messages = userdata1;
    messages->done = status == WGPUCompilationInfoRequestStatus_Success;
    messages->count = info->messageCount;
    if (info->messageCount == 0) return;
    messages->type = info->messages[0].type;
    messages->line = info->messages[0].lineNum;
    messages->has_text = info->messages[0].message.length > 0;
}

static int test_shader(uint32_t step)
{
    static Messages good, bad;
    static WGPUShaderModule shaders[2];
    if (step == 0) {
        const char *codes[2] = {"@compute @workgroup_size(1) fn run() {}",
                                "// first line\nfn run() { wrong(); }\n"};
        Messages *messages[2] = {&good, &bad};
        for (int k = 0; k < 2; k++) {
            WGPUShaderSourceWGSL source = {{NULL, WGPUSType_ShaderSourceWGSL}, weir_test_text(codes[k])};
            WGPUShaderModuleDescriptor descriptor = {&source.chain, weir_test_text("shader")};
            shaders[k] = wgpuDeviceCreateShaderModule(world.device, &descriptor);
            CHECK(shaders[k]);
            WGPUCompilationInfoCallbackInfo info = {.callback = on_messages, .userdata1 = messages[k]};
            wgpuShaderModuleGetCompilationInfo(shaders[k], info);
        }
    }
    if (!good.done || !bad.done) return PENDING;
    CHECK(good.count == 0);
    CHECK(bad.count >= 1 && bad.type == WGPUCompilationMessageType_Error && bad.line == 2 && bad.has_text);
    wgpuShaderModuleRelease(shaders[0]);
    wgpuShaderModuleRelease(shaders[1]);
    return DONE;
}

const WeirTest weir_device_tests[] = {
    {"wgpuCreateInstance wgpuInstanceRelease", test_instance, true},
    {"wgpuInstanceRequestAdapter wgpuInstanceProcessEvents", test_adapter, true},
    {"wgpuAdapterGetInfo wgpuAdapterInfoFreeMembers", test_info, false},
    {"wgpuAdapterGetLimits", test_limits, false},
    {"wgpuAdapterHasFeature", test_features, false},
    {"wgpuAdapterRequestDevice refused", test_device_refused, false},
    {"wgpuAdapterRequestDevice wgpuDeviceGetLimits wgpuDeviceHasFeature", test_device, false},
    {"wgpuDeviceGetQueue wgpuQueueRelease", test_queue, false},
    {"wgpuQueueOnSubmittedWorkDone", test_work_done, false},
    {"wgpuDevicePushErrorScope wgpuDevicePopErrorScope", test_error_scopes, false},
    {"uncaptured errors", test_uncaptured, false},
    {"exceptions of the browser", test_exception, false},
    {"descriptors that are not served", test_refused, false},
    {"wgpuDeviceCreateShaderModule wgpuShaderModuleGetCompilationInfo wgpuShaderModuleRelease", test_shader,
     false},
    {0},
};

// ---------------------------------------------------------------------------------------------------------

static int test_destroy(uint32_t step)
{
    if (step == 0) wgpuDeviceDestroy(world.device);
    if (!world.lost) return PENDING;
    CHECK(world.lost == WGPUDeviceLostReason_Destroyed);
    return DONE;
}

// A device whose last handle goes is destroyed; an instance that goes takes its callbacks along: each runs
// once, cancelled, before the release returns.
static int test_release(uint32_t step)
{
    static WGPURequestDeviceStatus status;
    static WGPUDevice device;
    static WGPUDeviceLostReason lost;
    static uint32_t mapped;
    static WGPURequestAdapterStatus found;
    static bool asked;
    if (step == 0) {
        wgpuQueueRelease(world.queue);
        wgpuDeviceRelease(world.device);
        wgpuAdapterRelease(world.adapter); // an adapter gives one device only
        world.adapter = NULL;
        WGPURequestAdapterCallbackInfo info = {.callback = on_adapter, .userdata1 = &found};
        wgpuInstanceRequestAdapter(world.instance, NULL, info);
    }
    if (!found) return PENDING;
    if (!asked) request_device(NULL, &status, &device, &lost);
    asked = true;
    if (!status) return PENDING;
    CHECK(status == WGPURequestDeviceStatus_Success);
    WGPUBufferDescriptor descriptor = {.usage = WGPUBufferUsage_MapRead, .size = 16};
    WGPUBuffer buffer = wgpuDeviceCreateBuffer(device, &descriptor);
    WGPUBufferMapCallbackInfo info = {.callback = (WGPUBufferMapCallback)weir_test_on_status,
                                      .userdata1 = &mapped};
    wgpuBufferMapAsync(buffer, WGPUMapMode_Read, 0, 16, info);
    wgpuBufferRelease(buffer);
    wgpuDeviceRelease(device);
    wgpuAdapterRelease(world.adapter);
    CHECK(!mapped && !lost);
    wgpuInstanceRelease(world.instance);
    world.instance = NULL;
    CHECK(mapped == WGPUMapAsyncStatus_CallbackCancelled);
    CHECK(lost == WGPUDeviceLostReason_CallbackCancelled);
    return DONE;
}

const WeirTest weir_end_tests[] = {
    {"wgpuDeviceDestroy", test_destroy, false},
    {"wgpuDeviceRelease wgpuAdapterRelease wgpuInstanceRelease", test_release, false},
    {0},
};
