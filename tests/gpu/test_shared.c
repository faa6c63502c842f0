// The bodies of tests/common on the GPU solver.
#include "adapter.h"
#include "common/shared.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    WeirGpu *gpu = weir_test_gpu(NULL);
    int failed = weir_shared_main(argc, argv, weir_gpu_backend(gpu));
    if (weir_gpu_memory(gpu) != 0) {
        fprintf(stderr, "%llu bytes of GPU memory were never freed\n",
                (unsigned long long)weir_gpu_memory(gpu));
        ++failed;
    }
    weir_gpu_destroy(gpu);
    return failed;
}
