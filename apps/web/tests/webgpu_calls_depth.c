// Depth attachments, and textures in bind groups: a near strip stays before a far one that is drawn later, and a
// second pass reads the depth that the first one left.
#include "webgpu_calls.h"

static const char scene_code[] =
    "@vertex fn corner(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32)\n"
    "    -> @builtin(position) vec4f {\n"
    // Instance 0 covers the left half at depth 0.25, instance 1 everything at 0.75.
    "  let right = select(1.0, 0.0, instance == 0u);\n"
    "  let x = select(-1.0, right, vertex / 2u == 1u);\n"
    "  return vec4f(x, select(-1.0, 1.0, vertex % 2u == 1u), 0.25 + 0.5 * f32(instance), 1.0);\n"
    "}\n"
    "@fragment fn color() -> @location(0) vec4f { return vec4f(1.0); }\n"
    "@group(0) @binding(3) var depth: texture_depth_2d;\n"
    "@fragment fn show(@builtin(position) place: vec4f) -> @location(0) vec4f {\n"
    "  return vec4f(textureLoad(depth, vec2u(place.xy), 0), 0.0, 0.0, 1.0);\n"
    "}\n";

enum { SIZE = 64, ROW = SIZE * 4 };

typedef struct Depth {
    WGPUShaderModule shader;
    WGPUBindGroupLayout layout;
    WGPUPipelineLayout empty_layout, texture_layout;
    WGPURenderPipeline draw, show;
    WGPUTexture textures[2]; // depth, picture
    WGPUTextureView views[2];
    WGPUBindGroup group;
    WGPUBuffer pixels, drawn;
} Depth;

static WGPURenderPipeline make_pipeline(const Depth *depth, WGPUPipelineLayout layout, const char *fragment,
                                        const WGPUDepthStencilState *state)
{
    WGPUColorTargetState target = {.format = WGPUTextureFormat_RGBA8Unorm,
                                   .writeMask = WGPUColorWriteMask_All};
    WGPUFragmentState stage = {.module = depth->shader,
                               .entryPoint = weir_test_text(fragment),
                               .targetCount = 1,
                               .targets = &target};
    return wgpuDeviceCreateRenderPipeline(
        world.device, &(WGPURenderPipelineDescriptor){
                          .layout = layout,
                          .vertex = {.module = depth->shader, .entryPoint = weir_test_text("corner")},
                          .primitive = {.topology = WGPUPrimitiveTopology_TriangleStrip},
                          .depthStencil = state,
                          .multisample = {.count = 1, .mask = 0xFFFFFFFF},
                          .fragment = &stage,
                      });
}

static void make_pipelines(Depth *depth)
{
    WGPUShaderSourceWGSL source = {{NULL, WGPUSType_ShaderSourceWGSL}, weir_test_text(scene_code)};
    depth->shader = wgpuDeviceCreateShaderModule(world.device,
                                                 &(WGPUShaderModuleDescriptor){.nextInChain = &source.chain});
    WGPUBindGroupLayoutEntry entry = {
        .binding = 3,
        .visibility = WGPUShaderStage_Fragment,
        .texture = {.sampleType = WGPUTextureSampleType_Depth, .viewDimension = WGPUTextureViewDimension_2D}};
    depth->layout = wgpuDeviceCreateBindGroupLayout(
        world.device, &(WGPUBindGroupLayoutDescriptor){.entryCount = 1, .entries = &entry});
    depth->empty_layout = wgpuDeviceCreatePipelineLayout(
        world.device, &(WGPUPipelineLayoutDescriptor){.bindGroupLayoutCount = 0});
    depth->texture_layout = wgpuDeviceCreatePipelineLayout(
        world.device,
        &(WGPUPipelineLayoutDescriptor){.bindGroupLayoutCount = 1, .bindGroupLayouts = &depth->layout});
    WGPUDepthStencilState state = {.format = WGPUTextureFormat_Depth32Float,
                                   .depthWriteEnabled = WGPUOptionalBool_True,
                                   .depthCompare = WGPUCompareFunction_Less};
    depth->draw = make_pipeline(depth, depth->empty_layout, "color", &state);
    depth->show = make_pipeline(depth, depth->texture_layout, "show", NULL);
}

