#include "upload.h"

#include <math.h>
#include <stdlib.h>

static WGPUBuffer create_buffer(WeirGpu *gpu, const void *data, size_t size)
{
    WGPUBuffer buffer = wgpuDeviceCreateBuffer(
        weir_gpu_wgpu_device(gpu),
        &(WGPUBufferDescriptor){.usage = WGPUBufferUsage_Storage | WGPUBufferUsage_CopyDst, .size = size});
    if (buffer) wgpuQueueWriteBuffer(weir_gpu_wgpu_queue(gpu), buffer, 0, data, size);
    return buffer;
}

bool weir_upload_arrays(WeirGpu *gpu, int32_t (*coordinate)[4], float (*motion)[4], uint32_t count,
                        WeirGpuParticles *particles)
{
    *particles = (WeirGpuParticles){
        .gpu = gpu,
        .method = WEIR_METHOD_WCSPH,
        .coordinate = create_buffer(gpu, coordinate, count * sizeof *coordinate),
        .motion = create_buffer(gpu, motion, count * sizeof *motion),
        .count = count,
    };
    return particles->coordinate && particles->motion;
}

bool weir_upload_solids(WeirGpuParticles *particles, const WeirSolidState *states, uint32_t count)
{
    particles->solids = create_buffer(particles->gpu, states, count * sizeof *states);
    particles->solid_count = count;
    return particles->solids;
}

static uint32_t solids_in(const WeirState *state)
{
    uint32_t count = 0;
    for (uint32_t i = 0; state->solids && i < state->count; i++) {
        uint32_t group = state->group[i];
        if (weir_group_is_solid(group) && group - WEIR_GROUP_SOLID >= count)
            count = group - WEIR_GROUP_SOLID + 1;
    }
    return count;
}

bool weir_upload(WeirGpu *gpu, WeirSim *cpu, WeirGpuParticles *particles)
{
    WeirState state;
    if (weir_sim_state(cpu, &state) != WEIR_OK) return false;
    const WeirConstants *constants = weir_sim_constants(cpu);
    int32_t(*coordinate)[4] = calloc(state.count, sizeof *coordinate);
    float(*motion)[4] = calloc(state.count, sizeof *motion);
    bool good = coordinate && motion;
    for (uint32_t i = 0; good && i < state.count; i++) {
        for (uint32_t k = 0; k < state.dimension; k++) {
            double place = (double)state.position[state.dimension * i + k] - (double)constants->origin[k];
            coordinate[i][k] = (int32_t)lround(place / (double)constants->quantum);
            motion[i][k] = state.velocity[state.dimension * i + k];
        }
        coordinate[i][3] = state.group ? (int32_t)state.group[i] : 0;
        motion[i][3] = state.density[i] - weir_sim_parameters(cpu)->rest_density;
    }
    good = good && weir_upload_arrays(gpu, coordinate, motion, state.count, particles);
    uint32_t solids = good ? solids_in(&state) : 0;
    if (solids > 0) good = weir_upload_solids(particles, state.solids, solids);
    free(coordinate);
    free(motion);
    return good;
}

void weir_upload_release(WeirGpuParticles *particles)
{
    if (particles->coordinate) wgpuBufferRelease(particles->coordinate);
    if (particles->motion) wgpuBufferRelease(particles->motion);
    if (particles->solids) wgpuBufferRelease(particles->solids);
    particles->coordinate = particles->motion = particles->solids = NULL;
}
