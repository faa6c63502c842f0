// Every field of Parameters and Constants, as a shader sees it, is the one that C wrote: a pass
// echoes all of them.
#include "adapter.h"
#include "gpu/mueller.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum Kind { VECTOR, NUMBER, COUNT } Kind;

static const struct Field {
    const char *owner, *name;
    Kind kind;
    size_t offset;
} fields[] = {
#define WEIR_VECTOR(name, ...) {"parameters", #name, VECTOR, offsetof(WeirParameters, name)},
#define WEIR_NUMBER(name, ...) {"parameters", #name, NUMBER, offsetof(WeirParameters, name)},
#define WEIR_CHOICE(name, ...) {"parameters", #name, COUNT, offsetof(WeirParameters, name)},
#include "core/params.inl"
#define WEIR_CONSTANT_VECTOR(name, help) {"constants", #name, VECTOR, offsetof(WeirConstants, name)},
#define WEIR_CONSTANT_NUMBER(name, help) {"constants", #name, NUMBER, offsetof(WeirConstants, name)},
#define WEIR_CONSTANT_COUNT(name, help)  {"constants", #name, COUNT, offsetof(WeirConstants, name)},
#include "core/constants.inl"
};
enum { FIELDS = sizeof fields / sizeof fields[0], ECHO_BINDING = 2 };

// One vec4 of 32-bit words per field; those that it does not fill are 0.
static char *make_shader(void)
{
    static char body[16384];
    size_t length = (size_t)snprintf(body, sizeof body,
                                     "@group(0) @binding(%d) var<storage, read_write> echo: array<vec4u>;\n"
                                     "@compute @workgroup_size(1) fn echo_fields() {\n",
                                     ECHO_BINDING);
    static const char *const forms[] = {
        [VECTOR] = "    echo[%d] = bitcast<vec4u>(%s.%s);\n",
        [NUMBER] = "    echo[%d] = vec4u(bitcast<u32>(%s.%s), 0u, 0u, 0u);\n",
        [COUNT] = "    echo[%d] = vec4u(%s.%s, 0u, 0u, 0u);\n",
    };
    for (int n = 0; n < FIELDS; ++n) {
        length += (size_t)snprintf(body + length, sizeof body - length, forms[fields[n].kind], n,
                                   fields[n].owner, fields[n].name);
    }
    length += (size_t)snprintf(body + length, sizeof body - length, "}\n");
    assert_true(length < sizeof body);
    char *source = weir_pass_source(&weir_mueller_method, "const TUTORIAL_KERNELS = false;\n", 1, NULL, body);
    assert_non_null(source);
    return source;
}

// Every word of both structs gets a value of its own.
static void fill(void *data, size_t size, uint32_t first)
{
    for (uint32_t word = 0; word < size / 4; ++word) {
        uint32_t value = 0x3f800000u + first + word; // a float near 1, and a number as good as any
        memcpy((char *)data + 4 * word, &value, 4);
    }
}

// The pass that echoes, and its three buffers: the uniforms and the echo.
typedef struct Echo {
    WeirGpu *gpu;
    uint64_t size[3];
    WGPUBuffer buffer[3];
    WGPUBindGroupLayout layout;
    WGPUBindGroup group;
    WGPUComputePipeline pipeline;
} Echo;

