// Buffers, mapping, copies, timestamps.
#include "webgpu_calls.h"

#include <string.h>

static int test_create(uint32_t step)
{
    (void)step;
    WGPUBufferUsage usage = WGPUBufferUsage_MapRead | WGPUBufferUsage_CopyDst;
    WGPUBuffer buffer = weir_test_buffer(usage, 4096);
    CHECK(buffer);
    CHECK(wgpuBufferGetSize(buffer) == 4096);
    CHECK(wgpuBufferGetUsage(buffer) == usage);
    CHECK(wgpuBufferGetMapState(buffer) == WGPUBufferMapState_Unmapped);
    wgpuBufferAddRef(buffer);
    wgpuBufferRelease(buffer);
    CHECK(wgpuBufferGetSize(buffer) == 4096); // one reference is left
    wgpuBufferRelease(buffer);
    return DONE;
}

// Written through a mapping, read through a copy.
static int test_mapped_at_creation(uint32_t step)
{
    static WGPUBuffer buffer;
    static uint32_t back[4];
    static const uint32_t sent[4] = {1, 0xFFFFFFFF, 3, 4};
    if (step == 0) {
        WGPUBufferDescriptor descriptor = {
            .usage = WGPUBufferUsage_CopySrc, .size = 16, .mappedAtCreation = 1};
        buffer = wgpuDeviceCreateBuffer(world.device, &descriptor);
        CHECK(wgpuBufferGetMapState(buffer) == WGPUBufferMapState_Mapped);
        memcpy(wgpuBufferGetMappedRange(buffer, 0, WGPU_WHOLE_MAP_SIZE), sent, 16);
        wgpuBufferUnmap(buffer);
    }
    AWAIT(weir_test_read(buffer, 0, 16, back));
    CHECK(memcmp(back, sent, 16) == 0);
    wgpuBufferRelease(buffer);
    return DONE;
}

static int test_write(uint32_t step)
{
    static WGPUBuffer buffer;
    static uint32_t back[4];
    if (step == 0) {
        buffer = weir_test_buffer(WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc, 16);
        wgpuQueueWriteBuffer(world.queue, buffer, 4, &(uint64_t){0x1234567890abcdef}, 8);
    }
    AWAIT(weir_test_read(buffer, 0, 16, back));
    CHECK(back[0] == 0 && back[1] == 0x90abcdef && back[2] == 0x12345678 && back[3] == 0);
    wgpuBufferRelease(buffer);
    return DONE;
}

static int test_map(uint32_t step)
{
    static WGPUBuffer buffer;
    static uint32_t status, refused, aborted;
    WGPUBufferMapCallbackInfo info = {.callback = (WGPUBufferMapCallback)weir_test_on_status};
    if (step == 0) {
        buffer = weir_test_buffer(WGPUBufferUsage_MapRead | WGPUBufferUsage_CopyDst, 64);
        wgpuQueueWriteBuffer(world.queue, buffer, 16, (uint32_t[]){7, 8}, 8);
        info.userdata1 = &status;
        wgpuBufferMapAsync(buffer, WGPUMapMode_Read, 8, 24, info);
        CHECK(wgpuBufferGetMapState(buffer) == WGPUBufferMapState_Pending);
        CHECK(!wgpuBufferGetConstMappedRange(buffer, 8, 24)); // too early
        WGPUBuffer unmappable = weir_test_buffer(WGPUBufferUsage_Storage, 16);
        info.userdata1 = &refused;
        wgpuBufferMapAsync(unmappable, WGPUMapMode_Read, 0, 16, info);
        wgpuBufferRelease(unmappable);
        WGPUBuffer destroyed = weir_test_buffer(WGPUBufferUsage_MapRead, 16);
        info.userdata1 = &aborted;
        wgpuBufferMapAsync(destroyed, WGPUMapMode_Read, 0, 16, info);
        wgpuBufferDestroy(destroyed);
        wgpuBufferRelease(destroyed);
    }
    if (!status || !refused || !aborted) return PENDING;
    CHECK(status == WGPUMapAsyncStatus_Success && refused == WGPUMapAsyncStatus_Error);
    CHECK(aborted == WGPUMapAsyncStatus_Aborted);
    const uint32_t *range = wgpuBufferGetConstMappedRange(buffer, 16, 8);
    CHECK(range && range[0] == 7 && range[1] == 8);
    CHECK(wgpuBufferGetConstMappedRange(buffer, 16, 8) == range);
    const uint32_t *second = wgpuBufferGetConstMappedRange(buffer, 24, WGPU_WHOLE_MAP_SIZE);
    CHECK(!second); // the whole rest of the buffer is more than was mapped
    CHECK(wgpuBufferGetMapState(buffer) == WGPUBufferMapState_Mapped);
    wgpuBufferUnmap(buffer);
    CHECK(wgpuBufferGetMapState(buffer) == WGPUBufferMapState_Unmapped);
    CHECK(!wgpuBufferGetConstMappedRange(buffer, 16, 8));
    wgpuBufferRelease(buffer);
    return DONE;
}

