// Layouts, pipelines, compute and render passes, textures, the surface.
#include "webgpu_calls.h"

#include <string.h>

static WGPUShaderModule make_shader(const char *code)
{
    WGPUShaderSourceWGSL source = {{NULL, WGPUSType_ShaderSourceWGSL}, weir_test_text(code)};
    return wgpuDeviceCreateShaderModule(world.device,
                                        &(WGPUShaderModuleDescriptor){.nextInChain = &source.chain});
}

// ---------------------------------------------------------------------------------------------------------
// Compute: two groups, one with a dynamic offset, over more workgroups in x and y than one.

static const char compute_code[] =
    "struct Uniform { factor: u32 }\n"
    "@group(0) @binding(0) var<uniform> uniforms: Uniform;\n"
    "@group(0) @binding(2) var<storage, read> numbers: array<u32>;\n"
    "@group(1) @binding(1) var<storage, read_write> results: array<u32>;\n"
    "@compute @workgroup_size(4) fn other() { results[0] = 77; }\n"
    "@compute @workgroup_size(4)\n"
    "fn multiply(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) size: vec3u) {\n"
    "  let index = id.x + id.y * size.x * 4;\n"
    "  results[index] = numbers[index] * uniforms.factor + id.z;\n"
    "}\n";

enum { NUMBERS = 24, FACTOR_OFFSET = 256, NUMBERS_OFFSET = 256, WINDOW = 4 * NUMBERS };

typedef struct Compute {
    WGPUBindGroupLayout layouts[2];
    WGPUPipelineLayout pipeline_layout;
    WGPUShaderModule shader;
    WGPUComputePipeline pipeline;
    WGPUBuffer uniforms, numbers, results;
    WGPUBindGroup groups[2];
    WGPUQuerySet times;
} Compute;

static WGPUComputePipelineDescriptor compute_descriptor(const Compute *compute, const char *entry)
{
    return (WGPUComputePipelineDescriptor){
        .label = weir_test_text("multiply"),
        .layout = compute->pipeline_layout,
        .compute = {.module = compute->shader, .entryPoint = weir_test_text(entry)},
    };
}

static void make_compute_pipeline(Compute *compute)
{
    WGPUBindGroupLayoutEntry inputs[2] = {
        {.binding = 0,
         .visibility = WGPUShaderStage_Compute,
         .buffer = {.type = WGPUBufferBindingType_Uniform, .hasDynamicOffset = 1, .minBindingSize = 4}},
        {.binding = 2,
         .visibility = WGPUShaderStage_Compute,
         .buffer = {.type = WGPUBufferBindingType_ReadOnlyStorage}},
    };
    WGPUBindGroupLayoutEntry output = {.binding = 1,
                                       .visibility = WGPUShaderStage_Compute,
                                       .buffer = {.type = WGPUBufferBindingType_Storage}};
    WGPUBindGroupLayoutDescriptor first = {
        .label = weir_test_text("inputs"), .entryCount = 2, .entries = inputs};
    WGPUBindGroupLayoutDescriptor second = {.entryCount = 1, .entries = &output};
    compute->layouts[0] = wgpuDeviceCreateBindGroupLayout(world.device, &first);
    compute->layouts[1] = wgpuDeviceCreateBindGroupLayout(world.device, &second);
    WGPUPipelineLayoutDescriptor layout = {.bindGroupLayoutCount = 2, .bindGroupLayouts = compute->layouts};
    compute->pipeline_layout = wgpuDeviceCreatePipelineLayout(world.device, &layout);
    compute->shader = make_shader(compute_code);
    WGPUComputePipelineDescriptor descriptor = compute_descriptor(compute, "multiply");
    compute->pipeline = wgpuDeviceCreateComputePipeline(world.device, &descriptor);
}

