// A browser: nothing blocks, callbacks come between frames.
#include "gpu/platform.h"

WGPUInstance weir_platform_create_instance(void)
{
    return wgpuCreateInstance(NULL);
}

bool weir_platform_can_wait(void)
{
    return false;
}

bool weir_platform_wait(WeirGpu *gpu)
{
    (void)gpu;
    return false;
}

bool weir_platform_may_look(WeirGpu *gpu)
{
    (void)gpu;
    return true; // a loss unmaps, and nothing is found
}

void weir_platform_submit(WeirGpu *gpu, WGPUCommandBuffer commands)
{
    wgpuQueueSubmit(gpu->queue, 1, &commands);
}

WGPUShaderModule weir_platform_shader_module(WeirGpu *gpu, const WGPUShaderModuleDescriptor *descriptor,
                                             bool trusted)
{
    (void)trusted; // browsers always check
    return wgpuDeviceCreateShaderModule(gpu->device, descriptor);
}

bool weir_platform_compiles_in_background(void)
{
    return true;
}

double weir_platform_timestamp_period(WeirGpu *gpu)
{
    (void)gpu;
    return 1.0; // WebGPU's timestamps are nanoseconds
}

bool weir_platform_dispatches_indirectly(void)
{
    return false; // browsers check the size in a pass of their own
}