static int test_destroy_buffer(uint32_t step)
{
    static WGPUBuffer buffer;
    if (step == 0) {
        buffer = weir_test_buffer(WGPUBufferUsage_CopyDst, 16);
        wgpuBufferDestroy(buffer);
        WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, NULL);
        wgpuCommandEncoderClearBuffer(encoder, buffer, 0, WGPU_WHOLE_SIZE);
        weir_test_submit(encoder);
    }
    if (world.error_count == 0) return PENDING; // a destroyed buffer cannot be used in a submit
    CHECK(world.error_type == WGPUErrorType_Validation);
    wgpuBufferRelease(buffer);
    return DONE;
}

static int test_copy_and_clear(uint32_t step)
{
    static WGPUBuffer from, to;
    static uint32_t back[8];
    if (step == 0) {
        WGPUBufferUsage usage = WGPUBufferUsage_CopyDst | WGPUBufferUsage_CopySrc;
        from = weir_test_buffer(usage, 32);
        to = weir_test_buffer(usage, 32);
        wgpuQueueWriteBuffer(world.queue, from, 0, (uint32_t[]){1, 2, 3, 4, 5, 6, 7, 8}, 32);
        wgpuQueueWriteBuffer(world.queue, to, 0, (uint32_t[]){9, 9, 9, 9, 9, 9, 9, 9}, 32);
        WGPUCommandEncoderDescriptor named = {.label = weir_test_text("copy")};
        WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, &named);
        wgpuCommandEncoderCopyBufferToBuffer(encoder, from, 4, to, 8, 12); // 2 3 4 to 2..4
        wgpuCommandEncoderClearBuffer(encoder, to, 24, WGPU_WHOLE_SIZE);
        wgpuCommandEncoderClearBuffer(encoder, to, 0, 4);
        WGPUCommandBufferDescriptor copy = {.label = weir_test_text("copy")};
        WGPUCommandBuffer commands[2] = {wgpuCommandEncoderFinish(encoder, &copy)};
        wgpuCommandEncoderRelease(encoder);
        encoder = wgpuDeviceCreateCommandEncoder(world.device, &named);
        wgpuCommandEncoderCopyBufferToBuffer(encoder, from, 28, to, 20, 4); // after the first one
        commands[1] = wgpuCommandEncoderFinish(encoder, NULL);
        wgpuCommandEncoderRelease(encoder);
        CHECK(commands[0] && commands[1]);
        wgpuQueueSubmit(world.queue, 2, commands);
        wgpuCommandBufferRelease(commands[0]);
        wgpuCommandBufferRelease(commands[1]);
    }
    AWAIT(weir_test_read(to, 0, 32, back));
    static const uint32_t wanted[8] = {0, 9, 2, 3, 4, 8, 0, 0};
    CHECK(memcmp(back, wanted, 32) == 0);
    wgpuBufferRelease(from);
    wgpuBufferRelease(to);
    return DONE;
}

// A label's text may change at its address from one call to the next; errors name the one that was given.
static int test_labels(uint32_t step)
{
    static char label[] = "first";
    if (step == 0) {
        WGPUBuffer buffer = weir_test_buffer(WGPUBufferUsage_CopyDst, 16);
        for (int k = 0; k < 2; k++) {
            if (k == 1) memcpy(label, "other", 5);
            WGPUCommandEncoderDescriptor named = {.label = {label, 5}};
            WGPUCommandEncoder encoder = wgpuDeviceCreateCommandEncoder(world.device, &named);
            if (k == 1) wgpuCommandEncoderClearBuffer(encoder, buffer, 0, 1024); // larger than the buffer
            WGPUCommandBuffer commands = wgpuCommandEncoderFinish(encoder, NULL);
            wgpuCommandBufferRelease(commands);
            wgpuCommandEncoderRelease(encoder);
        }
        wgpuBufferRelease(buffer);
    }
    if (world.error_count == 0) return PENDING;
    CHECK(strstr(world.error, "\"other\"") && !strstr(world.error, "first"));
    return DONE;
}

const WeirTest weir_buffer_tests[] = {
    {"labels", test_labels, false},
    {"wgpuDeviceCreateBuffer wgpuBufferGetSize wgpuBufferGetUsage wgpuBufferAddRef wgpuBufferRelease",
     test_create, false},
    {"wgpuBufferGetMappedRange", test_mapped_at_creation, false},
    {"wgpuQueueWriteBuffer", test_write, false},
    {"wgpuBufferMapAsync wgpuBufferGetMapState wgpuBufferGetConstMappedRange wgpuBufferUnmap", test_map,
     false},
    {"wgpuBufferDestroy", test_destroy_buffer, false},
    {"wgpuCommandEncoderCopyBufferToBuffer wgpuCommandEncoderClearBuffer wgpuDeviceCreateCommandEncoder "
     "wgpuCommandEncoderFinish wgpuCommandEncoderRelease wgpuQueueSubmit wgpuCommandBufferRelease",
     test_copy_and_clear, false},
    {0},
};
