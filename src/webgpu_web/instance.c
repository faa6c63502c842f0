// Instance, adapter, device, surface, and the way of every callback: JavaScript keeps what has
// finished in a queue and wgpuInstanceProcessEvents() takes it out through the exported
// weir_webgpu_*_done() functions below.
#include "webgpu_web/imports.h"

#include <stdlib.h>
#include <string.h>

#define WEIR_EXPORT(name) __attribute__((export_name(#name)))

// What a callback needs when its time comes.
typedef struct WebRecord {
    void *callback;
    void *userdata1, *userdata2;
} WebRecord;

uint32_t weir_webgpu_record(void *callback, void *userdata1, void *userdata2)
{
    WebRecord *record = malloc(sizeof *record);
    if (record) *record = (WebRecord){callback, userdata1, userdata2};
    return WEIR_ID(record);
}

WGPUFuture weir_webgpu_future(uint32_t record)
{
    return (WGPUFuture){record};
}

static WebRecord take_record(uint32_t number)
{
    WebRecord *record = WEIR_OBJECT(WebRecord *, number);
    WebRecord copy = *record;
    free(record);
    return copy;
}

size_t weir_webgpu_text_length(WGPUStringView view)
{
    if (!view.data) return 0;
    return view.length == WGPU_STRLEN ? strlen(view.data) : view.length;
}

WGPUStringView weir_webgpu_take_text(size_t length)
{
    char *text = length ? malloc(length + 1) : NULL;
    if (!text) return (WGPUStringView){NULL, 0};
    weir_js_take_text(text);
    text[length] = 0;
    return (WGPUStringView){text, length};
}

void weir_webgpu_refuse(uint32_t device, const char *message)
{
    weir_js_device_error(device, message, strlen(message));
}

static void free_text(WGPUStringView text)
{
    free((void *)text.data);
}

// ---------------------------------------------------------------------------------------------------------
// Callbacks: called by JavaScript with the record, a status of the enum that the callback has, an object or
// an error type, and the length of the message that it holds ready.

WEIR_EXPORT(weir_webgpu_adapter_done)
void weir_webgpu_adapter_done(uint32_t number, uint32_t status, uint32_t adapter, uint32_t length)
{
    WebRecord record = take_record(number);
    WGPUStringView message = weir_webgpu_take_text(length);
    ((WGPURequestAdapterCallback)record.callback)(status, WEIR_OBJECT(WGPUAdapter, adapter), message,
                                                  record.userdata1, record.userdata2);
    free_text(message);
}

WEIR_EXPORT(weir_webgpu_device_done)
void weir_webgpu_device_done(uint32_t number, uint32_t status, uint32_t device, uint32_t length)
{
    WebRecord record = take_record(number);
    WGPUStringView message = weir_webgpu_take_text(length);
    ((WGPURequestDeviceCallback)record.callback)(status, WEIR_OBJECT(WGPUDevice, device), message,
                                                 record.userdata1, record.userdata2);
    free_text(message);
}

// The two that end with status and message only (map, work done) have one signature.
WEIR_EXPORT(weir_webgpu_status_done)
void weir_webgpu_status_done(uint32_t number, uint32_t status, uint32_t unused, uint32_t length)
{
    (void)unused;
    WebRecord record = take_record(number);
    WGPUStringView message = weir_webgpu_take_text(length);
    ((WGPUBufferMapCallback)record.callback)(status, message, record.userdata1, record.userdata2);
    free_text(message);
}

WEIR_EXPORT(weir_webgpu_scope_done)
void weir_webgpu_scope_done(uint32_t number, uint32_t status, uint32_t type, uint32_t length)
{
    WebRecord record = take_record(number);
    WGPUStringView message = weir_webgpu_take_text(length);
    ((WGPUPopErrorScopeCallback)record.callback)(status, type, message, record.userdata1, record.userdata2);
    free_text(message);
}

WEIR_EXPORT(weir_webgpu_pipeline_done)
void weir_webgpu_pipeline_done(uint32_t number, uint32_t status, uint32_t pipeline, uint32_t length)
{
    WebRecord record = take_record(number);
    WGPUStringView message = weir_webgpu_take_text(length);
    ((WGPUCreateComputePipelineAsyncCallback)record.callback)(
        status, WEIR_OBJECT(WGPUComputePipeline, pipeline), message, record.userdata1, record.userdata2);
    free_text(message);
}