static void make_compute_groups(Compute *compute)
{
    WGPUBufferUsage storage = WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc;
    compute->uniforms =
        weir_test_buffer(WGPUBufferUsage_Uniform | WGPUBufferUsage_CopyDst, FACTOR_OFFSET + 16);
    compute->numbers = weir_test_buffer(storage, NUMBERS_OFFSET + WINDOW);
    compute->results = weir_test_buffer(storage, WINDOW);
    WGPUBindGroupEntry inputs[2] = {
        {.binding = 0, .buffer = compute->uniforms, .size = 16},
        {.binding = 2, .buffer = compute->numbers, .offset = NUMBERS_OFFSET, .size = WGPU_WHOLE_SIZE},
    };
    WGPUBindGroupEntry output = {.binding = 1, .buffer = compute->results, .size = WINDOW};
    WGPUBindGroupDescriptor first = {.layout = compute->layouts[0], .entryCount = 2, .entries = inputs};
    WGPUBindGroupDescriptor second = {.layout = compute->layouts[1], .entryCount = 1, .entries = &output};
    compute->groups[0] = wgpuDeviceCreateBindGroup(world.device, &first);
    compute->groups[1] = wgpuDeviceCreateBindGroup(world.device, &second);
}

enum { SIZES_OFFSET = 8 };

// With the numbers of workgroups from buffer `sizes`, if there is one.
static void run_compute(Compute *compute, const WGPUPassTimestampWrites *times, WGPUBuffer sizes)
{
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
    WGPUComputePassDescriptor descriptor = {.label = weir_test_text("multiply"), .timestampWrites = times};
    WGPUComputePassEncoder pass = wgpuCommandEncoderBeginComputePass(encoder, &descriptor);
    wgpuComputePassEncoderSetPipeline(pass, compute->pipeline);
    wgpuComputePassEncoderSetBindGroup(pass, 0, compute->groups[0], 1, &(uint32_t){FACTOR_OFFSET});
    wgpuComputePassEncoderSetBindGroup(pass, 1, compute->groups[1], 0, NULL);
    if (sizes)
        wgpuComputePassEncoderDispatchWorkgroupsIndirect(pass, sizes, SIZES_OFFSET);
    else
        wgpuComputePassEncoderDispatchWorkgroups(pass, 2, 3, 1);
    wgpuComputePassEncoderEnd(pass);
    wgpuComputePassEncoderRelease(pass);
    weir_test_submit(encoder);
}

static void free_compute(Compute *compute)
{
    for (int k = 0; k < 2; k++) wgpuBindGroupRelease(compute->groups[k]);
    for (int k = 0; k < 2; k++) wgpuBindGroupLayoutRelease(compute->layouts[k]);
    wgpuPipelineLayoutRelease(compute->pipeline_layout);
    wgpuShaderModuleRelease(compute->shader);
    wgpuComputePipelineAddRef(compute->pipeline);
    for (int k = 0; k < 2; k++) wgpuComputePipelineRelease(compute->pipeline);
    wgpuBufferRelease(compute->uniforms);
    wgpuBufferRelease(compute->numbers);
    wgpuBufferRelease(compute->results);
}

// With `sizes`, where other numbers of workgroups than the last ones would leave results at 0.
static int multiply(uint32_t step, Compute *compute, uint32_t factor, WGPUBuffer sizes)
{
    static uint32_t back[NUMBERS];
    if (step == 0) {
        make_compute_pipeline(compute);
        make_compute_groups(compute);
        CHECK(compute->pipeline && compute->groups[0] && compute->groups[1]);
        wgpuQueueWriteBuffer(world.queue, compute->uniforms, FACTOR_OFFSET, &factor, 4);
        for (uint32_t k = 0; k < NUMBERS; k++)
            wgpuQueueWriteBuffer(world.queue, compute->numbers, NUMBERS_OFFSET + 4 * k, &k, 4);
        if (sizes)
            wgpuQueueWriteBuffer(world.queue, sizes, 0, (uint32_t[]){1, 1, 2, 3, 1}, SIZES_OFFSET + 12);
        run_compute(compute, NULL, sizes);
    }
    AWAIT(weir_test_read(compute->results, 0, sizeof back, back));
    for (uint32_t k = 0; k < NUMBERS; k++) CHECK(back[k] == factor * k);
    CHECK(world.error_count == 0);
    free_compute(compute);
    return DONE;
}

