// Probes: the numbers that a scene's "probes" ask for, sampled while a simulation runs.
//
//   WeirProbes *probes = weir_probes_create(sim);
//   weir_probes_run_until(probes, sim, 2.0);            // or weir_sim_step() and weir_probes_update() in turn
//   weir_probe_series(probes, 0) ...
#pragma once

#include "weir/weir.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct WeirProbes WeirProbes;

typedef struct WeirProbeInfo {
    const char *name;    // as in the scene; "probe K" if it has none
    const char *kind;    // "pressure", "velocity", "height", "force", "front" or "mass"
    const char *unit;    // of the values
    uint32_t components; // values per sample: the dimension for velocity and force, else 1
    double rate;         // samples per simulated second
} WeirProbeInfo;

// All samples that a probe has so far; valid until the probes change.
typedef struct WeirProbeSeries {
    uint32_t count;
    const double *time;   // s, rising
    const double *values; // `components` per sample; NaN where there was nothing to measure
} WeirProbeSeries;

// Probes of the simulation's scene, without samples. NULL if memory runs out. Must not outlive the simulation.
WeirProbes *weir_probes_create(const WeirSim *sim);
void weir_probes_destroy(WeirProbes *probes); // NULL is allowed
uint32_t weir_probes_count(const WeirProbes *probes);
WeirProbeInfo weir_probe_info(const WeirProbes *probes, uint32_t index);
WeirProbeSeries weir_probe_series(const WeirProbes *probes, uint32_t index);
// When the next sample of any probe is due, s; infinite without probes.
double weir_probes_next_time(const WeirProbes *probes);
// Samples the probes that are due at the simulation's present time. WEIR_PENDING as weir_sim_read(): call again; a sample
// has the time of the state that was measured, which is that of the first call. A GPU with `wcsph` hands over no more than
// what they look at.
WeirStatus weir_probes_update(WeirProbes *probes, WeirSim *sim);
// weir_sim_run_until() that stops at each sample's time. WEIR_PENDING in a browser: call again.
WeirStatus weir_probes_run_until(WeirProbes *probes, WeirSim *sim, double time);
// Forgets all samples, as after weir_sim_reset().
void weir_probes_clear(WeirProbes *probes);

#ifdef __cplusplus
}
#endif