WEIR_EXPORT(weir_webgpu_shader_done)
void weir_webgpu_shader_done(uint32_t number, uint32_t status, uint32_t count, uint32_t length)
{
    (void)length;
    WebRecord record = take_record(number);
    WGPUCompilationMessage *messages = count ? calloc(count, sizeof *messages) : NULL;
    if (!messages) count = 0;
    for (uint32_t k = 0; k < count; k++) {
        messages[k].message = weir_webgpu_take_text(weir_js_message_text(k));
        messages[k].type = (WGPUCompilationMessageType)weir_js_message_number(k, 0);
        messages[k].lineNum = (uint64_t)weir_js_message_number(k, 1);
        messages[k].linePos = (uint64_t)weir_js_message_number(k, 2);
        messages[k].offset = (uint64_t)weir_js_message_number(k, 3);
        messages[k].length = (uint64_t)weir_js_message_number(k, 4);
    }
    WGPUCompilationInfo info = {.messageCount = count, .messages = messages};
    ((WGPUCompilationInfoCallback)record.callback)(status, &info, record.userdata1, record.userdata2);
    for (uint32_t k = 0; k < count; k++) free_text(messages[k].message);
    free(messages);
}

WEIR_EXPORT(weir_webgpu_lost_done)
void weir_webgpu_lost_done(uint32_t number, uint32_t reason, uint32_t device, uint32_t length)
{
    WebRecord record = take_record(number);
    WGPUStringView message = weir_webgpu_take_text(length);
    WGPUDevice handle = WEIR_OBJECT(WGPUDevice, device);
    ((WGPUDeviceLostCallback)record.callback)(&handle, reason, message, record.userdata1, record.userdata2);
    free_text(message);
}

// The only callback that may run more than once: its record lives as long as the device.
WEIR_EXPORT(weir_webgpu_error_done)
void weir_webgpu_error_done(uint32_t number, uint32_t type, uint32_t device, uint32_t length)
{
    WebRecord *record = WEIR_OBJECT(WebRecord *, number);
    WGPUStringView message = weir_webgpu_take_text(length);
    WGPUDevice handle = WEIR_OBJECT(WGPUDevice, device);
    ((WGPUUncapturedErrorCallback)record->callback)(&handle, type, message, record->userdata1,
                                                    record->userdata2);
    free_text(message);
}

WEIR_EXPORT(weir_webgpu_forget)
void weir_webgpu_forget(uint32_t number)
{
    free(WEIR_OBJECT(WebRecord *, number));
}

// ---------------------------------------------------------------------------------------------------------
// Instance

WGPUInstance wgpuCreateInstance(const WGPUInstanceDescriptor *descriptor)
{
    // Features of an instance are about waiting and SPIR-V: a browser has neither.
    if (descriptor && descriptor->requiredFeatureCount > 0) return NULL;
    return WEIR_OBJECT(WGPUInstance, weir_js_instance_create());
}

void wgpuInstanceRelease(WGPUInstance instance)
{
    weir_js_release(WEIR_ID(instance));
}

void wgpuInstanceProcessEvents(WGPUInstance instance)
{
    weir_js_process_events(WEIR_ID(instance));
}

WGPUFuture wgpuInstanceRequestAdapter(WGPUInstance instance, const WGPURequestAdapterOptions *options,
                                      WGPURequestAdapterCallbackInfo info)
{
    static const WGPURequestAdapterOptions defaults = {0};
    if (!options) options = &defaults;
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (record) {
        weir_js_request_adapter(WEIR_ID(instance), options->powerPreference, options->forceFallbackAdapter,
                                options->featureLevel, record);
    }
    return weir_webgpu_future(record);
}

// ---------------------------------------------------------------------------------------------------------
// Limits: the fields of WGPULimits in their order, which is also the order of the names in JavaScript.

#define WEIR_LIMITS(U32, U64)                                                                                \
    U32(maxTextureDimension1D)                                                                               \
    U32(maxTextureDimension2D)                                                                               \
    U32(maxTextureDimension3D)                                                                               \
    U32(maxTextureArrayLayers)                                                                               \
    U32(maxBindGroups)                                                                                       \
    U32(maxBindGroupsPlusVertexBuffers)                                                                      \
    U32(maxBindingsPerBindGroup)                                                                             \
    U32(maxDynamicUniformBuffersPerPipelineLayout)                                                           \
    U32(maxDynamicStorageBuffersPerPipelineLayout)                                                           \
    U32(maxSampledTexturesPerShaderStage)                                                                    \
    U32(maxSamplersPerShaderStage)                                                                           \
    U32(maxStorageBuffersPerShaderStage)                                                                     \
    U32(maxStorageTexturesPerShaderStage)                                                                    \
    U32(maxUniformBuffersPerShaderStage)                                                                     \
    U64(maxUniformBufferBindingSize)                                                                         \
    U64(maxStorageBufferBindingSize)                                                                         \
    U32(minUniformBufferOffsetAlignment)                                                                     \
    U32(minStorageBufferOffsetAlignment)                                                                     \
    U32(maxVertexBuffers)                                                                                    \
    U64(maxBufferSize)                                                                                       \
    U32(maxVertexAttributes)                                                                                 \
    U32(maxVertexBufferArrayStride)                                                                          \
    U32(maxInterStageShaderVariables)                                                                        \
    U32(maxColorAttachments)                                                                                 \
    U32(maxColorAttachmentBytesPerSample)                                                                    \
    U32(maxComputeWorkgroupStorageSize)                                                                      \
    U32(maxComputeInvocationsPerWorkgroup)                                                                   \
    U32(maxComputeWorkgroupSizeX)                                                                            \
    U32(maxComputeWorkgroupSizeY)                                                                            \
    U32(maxComputeWorkgroupSizeZ)                                                                            \
    U32(maxComputeWorkgroupsPerDimension)                                                                    \
    U32(maxImmediateSize)