static int test_compute(uint32_t step)
{
    static Compute compute;
    return multiply(step, &compute, 1000, NULL);
}

typedef struct Made {
    WGPUCreatePipelineAsyncStatus status;
    WGPUComputePipeline pipeline;
    bool has_message;
} Made;

static void on_made(WGPUCreatePipelineAsyncStatus status, WGPUComputePipeline pipeline,
                    WGPUStringView message, void *userdata1, void *userdata2)
{
    (void)userdata2;
    *(Made *)userdata1 = (Made){status, pipeline, message.length > 0};
}

// A pipeline that came later computes like one made at once; one that cannot be says why.
static int test_compute_async(uint32_t step)
{
    static Compute compute;
    static Made good, bad;
    static bool runs;
    static uint32_t back[NUMBERS];
    if (step == 0) {
        make_compute_pipeline(&compute);
        make_compute_groups(&compute);
        wgpuComputePipelineRelease(compute.pipeline);
        WGPUCreateComputePipelineAsyncCallbackInfo info = {
            .mode = WGPUCallbackMode_AllowProcessEvents, .callback = on_made, .userdata1 = &good};
        WGPUComputePipelineDescriptor descriptor = compute_descriptor(&compute, "multiply");
        wgpuDeviceCreateComputePipelineAsync(world.device, &descriptor, info);
        info.userdata1 = &bad;
        descriptor = compute_descriptor(&compute, "no_such_entry");
        wgpuDeviceCreateComputePipelineAsync(world.device, &descriptor, info);
        CHECK(!good.status && !bad.status); // later, from wgpuInstanceProcessEvents()
    }
    if (!good.status || !bad.status) return PENDING;
    CHECK(good.status == WGPUCreatePipelineAsyncStatus_Success && good.pipeline && !good.has_message);
    CHECK(bad.status == WGPUCreatePipelineAsyncStatus_ValidationError && !bad.pipeline && bad.has_message);
    if (!runs) {
        runs = true;
        compute.pipeline = good.pipeline;
        wgpuQueueWriteBuffer(world.queue, compute.uniforms, FACTOR_OFFSET, &(uint32_t){3}, 4);
        for (uint32_t k = 0; k < NUMBERS; k++)
            wgpuQueueWriteBuffer(world.queue, compute.numbers, NUMBERS_OFFSET + 4 * k, &k, 4);
        run_compute(&compute, NULL, NULL);
    }
    AWAIT(weir_test_read(compute.results, 0, sizeof back, back));
    for (uint32_t k = 0; k < NUMBERS; k++) CHECK(back[k] == 3 * k);
    CHECK(world.error_count == 0);
    free_compute(&compute);
    return DONE;
}

static int test_compute_indirect(uint32_t step)
{
    static Compute compute;
    static WGPUBuffer sizes;
    if (step == 0)
        sizes = weir_test_buffer(WGPUBufferUsage_Indirect | WGPUBufferUsage_CopyDst, SIZES_OFFSET + 12);
    AWAIT(multiply(step, &compute, 7, sizes));
    wgpuBufferRelease(sizes);
    return DONE;
}

