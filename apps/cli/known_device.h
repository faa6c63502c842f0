// What was measured of the machine's GPU, kept for the next run: device.json in $XDG_CACHE_HOME/weir or ~/.cache/weir. So runs
// on one device agree to the last bit. Where nothing can be kept, it is measured anew.
#pragma once

#include "weir/weir_gpu.h"

typedef struct WeirKnownDevice {
    char name[128];       // weir_gpu_device(); "" if none is known
    uint32_t parallelism; // weir_gpu_parallelism()
} WeirKnownDevice;

WeirKnownDevice weir_cli_recall_device(void);
// `known`: what was recalled; nothing is written if that is what the device tells.
void weir_cli_remember_device(const WeirKnownDevice *known, const WeirGpu *gpu);
