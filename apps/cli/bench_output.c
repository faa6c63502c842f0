#include "bench_output.h"

#include <math.h>
#include <string.h>

// ---- One row ----

json_t *weir_bench_row_json(const WeirBenchRow *row)
{
    json_t *passes = json_object();
    for (uint32_t k = 0; k < row->pass_count; ++k)
        json_object_set_new(passes, row->passes[k].name, weir_json_number(row->passes[k].milliseconds));
    return json_pack(
        "{s:s, s:I, s:I, s:s, s:s, s:s, s:I, s:I, s:o, s:o, s:f, s:f, s:f, s:o, s:o, s:f, s:f, s:f, "
        "s:o, s:o}",
        "scene", row->scene, "particles", (json_int_t)row->particles, "all_particles", (json_int_t)row->all,
        "backend", row->backend, "device", row->device, "search", row->search, "threads",
        (json_int_t)row->threads, "repetitions", (json_int_t)row->repetitions, "mean_neighbors",
        weir_json_number(row->mean_neighbors), "candidates", weir_json_number(row->candidates), "ms_per_step",
        row->ms_per_step, "spread", row->spread, "particle_steps_per_second", row->particle_steps_per_second,
        "pairs_per_second", weir_json_number(row->pairs_per_second), "bytes_per_particle",
        weir_json_number(row->bytes_per_particle), "time_step", row->time_step, "real_time_factor",
        row->real_time_factor, "frames_per_second", row->frames_per_second, "relative",
        weir_json_number(row->relative), "passes", passes);
}

// A number, or an empty field where it is not known.
static void print_field(double value, const char *format)
{
    putchar(',');
    if (isfinite(value)) printf(format, value);
}

static void print_csv_row(const WeirBenchRow *row, bool header)
{
    if (header) {
        printf("scene,particles,all_particles,backend,device,search,threads,repetitions,mean_neighbors,"
               "candidates,ms_per_step,spread,particle_steps_per_second,pairs_per_second,bytes_per_particle,"
               "time_step,real_time_factor,frames_per_second,relative,passes\n");
    }
    printf("\"%s\",%u,%u,%s,\"%s\",%s,%u,%u", row->scene, row->particles, row->all, row->backend, row->device,
           row->search, row->threads, row->repetitions);
    print_field(row->mean_neighbors, "%.2f");
    print_field(row->candidates, "%.2f");
    print_field(row->ms_per_step, "%.6g");
    print_field(row->spread, "%.3f");
    print_field(row->particle_steps_per_second, "%.6g");
    print_field(row->pairs_per_second, "%.5g");
    print_field(row->bytes_per_particle, "%.1f");
    print_field(row->time_step, "%.4g");
    print_field(row->real_time_factor, "%.4g");
    print_field(row->frames_per_second, "%.4g");
    print_field(row->relative, "%.3f");
    printf(",\"");
    for (uint32_t k = 0; k < row->pass_count; ++k)
        printf("%s%s %.4g", k > 0 ? "; " : "", row->passes[k].name, row->passes[k].milliseconds);
    printf("\"\n");
}

static void print_table_row(const WeirBenchRow *row, bool header)
{
    if (header) {
        printf("%-13s %11s %-4s %-9s %7s %6s %6s %10s %6s %11s %9s %7s %10s %8s  %s\n", "case", "particles",
               "on", "search", "threads", "n", "cand.", "ms/step", "+-%", "M p-steps/s", "G pairs/s",
               "B/part.", "real-time", "relative", "device");
    }
    printf("%-13s %11u %-4s %-9s %7u %6.1f %6.0f %10.4g %6.1f %11.4g %9.3g %7.0f %10.3g ", row->scene,
           row->particles, row->backend, row->search, row->threads, row->mean_neighbors, row->candidates,
           row->ms_per_step, 50.0 * row->spread, 1e-6 * row->particle_steps_per_second,
           1e-9 * row->pairs_per_second, row->bytes_per_particle, row->real_time_factor);
    if (isfinite(row->relative)) {
        printf("%8.2f  %s\n", row->relative, row->device);
    } else {
        printf("%8s  %s\n", "-", row->device);
    }
}

void weir_bench_print(const WeirBenchRow *row, WeirBenchFormat format, bool header)
{
    if (format == WEIR_BENCH_CSV) print_csv_row(row, header);
    if (format == WEIR_BENCH_TABLE) print_table_row(row, header);
    fflush(stdout);
}