static void get_limits(uint32_t object, WGPULimits *limits)
{
    uint32_t index = 0;
#define GET_U32(name) limits->name = (uint32_t)weir_js_limit(object, index++);
#define GET_U64(name) limits->name = (uint64_t)weir_js_limit(object, index++);
    WEIR_LIMITS(GET_U32, GET_U64)
}

static void require_limits(const WGPULimits *limits)
{
    uint32_t index = 0;
#define REQUIRE_U32(name)                                                                                    \
    if (limits->name != WGPU_LIMIT_U32_UNDEFINED) weir_js_require_limit(index, limits->name);                \
    index++;
#define REQUIRE_U64(name)                                                                                    \
    if (limits->name != WGPU_LIMIT_U64_UNDEFINED) weir_js_require_limit(index, (double)limits->name);        \
    index++;
    WEIR_LIMITS(REQUIRE_U32, REQUIRE_U64)
}

// ---------------------------------------------------------------------------------------------------------
// Adapter and device

WGPUStatus wgpuAdapterGetInfo(WGPUAdapter adapter, WGPUAdapterInfo *info)
{
    uint32_t id = WEIR_ID(adapter);
    info->vendor = weir_webgpu_take_text(weir_js_adapter_text(id, 0));
    info->architecture = weir_webgpu_take_text(weir_js_adapter_text(id, 1));
    info->device = weir_webgpu_take_text(weir_js_adapter_text(id, 2));
    info->description = weir_webgpu_take_text(weir_js_adapter_text(id, 3));
    info->backendType = WGPUBackendType_WebGPU;
    // A browser tells software adapters only, and no numbers of the vendor.
    info->adapterType = weir_js_adapter_number(id, 0) ? WGPUAdapterType_CPU : WGPUAdapterType_Unknown;
    info->vendorID = 0;
    info->deviceID = 0;
    info->subgroupMinSize = weir_js_adapter_number(id, 1);
    info->subgroupMaxSize = weir_js_adapter_number(id, 2);
    return WGPUStatus_Success;
}

void wgpuAdapterInfoFreeMembers(WGPUAdapterInfo info)
{
    free_text(info.vendor);
    free_text(info.architecture);
    free_text(info.device);
    free_text(info.description);
}

WGPUStatus wgpuAdapterGetLimits(WGPUAdapter adapter, WGPULimits *limits)
{
    get_limits(WEIR_ID(adapter), limits);
    return WGPUStatus_Success;
}

WGPUBool wgpuAdapterHasFeature(WGPUAdapter adapter, WGPUFeatureName feature)
{
    return weir_js_has_feature(WEIR_ID(adapter), feature);
}

WGPUFuture wgpuAdapterRequestDevice(WGPUAdapter adapter, const WGPUDeviceDescriptor *descriptor,
                                    WGPURequestDeviceCallbackInfo info)
{
    static const WGPUDeviceDescriptor defaults = {0};
    if (!descriptor) descriptor = &defaults;
    const WGPUDeviceLostCallbackInfo *lost = &descriptor->deviceLostCallbackInfo;
    const WGPUUncapturedErrorCallbackInfo *error = &descriptor->uncapturedErrorCallbackInfo;
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (!record) return weir_webgpu_future(0);
    for (size_t k = 0; k < descriptor->requiredFeatureCount; k++)
        weir_js_require_feature(descriptor->requiredFeatures[k]);
    if (descriptor->requiredLimits) require_limits(descriptor->requiredLimits);
    uint32_t lost_record =
        lost->callback ? weir_webgpu_record((void *)lost->callback, lost->userdata1, lost->userdata2) : 0;
    uint32_t error_record =
        error->callback ? weir_webgpu_record((void *)error->callback, error->userdata1, error->userdata2) : 0;
    weir_js_request_device(WEIR_ID(adapter), WEIR_TEXT(descriptor->label), lost_record, error_record, record);
    return weir_webgpu_future(record);
}

