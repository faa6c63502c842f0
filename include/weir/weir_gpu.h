// Weir on the GPU, through the standard webgpu.h: a device to make simulations on.
//
//   WeirGpu *gpu = weir_gpu_create(NULL);
//   while (weir_gpu_poll(gpu) == WEIR_PENDING) {}              // in a browser: once per frame
//   WeirSimOptions options = {.backend = weir_gpu_backend(gpu)};
//   WeirSim *sim = weir_sim_create(scene, &options);
//
// Link weir_gpu beside weir_core. Simulations must be destroyed before the device they run on.
#pragma once

#include "weir/weir.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct WeirGpu WeirGpu;

typedef struct WeirGpuOptions {
    bool low_power;       // prefer the integrated adapter
    bool no_timestamps;   // do not measure passes
    bool trusted_shaders; // native only: no run-time bounds checks in WGSL (4-18 % faster)
    // Bytes that the neighbour lists of a simulation may take, about as much as all else of it; 0: 8 GiB. Where they would be
    // larger, or the device's memory is too short for them, cells are walked, which takes 1.1 to 1.9 times as long.
    uint64_t list_memory;
    // Threads that keep the device busy, by which Weir chooses how it spreads its work; 0: measured, which takes a few ms
    // natively and 0.1 to 0.2 s in a browser. With parallelism_device (copied; NULL: any) only on the device of that name. So a
    // program can hand over what weir_gpu_parallelism() and weir_gpu_device() told last time.
    uint32_t parallelism;
    const char *parallelism_device;
} WeirGpuOptions;

// Starts to look for an adapter and a device. `options` NULL: all defaults. NULL only if memory runs out.
WeirGpu *weir_gpu_create(const WeirGpuOptions *options);
void weir_gpu_destroy(WeirGpu *gpu); // NULL is allowed
// Never blocks. WEIR_PENDING until the device is there, then WEIR_OK; WEIR_ERROR_DEVICE with a message if there
// is none, only a Null adapter, or once the device is lost.
WeirStatus weir_gpu_poll(WeirGpu *gpu);
// Natively waits for the device; in a browser the same as weir_gpu_poll().
WeirStatus weir_gpu_wait(WeirGpu *gpu);
const char *weir_gpu_error(const WeirGpu *gpu);  // "" if none
const char *weir_gpu_device(const WeirGpu *gpu); // the adapter's name
// True on a software adapter (lavapipe, SwiftShader, WARP): far slower than Weir's C solver.
bool weir_gpu_is_software(const WeirGpu *gpu);
// Threads that it runs as fast as one, to the nearest power of four: 65,536 on an H100, a sixteenth of that on small integrated
// cards. 0 until weir_gpu_poll() gave WEIR_OK. Sums over neighbours take another order, so results other last bits, where it differs.
uint32_t weir_gpu_parallelism(const WeirGpu *gpu);
// Backend for WeirSimOptions; NULL until weir_gpu_poll() gave WEIR_OK.
const WeirBackend *weir_gpu_backend(WeirGpu *gpu);
// Bytes of device memory that simulations on this device hold now.
uint64_t weir_gpu_memory(const WeirGpu *gpu);

#ifdef __cplusplus
}
#endif
