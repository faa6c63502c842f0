#include "gpu/report.h"

#include <stdlib.h>
#include <string.h>

struct WeirReport {
    WeirGpu *gpu;
    uint32_t pending; // callbacks that have not come yet
    bool orphaned;    // nobody but the callbacks knows this report any more
    WeirStatus status;
    WeirMessage message;
};

// wgpu-native aborts on the Internal filter; such errors end up in device.c.
static const WGPUErrorFilter filters[] = {WGPUErrorFilter_OutOfMemory, WGPUErrorFilter_Validation};
enum { FILTER_COUNT = sizeof filters / sizeof *filters };

WeirReport *weir_report_create(WeirGpu *gpu)
{
    WeirReport *report = calloc(1, sizeof *report);
    if (report) report->gpu = gpu;
    return report;
}

void weir_report_destroy(WeirReport *report)
{
    if (!report) return;
    report->orphaned = true;
    if (report->pending == 0) free(report);
}

// Keeps the first.
static void note_fault(WeirReport *report, const char *label, bool memory, WGPUStringView text)
{
    if (report->status != WEIR_OK) return;
    size_t length = text.data && text.length == WGPU_STRLEN ? strlen(text.data) : text.length;
    report->status = weir_fail(&report->message, memory ? WEIR_ERROR_MEMORY : WEIR_ERROR_DEVICE, "%s: %s%.*s",
                               label, memory ? "no GPU memory, use fewer particles; " : "",
                               (int)(length < 400 ? length : 400), text.data ? text.data : "");
}

static void free_if_orphaned(WeirReport *report)
{
    if (report->orphaned && report->pending == 0) free(report);
}

static void on_scope(WGPUPopErrorScopeStatus status, WGPUErrorType type, WGPUStringView text, void *userdata1,
                     void *userdata2)
{
    WeirReport *report = userdata1;
    --report->pending;
    if (status == WGPUPopErrorScopeStatus_Success && type != WGPUErrorType_NoError)
        note_fault(report, userdata2, type == WGPUErrorType_OutOfMemory, text);
    free_if_orphaned(report);
}

typedef struct Request {
    WeirReport *report;
    const char *label;
    WGPUComputePipeline *pipeline; // where it is to be
} Request;

static void on_pipeline(WGPUCreatePipelineAsyncStatus status, WGPUComputePipeline pipeline,
                        WGPUStringView text, void *userdata1, void *userdata2)
{
    (void)userdata2;
    Request request = *(Request *)userdata1;
    free(userdata1);
    WeirReport *report = request.report;
    --report->pending;
    if (status != WGPUCreatePipelineAsyncStatus_Success) {
        note_fault(report, request.label, false, text);
    } else if (report->orphaned) {
        wgpuComputePipelineRelease(pipeline);
    } else {
        *request.pipeline = pipeline;
    }
    free_if_orphaned(report);
}

WeirStatus weir_report_pipeline(WeirReport *report, const WGPUComputePipelineDescriptor *descriptor,
                                const char *label, WGPUComputePipeline *pipeline)
{
    Request *request = malloc(sizeof *request);
    if (!request) return WEIR_ERROR_MEMORY;
    *request = (Request){report, label, pipeline};
    ++report->pending;
    wgpuDeviceCreateComputePipelineAsync(
        report->gpu->device, descriptor,
        (WGPUCreateComputePipelineAsyncCallbackInfo){
            .mode = WGPUCallbackMode_AllowProcessEvents, .callback = on_pipeline, .userdata1 = request});
    return WEIR_OK;
}

void weir_report_begin(WeirReport *report)
{
    for (int n = 0; n < FILTER_COUNT; ++n) wgpuDevicePushErrorScope(report->gpu->device, filters[n]);
}

void weir_report_end(WeirReport *report, const char *label)
{
    report->pending += FILTER_COUNT;
    for (int n = 0; n < FILTER_COUNT; ++n) {
        wgpuDevicePopErrorScope(report->gpu->device,
                                (WGPUPopErrorScopeCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                                .callback = on_scope,
                                                                .userdata1 = report,
                                                                .userdata2 = (void *)(uintptr_t)label});
    }
}

bool weir_report_pending(const WeirReport *report)
{
    return report->pending > 0;
}

WeirStatus weir_report_check(const WeirReport *report, WeirMessage *message)
{
    if (report->status != WEIR_OK) *message = report->message;
    return report->status;
}
