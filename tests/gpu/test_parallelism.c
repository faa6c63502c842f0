// How many threads keep a device busy: measured, told, remembered; and what is chosen by it.
#include "adapter.h"
#include "common/check.h"
#include "gpu/mueller.h"
#include "gpu/parallelism.h"
#include "gpu/wcsph.h"
#include "worlds.h"

#include <stdio.h>
#include <string.h>

static void the_nearest_power_of_four_counts(void **state)
{
    (void)state;
    static const struct {
        double threads;
        uint32_t rounded;
    } cases[] = {{0.1, 256},     {512, 256},      {513, 1024},      {16384, 16384},
                 {67584, 65536}, {131072, 65536}, {131073, 262144}, {1e12, 1u << 22}};
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; ++n)
        assert_int_equal(weir_parallelism_rounded(cases[n].threads), cases[n].rounded);
}

// To be measured like a card: the driver's threads are few, but they are measured alike.
static WeirGpu *unmeasured(const WeirGpuOptions *options)
{
    WeirGpu *gpu = weir_test_gpu(options);
    assert_true(weir_gpu_parallelism(gpu) > 0);
    gpu->software = false;
    gpu->parallelism = 0;
    return gpu;
}

static void a_device_is_measured(void **state)
{
    (void)state;
    WeirGpu *gpu = unmeasured(NULL);
    assert_null(weir_gpu_backend(gpu));
    assert_int_equal(weir_gpu_poll(gpu), WEIR_PENDING);
    assert_int_equal(weir_gpu_wait(gpu), WEIR_OK);
    assert_in_range(weir_gpu_parallelism(gpu), 256, 65536);
    assert_non_null(weir_gpu_backend(gpu));
    assert_true(weir_gpu_memory(gpu) == 0);
    weir_gpu_destroy(gpu);
}

static void a_measurement_may_be_given_up(void **state)
{
    (void)state;
    WeirGpu *gpu = unmeasured(NULL);
    assert_int_equal(weir_gpu_poll(gpu), WEIR_PENDING);
    weir_gpu_destroy(gpu);
}

static void a_device_lost_while_it_is_measured_is_reported(void **state)
{
    (void)state;
    WeirGpu *gpu = unmeasured(NULL);
    assert_int_equal(weir_gpu_poll(gpu), WEIR_PENDING);
    wgpuDeviceDestroy(weir_gpu_wgpu_device(gpu));
    WeirStatus status = WEIR_PENDING;
    for (int n = 0; n < 1000 && (status == WEIR_OK || status == WEIR_PENDING); ++n)
        status = weir_gpu_wait(gpu);
    assert_int_equal(status, WEIR_ERROR_DEVICE);
    weir_gpu_destroy(gpu);
}

// A device that tells no times counts as a laptop's.
static void without_times_there_is_a_guess(void **state)
{
    (void)state;
    WeirGpu *gpu = unmeasured(&(WeirGpuOptions){.no_timestamps = true});
    assert_int_equal(weir_gpu_poll(gpu), WEIR_OK);
    assert_int_equal(weir_gpu_parallelism(gpu), 16384);
    weir_gpu_destroy(gpu);
}

static void what_is_remembered_holds_for_its_device(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(&(WeirGpuOptions){.parallelism = 5000});
    uint32_t own = 65536; // of a software adapter
    assert_int_equal(weir_gpu_parallelism(gpu), 4096);
    char device[128];
    snprintf(device, sizeof device, "%s", weir_gpu_device(gpu));
    weir_gpu_destroy(gpu);
    gpu = weir_test_gpu(&(WeirGpuOptions){.parallelism = 1024, .parallelism_device = device});
    assert_int_equal(weir_gpu_parallelism(gpu), 1024);
    weir_gpu_destroy(gpu);
    gpu = weir_test_gpu(&(WeirGpuOptions){.parallelism = 1024, .parallelism_device = "another one"});
    if (weir_gpu_is_software(gpu)) assert_int_equal(weir_gpu_parallelism(gpu), own);
    weir_gpu_destroy(gpu);
}

static WeirWcsphTraits planned(WeirGpu *gpu, uint32_t parallelism, uint32_t particles)
{
    gpu->parallelism = parallelism;
    WeirTestWorld test = weir_test_case("dam_2d");
    WeirSolver *solver = weir_test_world_solver(&test, weir_gpu_backend(gpu));
    const WeirWcsphGpu *own = (const WeirWcsphGpu *)solver;
    WeirWcsphTraits traits = own->traits;
    WeirConstants constants = own->common.constants;
    constants.particle_count = particles;
    weir_gpu_wcsph_plan(&traits, &own->common.parameters, &constants, gpu, UINT64_MAX);
    solver->interface->destroy(solver);
    weir_test_world_free(&test);
    return traits;
}

// Threads share neighbours where one per particle would leave a device idle, and lists are offered in every step where a dispatch
// costs little beside it.
static void small_devices_are_filled_by_fewer_particles(void **state)
{
    (void)state;
    WeirGpu *gpu = weir_test_gpu(NULL);
    gpu->software = false;
    WeirWcsphTraits large = planned(gpu, 65536, 20000), small = planned(gpu, 4096, 20000);
    assert_true(large.lanes > 1 && small.lanes == 1);
    assert_true(planned(gpu, 4096, 20000 / 16).lanes == large.lanes);
    assert_true(large.list_interval > 1 && planned(gpu, 1024, 20000).list_interval == 1);
    assert_true(!large.marks_mixed && small.marks_mixed);
    gpu->parallelism = 65536;
    assert_int_equal(weir_mueller_lanes(gpu, 20000), 4);
    assert_int_equal(weir_mueller_lanes(gpu, 2000), 8);
    gpu->parallelism = 4096;
    assert_int_equal(weir_mueller_lanes(gpu, 20000), 1);
    assert_int_equal(weir_mueller_lanes(gpu, 2000), 4);
    weir_gpu_destroy(gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_nearest_power_of_four_counts),
        cmocka_unit_test(a_device_is_measured),
        cmocka_unit_test(a_measurement_may_be_given_up),
        cmocka_unit_test(a_device_lost_while_it_is_measured_is_reported),
        cmocka_unit_test(without_times_there_is_a_guess),
        cmocka_unit_test(what_is_remembered_holds_for_its_device),
        cmocka_unit_test(small_devices_are_filled_by_fewer_particles),
    };
    return cmocka_run_group_tests_name("parallelism", tests, NULL, NULL);
}
