// A program for the tests of the layer (web/tests/node/webgpu.test.ts): every call that
// src/webgpu_web serves, with its results read back. A test is a function that JavaScript calls
// with step 0, 1, 2, ... until it is no longer pending; between two steps the event loop runs. It
// may keep its state in statics: it runs once.
#include "webgpu_calls.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

WeirTestWorld world;
static char failure[512];

int weir_test_fail(const char *condition, const char *file, int line)
{
    snprintf(failure, sizeof failure, "%s:%d: %s (last error: %s)", file, line, condition, world.error);
    return FAILED;
}

WGPUStringView weir_test_text(const char *text)
{
    return (WGPUStringView){text, WGPU_STRLEN};
}

void weir_test_on_error(WGPUDevice const *device, WGPUErrorType type, WGPUStringView message, void *userdata1,
                        void *userdata2)
{
    (void)device, (void)userdata1, (void)userdata2;
    world.error_count++;
    world.error_type = type;
    snprintf(world.error, sizeof world.error, "%.*s", (int)message.length, message.data ? message.data : "");
}

void weir_test_on_status(uint32_t status, WGPUStringView message, void *userdata1, void *userdata2)
{
    (void)message, (void)userdata2;
    *(uint32_t *)userdata1 = status;
}

WGPUBuffer weir_test_buffer(WGPUBufferUsage usage, uint64_t size)
{
    return wgpuDeviceCreateBuffer(world.device, &(WGPUBufferDescriptor){.usage = usage, .size = size});
}

void weir_test_submit(WGPUCommandEncoder encoder)
{
    WGPUCommandBuffer commands = wgpuCommandEncoderFinish(encoder, NULL);
    wgpuQueueSubmit(world.queue, 1, &commands);
    wgpuCommandBufferRelease(commands);
    wgpuCommandEncoderRelease(encoder);
}

// Copies `size` bytes of a buffer to `to`, over several steps; one at a time.
int weir_test_read(WGPUBuffer source, uint64_t offset, size_t size, void *to)
{
    static WGPUBuffer staging;
    static uint32_t status;
    if (!staging) {
        staging = weir_test_buffer(WGPUBufferUsage_MapRead | WGPUBufferUsage_CopyDst, size);
        WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
        wgpuCommandEncoderCopyBufferToBuffer(encoder, source, offset, staging, 0, size);
        weir_test_submit(encoder);
        status = 0;
        wgpuBufferMapAsync(staging, WGPUMapMode_Read, 0, size,
                           (WGPUBufferMapCallbackInfo){.mode = WGPUCallbackMode_AllowProcessEvents,
                                                       .callback = (WGPUBufferMapCallback)weir_test_on_status,
                                                       .userdata1 = &status});
        return PENDING;
    }
    if (!status) return PENDING;
    const void *range = wgpuBufferGetConstMappedRange(staging, 0, size);
    if (range) memcpy(to, range, size);
    wgpuBufferUnmap(staging);
    wgpuBufferDestroy(staging);
    wgpuBufferRelease(staging);
    staging = NULL;
    return range ? DONE : FAILED;
}

// ---------------------------------------------------------------------------------------------------------

extern const WeirTest weir_device_tests[], weir_buffer_tests[], weir_pass_tests[], weir_depth_tests[],
    weir_end_tests[];

static const WeirTest *test_at(uint32_t index)
{
    const WeirTest *const groups[] = {weir_device_tests, weir_buffer_tests, weir_pass_tests, weir_depth_tests,
                                      weir_end_tests};
    for (size_t group = 0; group < sizeof groups / sizeof *groups; group++) {
        for (const WeirTest *test = groups[group]; test->calls; test++) {
            if (index-- == 0) return test;
        }
    }
    return NULL;
}

// The calls that test `index` is about, separated by spaces; NULL after the last test.
WEIR_EXPORT(weir_test_calls)
const char *weir_test_calls(uint32_t index)
{
    const WeirTest *test = test_at(index);
    return test ? test->calls : NULL;
}

WEIR_EXPORT(weir_test_run)
int weir_test_run(uint32_t index, uint32_t step)
{
    if (world.instance && !test_at(index)->own_events) wgpuInstanceProcessEvents(world.instance);
    if (step == 0) world.error_count = 0;
    if (step == 0) world.error[0] = 0;
    return test_at(index)->run(step);
}

WEIR_EXPORT(weir_test_failure)
const char *weir_test_failure(void)
{
    return failure;
}
