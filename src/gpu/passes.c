#include "gpu/passes.h"
#include "gpu/platform.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

uint32_t weir_pass_storage_buffers(const WeirPassInfo *pass)
{
    uint32_t count = 0;
    for (uint32_t bound = pass->reads | pass->writes; bound; bound &= bound - 1) ++count;
    return count;
}

// Of one pass: all buffers once, and the further parts of three kinds of copies and of the lists.
enum { WEIR_MAX_BINDINGS = WEIR_MAX_BUFFERS + 3 * 2 + WEIR_MAX_PARTS };

// Storage buffers that a pass binds, with all parts.
static uint32_t bound_buffers(const WeirPasses *passes, uint32_t pass)
{
    const WeirPassInfo *info = &passes->method->passes[pass];
    uint32_t count = 0;
    for (uint32_t name = 0; name < passes->method->buffer_count; ++name)
        if ((info->reads | info->writes) >> name & 1) count += passes->buffers->parts[name];
    return count;
}

WeirStatus weir_passes_check(const WeirPasses *passes, WeirMessage *message)
{
    uint32_t worst = 0, most = passes->gpu->limits.maxStorageBuffersPerShaderStage;
    for (uint32_t pass = 1; pass < passes->method->pass_count; ++pass)
        if (bound_buffers(passes, pass) > bound_buffers(passes, worst)) worst = pass;
    uint32_t count = bound_buffers(passes, worst);
    if (count <= most) return WEIR_OK;
    return weir_fail(message, WEIR_ERROR_MEMORY,
                     "so many particles need %u storage buffers in the GPU's %s, but %s allows %u; "
                     "raise parameters.particle_spacing",
                     count, passes->method->passes[worst].label, passes->gpu->name, most);
}

// Constants that C decides: binding numbers by name, sizes, and what is chosen, so that no pass branches on it.
static size_t write_constants(char *text, size_t capacity, const WeirMethodInfo *method, uint32_t threads,
                              const char *settings)
{
    size_t length = 0;
#define APPEND(...)                                                                                          \
    length += (size_t)snprintf(text ? text + length : NULL, text ? capacity - length : 0, __VA_ARGS__)
    APPEND("const WORKGROUP_SIZE = %uu;\nconst SCAN_VECTORS = %du;\n", threads, WEIR_SCAN_VECTORS);
    for (uint32_t name = 0; name < method->buffer_count; ++name)
        APPEND("const BINDING_%s = %uu;\n", method->buffers[name].name, name);
    APPEND("%s", settings);
#undef APPEND
    return length;
}

// Twice the texts' length: the names in them may become longer.
static size_t room_for(const char *const *parts)
{
    size_t length = 0;
    for (; parts && *parts; ++parts) length += 2 * strlen(*parts);
    return length;
}

static char *append(char *end, const char *text)
{
    size_t length = strlen(text);
    memcpy(end, text, length + 1);
    return end + length;
}

// ---- Parts with other names ----

const char weir_seen_parts[] = "seen_";

static size_t name_length(const char *at)
{
    size_t length = 0;
    while (isalnum((unsigned char)at[length]) || at[length] == '_') ++length;
    return length;
}

typedef struct Names {
    const char *name[32];
    size_t length[32], count;
} Names;

// What a part declares: a line each.
static void note_names(Names *names, const char *part)
{
    static const char *const kinds[] = {"fn ", "struct ", "const ", "var<workgroup> "};
    for (const char *line = part; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; ++k) {
            if (strncmp(line, kinds[k], strlen(kinds[k])) != 0 || names->count == 32) continue;
            names->name[names->count] = line + strlen(kinds[k]);
            names->length[names->count] = name_length(line + strlen(kinds[k]));
            ++names->count;
        }
    }
}

static bool is_noted(const Names *names, const char *name, size_t length)
{
    for (size_t n = 0; n < names->count; ++n)
        if (names->length[n] == length && strncmp(names->name[n], name, length) == 0) return true;
    return false;
}

