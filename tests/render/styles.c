#include "styles.h"

#include "adapter.h"
#include "gpu/device.h"
#include "image.h"
#include "render/renderer.h"
#include "upload.h"

void weir_test_styles_and_sizes(WeirGpu *gpu, WeirSim *sim, WeirView (*view_of)(WeirFluidStyle))
{
    WeirGpuParticles particles;
    assert_true(weir_upload(gpu, sim, &particles));
    WeirRenderer *renderer = weir_renderer_create(gpu, WGPUTextureFormat_RGBA8Unorm);
    const struct {
        uint32_t width, height;
        WeirFluidStyle style;
    } frames[] = {{64, 48, WEIR_FLUID_WATER},
                  {64, 48, WEIR_FLUID_PARTICLES},
                  {1, 1, WEIR_FLUID_WATER},
                  {97, 33, WEIR_FLUID_WATER},
                  {64, 48, WEIR_FLUID_WATER}};
    enum { FRAMES = sizeof frames / sizeof *frames };
    WeirImage images[FRAMES];
    for (int k = 0; k < FRAMES; k++) {
        WeirView view = view_of(frames[k].style);
        assert_true(weir_image_create(&images[k], gpu, WGPUTextureFormat_RGBA8Unorm, frames[k].width,
                                      frames[k].height));
        assert_int_equal(weir_renderer_draw_particles(renderer, sim, &particles, &view, images[k].view,
                                                      frames[k].width, frames[k].height),
                         WEIR_OK);
        assert_true(weir_image_read(&images[k]));
    }
    // Times of those before the last one have come.
    double time = weir_renderer_draw_time(renderer);
    assert_true(gpu->timestamps ? time > 0.01 && time < 10e3 : time == 0.0);
    assert_memory_equal(images[0].pixels, images[FRAMES - 1].pixels, (size_t)4 * 64 * 48);
    assert_memory_not_equal(images[0].pixels, images[1].pixels, (size_t)4 * 64 * 48);
    for (int k = 0; k < FRAMES; k++) weir_image_destroy(&images[k]);
    weir_renderer_destroy(renderer);
    weir_upload_release(&particles);
    if (weir_gpu_poll(gpu) != WEIR_OK) fail_msg("%s", weir_gpu_error(gpu));
}
