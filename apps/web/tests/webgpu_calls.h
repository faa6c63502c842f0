// What the tests of the layer share.
#pragma once

#include "webgpu_web/webgpu_web.h"

#define WEIR_EXPORT(name) __attribute__((export_name(#name)))

enum { FAILED = -1, PENDING = 0, DONE = 1 };

// `condition` must hold, or the test has failed.
#define CHECK(condition)                                                                                     \
    do {                                                                                                     \
        if (!(condition)) return weir_test_fail(#condition, __FILE_NAME__, __LINE__);                        \
    } while (0)
// Goes on when a step that takes several turns is done.
#define AWAIT(step)                                                                                          \
    do {                                                                                                     \
        int state = (step);                                                                                  \
        CHECK(state != FAILED);                                                                              \
        if (state == PENDING) return PENDING;                                                                \
    } while (0)

typedef struct WeirTest {
    const char *calls; // what it is about
    int (*run)(uint32_t step);
    bool own_events; // calls wgpuInstanceProcessEvents() itself
} WeirTest;

// What the first tests make and the others use, and the last uncaptured error.
typedef struct WeirTestWorld {
    WGPUInstance instance;
    WGPUAdapter adapter;
    WGPUDevice device;
    WGPUQueue queue;
    WGPUDeviceLostReason lost; // of the device, 0 while it lives
    int error_count;
    WGPUErrorType error_type;
    char error[256];
} WeirTestWorld;
extern WeirTestWorld world;

int weir_test_fail(const char *condition, const char *file, int line);
WGPUStringView weir_test_text(const char *text);
void weir_test_on_error(WGPUDevice const *device, WGPUErrorType type, WGPUStringView message, void *userdata1,
                        void *userdata2);
// For map and work-done callbacks: stores the status at userdata1.
void weir_test_on_status(uint32_t status, WGPUStringView message, void *userdata1, void *userdata2);
WGPUBuffer weir_test_buffer(WGPUBufferUsage usage, uint64_t size);
void weir_test_submit(WGPUCommandEncoder encoder); // finishes and releases it
int weir_test_read(WGPUBuffer source, uint64_t offset, size_t size, void *to);
