// The device that the tests run on: the machine's own, or a software adapter (lavapipe).
#pragma once

#include "common/build.h"
#include "gpu/device.h"

// A ready device. Without any adapter the program ends as a failure, unless WEIR_ALLOW_NO_GPU is set: then it
// says so and ends with exit status 77, which ctest shows as skipped.
WeirGpu *weir_test_gpu(const WeirGpuOptions *options);
