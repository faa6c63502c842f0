// The device: start, loss, faults with the name of what failed, limits, memory, times.
#include "adapter.h"
#include "core/sim.h"
#include "gpu/mueller.h"
#include "gpu/wcsph.h"

#include <stdlib.h>
#include <string.h>

static WeirSim *dam_on(WeirGpu *gpu)
{
    WeirScene *scene = weir_test_dam();
    WeirSim *sim = weir_test_sim(scene, weir_gpu_backend(gpu), 0);
    weir_scene_destroy(scene);
    return sim;
}

static void device_starts(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    assert_int_equal(weir_gpu_poll(gpu), WEIR_OK);
    assert_true(strlen(weir_gpu_device(gpu)) > 0);
    assert_string_equal(weir_gpu_error(gpu), "");
    assert_true(weir_gpu_memory(gpu) == 0);
    bool llvmpipe = strstr(weir_gpu_device(gpu), "llvmpipe") != NULL;
    if (llvmpipe) assert_true(weir_gpu_is_software(gpu));
    WeirSim *sim = dam_on(gpu);
    assert_string_equal(weir_sim_backend(sim), "gpu");
    assert_string_equal(weir_sim_device(sim), weir_gpu_device(gpu));
    assert_int_equal(weir_sim_threads(sim), 0);
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
}

// A program may give up while the adapter is still being looked for, and no backend exists before
// it was found.
static void device_may_be_destroyed_early(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_gpu_create(NULL);
    assert_non_null(gpu);
    weir_gpu_destroy(gpu);
    weir_gpu_destroy(NULL);
}

static void a_lost_device_is_reported(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirSim *sim = dam_on(gpu);
    weir_test_step(sim, 3);
    assert_int_equal(weir_sim_wait(sim), WEIR_OK);
    wgpuDeviceDestroy(weir_gpu_wgpu_device(gpu));
    WeirStatus status = WEIR_OK;
    for (int n = 0; n < 100 && status == WEIR_OK; ++n) {
        status = weir_sim_step(sim, 1);
        if (status == WEIR_OK) status = weir_sim_poll(sim);
    }
    assert_int_equal(status, WEIR_ERROR_DEVICE);
    CHECK_CONTAINS(weir_sim_error(sim), "GPU device was destroyed");
    assert_int_equal(weir_sim_status(sim), WEIR_ERROR_DEVICE);
    assert_int_equal(weir_gpu_poll(gpu), WEIR_ERROR_DEVICE);
    CHECK_CONTAINS(weir_gpu_error(gpu), "weir_gpu_create");
    assert_null(weir_gpu_backend(gpu));
    // Nothing that is called from now on may crash.
    float positions[2 * 1000];
    assert_int_equal(weir_sim_step(sim, 5), WEIR_ERROR_DEVICE);
    assert_int_equal(weir_sim_wait(sim), WEIR_ERROR_DEVICE);
    assert_int_equal(weir_sim_read(sim, WEIR_FIELD_POSITION, positions, 2000), WEIR_ERROR_DEVICE);
    assert_int_equal(weir_gpu_wait(gpu), WEIR_ERROR_DEVICE);
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
}

// The loss comes while steps, a health copy and a measured step are under way.
static void a_device_lost_at_work_is_reported(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirSim *sim = dam_on(gpu);
    weir_test_step(sim, 40);
    weir_sim_poll(sim);
    wgpuDeviceDestroy(weir_gpu_wgpu_device(gpu));
    // What was queued may still get done; the next command learns of the loss.
    WeirStatus status = weir_sim_wait(sim);
    assert_true(status == WEIR_OK || status == WEIR_ERROR_DEVICE);
    assert_int_equal(weir_sim_step(sim, 1), WEIR_ERROR_DEVICE);
    CHECK_CONTAINS(weir_sim_error(sim), "GPU device was destroyed");
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
}

// The state is being read when the device goes, by a command that wgpu-native would abort on.
static void a_device_lost_before_a_read_is_reported(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirSim *sim = dam_on(gpu);
    weir_test_step(sim, 2);
    wgpuDeviceDestroy(weir_gpu_wgpu_device(gpu));
    WeirDiagnostics diagnostics;
    assert_int_equal(weir_sim_diagnose(sim, 0, &diagnostics), WEIR_ERROR_DEVICE);
    CHECK_CONTAINS(weir_sim_error(sim), "GPU device was destroyed");
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
}

