// What the page's JavaScript (web/src/webgpu_imports.ts) serves to the C side of the layer. Handles are small
// integers, 0 for none; texts are pointer and length; 64-bit numbers travel as doubles, -1 for "not given".
#pragma once

#include "webgpu_web/webgpu_web.h"

// A declaration of one import: result, name, parameters.
#define WEIR_JS(result, name, ...)                                                                           \
    __attribute__((import_module("webgpu"), import_name(#name))) result weir_js_##name(__VA_ARGS__);
// Text parameters as JavaScript takes them.
#define WEIR_JS_TEXT const char *text, size_t length

#define WEIR_ID(object)           ((uint32_t)(uintptr_t)(object))
#define WEIR_OBJECT(type, number) ((type)(uintptr_t)(number))
// Passes a WGPUStringView as pointer and length.
#define WEIR_TEXT(view) (view).data, weir_webgpu_text_length(view)

size_t weir_webgpu_text_length(WGPUStringView view);
// Copies the text that JavaScript holds ready, `length` bytes of it, into memory from malloc; NULL
// data if empty.
WGPUStringView weir_webgpu_take_text(size_t length);
// Reports a use of the API that the layer does not serve, as a validation error of the device.
void weir_webgpu_refuse(uint32_t device, const char *message);
// Memory for one callback that JavaScript will deliver; freed after it ran. 0 if memory ran out.
uint32_t weir_webgpu_record(void *callback, void *userdata1, void *userdata2);
// Futures cannot be waited for: their ids only have to differ.
WGPUFuture weir_webgpu_future(uint32_t record);

// Objects, events, texts
WEIR_JS(void, add_reference, uint32_t object)
WEIR_JS(uint32_t, release, uint32_t object) // references left
WEIR_JS(void, take_text, char *to)
WEIR_JS(void, device_error, uint32_t device, WEIR_JS_TEXT)

// Instance, adapter, device
WEIR_JS(uint32_t, instance_create, void)
WEIR_JS(void, process_events, uint32_t instance)
WEIR_JS(void, request_adapter, uint32_t instance, uint32_t power, uint32_t fallback, uint32_t level,
        uint32_t record)
WEIR_JS(uint32_t, adapter_text, uint32_t adapter, uint32_t which)
WEIR_JS(uint32_t, adapter_number, uint32_t adapter, uint32_t which)
WEIR_JS(double, limit, uint32_t object, uint32_t index)
WEIR_JS(uint32_t, has_feature, uint32_t object, uint32_t feature)
WEIR_JS(void, require_feature, uint32_t feature)
WEIR_JS(void, require_limit, uint32_t index, double value)
WEIR_JS(void, request_device, uint32_t adapter, WEIR_JS_TEXT, uint32_t lost, uint32_t error, uint32_t record)
WEIR_JS(uint32_t, device_queue, uint32_t device)
WEIR_JS(void, device_destroy, uint32_t device)
WEIR_JS(void, push_error_scope, uint32_t device, uint32_t filter)
WEIR_JS(void, pop_error_scope, uint32_t device, uint32_t record)

// Buffers
WEIR_JS(uint32_t, buffer_create, uint32_t device, WEIR_JS_TEXT, uint32_t usage, double size, uint32_t mapped)
WEIR_JS(double, buffer_size, uint32_t buffer)
WEIR_JS(uint32_t, buffer_usage, uint32_t buffer)
WEIR_JS(uint32_t, buffer_map_state, uint32_t buffer)
WEIR_JS(void, buffer_map, uint32_t buffer, uint32_t mode, double offset, double size, uint32_t record)
WEIR_JS(uint32_t, buffer_find_range, uint32_t buffer, double offset, double size)
WEIR_JS(uint32_t, buffer_open_range, uint32_t buffer, double offset, double size, void *at, uint32_t writable)
WEIR_JS(uint32_t, buffer_close_range, uint32_t buffer)
WEIR_JS(void, buffer_unmap, uint32_t buffer)
WEIR_JS(void, buffer_destroy, uint32_t buffer)

// Textures, query sets
WEIR_JS(uint32_t, texture_create, uint32_t device, WEIR_JS_TEXT, uint32_t usage, uint32_t dimension,
        uint32_t width, uint32_t height, uint32_t layers, uint32_t format, uint32_t mip_levels,
        uint32_t samples)
WEIR_JS(uint32_t, texture_view, uint32_t texture, WEIR_JS_TEXT, uint32_t format, uint32_t dimension,
        uint32_t base_mip, double mip_count, uint32_t base_layer, double layer_count, uint32_t aspect)
WEIR_JS(uint32_t, texture_number, uint32_t texture, uint32_t which)
WEIR_JS(void, texture_destroy, uint32_t texture)
WEIR_JS(uint32_t, query_set_create, uint32_t device, WEIR_JS_TEXT, uint32_t type, uint32_t count)
WEIR_JS(void, query_set_destroy, uint32_t query_set)

// Shaders and their messages (the last two while a compilation callback runs)
WEIR_JS(uint32_t, shader_create, uint32_t device, WEIR_JS_TEXT, const char *code, size_t code_length)
WEIR_JS(void, shader_messages, uint32_t shader, uint32_t record)
WEIR_JS(double, message_number, uint32_t index, uint32_t which)
WEIR_JS(uint32_t, message_text, uint32_t index)

// Layouts, bind groups, pipelines: parts first, then the call that takes them
WEIR_JS(void, layout_buffer, uint32_t binding, uint32_t visibility, uint32_t type, uint32_t dynamic,
        double size)
WEIR_JS(void, layout_texture, uint32_t binding, uint32_t visibility, uint32_t sample_type, uint32_t dimension,
        uint32_t multisampled)
WEIR_JS(uint32_t, layout_create, uint32_t device, WEIR_JS_TEXT)
WEIR_JS(void, pipeline_layout_group, uint32_t layout)
WEIR_JS(uint32_t, pipeline_layout_create, uint32_t device, WEIR_JS_TEXT)
WEIR_JS(void, group_buffer, uint32_t binding, uint32_t buffer, double offset, double size)
WEIR_JS(void, group_texture, uint32_t binding, uint32_t view)
WEIR_JS(uint32_t, group_create, uint32_t device, WEIR_JS_TEXT, uint32_t layout)
WEIR_JS(uint32_t, compute_pipeline, uint32_t device, WEIR_JS_TEXT, uint32_t layout, uint32_t shader,
        const char *entry, size_t entry_length)
WEIR_JS(void, compute_pipeline_async, uint32_t device, WEIR_JS_TEXT, uint32_t layout, uint32_t shader,
        const char *entry, size_t entry_length, uint32_t record)
WEIR_JS(void, vertex_stage, uint32_t shader, WEIR_JS_TEXT)
WEIR_JS(void, blend, uint32_t color_operation, uint32_t color_source, uint32_t color_destination,
        uint32_t alpha_operation, uint32_t alpha_source, uint32_t alpha_destination)
WEIR_JS(void, color_target, uint32_t format, uint32_t write_mask)
WEIR_JS(void, fragment_stage, uint32_t shader, WEIR_JS_TEXT)
WEIR_JS(void, depth_state, uint32_t format, uint32_t write, uint32_t compare)
WEIR_JS(uint32_t, render_pipeline, uint32_t device, WEIR_JS_TEXT, uint32_t layout, uint32_t topology,
        uint32_t strip_format, uint32_t front_face, uint32_t cull_mode, uint32_t samples,
        uint32_t sample_mask, uint32_t alpha_to_coverage)

// Commands
WEIR_JS(uint32_t, encoder_create, uint32_t device, WEIR_JS_TEXT)
WEIR_JS(uint32_t, encoder_finish, uint32_t encoder, WEIR_JS_TEXT)
WEIR_JS(void, copy_buffer, uint32_t encoder, uint32_t source, double source_offset, uint32_t destination,
        double destination_offset, double size)
WEIR_JS(void, clear_buffer, uint32_t encoder, uint32_t buffer, double offset, double size)
WEIR_JS(void, copy_texture, uint32_t encoder, uint32_t texture, uint32_t mip, uint32_t x, uint32_t y,
        uint32_t z, uint32_t aspect, uint32_t buffer, double offset, double row_bytes, double rows,
        uint32_t width, uint32_t height, uint32_t layers)
WEIR_JS(void, resolve_queries, uint32_t encoder, uint32_t query_set, uint32_t first, uint32_t count,
        uint32_t buffer, double offset)
WEIR_JS(uint32_t, compute_pass, uint32_t encoder, WEIR_JS_TEXT, uint32_t query_set, double begin, double end)
WEIR_JS(void, color_attachment, uint32_t view, double depth_slice, uint32_t resolve, uint32_t load,
        uint32_t store, double red, double green, double blue, double alpha)
WEIR_JS(void, depth_attachment, uint32_t view, uint32_t load, uint32_t store, double clear,
        uint32_t read_only)
WEIR_JS(uint32_t, render_pass, uint32_t encoder, WEIR_JS_TEXT, uint32_t query_set, double begin, double end)
WEIR_JS(void, pass_pipeline, uint32_t pass, uint32_t pipeline)
WEIR_JS(void, pass_group, uint32_t pass, uint32_t index, uint32_t group, const uint32_t *offsets,
        size_t count)
WEIR_JS(void, pass_end, uint32_t pass)
WEIR_JS(void, dispatch, uint32_t pass, uint32_t x, uint32_t y, uint32_t z)
WEIR_JS(void, dispatch_indirect, uint32_t pass, uint32_t sizes, double offset)
WEIR_JS(void, draw, uint32_t pass, uint32_t vertices, uint32_t instances, uint32_t first_vertex,
        uint32_t first_instance)
WEIR_JS(void, draw_indirect, uint32_t pass, uint32_t drawn, double offset)

// Queue
WEIR_JS(void, submit, uint32_t queue, const WGPUCommandBuffer *commands, size_t count)
WEIR_JS(void, write_buffer, uint32_t queue, uint32_t buffer, double offset, const void *data, size_t size)
WEIR_JS(void, work_done, uint32_t queue, uint32_t record)

// Surface
WEIR_JS(uint32_t, surface_create, uint32_t instance, uint32_t canvas)
WEIR_JS(uint32_t, surface_format, void)
WEIR_JS(void, surface_configure, uint32_t surface, uint32_t device, uint32_t format, uint32_t usage,
        uint32_t width, uint32_t height, uint32_t alpha_mode)
WEIR_JS(void, surface_unconfigure, uint32_t surface)
WEIR_JS(uint32_t, surface_texture, uint32_t surface)
