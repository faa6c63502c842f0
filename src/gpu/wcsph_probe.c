// What the scene's probes look at, gathered on the device, and its way to the host.
#include "core/probe.h"
#include "gpu/wcsph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GATHERED, FOUND, CONTROL, SOLIDS, SUMS, PIECES }; // of the copy
enum { FOUND_TOTAL = WEIR_MAX_PROBES + 1 };              // what each look found, and how many were gathered

// `struct Gathered` in shaders/wcsph/gather.wgsl.
typedef struct WeirGpuGathered {
    int32_t place[3]; // quanta
    float excess;
    float velocity[3], pressure;
    uint32_t id, unused[3];
} WeirGpuGathered;
static_assert(sizeof(WeirGpuGathered) == 48 && sizeof(WeirLook) == 32, "the layouts of the shader's structs");

enum { DIGIT_BITS = 14, DIGITS = 1 << DIGIT_BITS };
static_assert(WEIR_MAX_PARTICLES <= 1 << 2 * DIGIT_BITS, "two digits make an id");

struct WeirWcsphProbes {
    WeirProbePiece pieces[WEIR_MAX_PROBES];
    bool measures_force;
    float *values;             // the arrays of a state, one after the other
    uint32_t *order, *shuffle; // of the records by id
    uint32_t first[DIGITS];
    double found[WEIR_MAX_PROBES];
};

bool weir_gpu_wcsph_copy_probes(WeirWcsphGpu *solver, const WeirSolverSetup *setup)
{
    WeirWcsphTraits *traits = &solver->traits;
    if (setup->probe_count == 0) return true;
    uint32_t reach =
        weir_probe_reach(setup->probes, setup->probe_count, &setup->parameters, &setup->constants);
    traits->probe_count = setup->probe_count;
    traits->most_gathered = reach > 0 ? reach : 1;
    struct WeirWcsphProbes *probes = solver->probes = calloc(1, sizeof *probes);
    if (!probes) return false;
    memcpy(probes->pieces, setup->probes, setup->probe_count * sizeof *probes->pieces);
    for (uint32_t k = 0; k < setup->probe_count; ++k)
        probes->measures_force = probes->measures_force || setup->probes[k].kind == WEIR_PROBE_FORCE;
    size_t per_record = 2 * setup->constants.dimension + 2;
    probes->values = calloc(per_record * traits->most_gathered, sizeof *probes->values);
    probes->order = calloc(2 * (size_t)traits->most_gathered, sizeof *probes->order);
    if (!probes->values || !probes->order) return false;
    probes->shuffle = probes->order + traits->most_gathered;
    return true;
}

void weir_gpu_wcsph_free_probes(WeirWcsphGpu *solver)
{
    if (!solver->probes) return;
    free(solver->probes->values);
    free(solver->probes->order);
    free(solver->probes);
}

void weir_gpu_wcsph_probe_sizes(const WeirWcsphTraits *traits, WeirBufferSize sizes[WEIR_WCSPH_BUFFER_TOTAL])
{
    uint64_t probes = traits->probe_count, gathered = traits->most_gathered;
    sizes[WEIR_WCSPH_looks].bytes = sizeof(WeirLook) * (probes > 0 ? probes : 1);
    sizes[WEIR_WCSPH_gathered].bytes = sizeof(WeirGpuGathered) * (gathered > 0 ? gathered : 1);
    sizes[WEIR_WCSPH_found].bytes = FOUND_TOTAL * sizeof(uint32_t);
}

bool weir_gpu_wcsph_make_gather_copy(WeirWcsphGpu *solver)
{
    static const WeirWcsphBuffer from[PIECES] = {WEIR_WCSPH_gathered, WEIR_WCSPH_found, WEIR_WCSPH_control,
                                                 WEIR_WCSPH_solid_state, WEIR_WCSPH_solid_sum};
    WeirGpuSolver *common = &solver->common;
    if (!solver->probes) return true;
    uint64_t sizes[PIECES];
    for (int n = 0; n < PIECES; ++n) sizes[n] = common->buffers.size[from[n]].bytes;
    weir_report_begin(common->report);
    common->gather_copy.readback = weir_readback_create(common->gpu, "probe readback", PIECES, sizes);
    weir_report_end(common->report, "buffer for reading what probes look at");
    return common->gather_copy.readback;
}

void weir_gpu_wcsph_write_looks(WeirWcsphGpu *solver)
{
    WeirGpuSolver *common = &solver->common;
    WeirLook looks[WEIR_MAX_PROBES];
    for (uint32_t k = 0; k < solver->traits.probe_count; ++k)
        looks[k] = weir_probe_look(&solver->probes->pieces[k], &common->parameters, &common->constants);
    if (solver->traits.probe_count > 0)
        weir_buffers_write(&common->buffers, WEIR_WCSPH_looks, looks,
                           solver->traits.probe_count * sizeof *looks);
}

