// What differs between wgpu-native (native.c) and a browser (web.c); everything else is standard webgpu.h.
#pragma once

#include "gpu/device.h"

// NULL where there is no WebGPU.
WGPUInstance weir_platform_create_instance(void);
// True if weir_platform_wait() blocks and callbacks come only from within webgpu.h calls.
bool weir_platform_can_wait(void);
// Blocks until the queued work is done and its callbacks ran. Returns false, at once, where nothing
// may block.
bool weir_platform_wait(WeirGpu *gpu);
// Whether bytes of a mapped buffer may be asked for: on a lost device that ends the process natively.
bool weir_platform_may_look(WeirGpu *gpu);
// Queues one command buffer; natively waits while too many are under way.
void weir_platform_submit(WeirGpu *gpu, WGPUCommandBuffer commands);
// With `trusted`, without run-time bounds checks where the platform can.
WGPUShaderModule weir_platform_shader_module(WeirGpu *gpu, const WGPUShaderModuleDescriptor *descriptor,
                                             bool trusted);
// Whether pipelines may be compiled beside each other and the program's own work.
bool weir_platform_compiles_in_background(void);
// Nanoseconds of one tick of a timestamp query.
double weir_platform_timestamp_period(WeirGpu *gpu);
// Whether a dispatch whose size the device decides costs no more than one that does nothing.
bool weir_platform_dispatches_indirectly(void);