void wgpuAdapterRelease(WGPUAdapter adapter)
{
    weir_js_release(WEIR_ID(adapter));
}

WGPUStatus wgpuDeviceGetLimits(WGPUDevice device, WGPULimits *limits)
{
    get_limits(WEIR_ID(device), limits);
    return WGPUStatus_Success;
}

WGPUBool wgpuDeviceHasFeature(WGPUDevice device, WGPUFeatureName feature)
{
    return weir_js_has_feature(WEIR_ID(device), feature);
}

WGPUQueue wgpuDeviceGetQueue(WGPUDevice device)
{
    return WEIR_OBJECT(WGPUQueue, weir_js_device_queue(WEIR_ID(device)));
}

void wgpuDeviceDestroy(WGPUDevice device)
{
    weir_js_device_destroy(WEIR_ID(device));
}

void wgpuDeviceRelease(WGPUDevice device)
{
    weir_js_release(WEIR_ID(device));
}

void wgpuDevicePushErrorScope(WGPUDevice device, WGPUErrorFilter filter)
{
    weir_js_push_error_scope(WEIR_ID(device), filter);
}

WGPUFuture wgpuDevicePopErrorScope(WGPUDevice device, WGPUPopErrorScopeCallbackInfo info)
{
    uint32_t record = weir_webgpu_record((void *)info.callback, info.userdata1, info.userdata2);
    if (record) weir_js_pop_error_scope(WEIR_ID(device), record);
    return weir_webgpu_future(record);
}

// ---------------------------------------------------------------------------------------------------------
// Surface

WGPUSurface weir_webgpu_canvas_surface(WGPUInstance instance, uint32_t canvas_id)
{
    return WEIR_OBJECT(WGPUSurface, weir_js_surface_create(WEIR_ID(instance), canvas_id));
}

WGPUStatus wgpuSurfaceGetCapabilities(WGPUSurface surface, WGPUAdapter adapter,
                                      WGPUSurfaceCapabilities *capabilities)
{
    (void)surface;
    (void)adapter;
    // The first format is the one that the browser shows without a copy.
    static const WGPUTextureFormat formats[2][2] = {
        {WGPUTextureFormat_RGBA8Unorm, WGPUTextureFormat_BGRA8Unorm},
        {WGPUTextureFormat_BGRA8Unorm, WGPUTextureFormat_RGBA8Unorm},
    };
    static const WGPUPresentMode present_modes[] = {WGPUPresentMode_Fifo};
    static const WGPUCompositeAlphaMode alpha_modes[] = {WGPUCompositeAlphaMode_Opaque,
                                                         WGPUCompositeAlphaMode_Premultiplied};
    *capabilities = (WGPUSurfaceCapabilities){
        .usages = WGPUTextureUsage_RenderAttachment | WGPUTextureUsage_CopySrc | WGPUTextureUsage_CopyDst |
                  WGPUTextureUsage_TextureBinding,
        .formatCount = 2,
        .formats = formats[weir_js_surface_format() == WGPUTextureFormat_BGRA8Unorm],
        .presentModeCount = 1,
        .presentModes = present_modes,
        .alphaModeCount = 2,
        .alphaModes = alpha_modes,
    };
    return WGPUStatus_Success;
}

void wgpuSurfaceCapabilitiesFreeMembers(WGPUSurfaceCapabilities capabilities)
{
    (void)capabilities; // all static
}

void wgpuSurfaceConfigure(WGPUSurface surface, const WGPUSurfaceConfiguration *config)
{
    uint32_t device = WEIR_ID(config->device);
    if (config->viewFormatCount > 0) {
        weir_webgpu_refuse(device, "surface view formats are not served");
        return;
    }
    weir_js_surface_configure(WEIR_ID(surface), device, config->format, (uint32_t)config->usage,
                              config->width, config->height, config->alphaMode);
}

void wgpuSurfaceUnconfigure(WGPUSurface surface)
{
    weir_js_surface_unconfigure(WEIR_ID(surface));
}

void wgpuSurfaceGetCurrentTexture(WGPUSurface surface, WGPUSurfaceTexture *texture)
{
    uint32_t id = weir_js_surface_texture(WEIR_ID(surface));
    texture->texture = WEIR_OBJECT(WGPUTexture, id);
    texture->status =
        id ? WGPUSurfaceGetCurrentTextureStatus_SuccessOptimal : WGPUSurfaceGetCurrentTextureStatus_Error;
}

WGPUStatus wgpuSurfacePresent(WGPUSurface surface)
{
    (void)surface; // the browser presents when the script's turn ends
    return WGPUStatus_Success;
}

void wgpuSurfaceRelease(WGPUSurface surface)
{
    weir_js_release(WEIR_ID(surface));
}
