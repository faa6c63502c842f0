#define _GNU_SOURCE // dl_iterate_phdr
#include "adapter.h"

#include <dlfcn.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A driver that is unloaded while memory hangs on its globals looks like a leak of ours to a leak checker.
static int keep_driver_loaded(struct dl_phdr_info *info, size_t size, void *data)
{
    (void)size, (void)data;
    if (strstr(info->dlpi_name, "vulkan")) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
}

// lavapipe (Mesa 22.3) frees a pipeline with the next submit, and never those destroyed after the last one. What Weir
// itself forgets would show as memory of wgpu-native too.
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libvulkan_lvp.so";
}

WeirGpu *weir_test_gpu(const WeirGpuOptions *options)
{
    // Some drivers complain on standard error where no desktop runs.
    if (!getenv("XDG_RUNTIME_DIR")) setenv("XDG_RUNTIME_DIR", "/tmp", 1);
    WeirGpu *gpu = weir_gpu_create(options);
    if (gpu && weir_gpu_wait(gpu) == WEIR_OK) {
        dl_iterate_phdr(keep_driver_loaded, NULL);
        return gpu;
    }
    fprintf(stderr, "\n*** NO GPU, NOT EVEN A SOFTWARE ONE: %s ***\n*** install mesa-vulkan-drivers ***\n\n",
            gpu ? weir_gpu_error(gpu) : "no memory");
    weir_gpu_destroy(gpu);
    exit(getenv("WEIR_ALLOW_NO_GPU") ? 77 : 1);
}