static void make_echo(Echo *echo, WeirGpu *gpu)
{
    *echo = (Echo){.gpu = gpu, .size = {sizeof(WeirParameters), sizeof(WeirConstants), 16 * FIELDS}};
    WGPUBindGroupLayoutEntry layout[3] = {0};
    WGPUBindGroupEntry entries[3] = {0};
    for (uint32_t n = 0; n < 3; ++n) {
        bool uniform = n != ECHO_BINDING;
        WGPUBufferUsage usage = uniform ? WGPUBufferUsage_Uniform : WGPUBufferUsage_Storage;
        echo->buffer[n] = weir_gpu_create_buffer(
            gpu, "echo", usage | WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc, echo->size[n]);
        layout[n] = (WGPUBindGroupLayoutEntry){.binding = n,
                                               .visibility = WGPUShaderStage_Compute,
                                               .buffer.type = uniform ? WGPUBufferBindingType_Uniform
                                                                      : WGPUBufferBindingType_Storage};
        entries[n] = (WGPUBindGroupEntry){.binding = n, .buffer = echo->buffer[n], .size = echo->size[n]};
    }
    echo->layout = wgpuDeviceCreateBindGroupLayout(
        gpu->device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 3, .entries = layout});
    echo->group = wgpuDeviceCreateBindGroup(
        gpu->device, &(WGPUBindGroupDescriptor){.layout = echo->layout, .entryCount = 3, .entries = entries});
    char *source = make_shader();
    WeirReport *report = weir_report_create(gpu);
    echo->pipeline = weir_pass_pipeline(gpu, "echo_fields", "pass echo", source, echo->layout, report);
    free(source);
    while (weir_report_pending(report)) weir_gpu_poll(gpu);
    WeirMessage message = {""};
    if (weir_report_check(report, &message) != WEIR_OK) fail_msg("%s", message.text);
    weir_report_destroy(report);
}

static void free_echo(Echo *echo)
{
    wgpuComputePipelineRelease(echo->pipeline);
    wgpuBindGroupRelease(echo->group);
    wgpuBindGroupLayoutRelease(echo->layout);
    for (int n = 0; n < 3; ++n) weir_gpu_destroy_buffer(echo->gpu, echo->buffer[n], echo->size[n]);
}

// Runs the pass; the readback is ready then.
static WeirReadback *run_echo(const Echo *echo)
{
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(echo->gpu->device, NULL);
    WGPUComputePassEncoder pass = wgpuCommandEncoderBeginComputePass(encoder, NULL);
    wgpuComputePassEncoderSetPipeline(pass, echo->pipeline);
    wgpuComputePassEncoderSetBindGroup(pass, 0, echo->group, 0, NULL);
    wgpuComputePassEncoderDispatchWorkgroups(pass, 1, 1, 1);
    wgpuComputePassEncoderEnd(pass);
    wgpuComputePassEncoderRelease(pass);
    WeirReadback *readback = weir_readback_create(echo->gpu, "echo readback", echo->size[ECHO_BINDING]);
    weir_readback_copy(readback, encoder, echo->buffer[ECHO_BINDING], 0, echo->size[ECHO_BINDING]);
    weir_gpu_submit(echo->gpu, encoder, "echo");
    weir_readback_start(readback);
    while (weir_readback_state(readback) != WEIR_READBACK_READY)
        assert_int_equal(weir_gpu_poll(echo->gpu), WEIR_OK);
    return readback;
}

static void every_field_arrives(void **state)
{
    Echo echo;
    make_echo(&echo, *state);
    WeirParameters parameters;
    WeirConstants constants;
    fill(&parameters, sizeof parameters, 1000);
    fill(&constants, sizeof constants, 2000);
    wgpuQueueWriteBuffer(echo.gpu->queue, echo.buffer[0], 0, &parameters, sizeof parameters);
    wgpuQueueWriteBuffer(echo.gpu->queue, echo.buffer[1], 0, &constants, sizeof constants);
    WeirReadback *readback = run_echo(&echo);
    const uint32_t *seen = weir_readback_data(readback);
    assert_non_null(seen);
    for (int n = 0; n < FIELDS; ++n) {
        bool first = strcmp(fields[n].owner, "parameters") == 0;
        const char *written = (first ? (char *)&parameters : (char *)&constants) + fields[n].offset;
        if (memcmp(seen + 4 * n, written, fields[n].kind == VECTOR ? 16 : 4) != 0)
            fail_msg("%s.%s: C wrote 0x%x, the shader reads 0x%x", fields[n].owner, fields[n].name,
                     (unsigned)*(const uint32_t *)written, (unsigned)seen[4 * n]);
    }
    weir_readback_finish(readback);
    weir_readback_destroy(readback);
    free_echo(&echo);
}

int main(void)
{
    WeirGpu *gpu = weir_test_gpu(NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(every_field_arrives, gpu)};
    int failed = cmocka_run_group_tests_name("layout", tests, NULL, NULL);
    weir_gpu_destroy(gpu);
    return failed;
}
