// Which backend a command runs on: the CPU, or the GPU where there is one.
#pragma once

#include "weir/weir.h"
#include "weir/weir_gpu.h"

typedef struct WeirCliBackend {
    const WeirBackend *backend;
    WeirGpu *gpu; // NULL on the CPU
} WeirCliBackend;

// `name` is "cpu", "gpu" or "auto": the GPU if it is a real one, else the CPU (a software adapter is far
// slower than the C solver). `list_memory`: GiB, as in WeirGpuOptions. On failure `message` says why.
WeirStatus weir_cli_backend_open(WeirCliBackend *backend, const char *name, double list_memory, char *message,
                                 size_t message_size);
// The same for --backend of `command`; false after a message on standard error.
bool weir_cli_backend_choose(WeirCliBackend *backend, const char *name, double list_memory,
                             const char *command);
// Simulations must be gone before.
void weir_cli_backend_close(WeirCliBackend *backend);