static void a_shader_error_names_the_pass(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirReport *report = weir_report_create(gpu);
    WeirMessage message = {""};
    static const char wrong[] = "@compute @workgroup_size(1) fn density() { let x: u32 = 1.5; }";
    char settings[WEIR_SETTINGS_LENGTH];
    weir_mueller_settings(gpu, &(WeirParameters){0}, &(WeirConstants){0}, settings);
    char *source = weir_pass_source(&weir_mueller_method, WEIR_WORKGROUP_SIZE, settings, NULL, wrong);
    WGPUBindGroupLayout layout =
        wgpuDeviceCreateBindGroupLayout(weir_gpu_wgpu_device(gpu), &(WGPUBindGroupLayoutDescriptor){0});
    WGPUComputePipeline pipeline = weir_pass_pipeline(gpu, "density", "pass density", source, layout, report);
    while (weir_report_pending(report)) weir_gpu_poll(gpu);
    assert_int_equal(weir_report_check(report, &message), WEIR_ERROR_DEVICE);
    CHECK_CONTAINS(message.text, "pass density: ");
    CHECK_CONTAINS(message.text, "1.5");
    // It is that pass's fault, not the device's.
    assert_int_equal(weir_gpu_poll(gpu), WEIR_OK);
    free(source);
    wgpuBindGroupLayoutRelease(layout);
    if (pipeline) wgpuComputePipelineRelease(pipeline);
    weir_report_destroy(report);
    weir_gpu_destroy(gpu);
}

// What no report catches names the object by its label.
static void a_refused_command_names_its_object(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WGPUBuffer buffer =
        weir_gpu_create_buffer(gpu, "buffer flow", WGPUBufferUsage_MapRead | WGPUBufferUsage_Storage, 16);
    for (int n = 0; n < 100 && weir_gpu_poll(gpu) == WEIR_OK; ++n) {
    }
    assert_int_equal(weir_gpu_poll(gpu), WEIR_ERROR_DEVICE);
    CHECK_CONTAINS(weir_gpu_error(gpu), "buffer flow");
    weir_gpu_destroy_buffer(gpu, buffer, 16);
    weir_gpu_destroy(gpu);
}

static void too_many_particles_are_refused(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirScene *scene = weir_test_scene(0.01, 0.025, 0, 1);
    weir_test_box(scene, 0, 0, 1, 1);
    gpu->limits.maxStorageBufferBindingSize = 100 * 1024; // 10,000 particles need 160,000 bytes for flow
    WeirSim *sim = weir_sim_create(scene, &(WeirSimOptions){.backend = weir_gpu_backend(gpu)});
    assert_int_equal(weir_sim_status(sim), WEIR_ERROR_MEMORY);
    CHECK_CONTAINS(weir_sim_error(sim), "10000 particles");
    CHECK_CONTAINS(weir_sim_error(sim), "particle_spacing");
    CHECK_CONTAINS(weir_sim_error(sim), "6400 particles or fewer");
    weir_sim_destroy(sim);
    // The device goes on.
    assert_true(weir_gpu_memory(gpu) == 0);
    sim = dam_on(gpu);
    weir_test_step(sim, 2);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
    weir_gpu_destroy(gpu);
}

static void memory_is_bounded(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirScene *scene = weir_test_scene(0.01, 0.025, 0, 1);
    weir_test_box(scene, 0, 0, 0.5, 1);
    WeirSim *sim = weir_test_sim(scene, weir_gpu_backend(gpu), 0);
    uint64_t memory = weir_gpu_memory(gpu);
    assert_true(memory > 0);
    CHECK_AT_MOST((double)memory / weir_sim_particle_count(sim), 160.0);
    weir_test_step(sim, 5);
    weir_test_diagnose(sim, 0);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "search", (double[]){WEIR_SEARCH_ALL_PAIRS}, 1), WEIR_OK);
    CHECK_SIM(sim, weir_sim_set_parameter(sim, "kernels", (double[]){WEIR_KERNELS_TUTORIAL}, 1), WEIR_OK);
    weir_test_step(sim, 1);
    CHECK_SIM(sim, weir_sim_reset(sim), WEIR_OK);
    assert_true(weir_gpu_memory(gpu) == memory);
    // A second simulation counts as much again, and both give it back.
    WeirSim *other = weir_test_sim(scene, weir_gpu_backend(gpu), 0);
    assert_true(weir_gpu_memory(gpu) == 2 * memory);
    weir_sim_destroy(sim);
    weir_sim_destroy(other);
    assert_true(weir_gpu_memory(gpu) == 0);
    weir_scene_destroy(scene);
    weir_gpu_destroy(gpu);
}