static int test_timestamps(uint32_t step)
{
    static Compute compute;
    static WGPUBuffer resolved;
    static uint64_t back[4];
    if (!wgpuDeviceHasFeature(world.device, WGPUFeatureName_TimestampQuery)) return DONE;
    if (step == 0) {
        WGPUQuerySetDescriptor descriptor = {.type = WGPUQueryType_Timestamp, .count = 4};
        compute.times = wgpuDeviceCreateQuerySet(world.device, &descriptor);
        resolved = weir_test_buffer(WGPUBufferUsage_QueryResolve | WGPUBufferUsage_CopySrc, 512);
        make_compute_pipeline(&compute);
        make_compute_groups(&compute);
        WGPUPassTimestampWrites both = {
            .querySet = compute.times, .beginningOfPassWriteIndex = 1, .endOfPassWriteIndex = 2};
        run_compute(&compute, &both, NULL);
        WGPUPassTimestampWrites last = {.querySet = compute.times,
                                        .beginningOfPassWriteIndex = WGPU_QUERY_SET_INDEX_UNDEFINED,
                                        .endOfPassWriteIndex = 3};
        run_compute(&compute, &last, NULL);
        WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
        wgpuCommandEncoderResolveQuerySet(encoder, compute.times, 1, 3, resolved, 256);
        weir_test_submit(encoder);
    }
    AWAIT(weir_test_read(resolved, 256, 24, back));
    CHECK(world.error_count == 0);
    CHECK(back[0] > 0 && back[1] >= back[0] && back[2] >= back[1]);
    free_compute(&compute);
    wgpuQuerySetRelease(compute.times);
    wgpuBufferRelease(resolved);
    return DONE;
}

// What is destroyed cannot be used in a submit.
static int test_destroy_query_set(uint32_t step)
{
    static WGPUBuffer resolved;
    if (step == 0) {
        WGPUQuerySetDescriptor descriptor = {.type = WGPUQueryType_Occlusion, .count = 1};
        WGPUQuerySet queries = wgpuDeviceCreateQuerySet(world.device, &descriptor);
        resolved = weir_test_buffer(WGPUBufferUsage_QueryResolve, 256);
        WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
        wgpuCommandEncoderResolveQuerySet(encoder, queries, 0, 1, resolved, 0);
        wgpuQuerySetDestroy(queries);
        wgpuQuerySetRelease(queries);
        weir_test_submit(encoder);
    }
    if (world.error_count == 0) return PENDING;
    CHECK(world.error_type == WGPUErrorType_Validation);
    wgpuBufferRelease(resolved);
    return DONE;
}

// ---------------------------------------------------------------------------------------------------------
// Render: clear to a colour, then a strip over the left half, blended in with half its colour. The pass reads
// a storage buffer in the vertex stage, as Weir's renderer does.

static const char render_code[] =
    "@group(0) @binding(0) var<storage, read> edges: array<f32>;\n"
    "@vertex fn corner(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32)\n"
    "    -> @builtin(position) vec4f {\n"
    "  let right = edges[instance * 2 + vertex / 2];\n"
    "  return vec4f(right, select(-1.0, 1.0, vertex % 2 == 1), 0.0, 1.0);\n"
    "}\n"
    "@fragment fn color() -> @location(0) vec4f { return vec4f(1.0, 0.0, 0.0, 0.5); }\n";

enum { SIZE = 64, ROW = SIZE * 4 };

typedef struct Render {
    WGPUBindGroupLayout layout;
    WGPUPipelineLayout pipeline_layout;
    WGPUShaderModule shader;
    WGPURenderPipeline pipeline;
    WGPUBuffer edges, pixels;
    WGPUBindGroup group;
    WGPUTexture texture;
    WGPUTextureView view;
} Render;

static void make_render_layout(Render *render)
{
    WGPUBindGroupLayoutEntry entry = {.visibility = WGPUShaderStage_Vertex,
                                      .buffer = {.type = WGPUBufferBindingType_ReadOnlyStorage}};
    WGPUBindGroupLayoutDescriptor layout = {.entryCount = 1, .entries = &entry};
    render->layout = wgpuDeviceCreateBindGroupLayout(world.device, &layout);
    WGPUPipelineLayoutDescriptor pipeline = {.bindGroupLayoutCount = 1, .bindGroupLayouts = &render->layout};
    render->pipeline_layout = wgpuDeviceCreatePipelineLayout(world.device, &pipeline);
    render->edges = weir_test_buffer(WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst, 16);
    // Instance 1 covers the left half; instance 0 would cover everything.
    wgpuQueueWriteBuffer(world.queue, render->edges, 0, (float[]){-1, 1, -1, 0}, 16);
    WGPUBindGroupEntry bound = {.buffer = render->edges, .size = 16};
    WGPUBindGroupDescriptor group = {.layout = render->layout, .entryCount = 1, .entries = &bound};
    render->group = wgpuDeviceCreateBindGroup(world.device, &group);
}