static void make_textures(Depth *depth)
{
    const WGPUTextureFormat formats[2] = {WGPUTextureFormat_Depth32Float, WGPUTextureFormat_RGBA8Unorm};
    const WGPUTextureUsage usages[2] = {WGPUTextureUsage_TextureBinding, WGPUTextureUsage_CopySrc};
    for (int k = 0; k < 2; k++) {
        depth->textures[k] = wgpuDeviceCreateTexture(
            world.device, &(WGPUTextureDescriptor){.usage = usages[k] | WGPUTextureUsage_RenderAttachment,
                                                   .dimension = WGPUTextureDimension_2D,
                                                   .size = {SIZE, SIZE, 1},
                                                   .format = formats[k],
                                                   .mipLevelCount = 1,
                                                   .sampleCount = 1});
        depth->views[k] = wgpuTextureCreateView(depth->textures[k], NULL);
    }
    WGPUBindGroupEntry entry = {.binding = 3, .textureView = depth->views[0]};
    depth->group = wgpuDeviceCreateBindGroup(
        world.device,
        &(WGPUBindGroupDescriptor){.layout = depth->layout, .entryCount = 1, .entries = &entry});
    depth->pixels = weir_test_buffer(WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc, SIZE * ROW);
    const uint32_t both[6] = {0, 0, 4, 2, 0, 0}; // strips, from 8 bytes on
    depth->drawn = weir_test_buffer(WGPUBufferUsage_CopyDst | WGPUBufferUsage_Indirect, sizeof both);
    wgpuQueueWriteBuffer(world.queue, depth->drawn, 0, both, sizeof both);
}

static void draw(Depth *depth)
{
    WGPURenderPassColorAttachment color = {.view = depth->views[1],
                                           .depthSlice = WGPU_DEPTH_SLICE_UNDEFINED,
                                           .loadOp = WGPULoadOp_Clear,
                                           .storeOp = WGPUStoreOp_Store};
    WGPURenderPassDepthStencilAttachment behind = {.view = depth->views[0],
                                                   .depthLoadOp = WGPULoadOp_Clear,
                                                   .depthStoreOp = WGPUStoreOp_Store,
                                                   .depthClearValue = 1.0f};
    WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
    for (int show = 0; show < 2; show++) {
        WGPURenderPassEncoder pass = wgpuCommandEncoderBeginRenderPass(
            encoder, &(WGPURenderPassDescriptor){.colorAttachmentCount = 1,
                                                 .colorAttachments = &color,
                                                 .depthStencilAttachment = show ? NULL : &behind});
        wgpuRenderPassEncoderSetPipeline(pass, show ? depth->show : depth->draw);
        if (show) wgpuRenderPassEncoderSetBindGroup(pass, 0, depth->group, 0, NULL);
        // The far strip once more when showing: it covers every pixel.
        if (show)
            wgpuRenderPassEncoderDraw(pass, 4, 1, 0, 1);
        else
            wgpuRenderPassEncoderDrawIndirect(pass, depth->drawn, 8);
        wgpuRenderPassEncoderEnd(pass);
        wgpuRenderPassEncoderRelease(pass);
    }
    wgpuCommandEncoderCopyTextureToBuffer(
        encoder, &(WGPUTexelCopyTextureInfo){.texture = depth->textures[1], .aspect = WGPUTextureAspect_All},
        &(WGPUTexelCopyBufferInfo){.layout = {.bytesPerRow = ROW, .rowsPerImage = SIZE},
                                   .buffer = depth->pixels},
        &(WGPUExtent3D){SIZE, SIZE, 1});
    weir_test_submit(encoder);
}

static int test_depth(uint32_t step)
{
    static Depth depth;
    static uint8_t back[SIZE * ROW];
    if (step == 0) {
        make_pipelines(&depth);
        make_textures(&depth);
        draw(&depth);
    }
    AWAIT(weir_test_read(depth.pixels, 0, sizeof back, back));
    CHECK(world.error_count == 0);
    CHECK(back[0] == 64);               // the near strip: 0.25
    CHECK(back[4 * (SIZE - 1)] == 191); // the far one: 0.75
    wgpuBindGroupRelease(depth.group);
    wgpuBindGroupLayoutRelease(depth.layout);
    wgpuPipelineLayoutRelease(depth.empty_layout);
    wgpuPipelineLayoutRelease(depth.texture_layout);
    wgpuRenderPipelineRelease(depth.draw);
    wgpuRenderPipelineRelease(depth.show);
    wgpuShaderModuleRelease(depth.shader);
    wgpuBufferRelease(depth.pixels);
    wgpuBufferRelease(depth.drawn);
    for (int k = 0; k < 2; k++) {
        wgpuTextureViewRelease(depth.views[k]);
        wgpuTextureRelease(depth.textures[k]);
    }
    return DONE;
}

const WeirTest weir_depth_tests[] = {
    {"depth attachments and textures in bind groups, wgpuRenderPassEncoderDrawIndirect", test_depth, false},
    {0},
};
