#include "adapter.h"

#include <stdio.h>
#include <stdlib.h>

WeirGpu *weir_test_gpu(const WeirGpuOptions *options)
{
    // Some drivers complain on standard error where no desktop runs.
    if (!getenv("XDG_RUNTIME_DIR")) setenv("XDG_RUNTIME_DIR", "/tmp", 1);
    WeirGpu *gpu = weir_gpu_create(options);
    if (gpu && weir_gpu_wait(gpu) == WEIR_OK) return gpu;
    fprintf(stderr, "\n*** NO GPU, NOT EVEN A SOFTWARE ONE: %s ***\n*** install mesa-vulkan-drivers ***\n\n",
            gpu ? weir_gpu_error(gpu) : "no memory");
    weir_gpu_destroy(gpu);
    exit(getenv("WEIR_ALLOW_NO_GPU") ? 77 : 1);
}