static void make_render_pipeline(Render *render, WGPUTextureFormat format)
{
    render->shader = make_shader(render_code);
    WGPUBlendState blend = {
        .color = {WGPUBlendOperation_Add, WGPUBlendFactor_SrcAlpha, WGPUBlendFactor_OneMinusSrcAlpha},
        .alpha = {WGPUBlendOperation_Add, WGPUBlendFactor_One, WGPUBlendFactor_Zero},
    };
    WGPUColorTargetState target = {.format = format, .blend = &blend, .writeMask = WGPUColorWriteMask_All};
    WGPUFragmentState fragment = {.module = render->shader,
                                  .entryPoint = weir_test_text("color"),
                                  .targetCount = 1,
                                  .targets = &target};
    WGPURenderPipelineDescriptor descriptor = {
        .label = weir_test_text("strip"),
        .layout = render->pipeline_layout,
        .vertex = {.module = render->shader, .entryPoint = weir_test_text("corner")},
        .primitive = {.topology = WGPUPrimitiveTopology_TriangleStrip, .cullMode = WGPUCullMode_None},
        .multisample = {.count = 1, .mask = 0xFFFFFFFF},
        .fragment = &fragment,
    };
    render->pipeline = wgpuDeviceCreateRenderPipeline(world.device, &descriptor);
}

static void draw_strip(Render *render, WGPUTextureView view)
{
    WGPURenderPassColorAttachment color = {
        .view = view,
        .depthSlice = WGPU_DEPTH_SLICE_UNDEFINED,
        .loadOp = WGPULoadOp_Clear,
        .storeOp = WGPUStoreOp_Store,
        .clearValue = {0.2, 0.4, 0.6, 1.0},
    };
    WGPURenderPassDescriptor descriptor = {
        .label = weir_test_text("strip"), .colorAttachmentCount = 1, .colorAttachments = &color};
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
    WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(encoder, &descriptor);
    wgpuRenderPassEncoderSetPipeline(pass, render->pipeline);
    wgpuRenderPassEncoderSetBindGroup(pass, 0, render->group, 0, NULL);
    wgpuRenderPassEncoderDraw(pass, 4, 1, 0, 1);
    wgpuRenderPassEncoderEnd(pass);
    wgpuRenderPassEncoderRelease(pass);
    weir_test_submit(encoder);
}

static void copy_pixels(WGPUTexture texture, WGPUBuffer pixels)
{
    WGPUTexelCopyTextureInfo source = {.texture = texture, .aspect = WGPUTextureAspect_All};
    WGPUTexelCopyBufferInfo to = {.layout = {.bytesPerRow = ROW, .rowsPerImage = SIZE}, .buffer = pixels};
    WGPUExtent3D size = {SIZE, SIZE, 1};
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
    wgpuCommandEncoderCopyTextureToBuffer(encoder, &source, &to, &size);
    weir_test_submit(encoder);
}

static void free_render(Render *render)
{
    wgpuBindGroupLayoutRelease(render->layout);
    wgpuPipelineLayoutRelease(render->pipeline_layout);
    wgpuShaderModuleRelease(render->shader);
    wgpuRenderPipelineRelease(render->pipeline);
    wgpuBufferRelease(render->edges);
    wgpuBufferRelease(render->pixels);
    wgpuBindGroupRelease(render->group);
}

static bool is_color(const uint8_t *pixel, int red, int green, int blue)
{
    int wanted[3] = {red, green, blue};
    for (int k = 0; k < 3; k++) {
        if (pixel[k] < wanted[k] - 1 || pixel[k] > wanted[k] + 1) return false;
    }
    return true;
}

