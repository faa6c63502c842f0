// How many threads keep a device busy: what decides where several of them share a particle's neighbours, and what a dispatch
// that has nothing to do costs beside others. Measured when a device is made, unless WeirGpuOptions tell.
//
// A chain of additions that wait for one another takes t of one workgroup's threads, and T of so many threads n that T is
// several t. So the device runs n t / T threads as fast as it runs one (Little's law: latency times throughput).
#pragma once

#include "gpu/device.h"

// The nearest power of four: what is tuned by it needs no more, and two measurements are to give the same.
uint32_t weir_parallelism_rounded(double threads);
// Goes on with the measurement, which it begins. True once gpu->parallelism is known.
bool weir_parallelism_poll(WeirGpu *gpu);
void weir_parallelism_destroy(WeirParallelism *measuring); // NULL is allowed
// Over that of the device on which constants were tuned (docs/performance.md).
double weir_parallelism_ratio(const WeirGpu *gpu);