void weir_gpu_wcsph_copy_gathered(WeirGpuSolver *common)
{
    static const uint32_t nothing[FOUND_TOTAL];
    WeirWcsphGpu *solver = (WeirWcsphGpu *)common;
    WeirBuffers *buffers = &common->buffers;
    weir_buffers_write(buffers, WEIR_WCSPH_found, nothing, sizeof nothing);
    WGPUCommandEncoder encoder = weir_gpu_solver_commands(common, "gather");
    if (solver->probes->measures_force) weir_gpu_wcsph_evaluate(solver, encoder, WEIR_EVALUATE_STATE);
    WeirRecorder recorder = weir_recorder_begin(common, encoder);
    weir_record(&recorder, WEIR_WCSPH_GATHER);
    weir_recorder_end(&recorder);
    WeirReadback *to = common->gather_copy.readback;
    weir_readback_copy(to, encoder, GATHERED, buffers->handle[WEIR_WCSPH_gathered][0], 0);
    weir_readback_copy(to, encoder, FOUND, buffers->handle[WEIR_WCSPH_found][0], 0);
    weir_readback_copy(to, encoder, CONTROL, buffers->handle[WEIR_WCSPH_control][0], 0);
    weir_readback_copy(to, encoder, SOLIDS, buffers->handle[WEIR_WCSPH_solid_state][0], 0);
    weir_readback_copy(to, encoder, SUMS, buffers->handle[WEIR_WCSPH_solid_sum][0], 0);
    weir_gpu_submit(common->gpu, encoder, "gather");
}

// The device gathers in no order; sums on the host have one.
static void order_by_digit(struct WeirWcsphProbes *probes, const WeirGpuGathered *records, uint32_t count,
                           uint32_t shift, const uint32_t *from, uint32_t *to)
{
    memset(probes->first, 0, sizeof probes->first);
    for (uint32_t n = 0; n < count; ++n) ++probes->first[records[n].id >> shift & (DIGITS - 1)];
    for (uint32_t digit = 0, sum = 0; digit < DIGITS; ++digit) {
        uint32_t own = probes->first[digit];
        probes->first[digit] = sum;
        sum += own;
    }
    for (uint32_t n = 0; n < count; ++n) {
        uint32_t record = from ? from[n] : n;
        to[probes->first[records[record].id >> shift & (DIGITS - 1)]++] = record;
    }
}

static WeirState state_of(const WeirWcsphGpu *solver, const WeirGpuGathered *records, uint32_t count)
{
    struct WeirWcsphProbes *probes = solver->probes;
    uint32_t dimension = solver->traits.dimension;
    float *position = probes->values, *velocity = position + (size_t)dimension * count;
    float *density = velocity + (size_t)dimension * count, *pressure = density + count;
    order_by_digit(probes, records, count, 0, NULL, probes->shuffle);
    order_by_digit(probes, records, count, DIGIT_BITS, probes->shuffle, probes->order);
    for (uint32_t n = 0; n < count; ++n) {
        const WeirGpuGathered *record = &records[probes->order[n]];
        weir_gpu_wcsph_position(&solver->common.constants, record->place, position + (size_t)dimension * n);
        memcpy(velocity + (size_t)dimension * n, record->velocity, dimension * sizeof *velocity);
        density[n] = solver->common.parameters.rest_density + record->excess;
        pressure[n] = record->pressure;
    }
    return (WeirState){.count = count,
                       .dimension = dimension,
                       .position = position,
                       .velocity = velocity,
                       .density = density,
                       .pressure = pressure};
}

// order_of() in gather.wgsl, back.
static double number_of(uint32_t order)
{
    uint32_t bits = order & 0x80000000u ? order & 0x7FFFFFFFu : ~order;
    float number;
    memcpy(&number, &bits, sizeof number);
    return order ? (double)number : (double)-INFINITY;
}

WeirStatus weir_gpu_wcsph_take_gathered(WeirGpuSolver *common, void *result)
{
    WeirWcsphGpu *solver = (WeirWcsphGpu *)common;
    struct WeirWcsphProbes *probes = solver->probes;
    const WeirReadback *from = common->gather_copy.readback;
    const WeirWcsphControl *control = weir_readback_data(from, CONTROL);
    const uint32_t *found = weir_readback_data(from, FOUND);
    uint32_t count = found[WEIR_MAX_PROBES];
    if (control->bad_step != UINT32_MAX || count > solver->traits.most_gathered) return WEIR_ERROR_UNSTABLE;
    for (uint32_t k = 0; k < solver->traits.probe_count; ++k)
        probes->found[k] = probes->pieces[k].kind == WEIR_PROBE_FRONT ? number_of(found[k]) : found[k];
    WeirGathered *gathered = result;
    *gathered = (WeirGathered){.state = state_of(solver, weir_readback_data(from, GATHERED), count),
                               .found = probes->found};
    if (probes->measures_force) {
        weir_gpu_wcsph_take_solids(solver, weir_readback_data(from, SOLIDS), weir_readback_data(from, SUMS));
        gathered->state.solids = solver->host_solids;
    }
    weir_gpu_wcsph_take_moment(solver, control, &gathered->state);
    return WEIR_OK;
}
