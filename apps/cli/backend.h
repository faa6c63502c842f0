// Which backend a command runs on: the CPU, or the GPU where there is one.
#pragma once

#include "weir/weir.h"
#include "weir/weir_gpu.h"

typedef struct WeirCliBackend {
    const WeirBackend *backend;
    WeirGpu *gpu; // NULL on the CPU
} WeirCliBackend;

// Of a GPU, as in WeirGpuOptions; 0: the default.
typedef struct WeirCliDevice {
    double list_memory; // GiB
    double parallelism; // threads
} WeirCliDevice;

// `name` is "cpu", "gpu" or "auto": the GPU if it is a real one, else the CPU (a software adapter is far
// slower than the C solver). On failure `message` says why.
WeirStatus weir_cli_backend_open(WeirCliBackend *backend, const char *name, WeirCliDevice device,
                                 char *message, size_t message_size);
// The same for --backend of `command`; false after a message on standard error.
bool weir_cli_backend_choose(WeirCliBackend *backend, const char *name, WeirCliDevice device,
                             const char *command);
// Simulations must be gone before.
void weir_cli_backend_close(WeirCliBackend *backend);
