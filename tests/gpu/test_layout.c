// Every field of every struct that C and the shaders share is, as a shader sees it, the one that C wrote: a pass echoes
// all of them.
#include "adapter.h"
#include "gpu/mueller.h"
#include "gpu/wcsph.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum Kind { VECTOR, NUMBER, COUNT } Kind;

typedef struct Field {
    const char *owner, *name; // owner.name is the shader's expression
    Kind kind;
    size_t offset;
} Field;

static const Field fields[] = {
#define WEIR_VECTOR(name, ...) {"parameters", #name, VECTOR, offsetof(WeirParameters, name)},
#define WEIR_NUMBER(name, ...) {"parameters", #name, NUMBER, offsetof(WeirParameters, name)},
#define WEIR_CHOICE(name, ...) {"parameters", #name, COUNT, offsetof(WeirParameters, name)},
#include "core/params.inl"
#define WEIR_CONSTANT_VECTOR(name, help) {"constants", #name, VECTOR, offsetof(WeirConstants, name)},
#define WEIR_CONSTANT_PLACE(name, help)  {"constants", #name, VECTOR, offsetof(WeirConstants, name)},
#define WEIR_CONSTANT_NUMBER(name, help) {"constants", #name, NUMBER, offsetof(WeirConstants, name)},
#define WEIR_CONSTANT_COUNT(name, help)  {"constants", #name, COUNT, offsetof(WeirConstants, name)},
#include "core/constants.inl"
#define SOLID(name, kind) {"solid_table[1]", #name, kind, sizeof(WeirSolid) + offsetof(WeirSolid, name)}
    SOLID(kind, COUNT),
    SOLID(no_slip, COUNT),
    SOLID(first, COUNT),
    SOLID(count, COUNT),
    SOLID(motion_first, COUNT),
    SOLID(motion_count, COUNT),
    SOLID(motion_repeats, COUNT),
    SOLID(mass, NUMBER),
    SOLID(surface_velocity, VECTOR),
    SOLID(freedom, VECTOR),
    SOLID(angular_freedom, VECTOR),
    SOLID(inverse_inertia[0], VECTOR),
    SOLID(inverse_inertia[2], VECTOR),
    SOLID(position, VECTOR),
    SOLID(velocity, VECTOR),
    SOLID(angular_velocity, VECTOR),
#define EMITTER(name, kind)                                                                                  \
    {"emitters[3]", #name, kind, 3 * sizeof(WeirEmitter) + offsetof(WeirEmitter, name)}
    EMITTER(point_first, COUNT),
    EMITTER(point_count, COUNT),
    EMITTER(speed, NUMBER),
    EMITTER(start, NUMBER),
    EMITTER(stop, NUMBER),
    EMITTER(direction, VECTOR),
    EMITTER(center, VECTOR),
    {"drains[2]", "low", VECTOR, 2 * sizeof(WeirDrain) + offsetof(WeirDrain, min)},
    {"drains[2]", "high", VECTOR, 2 * sizeof(WeirDrain) + offsetof(WeirDrain, max)},
#define STATE(name)                                                                                          \
    {"solid_state[2]", #name, VECTOR, 2 * sizeof(WeirSolidState) + offsetof(WeirSolidState, name)}
    STATE(position),
    STATE(orientation),
    STATE(velocity),
    STATE(angular_velocity),
    STATE(acceleration),
    STATE(angular_acceleration),
    STATE(force),
    STATE(torque),
#define CONTROL(name, kind) {"control", #name, kind, offsetof(WeirWcsphControl, name)}
#define TIME(name)                                                                                           \
    {"control", #name ".x", COUNT, offsetof(WeirWcsphControl, name)},                                        \
        {"control", #name ".y", COUNT, offsetof(WeirWcsphControl, name) + 4}
    TIME(until),
#define CLOCK(name, kind)                                                                                    \
    CONTROL(clock.name, kind), CONTROL(clocks[0].name, kind), CONTROL(clocks[2].name, kind)
    TIME(clock.time),
    TIME(clock.began),
    TIME(clocks[2].time),
    TIME(clocks[2].began),
    CLOCK(steps_left, COUNT),
    CLOCK(running, COUNT),
    CLOCK(stepping, COUNT),
    CLOCK(steps, COUNT),
    CLOCK(dt, NUMBER),
    CLOCK(free_dt, NUMBER),
    CLOCK(next_dt, NUMBER),
    CLOCK(max_speed, NUMBER),
    CLOCK(side, COUNT),
    CLOCK(last_side, COUNT),
    CLOCK(sorting, COUNT),
    CLOCK(listing, COUNT),
    CLOCK(worn, COUNT),
    CLOCK(stale, COUNT),
    CLOCK(travelled, COUNT),
    CLOCK(next_allowance, COUNT),
    CLOCK(noting, COUNT),
    CLOCK(left, NUMBER),
    CLOCK(flow_speed, NUMBER),
    CLOCK(due_excess, NUMBER),
    CLOCK(diffusion, NUMBER),
#define MAXIMA(name) CONTROL(maxima[0].name, COUNT), CONTROL(maxima[2].name, COUNT)
    MAXIMA(speed2_bits),
    MAXIMA(acceleration2_bits),
    MAXIMA(excess_bits),
    MAXIMA(finish2_bits),
    MAXIMA(drift2_bits),
    MAXIMA(bad),
    CONTROL(steps_asked, COUNT),
    CONTROL(solid_speed, NUMBER),
    CONTROL(bad_particles, COUNT),
    CONTROL(bad_step, COUNT),
    CONTROL(bad_id, COUNT),
    CONTROL(bad_slot, COUNT),
    CONTROL(starting, COUNT),
    CONTROL(bad_place, VECTOR),
    CONTROL(drained, COUNT),
    CONTROL(lost, COUNT),
    CONTROL(emitted, COUNT),
    CONTROL(restored, COUNT),
    CONTROL(sorted_at, COUNT),
    CONTROL(listed_at, COUNT),
    CONTROL(allowance, COUNT),
    TIME(next_due),
};
enum { FIELDS = sizeof fields / sizeof fields[0], SOLIDS = 3, EMITTERS = 4, DRAINS = 2, GROUPS = 1 };

// The buffers that the pass reads, by what the fields' owners start with, and the one that it writes, last.
typedef struct Source {
    const char *owner;
    uint32_t binding;
    WGPUBufferBindingType type;
    uint64_t size;
} Source;
static const Source sources[] = {
    {"parameters", WEIR_WCSPH_parameters, WGPUBufferBindingType_Uniform, sizeof(WeirParameters)},
    {"constants", WEIR_WCSPH_constants, WGPUBufferBindingType_Uniform, sizeof(WeirConstants)},
    {"solid_table", WEIR_WCSPH_solid_table, WGPUBufferBindingType_Uniform, SOLIDS * sizeof(WeirSolid)},
    {"emitters", WEIR_WCSPH_emitters, WGPUBufferBindingType_Uniform, EMITTERS * sizeof(WeirEmitter)},
    {"drains", WEIR_WCSPH_drains, WGPUBufferBindingType_Uniform, (GROUPS + DRAINS) * sizeof(WeirDrain)},
    {"solid_state", WEIR_WCSPH_solid_state, WGPUBufferBindingType_ReadOnlyStorage,
     SOLIDS * sizeof(WeirSolidState)},
    {"control", WEIR_WCSPH_control, WGPUBufferBindingType_ReadOnlyStorage, sizeof(WeirWcsphControl)},
    {"echo", WEIR_WCSPH_kicked, WGPUBufferBindingType_Storage, 16 * FIELDS},
};
enum { SOURCES = sizeof sources / sizeof sources[0], ECHO = SOURCES - 1 };

// One vec4 of 32-bit words per field; those that it does not fill are 0.
static char *make_shader(void)
{
    static char body[32768], settings[WEIR_SETTINGS_LENGTH];
    size_t length = (size_t)snprintf(
        body, sizeof body,
        "@group(0) @binding(BINDING_kicked) var<storage, read_write> echo: array<vec4u>;\n"
        "@group(0) @binding(BINDING_solid_state) var<storage, read> solid_state: array<SolidState>;\n"
        "@group(0) @binding(BINDING_control) var<storage, read> control: Control;\n"
        "@compute @workgroup_size(1) fn echo_fields() {\n");
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
    WeirParameters parameters = {0};
    WeirConstants constants = {0};
    weir_gpu_wcsph_settings(&parameters, &constants,
                            &(WeirWcsphTraits){.dimension = 2,
                                               .solid_count = SOLIDS,
                                               .emitter_count = EMITTERS,
                                               .drain_count = DRAINS,
                                               .drain_group_count = GROUPS},
                            settings);
    char *source = weir_pass_source(weir_gpu_wcsph_method(2), WEIR_WORKGROUP_SIZE, settings, NULL, body);
    assert_non_null(source);
    return source;
}

// Every word gets a value of its own.
static void fill(void *data, size_t size, uint32_t first)
{
    for (uint32_t word = 0; word < size / 4; ++word) {
        uint32_t value = 0x3f800000u + first + word; // a float near 1, and a number as good as any
        memcpy((char *)data + 4 * word, &value, 4);
    }
}

// The pass that echoes, and its buffers.
typedef struct Echo {
    WeirGpu *gpu;
    WGPUBuffer buffer[SOURCES];
    WGPUBindGroupLayout layout;
    WGPUBindGroup group;
    WGPUComputePipeline pipeline;
} Echo;

static void make_echo(Echo *echo, WeirGpu *gpu)
{
    *echo = (Echo){.gpu = gpu};
    WGPUBindGroupLayoutEntry layout[SOURCES] = {0};
    WGPUBindGroupEntry entries[SOURCES] = {0};
    for (int n = 0; n < SOURCES; ++n) {
        const Source *source = &sources[n];
        bool uniform = source->type == WGPUBufferBindingType_Uniform;
        WGPUBufferUsage usage = uniform ? WGPUBufferUsage_Uniform : WGPUBufferUsage_Storage;
        echo->buffer[n] = weir_gpu_create_buffer(
            gpu, "echo", usage | WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc, source->size);
        layout[n] = (WGPUBindGroupLayoutEntry){
            .binding = source->binding, .visibility = WGPUShaderStage_Compute, .buffer.type = source->type};
        entries[n] =
            (WGPUBindGroupEntry){.binding = source->binding, .buffer = echo->buffer[n], .size = source->size};
    }
    echo->layout = wgpuDeviceCreateBindGroupLayout(
        gpu->device, &(WGPUBindGroupLayoutDescriptor){.entryCount = SOURCES, .entries = layout});
    echo->group = wgpuDeviceCreateBindGroup(
        gpu->device,
        &(WGPUBindGroupDescriptor){.layout = echo->layout, .entryCount = SOURCES, .entries = entries});
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
    for (int n = 0; n < SOURCES; ++n) weir_gpu_destroy_buffer(echo->gpu, echo->buffer[n], sources[n].size);
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
    WeirReadback *readback =
        weir_readback_create(echo->gpu, "echo readback", 1, &(uint64_t){sources[ECHO].size});
    weir_readback_copy(readback, encoder, 0, echo->buffer[ECHO], 0);
    weir_gpu_submit(echo->gpu, encoder, "echo");
    weir_readback_start(readback);
    while (weir_readback_state(readback) != WEIR_READBACK_READY)
        assert_int_equal(weir_gpu_poll(echo->gpu), WEIR_OK);
    return readback;
}

static const char *written_to(char *const data[ECHO], const Field *field)
{
    for (int n = 0; n < ECHO; ++n) {
        if (strncmp(field->owner, sources[n].owner, strlen(sources[n].owner)) == 0)
            return data[n] + field->offset;
    }
    fail_msg("%s: no such buffer", field->owner);
    return NULL;
}

static void every_field_arrives(void **state)
{
    Echo echo;
    make_echo(&echo, *state);
    char *data[ECHO];
    for (int n = 0; n < ECHO; ++n) {
        data[n] = malloc(sources[n].size);
        assert_non_null(data[n]);
        fill(data[n], sources[n].size, 1000 * (uint32_t)(n + 1));
        wgpuQueueWriteBuffer(echo.gpu->queue, echo.buffer[n], 0, data[n], sources[n].size);
    }
    WeirReadback *readback = run_echo(&echo);
    const uint32_t *seen = weir_readback_data(readback, 0);
    assert_non_null(seen);
    for (int n = 0; n < FIELDS; ++n) {
        const char *written = written_to(data, &fields[n]);
        if (memcmp(seen + 4 * n, written, fields[n].kind == VECTOR ? 16 : 4) != 0)
            fail_msg("%s.%s: C wrote 0x%x, the shader reads 0x%x", fields[n].owner, fields[n].name,
                     (unsigned)*(const uint32_t *)(const void *)written, (unsigned)seen[4 * n]);
    }
    weir_readback_finish(readback);
    weir_readback_destroy(readback);
    free_echo(&echo);
    for (int n = 0; n < ECHO; ++n) free(data[n]);
}

int main(void)
{
    WeirGpu *gpu = weir_test_gpu(NULL);
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(every_field_arrives, gpu)};
    int failed = cmocka_run_group_tests_name("layout", tests, NULL, NULL);
    weir_gpu_destroy(gpu);
    return failed;
}