static int test_render(uint32_t step)
{
    static Render render;
    static uint8_t back[SIZE * ROW];
    if (step == 0) {
        WGPUTextureDescriptor descriptor = {
            .label = weir_test_text("picture"),
            .usage = WGPUTextureUsage_RenderAttachment | WGPUTextureUsage_CopySrc,
            .dimension = WGPUTextureDimension_2D,
            .size = {SIZE, SIZE, 1},
            .format = WGPUTextureFormat_RGBA8Unorm,
            .mipLevelCount = 1,
            .sampleCount = 1,
        };
        render.texture = wgpuDeviceCreateTexture(world.device, &descriptor);
        CHECK(wgpuTextureGetWidth(render.texture) == SIZE && wgpuTextureGetHeight(render.texture) == SIZE);
        CHECK(wgpuTextureGetFormat(render.texture) == WGPUTextureFormat_RGBA8Unorm);
        WGPUTextureViewDescriptor view = WGPU_TEXTURE_VIEW_DESCRIPTOR_INIT;
        view.label = weir_test_text("picture");
        view.format = WGPUTextureFormat_RGBA8Unorm;
        view.dimension = WGPUTextureViewDimension_2D;
        view.mipLevelCount = 1;
        render.view = wgpuTextureCreateView(render.texture, &view);
        render.pixels = weir_test_buffer(WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc, sizeof back);
        make_render_layout(&render);
        make_render_pipeline(&render, WGPUTextureFormat_RGBA8Unorm);
        CHECK(render.pipeline && render.view);
        draw_strip(&render, render.view);
        copy_pixels(render.texture, render.pixels);
    }
    AWAIT(weir_test_read(render.pixels, 0, sizeof back, back));
    CHECK(world.error_count == 0);
    CHECK(is_color(back + (SIZE / 2) * ROW + 4 * (SIZE / 2 + 1), 51, 102, 153)); // right: cleared
    CHECK(is_color(back + (SIZE / 2) * ROW + 4 * (SIZE / 2 - 2), 153, 51, 77));  // left: half red on it
    wgpuTextureViewRelease(render.view);
    wgpuTextureRelease(render.texture);
    free_render(&render);
    return DONE;
}

static int test_destroy_texture(uint32_t step)
{
    static WGPUBuffer pixels;
    if (step == 0) {
        WGPUTextureDescriptor descriptor = {.usage = WGPUTextureUsage_CopySrc,
                                            .dimension = WGPUTextureDimension_2D,
                                            .size = {SIZE, SIZE, 1},
                                            .format = WGPUTextureFormat_RGBA8Unorm,
                                            .mipLevelCount = 1,
                                            .sampleCount = 1};
        WGPUTexture texture = wgpuDeviceCreateTexture(world.device, &descriptor);
        pixels = weir_test_buffer(WGPUBufferUsage_CopyDst, SIZE * ROW);
        wgpuTextureDestroy(texture);
        copy_pixels(texture, pixels);
        wgpuTextureRelease(texture);
    }
    if (world.error_count == 0) return PENDING;
    CHECK(world.error_type == WGPUErrorType_Validation);
    wgpuBufferRelease(pixels);
    return DONE;
}

