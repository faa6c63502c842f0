// wgpu-native: the only file that uses its extensions (wgpu.h).
#include "gpu/platform.h"
#include <webgpu/wgpu.h>

WGPUInstance weir_platform_create_instance(void)
{
    // Vulkan, Metal and DirectX 12: OpenGL's compute shaders fall short, and looking for it makes
    // drivers print. No flags: a check of indirect dispatches takes a dispatch for each, and their sizes are our own.
    WGPUInstanceExtras extras = {.chain.sType = (WGPUSType)WGPUSType_InstanceExtras,
                                 .backends = WGPUInstanceBackend_Primary,
                                 .flags = WGPUInstanceFlag_Empty};
    return wgpuCreateInstance(&(WGPUInstanceDescriptor){.nextInChain = &extras.chain});
}

bool weir_platform_can_wait(void)
{
    return true;
}

bool weir_platform_wait(WeirGpu *gpu)
{
    // wgpuInstanceWaitAny is not implemented there.
    if (gpu->device && gpu->status == WEIR_OK) wgpuDevicePoll(gpu->device, true, NULL);
    if (gpu->instance) wgpuInstanceProcessEvents(gpu->instance);
    return true;
}

bool weir_platform_may_look(WeirGpu *gpu)
{
    // Recording a command tells of a loss.
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(gpu->device, NULL);
    if (encoder) wgpuCommandEncoderRelease(encoder);
    return gpu->status == WEIR_OK;
}

void weir_platform_submit(WeirGpu *gpu, WGPUCommandBuffer commands)
{
    uint64_t *slot = &gpu->submits[gpu->submit_count % WEIR_MAX_SUBMITS];
    if (gpu->submit_count >= WEIR_MAX_SUBMITS) {
        WGPUSubmissionIndex oldest = *slot;
        wgpuDevicePoll(gpu->device, true, &oldest);
        if (gpu->status != WEIR_OK) return;
    }
    *slot = wgpuQueueSubmitForIndex(gpu->queue, 1, &commands);
    ++gpu->submit_count;
}

WGPUShaderModule weir_platform_shader_module(WeirGpu *gpu, const WGPUShaderModuleDescriptor *descriptor,
                                             bool trusted)
{
    if (!trusted) return wgpuDeviceCreateShaderModule(gpu->device, descriptor);
    return wgpuDeviceCreateShaderModuleTrusted(gpu->device, descriptor, WGPUShaderRuntimeChecks_None);
}

bool weir_platform_compiles_in_background(void)
{
    return false; // wgpu-native does not have the call
}

double weir_platform_timestamp_period(WeirGpu *gpu)
{
    return wgpuQueueGetTimestampPeriod(gpu->queue);
}

bool weir_platform_dispatches_indirectly(void)
{
    return true;
}