static uint64_t hash_with_groups(WeirGpu *gpu, uint32_t max_groups)
{
    uint32_t own = gpu->max_groups;
    gpu->max_groups = max_groups;
    WeirScene *scene = weir_test_scene(0.02, 0.05, 0, 1);
    weir_test_gravity(scene, 0, -9.81);
    weir_test_box(scene, 0, 0, 0.5, 1); // 1,250 particles: 10 workgroups
    WeirSim *sim = weir_test_sim(scene, weir_gpu_backend(gpu), 0);
    weir_test_step(sim, 20);
    uint64_t hash = weir_test_hash(sim);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
    gpu->max_groups = own;
    return hash;
}

// The path of more than 65,535 workgroups, with a limit that few particles reach.
static void dispatches_may_be_two_dimensional(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    assert_true(gpu->max_groups >= 65533);
    uint64_t expected = hash_with_groups(gpu, 65533);
    assert_true(hash_with_groups(gpu, 3) == expected);
    assert_true(hash_with_groups(gpu, 1) == expected);
    assert_true(hash_with_groups(gpu, 9) == expected);
    weir_gpu_destroy(gpu);
}

static void passes_are_timed(void **state)
{
    (void)state;
    static const char *const names[] = {"count",   "scan_reduce", "scan_write", "scatter",
                                        "density", "forces",      "integrate"};
    WeirPassTime times[16];
    WeirGpu *gpu = weir_test_gpu(NULL);
    WeirSim *sim = dam_on(gpu);
    weir_test_step(sim, 3);
    assert_int_equal(weir_sim_wait(sim), WEIR_OK);
    uint32_t count = weir_sim_pass_times(sim, times, 16);
    if (!gpu->timestamps) {
        assert_int_equal(count, 0);
    } else {
        assert_int_equal(count, sizeof names / sizeof names[0]);
        double total = 0;
        for (uint32_t n = 0; n < count; ++n) {
            assert_string_equal(times[n].name, names[n]);
            assert_true(times[n].milliseconds >= 0);
            CHECK_AT_MOST(times[n].milliseconds, 10e3);
            total += times[n].milliseconds;
        }
        assert_true(total > 0);
        assert_true(weir_sim_step_time(sim) > 0);
        weir_test_step(sim, 30);
        assert_int_equal(weir_sim_wait(sim), WEIR_OK);
        CHECK_AT_MOST(weir_sim_step_time(sim), 10e3);
        assert_true(weir_sim_step_time(sim) > 0);
        WeirPassTime one = {NULL, 0};
        assert_int_equal(weir_sim_pass_times(sim, &one, 1), count);
        assert_string_equal(one.name, "count");
    }
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
    gpu = weir_test_gpu(&(WeirGpuOptions){.no_timestamps = true});
    sim = dam_on(gpu);
    weir_test_step(sim, 3);
    assert_int_equal(weir_sim_wait(sim), WEIR_OK);
    assert_int_equal(weir_sim_pass_times(sim, times, 16), 0);
    assert_true(weir_sim_step_time(sim) == 0);
    weir_sim_destroy(sim);
    weir_gpu_destroy(gpu);
}

// Phones give no more than WebGPU's least limit.
static void passes_fit_the_least_limits(void **state)
{
    (void)state;
    const WeirMethodInfo *const methods[] = {&weir_mueller_method, weir_gpu_wcsph_method(2)};
    for (int n = 0; n < 2; ++n) {
        for (uint32_t pass = 0; pass < methods[n]->pass_count; ++pass)
            assert_in_range(weir_pass_storage_buffers(&methods[n]->passes[pass]), 1, 8);
    }
}

// Shaders without run-time checks give the same bits.
static void trusted_shaders_change_nothing(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int trusted = 0; trusted < 2; ++trusted) {
        WeirGpu *gpu = weir_test_gpu(&(WeirGpuOptions){.trusted_shaders = trusted});
        WeirSim *sim = dam_on(gpu);
        weir_test_step(sim, 30);
        hash[trusted] = weir_test_hash(sim);
        weir_sim_destroy(sim);
        weir_gpu_destroy(gpu);
    }
    assert_true(hash[0] == hash[1]);
}

// Destroying a simulation with work, health copy and measured step under way is no fault of the device.
static void simulations_may_end_at_work(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    for (int n = 0; n < 3; ++n) {
        WeirSim *sim = dam_on(gpu);
        weir_test_step(sim, 10);
        weir_sim_poll(sim);
        weir_sim_destroy(sim);
    }
    assert_int_equal(weir_gpu_poll(gpu), WEIR_OK);
    weir_gpu_destroy(gpu);
}