// Members, which follow a full stop, keep their names.
static char *append_renamed(char *end, const char *part, const Names *names)
{
    for (char last = '\0'; *part; last = end[-1]) {
        size_t length = name_length(part);
        if (length > 0 && last != '.' && is_noted(names, part, length)) end = append(end, weir_seen_parts);
        if (length == 0) length = 1;
        memcpy(end, part, length);
        end += length;
        part += length;
    }
    *end = '\0';
    return end;
}

static char *append_parts(char *end, const char *const *parts)
{
    for (; parts && *parts && *parts != weir_seen_parts; ++parts) end = append(end, *parts);
    if (!parts || !*parts) return end;
    Names names = {0};
    for (const char *const *part = parts + 1; *part; ++part) note_names(&names, *part);
    for (const char *const *part = parts + 1; *part; ++part) end = append_renamed(end, *part, &names);
    return end;
}

char *weir_pass_source(const WeirMethodInfo *method, uint32_t threads, const char *settings,
                       const char *const *parts, const char *source)
{
    size_t constants = write_constants(NULL, 0, method, threads, settings);
    size_t size = constants + strlen(weir_wgsl_structs) + room_for(method->parts) + room_for(parts) +
                  strlen(source) + 1;
    char *text = malloc(size);
    if (!text) return NULL;
    char *end = text + write_constants(text, size, method, threads, settings);
    end = append(end, weir_wgsl_structs);
    end = append_parts(append_parts(end, method->parts), parts);
    append(end, source);
    return text;
}

static WGPUBufferBindingType binding_type(const WeirPasses *passes, uint32_t pass, uint32_t name)
{
    const WeirPassInfo *info = &passes->method->passes[pass];
    if (passes->method->buffers[name].uniform) return WGPUBufferBindingType_Uniform;
    if (info->writes >> name & 1) return WGPUBufferBindingType_Storage;
    if (info->reads >> name & 1) return WGPUBufferBindingType_ReadOnlyStorage;
    return WGPUBufferBindingType_BindingNotUsed;
}

static void make_bind_group(WeirPasses *passes, uint32_t pass)
{
    WGPUBindGroupLayoutEntry layout[WEIR_MAX_BINDINGS] = {0};
    WGPUBindGroupEntry entries[WEIR_MAX_BINDINGS] = {0};
    const WeirBuffers *buffers = passes->buffers;
    size_t count = 0;
    for (uint32_t name = 0; name < passes->method->buffer_count; ++name) {
        WGPUBufferBindingType type = binding_type(passes, pass, name);
        if (type == WGPUBufferBindingType_BindingNotUsed) continue;
        for (uint32_t part = 0; part < buffers->parts[name]; ++part) {
            uint32_t binding = name + part * WEIR_MAX_BUFFERS;
            layout[count] = (WGPUBindGroupLayoutEntry){
                .binding = binding, .visibility = WGPUShaderStage_Compute, .buffer.type = type};
            entries[count++] = (WGPUBindGroupEntry){.binding = binding,
                                                    .buffer = buffers->handle[name][part],
                                                    .size = weir_buffers_part_bytes(buffers, name)};
        }
    }
    WGPUStringView label = weir_gpu_text(passes->method->passes[pass].label);
    passes->layout[pass] = wgpuDeviceCreateBindGroupLayout(
        passes->gpu->device,
        &(WGPUBindGroupLayoutDescriptor){.label = label, .entryCount = count, .entries = layout});
    passes->bind_group[pass] = wgpuDeviceCreateBindGroup(
        passes->gpu->device,
        &(WGPUBindGroupDescriptor){
            .label = label, .layout = passes->layout[pass], .entryCount = count, .entries = entries});
}

// What a pipeline is made of: shader module, layout, and the descriptor that names them.
typedef struct Ingredients {
    WGPUShaderModule module;
    WGPUComputePipelineDescriptor descriptor;
} Ingredients;

