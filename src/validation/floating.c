// Bodies in water: a box of half the water's density floats half in, one of the water's density stays where it is.
#include "validation/measure.h"

#include "core/probe.h"

#include <math.h>
#include <stdio.h>

extern const char weir_case_floating_box_scene[], weir_case_floating_box_scene_3d[],
    weir_case_floating_box_scene_neutral[];

enum { RUNS = 3 };
enum { FLOATS_2D, FLOATS_3D, NEUTRAL };
static const double box_height[2] = {0.2, 0.2}; // of the floating boxes, m
static const double density_ratio = 0.5;

typedef struct Floating {
    uint32_t draught[2], drift; // curves
    double start[3];            // of the neutral box's centre
} Floating;

static void plan(WeirValidation *v)
{
    Floating *data = v->data;
    double flat = weir_by_resolution(v, 0.02, 0.01, 0.005), deep = weir_by_resolution(v, 0.04, 0.02, 0.01);
    weir_plan_run(v, "floats, 2D", "validation/floating_box/scene.json", weir_case_floating_box_scene, flat,
                  weir_by_resolution(v, 4.0, 8.0, 8.0), 0.02);
    weir_plan_run(v, "floats, 3D", "validation/floating_box/scene_3d.json", weir_case_floating_box_scene_3d,
                  deep, weir_by_resolution(v, 2.0, 6.0, 6.0), 0.02);
    weir_plan_run(v, "neutral, 2D", "validation/floating_box/scene_neutral.json",
                  weir_case_floating_box_scene_neutral, flat, 5.0, 0.02);
    data->draught[0] = weir_curve_add(v, "Draught", "2D", "time", "s", "draught", "m", false);
    data->draught[1] = weir_curve_add(v, "Draught", "3D", "time", "s", "draught", "m", false);
    data->drift = weir_curve_add(v, "Drift of the neutral box", "distance from the start in spacings", "time",
                                 "s", "drift", "1", false);
    uint32_t exact =
        weir_curve_add(v, "Draught", "density ratio times height", "time", "s", "draught", "m", true);
    for (int k = 0; k < 2; ++k) weir_curve_push(v, exact, 8.0 * k, density_ratio * box_height[0]);
}

// Level of the water beside the box: probes between it and the walls.
static double water_level(const WeirSample *sample)
{
    double low = sample->scene->domain_min[0], width = sample->scene->domain_max[0] - low;
    double middle = 0.5 * (sample->scene->domain_min[2] + sample->scene->domain_max[2]);
    return 0.25 * (weir_measure_height(sample, low + 0.15 * width, middle) +
                   weir_measure_height(sample, low + 0.2 * width, middle) +
                   weir_measure_height(sample, low + 0.8 * width, middle) +
                   weir_measure_height(sample, low + 0.85 * width, middle));
}

static void sample(WeirValidation *v, const WeirSample *sample)
{
    Floating *data = v->data;
    uint32_t solid;
    if (!sample->state->solids || !weir_probe_target(sample->scene, "box", &solid)) return;
    const float *center = sample->state->solids[solid].position;
    if (v->run == NEUTRAL) {
        double distance2 = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            if (sample->time == 0.0) data->start[axis] = center[axis];
            distance2 +=
                ((double)center[axis] - data->start[axis]) * ((double)center[axis] - data->start[axis]);
        }
        weir_curve_push(v, data->drift, sample->time,
                        sqrt(distance2) / (double)sample->parameters->particle_spacing);
        return;
    }
    double bottom = (double)center[1] - 0.5 * box_height[v->run];
    weir_curve_push(v, data->draught[v->run], sample->time, water_level(sample) - bottom);
}

static void judge(WeirValidation *v)
{
    const Floating *data = v->data;
    static const char *const names[2] = {"draught of the floating box, 2D",
                                         "draught of the floating box, 3D"};
    for (int k = 0; k < 2; ++k) {
        double end = v->runs[k].info.end_time;
        weir_gate_add(v, names[k], "m", WEIR_GATE_RELATIVE,
                      weir_curve_mean(v, data->draught[k], 0.5 * end, end), density_ratio * box_height[k],
                      weir_limit(v, 0.1, 0.03));
    }
    weir_gate_add(v, "drift of the neutral box in 5 s, in spacings", "1", WEIR_GATE_AT_MOST,
                  weir_curve_max(v, data->drift, 0.0, 5.0), NAN, 1.0);
}

const WeirCase weir_case_floating_box = {
    .info = {"floating_box", "Floating and neutral boxes",
             "A box of half the water's density is let go 20 mm above its place and must float half in, in "
             "2D and 3D; "
             "a box of the water's density under water must stay. Draughts are means of the second half.",
             "Archimedes"},
    .data_size = sizeof(Floating),
    .plan = plan,
    .sample = sample,
    .judge = judge,
};