static uint32_t kept_pipelines(const WeirGpu *gpu)
{
    uint32_t count = 0;
    for (int n = 0; n < WEIR_KEPT_PIPELINES; ++n) count += gpu->pipelines.kept[n].pipeline != NULL;
    return count;
}

// Positions of a dam break of `wcsph` after 20 steps, x and y of the first particle; `kernel` NULL: the usual one.
static void fall(WeirGpu *gpu, double spacing, const char *kernel, float first[2])
{
    WeirScene *scene = weir_scene_create();
    CHECK_SCENE(scene, weir_scene_set_string(scene, "method", "wcsph"), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_number(scene, "dimension", 2), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_set_domain(scene, (double[]){0, 0, 0}, (double[]){1, 0.5, 0}), WEIR_OK);
    CHECK_SCENE(scene, weir_scene_add_box(scene, (double[]){0, 0, 0}, (double[]){0.4, 0.4, 0}, NULL),
                WEIR_OK);
    weir_test_set(scene, "particle_spacing", spacing);
    if (kernel) CHECK_SCENE(scene, weir_scene_set_string(scene, "parameters.kernel", kernel), WEIR_OK);
    WeirSim *sim = weir_test_sim(scene, weir_gpu_backend(gpu), 0);
    weir_test_step(sim, 20);
    float *positions = weir_test_read(sim, WEIR_FIELD_POSITION);
    memcpy(first, positions, 2 * sizeof *first);
    free(positions);
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

// A scene that starts again, with other particles too, finds its pipelines; they give the same bits. What is kept is bounded.
static void pipelines_are_kept(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    float once[2], again[2];
    assert_int_equal(kept_pipelines(gpu), 0);
    fall(gpu, 0.02, NULL, once);
    uint32_t made = kept_pipelines(gpu);
    assert_in_range(made, 10, WEIR_KEPT_PIPELINES - 1);
    fall(gpu, 0.02, NULL, again);
    assert_memory_equal(again, once, sizeof once);
    fall(gpu, 0.0195, NULL, again);
    assert_int_equal(kept_pipelines(gpu), made);
    fall(gpu, 0.02, "cubic", again);
    assert_in_range(kept_pipelines(gpu), made + 1, 2 * made);
    weir_gpu_destroy(gpu);
}

static void what_was_not_looked_for_makes_room(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    float where[2];
    fall(gpu, 0.02, NULL, where);
    WeirPipelines *pipelines = &gpu->pipelines;
    WGPUComputePipeline any = pipelines->kept[0].pipeline;
    uint64_t first = pipelines->kept[0].key, second = pipelines->kept[1].key;
    uint32_t made = kept_pipelines(gpu);
    for (uint64_t key = made; key < WEIR_KEPT_PIPELINES; ++key) weir_pipelines_keep(pipelines, key, any);
    assert_int_equal(kept_pipelines(gpu), WEIR_KEPT_PIPELINES);
    wgpuComputePipelineRelease(weir_pipelines_find(pipelines, first));
    weir_pipelines_keep(pipelines, 1, any);
    assert_int_equal(kept_pipelines(gpu), WEIR_KEPT_PIPELINES);
    assert_null(weir_pipelines_find(pipelines, second));
    assert_ptr_equal(weir_pipelines_find(pipelines, first), any);
    wgpuComputePipelineRelease(any);
    weir_gpu_destroy(gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(device_starts),
        cmocka_unit_test(device_may_be_destroyed_early),
        cmocka_unit_test(a_lost_device_is_reported),
        cmocka_unit_test(a_device_lost_at_work_is_reported),
        cmocka_unit_test(a_device_lost_before_a_read_is_reported),
        cmocka_unit_test(a_shader_error_names_the_pass),
        cmocka_unit_test(a_refused_command_names_its_object),
        cmocka_unit_test(too_many_particles_are_refused),
        cmocka_unit_test(memory_is_bounded),
        cmocka_unit_test(dispatches_may_be_two_dimensional),
        cmocka_unit_test(passes_are_timed),
        cmocka_unit_test(passes_fit_the_least_limits),
        cmocka_unit_test(trusted_shaders_change_nothing),
        cmocka_unit_test(simulations_may_end_at_work),
        cmocka_unit_test(pipelines_are_kept),
        cmocka_unit_test(what_was_not_looked_for_makes_room),
    };
    return cmocka_run_group_tests_name("device", tests, NULL, NULL);
}