// JavaScript has registered a canvas as number 0, and one without WebGPU as number 1.
static int test_surface(uint32_t step)
{
    static Render render;
    static uint8_t back[SIZE * ROW];
    static WGPUSurface surface;
    if (step == 0) {
        CHECK(!weir_webgpu_canvas_surface(world.instance, 1));
        CHECK(!weir_webgpu_canvas_surface(world.instance, 2)); // there is none
        surface = weir_webgpu_canvas_surface(world.instance, 0);
        CHECK(surface);
        WGPUSurfaceCapabilities capabilities = {0};
        CHECK(wgpuSurfaceGetCapabilities(surface, world.adapter, &capabilities) == WGPUStatus_Success);
        CHECK(capabilities.formatCount == 2 && capabilities.formats[0] == WGPUTextureFormat_BGRA8Unorm);
        CHECK(capabilities.usages & WGPUTextureUsage_RenderAttachment);
        WGPUSurfaceConfiguration configuration = {
            .device = world.device,
            .format = capabilities.formats[0],
            .usage = WGPUTextureUsage_RenderAttachment | WGPUTextureUsage_CopySrc,
            .width = SIZE,
            .height = SIZE,
            .alphaMode = WGPUCompositeAlphaMode_Opaque,
        };
        wgpuSurfaceCapabilitiesFreeMembers(capabilities);
        wgpuSurfaceConfigure(surface, &configuration);
        WGPUSurfaceTexture current = {0};
        wgpuSurfaceGetCurrentTexture(surface, &current);
        CHECK(current.status == WGPUSurfaceGetCurrentTextureStatus_SuccessOptimal && current.texture);
        CHECK(wgpuTextureGetWidth(current.texture) == SIZE);
        WGPUTextureView view = wgpuTextureCreateView(current.texture, NULL);
        render.pixels = weir_test_buffer(WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc, sizeof back);
        make_render_layout(&render);
        make_render_pipeline(&render, WGPUTextureFormat_BGRA8Unorm);
        draw_strip(&render, view);
        copy_pixels(current.texture, render.pixels);
        CHECK(wgpuSurfacePresent(surface) == WGPUStatus_Success);
        wgpuTextureViewRelease(view);
        wgpuTextureRelease(current.texture);
    }
    AWAIT(weir_test_read(render.pixels, 0, sizeof back, back));
    CHECK(world.error_count == 0);
    CHECK(is_color(back + 4 * (SIZE - 1), 153, 102, 51)); // blue comes first
    CHECK(is_color(back, 77, 51, 153));
    wgpuSurfaceUnconfigure(surface);
    WGPUSurfaceTexture none = {0};
    wgpuSurfaceGetCurrentTexture(surface, &none);
    CHECK(none.status == WGPUSurfaceGetCurrentTextureStatus_Error && !none.texture);
    wgpuSurfaceRelease(surface);
    free_render(&render);
    return DONE;
}

const WeirTest weir_pass_tests[] = {
    {"wgpuDeviceCreateBindGroupLayout wgpuBindGroupLayoutRelease wgpuDeviceCreatePipelineLayout "
     "wgpuPipelineLayoutRelease wgpuDeviceCreateComputePipeline wgpuComputePipelineAddRef "
     "wgpuComputePipelineRelease "
     "wgpuDeviceCreateBindGroup wgpuBindGroupRelease wgpuCommandEncoderBeginComputePass "
     "wgpuComputePassEncoderSetPipeline wgpuComputePassEncoderSetBindGroup "
     "wgpuComputePassEncoderDispatchWorkgroups wgpuComputePassEncoderEnd wgpuComputePassEncoderRelease",
     test_compute, false},
    {"wgpuDeviceCreateComputePipelineAsync", test_compute_async, false},
    {"wgpuComputePassEncoderDispatchWorkgroupsIndirect", test_compute_indirect, false},
    {"wgpuDeviceCreateQuerySet wgpuCommandEncoderResolveQuerySet wgpuQuerySetRelease", test_timestamps,
     false},
    {"wgpuQuerySetDestroy", test_destroy_query_set, false},
    {"wgpuDeviceCreateTexture wgpuTextureGetWidth wgpuTextureGetHeight wgpuTextureGetFormat "
     "wgpuTextureCreateView wgpuTextureViewRelease wgpuTextureRelease "
     "wgpuDeviceCreateRenderPipeline wgpuRenderPipelineRelease wgpuCommandEncoderBeginRenderPass "
     "wgpuRenderPassEncoderSetPipeline wgpuRenderPassEncoderSetBindGroup wgpuRenderPassEncoderDraw "
     "wgpuRenderPassEncoderEnd wgpuRenderPassEncoderRelease wgpuCommandEncoderCopyTextureToBuffer",
     test_render, false},
    {"wgpuTextureDestroy", test_destroy_texture, false},
    {"weir_webgpu_canvas_surface wgpuSurfaceGetCapabilities wgpuSurfaceCapabilitiesFreeMembers "
     "wgpuSurfaceConfigure wgpuSurfaceGetCurrentTexture wgpuSurfacePresent wgpuSurfaceUnconfigure "
     "wgpuSurfaceRelease",
     test_surface, false},
    {0},
};
