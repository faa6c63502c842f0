// A device and what the solvers' files share about it. Everything on a device is made through these
// functions, so that every object has a label, every byte is counted and every fault becomes a message.
#pragma once

#include "gpu/gpu.h"
#include "gpu/pipelines.h"

// Threads of a workgroup, in C and WGSL alike; pass forces of `wcsph` may have others.
enum { WEIR_WORKGROUP_SIZE = 128 };

// Submits that may be under way natively: enough to keep the device busy, few enough to bound the
// queue's memory.
enum { WEIR_MAX_SUBMITS = 4 };

typedef struct WeirParallelism WeirParallelism; // parallelism.h

typedef struct WeirGpuBackend {
    WeirBackend base;
    WeirGpu *gpu;
} WeirGpuBackend;

struct WeirGpu {
    WeirGpuBackend backend;
    WeirGpuOptions options;
    WGPUInstance instance;
    WGPUAdapter adapter;
    WGPUDevice device;
    WGPUQueue queue;
    WGPULimits limits;
    uint32_t max_groups; // workgroups of a dispatch in one dimension; tests make it small
    bool timestamps;     // timestamp queries may be used
    bool software;
    uint32_t parallelism;       // threads that keep it busy; 0: not known yet
    WeirParallelism *measuring; // that, or NULL
    char told_device[128];      // options.parallelism_device
    bool destroyed;             // weir_gpu_destroy() was called; callbacks may still come
    uint32_t callbacks;         // that have not come yet
    uint64_t memory;            // bytes of all buffers
    WeirPipelines pipelines;
    uint64_t submits[WEIR_MAX_SUBMITS]; // native.c: the last ones
    uint32_t submit_count;
    WeirStatus status; // WEIR_PENDING, WEIR_OK, then the first error
    WeirMessage message;
    char name[128];
};

// "text" as webgpu.h takes it.
WGPUStringView weir_gpu_text(const char *text);
// Copies the device's error into `message`; WEIR_OK if there is none.
WeirStatus weir_gpu_check(const WeirGpu *gpu, WeirMessage *message);
// A buffer, counted in weir_gpu_memory().
WGPUBuffer weir_gpu_create_buffer(WeirGpu *gpu, const char *label, WGPUBufferUsage usage, uint64_t size);
void weir_gpu_destroy_buffer(WeirGpu *gpu, WGPUBuffer buffer, uint64_t size); // NULL is allowed
// Ends the encoder and queues its work.
void weir_gpu_submit(WeirGpu *gpu, WGPUCommandEncoder encoder, const char *label);
