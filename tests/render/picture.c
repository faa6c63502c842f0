#include "picture.h"

#include <stdlib.h>

#include "adapter.h"
#include "common/build.h"

void weir_test_picture(WeirGpu *gpu, const WeirSim *sim, const WeirGpuParticles *particles,
                       const WeirView *view, uint32_t effects, uint32_t size, WeirImage *image)
{
    WeirRenderer *renderer = weir_renderer_create(gpu, WGPUTextureFormat_RGBA8Unorm);
    assert_non_null(renderer);
    renderer->effects = effects;
    assert_true(weir_image_create(image, gpu, WGPUTextureFormat_RGBA8Unorm, size, size));
    if (weir_renderer_draw_particles(renderer, sim, particles, view, image->view, size, size) != WEIR_OK)
        fail_msg("%s", weir_renderer_error(renderer));
    assert_true(weir_image_read(image));
    weir_renderer_destroy(renderer);
    if (weir_gpu_poll(gpu) != WEIR_OK) fail_msg("%s", weir_gpu_error(gpu));
}

int weir_test_difference(const uint8_t *a, const uint8_t *b)
{
    return abs(a[0] - b[0]) + abs(a[1] - b[1]) + abs(a[2] - b[2]);
}
