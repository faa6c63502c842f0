// weir info: what this program was built with and what it finds on this machine.
#include "backend.h"
#include "commands.h"
#include "output.h"

#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

#if WEIR_WITH_GPU
#include "gpu/gpu.h"
#endif

typedef struct InfoOptions {
    bool json;
} InfoOptions;

// The CPU solver names the instruction set that it has chosen; a simulation of one particle tells.
static void cpu_device(char *text, size_t size)
{
    snprintf(text, size, "unknown");
    WeirScene *scene = weir_scene_create();
    if (!scene) return;
    double corner[3] = {0.01, 0.01, 0.0};
    weir_scene_add_box(scene, (double[3]){0}, corner, NULL);
    WeirSim *sim = weir_sim_create(scene, NULL);
    if (sim && weir_sim_status(sim) == WEIR_OK) snprintf(text, size, "%s", weir_sim_device(sim));
    weir_sim_destroy(sim);
    weir_scene_destroy(scene);
}

#if WEIR_WITH_GPU
static json_t *limits_json(WeirGpu *gpu)
{
    WGPULimits limits = WGPU_LIMITS_INIT;
    if (wgpuDeviceGetLimits(weir_gpu_wgpu_device(gpu), &limits) != WGPUStatus_Success) return json_object();
    return json_pack(
        "{s:I, s:I, s:I, s:I, s:I, s:I}", "max_buffer_size", (json_int_t)limits.maxBufferSize,
        "max_storage_buffer_binding_size", (json_int_t)limits.maxStorageBufferBindingSize,
        "max_storage_buffers_per_shader_stage", (json_int_t)limits.maxStorageBuffersPerShaderStage,
        "max_compute_workgroups_per_dimension", (json_int_t)limits.maxComputeWorkgroupsPerDimension,
        "max_compute_invocations_per_workgroup", (json_int_t)limits.maxComputeInvocationsPerWorkgroup,
        "max_compute_workgroup_storage_size", (json_int_t)limits.maxComputeWorkgroupStorageSize);
}
#endif

// The adapter that Weir takes, or why there is none.
static json_t *gpu_json(void)
{
    WeirCliBackend backend;
    char message[512];
    if (weir_cli_backend_open(&backend, "gpu", (WeirCliDevice){0}, message, sizeof message)) {
        return json_pack("{s:n, s:s}", "device", "error", message);
    }
#if WEIR_WITH_GPU
    json_t *gpu =
        json_pack("{s:s, s:b, s:I, s:o}", "device", weir_gpu_device(backend.gpu), "software",
                  weir_gpu_is_software(backend.gpu), "parallelism",
                  (json_int_t)weir_gpu_parallelism(backend.gpu), "limits", limits_json(backend.gpu));
#else
    json_t *gpu = json_object();
#endif
    weir_cli_backend_close(&backend);
    return gpu;
}

static json_t *info_json(void)
{
    char cpu[128];
    struct utsname system = {0};
    uname(&system);
    cpu_device(cpu, sizeof cpu);
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:I, s:o}", "version", WEIR_VERSION, "compiler",
                     WEIR_BUILD_COMPILER, "build", WEIR_BUILD_TYPE, "flags", WEIR_BUILD_FLAGS, "system",
                     system.sysname, "machine", system.machine, "cpu", cpu, "cores",
                     (json_int_t)sysconf(_SC_NPROCESSORS_ONLN), "gpu", gpu_json());
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

static void print_text(const json_t *info)
{
    const json_t *gpu = json_object_get(info, "gpu");
    const char *key;
    json_t *value;
    printf("version   %s\n", text_of(info, "version"));
    printf("compiler  %s, %s\n", text_of(info, "compiler"), text_of(info, "build"));
    printf("flags     %s\n", text_of(info, "flags"));
    printf("system    %s %s, %lld cores\n", text_of(info, "system"), text_of(info, "machine"),
           (long long)json_integer_value(json_object_get(info, "cores")));
    printf("cpu       %s\n", text_of(info, "cpu"));
    if (!json_is_string(json_object_get(gpu, "device"))) {
        printf("gpu       none: %s\n", text_of(gpu, "error"));
        return;
    }
    printf("gpu       %s%s\n", text_of(gpu, "device"),
           json_is_true(json_object_get(gpu, "software")) ? " (software: --backend auto takes the CPU)" : "");
    printf("          %-38s %lld\n", "parallelism (threads that keep it busy)",
           (long long)json_integer_value(json_object_get(gpu, "parallelism")));
    json_object_foreach(json_object_get(gpu, "limits"), key, value)
    {
        printf("          %-38s %lld\n", key, (long long)json_integer_value(value));
    }
}

static int info_command(int argument_count, char **arguments)
{
    InfoOptions options = {0};
    const char *positional;
    int exit_status;
    if (!weir_options_parse(&weir_info_command, argument_count, arguments, &options, &positional,
                            &exit_status)) {
        return exit_status;
    }
    json_t *info = info_json();
    if (!info) {
        fprintf(stderr, "weir info: memory ran out\n");
        return WEIR_EXIT_FAILED;
    }
    if (options.json) return weir_json_print(info, stdout) ? WEIR_EXIT_DONE : WEIR_EXIT_FAILED;
    print_text(info);
    json_decref(info);
    return WEIR_EXIT_DONE;
}

static const WeirOption info_options[] = {
    {"--json", WEIR_OPTION_FLAG, NULL, NULL, offsetof(InfoOptions, json), 0, 0, "as JSON"},
};

const WeirCommand weir_info_command = {
    .name = "info",
    .synopsis = "[--json]",
    .summary = "tells the version, how it was built, and the devices of this machine",
    .notes = "",
    .options = info_options,
    .option_count = sizeof info_options / sizeof info_options[0],
    .run = info_command,
};
