// Walls and bodies in 3D as the shapes that they are: made into triangles once, put where the device's own state of the
// solids has them.
#include "render/renderer.h"

#include "render/shape.h"

static void release(WeirSolids *solids)
{
    if (solids->group) wgpuBindGroupRelease(solids->group);
    if (solids->corners) {
        wgpuBufferDestroy(solids->corners);
        wgpuBufferRelease(solids->corners);
    }
    if (solids->states) wgpuBufferRelease(solids->states);
    *solids = (WeirSolids){.group = NULL};
}

void weir_solids_release(WeirRenderer *renderer)
{
    release(&renderer->solids);
}

static bool create(WeirRenderer *renderer, const WeirTriangles *triangles)
{
    WeirSolids *solids = &renderer->solids;
    WGPUDevice device = weir_gpu_wgpu_device(renderer->gpu);
    size_t size = triangles->count * sizeof *triangles->corners;
    solids->corners = wgpuDeviceCreateBuffer(
        device,
        &(WGPUBufferDescriptor){.usage = WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst, .size = size});
    if (!solids->corners) return false;
    wgpuQueueWriteBuffer(weir_gpu_wgpu_queue(renderer->gpu), solids->corners, 0, triangles->corners, size);
    // The layout of the particles' group, which has four bindings; the shaders have two.
    WGPUBindGroupEntry entries[4];
    for (uint32_t k = 0; k < 4; k++) {
        entries[k] = (WGPUBindGroupEntry){
            .binding = k, .buffer = k == 0 ? solids->corners : solids->states, .size = WGPU_WHOLE_SIZE};
    }
    solids->group = wgpuDeviceCreateBindGroup(
        device,
        &(WGPUBindGroupDescriptor){.layout = renderer->particle_layout, .entryCount = 4, .entries = entries});
    return solids->group != NULL;
}

WeirStatus weir_solids_prepare(WeirRenderer *renderer, const WeirScene *scene,
                               const WeirGpuParticles *particles)
{
    WeirSolids *solids = &renderer->solids;
    if (solids->states == particles->solids) return WEIR_OK;
    release(solids);
    if (!particles->solids) return WEIR_OK;
    // A reference, so that no other simulation's buffer gets its address.
    wgpuBufferAddRef(particles->solids);
    solids->states = particles->solids;
    WeirTriangles triangles;
    weir_triangles_of(&triangles, scene);
    // Those of a mesh too large for a buffer stay what they are made of: particles.
    bool any = !triangles.failed && triangles.count > 0, good = !any || create(renderer, &triangles);
    if (any) solids->corner_count = triangles.count;
    weir_triangles_free(&triangles);
    if (good) return WEIR_OK;
    release(solids);
    return weir_fail(&renderer->message, WEIR_ERROR_MEMORY, "No device memory for the shapes of the bodies.");
}
