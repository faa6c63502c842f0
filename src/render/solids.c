// Walls and bodies as the shapes that they are: made into triangles (3D) or outlines (2D) once, put where the device's
// own state of the solids has them.
#include "render/renderer.h"

#include <stdlib.h>

#include "render/flat_shape.h"
#include "render/shape.h"

static void release_buffer(WGPUBuffer buffer)
{
    if (!buffer) return;
    wgpuBufferDestroy(buffer);
    wgpuBufferRelease(buffer);
}

static void release(WeirSolids *solids)
{
    if (solids->group) wgpuBindGroupRelease(solids->group);
    if (solids->edged) wgpuBindGroupRelease(solids->edged);
    if (solids->traced) wgpuBindGroupRelease(solids->traced);
    release_buffer(solids->shapes);
    release_buffer(solids->forms);
    release_buffer(solids->edges);
    if (solids->states) wgpuBufferRelease(solids->states);
    *solids = (WeirSolids){.group = NULL};
}

void weir_solids_release(WeirRenderer *renderer)
{
    release(&renderer->solids);
}

static WGPUBuffer create_buffer(WeirRenderer *renderer, WGPUBufferUsage usage, const void *data, size_t size)
{
    WGPUBuffer buffer = wgpuDeviceCreateBuffer(
        weir_gpu_wgpu_device(renderer->gpu),
        &(WGPUBufferDescriptor){.usage = usage | WGPUBufferUsage_CopyDst, .size = size});
    if (buffer) wgpuQueueWriteBuffer(weir_gpu_wgpu_queue(renderer->gpu), buffer, 0, data, size);
    return buffer;
}

static bool create(WeirRenderer *renderer, const void *shapes, size_t size, uint32_t count)
{
    WeirSolids *solids = &renderer->solids;
    solids->shapes = create_buffer(renderer, WGPUBufferUsage_Storage, shapes, size);
    if (!solids->shapes) return false;
    // The layout of the particles' group, of which the shaders have two bindings.
    WGPUBindGroupEntry entries[WEIR_PARTICLE_BINDINGS];
    for (uint32_t k = 0; k < WEIR_PARTICLE_BINDINGS; k++) {
        entries[k] = (WGPUBindGroupEntry){
            .binding = k, .buffer = k == 0 ? solids->shapes : solids->states, .size = WGPU_WHOLE_SIZE};
    }
    solids->group = wgpuDeviceCreateBindGroup(weir_gpu_wgpu_device(renderer->gpu),
                                              &(WGPUBindGroupDescriptor){.layout = renderer->particle_layout,
                                                                         .entryCount = WEIR_PARTICLE_BINDINGS,
                                                                         .entries = entries});
    solids->shape_count = count;
    return solids->group != NULL;
}

static bool create_triangles(WeirRenderer *renderer, const WeirScene *scene)
{
    WeirTriangles triangles;
    weir_triangles_of(&triangles, scene);
    // Those of a mesh too large for a buffer stay what they are made of: particles.
    bool good = true;
    if (!triangles.failed && triangles.count > 0) {
        WeirSolids *solids = &renderer->solids;
        solids->forms = create_buffer(renderer, WGPUBufferUsage_Storage, triangles.forms,
                                      triangles.form_count * sizeof *triangles.forms);
        good = solids->forms && create(renderer, triangles.corners,
                                       triangles.count * sizeof *triangles.corners, triangles.count);
    }
    weir_triangles_free(&triangles);
    return good;
}

// What clear_water.wgsl meets with rays: corners, states, forms.
static bool create_traced(WeirRenderer *renderer)
{
    WeirSolids *solids = &renderer->solids;
    const WGPUBuffer buffers[3] = {solids->shapes, solids->states, solids->forms};
    WGPUBindGroupEntry entries[3];
    for (uint32_t k = 0; k < 3; k++) {
        entries[k] = (WGPUBindGroupEntry){
            .binding = k, .buffer = buffers[k] ? buffers[k] : renderer->nothing, .size = WGPU_WHOLE_SIZE};
    }
    solids->traced = wgpuDeviceCreateBindGroup(
        weir_gpu_wgpu_device(renderer->gpu),
        &(WGPUBindGroupDescriptor){.layout = renderer->form_layout, .entryCount = 3, .entries = entries});
    return solids->traced != NULL;
}

static bool create_edges(WeirRenderer *renderer, const WeirFlatShapes *flat)
{
    WeirSolids *solids = &renderer->solids;
    solids->edges = create_buffer(renderer, WGPUBufferUsage_Uniform, flat->edges, sizeof flat->edges);
    if (!solids->edges) return false;
    WGPUBindGroupEntry entry = {.buffer = solids->edges, .size = sizeof flat->edges};
    solids->edged = wgpuDeviceCreateBindGroup(
        weir_gpu_wgpu_device(renderer->gpu),
        &(WGPUBindGroupDescriptor){
            .layout = renderer->texture_layouts[WEIR_TEXTURES_EDGES], .entryCount = 1, .entries = &entry});
    return solids->edged != NULL;
}

static bool create_flat(WeirRenderer *renderer, const WeirScene *scene)
{
    WeirFlatShapes *flat = calloc(1, sizeof *flat);
    if (!flat) return false;
    weir_flat_shapes_of(flat, scene);
    // Polygons with too many edges stay particles too.
    bool any = !flat->failed && flat->count > 0;
    bool good = !any || (create_edges(renderer, flat) &&
                         create(renderer, flat->shapes, flat->count * sizeof *flat->shapes, flat->count));
    free(flat);
    return good;
}

WeirStatus weir_solids_prepare(WeirRenderer *renderer, const WeirScene *scene,
                               const WeirGpuParticles *particles)
{
    WeirSolids *solids = &renderer->solids;
    bool space = scene->dimension == 3, good = true;
    if (solids->states == particles->solids && (solids->traced || !space)) return WEIR_OK;
    release(solids);
    if (particles->solids) {
        // A reference, so that no other simulation's buffer gets its address.
        wgpuBufferAddRef(particles->solids);
        solids->states = particles->solids;
        good = space ? create_triangles(renderer, scene) : create_flat(renderer, scene);
    }
    if (good && (!space || create_traced(renderer))) return WEIR_OK;
    release(solids);
    return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No device memory for the shapes of the bodies.");
}