static Ingredients prepare_ingredients(WeirGpu *gpu, const char *name, const char *label, const char *source,
                                       WGPUBindGroupLayout layout)
{
    WGPUShaderSourceWGSL wgsl = {.chain.sType = WGPUSType_ShaderSourceWGSL, .code = weir_gpu_text(source)};
    WGPUShaderModuleDescriptor module_descriptor = {.nextInChain = &wgsl.chain,
                                                    .label = weir_gpu_text(label)};
    WGPUShaderModule module =
        weir_platform_shader_module(gpu, &module_descriptor, gpu->options.trusted_shaders);
    WGPUPipelineLayout pipeline_layout = wgpuDeviceCreatePipelineLayout(
        gpu->device, &(WGPUPipelineLayoutDescriptor){.label = weir_gpu_text(label),
                                                     .bindGroupLayoutCount = 1,
                                                     .bindGroupLayouts = &layout});
    return (Ingredients){module,
                         {.label = weir_gpu_text(label),
                          .layout = pipeline_layout,
                          .compute = {.module = module, .entryPoint = weir_gpu_text(name)}}};
}

static void release_ingredients(const Ingredients *made)
{
    if (made->descriptor.layout) wgpuPipelineLayoutRelease(made->descriptor.layout);
    if (made->module) wgpuShaderModuleRelease(made->module);
}

WGPUComputePipeline weir_pass_pipeline(WeirGpu *gpu, const char *name, const char *label, const char *source,
                                       WGPUBindGroupLayout layout, WeirReport *report)
{
    if (report) weir_report_begin(report);
    Ingredients made = prepare_ingredients(gpu, name, label, source, layout);
    WGPUComputePipeline pipeline = wgpuDeviceCreateComputePipeline(gpu->device, &made.descriptor);
    if (report) weir_report_end(report, label);
    release_ingredients(&made);
    return pipeline;
}

// The same beside the program's own work: *pipeline comes later.
static WeirStatus request_pipeline(WeirGpu *gpu, const WeirPassInfo *info, const char *source,
                                   WGPUBindGroupLayout layout, WeirReport *report,
                                   WGPUComputePipeline *pipeline)
{
    weir_report_begin(report);
    Ingredients made = prepare_ingredients(gpu, info->name, info->label, source, layout);
    WeirStatus status = weir_report_pipeline(report, &made.descriptor, info->label, pipeline);
    weir_report_end(report, info->label);
    release_ingredients(&made);
    return status;
}

static bool make_pipeline(WeirPasses *passes, WeirVariant *variant, uint32_t pass, WeirReport *report)
{
    const WeirMethodInfo *method = passes->method;
    const WeirPassInfo *info = &method->passes[pass];
    size_t capacity = 2 * WEIR_SETTINGS_LENGTH + weir_parts_declare(passes->buffers, method->functions,
                                                                    info->reads, info->writes, NULL, 0);
    char *settings = malloc(capacity);
    if (!settings) return false;
    size_t length =
        (size_t)snprintf(settings, capacity, "%s%s", variant->settings, info->settings ? info->settings : "");
    weir_parts_declare(passes->buffers, method->functions, info->reads, info->writes, settings + length,
                       capacity - length);
    uint32_t threads = info->items == WEIR_ITEMS_SHARES || info->items == WEIR_ITEMS_STEP
                           ? passes->share_threads
                           : WEIR_WORKGROUP_SIZE;
    char *source = weir_pass_source(method, threads, settings, info->parts, info->source);
    free(settings);
    if (!source) return false;
    WGPUBindGroupLayout layout = passes->layout[pass];
    WGPUComputePipeline *pipeline = &variant->pipeline[pass];
    variant->key[pass] = weir_pipeline_key(info->label, source);
    *pipeline = weir_pipelines_find(&passes->gpu->pipelines, variant->key[pass]);
    bool made = true;
    if (*pipeline) {
        // An equal layout is as good as the one that it was made with.
    } else if (passes->in_background)
        made = request_pipeline(passes->gpu, info, source, layout, report, pipeline) == WEIR_OK;
    else
        *pipeline = weir_pass_pipeline(passes->gpu, info->name, info->label, source, layout, report);
    free(source);
    return made;
}

static void release_pipelines(WeirVariant *variant)
{
    for (int pass = 0; pass < WEIR_MAX_PASSES; ++pass) {
        if (variant->pipeline[pass]) wgpuComputePipelineRelease(variant->pipeline[pass]);
        variant->pipeline[pass] = NULL;
    }
}

