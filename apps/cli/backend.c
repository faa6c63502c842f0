#include "backend.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if WEIR_WITH_GPU
#include "known_device.h"

static WeirStatus open_gpu(WeirCliBackend *backend, WeirCliDevice device, char *message, size_t message_size)
{
    WeirKnownDevice known = weir_cli_recall_device();
    bool is_told = device.parallelism > 0.0;
    // Vulkan drivers look for a Wayland display and print errors where this is not set, as on a server.
    setenv("XDG_RUNTIME_DIR", "/tmp", 0);
    // Weir's passes clamp every index themselves, so the driver need not check them again.
    backend->gpu = weir_gpu_create(
        &(WeirGpuOptions){.trusted_shaders = true,
                          .list_memory = (uint64_t)(device.list_memory * 1073741824.0),
                          .parallelism = is_told ? (uint32_t)device.parallelism : known.parallelism,
                          .parallelism_device = is_told ? NULL : known.name});
    if (!backend->gpu) {
        snprintf(message, message_size, "memory ran out");
        return WEIR_ERROR_MEMORY;
    }
    WeirStatus status = weir_gpu_wait(backend->gpu);
    if (!status) {
        backend->backend = weir_gpu_backend(backend->gpu);
        if (!is_told) weir_cli_remember_device(&known, backend->gpu);
        return WEIR_OK;
    }
    snprintf(message, message_size, "%s", weir_gpu_error(backend->gpu));
    weir_gpu_destroy(backend->gpu);
    backend->gpu = NULL;
    return status;
}

static bool is_software(const WeirCliBackend *backend)
{
    return weir_gpu_is_software(backend->gpu);
}

static void close_gpu(WeirCliBackend *backend)
{
    weir_gpu_destroy(backend->gpu);
}

#else

static WeirStatus open_gpu(WeirCliBackend *backend, WeirCliDevice device, char *message, size_t message_size)
{
    (void)backend;
    (void)device;
    snprintf(message, message_size, "this build has no GPU backend (built with WEIR_GPU=OFF)");
    return WEIR_ERROR_DEVICE;
}

static bool is_software(const WeirCliBackend *backend)
{
    (void)backend;
    return false;
}

static void close_gpu(WeirCliBackend *backend)
{
    (void)backend;
}

#endif

WeirStatus weir_cli_backend_open(WeirCliBackend *backend, const char *name, WeirCliDevice device,
                                 char *message, size_t message_size)
{
    *backend = (WeirCliBackend){.backend = weir_cpu_backend()};
    if (strcmp(name, "cpu") == 0) return WEIR_OK;
    WeirStatus status = open_gpu(backend, device, message, message_size);
    if (strcmp(name, "gpu") == 0) return status;
    if (!status && is_software(backend)) {
        weir_cli_backend_close(backend);
        *backend = (WeirCliBackend){.backend = weir_cpu_backend()};
    }
    return WEIR_OK;
}

bool weir_cli_backend_choose(WeirCliBackend *backend, const char *name, WeirCliDevice device,
                             const char *command)
{
    char message[512];
    if (!weir_cli_backend_open(backend, name, device, message, sizeof message)) return true;
    fprintf(stderr, "weir %s: --backend %s: %s\n", command, name, message);
    return false;
}

void weir_cli_backend_close(WeirCliBackend *backend)
{
    close_gpu(backend);
    *backend = (WeirCliBackend){0};
}
