// Adapters for probes.
#include "web.h"
#include "weir/weir_probe.h"

// Fills name, kind and unit (their addresses), components and rate.
WEIR_WEB(weir_web_probe_info)
void weir_web_probe_info(const WeirProbes *probes, uint32_t index, double values[5])
{
    WeirProbeInfo info = weir_probe_info(probes, index);
    values[0] = (double)(uintptr_t)info.name;
    values[1] = (double)(uintptr_t)info.kind;
    values[2] = (double)(uintptr_t)info.unit;
    values[3] = info.components;
    values[4] = info.rate;
}

// Fills the number of samples and the addresses of their times and values.
WEIR_WEB(weir_web_probe_series)
void weir_web_probe_series(const WeirProbes *probes, uint32_t index, double values[3])
{
    WeirProbeSeries series = weir_probe_series(probes, index);
    values[0] = series.count;
    values[1] = (double)(uintptr_t)series.time;
    values[2] = (double)(uintptr_t)series.values;
}