// The variant of these settings: the one that runs or the other one, which is made theirs if it is not.
static uint32_t find_variant(WeirPasses *passes, const char *settings)
{
    for (uint32_t n = 0; n < 2; ++n)
        if (strcmp(passes->variants[n].settings, settings) == 0) return n;
    uint32_t other = 1 - passes->current;
    WeirVariant *variant = &passes->variants[other];
    release_pipelines(variant);
    snprintf(variant->settings, sizeof variant->settings, "%s", settings);
    return other;
}

WeirStatus weir_passes_prepare(WeirPasses *passes, const char *settings, uint32_t needed, WeirReport *report,
                               WeirMessage *message)
{
    passes->next = find_variant(passes, settings);
    WeirVariant *variant = &passes->variants[passes->next];
    for (uint32_t pass = 0; pass < passes->method->pass_count; ++pass) {
        if (!(needed >> pass & 1)) continue;
        const char *label = passes->method->passes[pass].label;
        if (!passes->bind_group[pass]) {
            weir_report_begin(report);
            make_bind_group(passes, pass);
            weir_report_end(report, label);
        }
        if (!variant->pipeline[pass] && !make_pipeline(passes, variant, pass, report))
            return weir_fail(message, WEIR_ERROR_MEMORY, "%s: no host memory for it", label);
    }
    return weir_report_check(report, message);
}

void weir_passes_use_prepared(WeirPasses *passes)
{
    passes->current = passes->next;
}

void weir_passes_keep(const WeirPasses *passes)
{
    const WeirVariant *variant = &passes->variants[passes->current];
    for (uint32_t pass = 0; pass < passes->method->pass_count; ++pass)
        if (variant->pipeline[pass])
            weir_pipelines_keep(&passes->gpu->pipelines, variant->key[pass], variant->pipeline[pass]);
}

void weir_passes_destroy(WeirPasses *passes)
{
    for (int pass = 0; pass < WEIR_MAX_PASSES; ++pass) {
        if (passes->bind_group[pass]) wgpuBindGroupRelease(passes->bind_group[pass]);
        if (passes->layout[pass]) wgpuBindGroupLayoutRelease(passes->layout[pass]);
    }
    for (int n = 0; n < 2; ++n) release_pipelines(&passes->variants[n]);
}

void weir_pass_groups(const WeirGpu *gpu, uint32_t groups, uint32_t size[2])
{
    size[1] = (groups + gpu->max_groups - 1) / gpu->max_groups;
    size[0] = (groups + size[1] - 1) / size[1];
}

static void set_pass(const WeirPasses *passes, uint32_t pass, WGPUComputePassEncoder encoder)
{
    wgpuComputePassEncoderSetPipeline(encoder, passes->variants[passes->current].pipeline[pass]);
    wgpuComputePassEncoderSetBindGroup(encoder, 0, passes->bind_group[pass], 0, NULL);
}

void weir_pass_dispatch(const WeirPasses *passes, uint32_t pass, WGPUComputePassEncoder encoder)
{
    uint32_t size[2];
    weir_pass_groups(passes->gpu, passes->groups[passes->method->passes[pass].items], size);
    set_pass(passes, pass, encoder);
    wgpuComputePassEncoderDispatchWorkgroups(encoder, size[0], size[1], 1);
}

void weir_pass_dispatch_turn(const WeirPasses *passes, uint32_t pass, uint32_t turn,
                             WGPUComputePassEncoder encoder)
{
    uint32_t size[2];
    weir_pass_groups(passes->gpu, passes->groups[passes->method->passes[pass].items], size);
    set_pass(passes, pass, encoder);
    wgpuComputePassEncoderDispatchWorkgroups(encoder, size[0] + (turn + 3 - size[0] % 3) % 3, size[1], 1);
}

void weir_pass_dispatch_indirect(const WeirPasses *passes, uint32_t pass, WGPUComputePassEncoder encoder,
                                 WGPUBuffer sizes, uint64_t offset)
{
    set_pass(passes, pass, encoder);
    wgpuComputePassEncoderDispatchWorkgroupsIndirect(encoder, sizes, offset);
}
