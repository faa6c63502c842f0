#include "progress.h"
#include "output.h"

#include <string.h>
#include <unistd.h>

enum { BAR_WIDTH = 24 };
static const double terminal_interval = 0.1; // s
static const double line_interval = 1.0;     // s

void weir_progress_begin(WeirProgress *progress, bool enabled, uint64_t steps)
{
    double now = weir_wall_time();
    *progress = (WeirProgress){
        .enabled = enabled,
        .terminal = isatty(STDERR_FILENO),
        .start = now,
        .last_print = now,
        .steps = steps,
    };
}

void weir_progress_update(WeirProgress *progress, uint64_t step, double time)
{
    double now = weir_wall_time();
    double interval = progress->terminal ? terminal_interval : line_interval;
    if (!progress->enabled || now - progress->last_print < interval) return;
    progress->last_print = now;
    double share = progress->steps > 0 ? (double)step / (double)progress->steps : 1.0;
    double spent = now - progress->start;
    char left[32] = "?";
    if (step > 0) weir_format_seconds(spent * (1.0 / share - 1.0), left);
    if (progress->terminal) {
        char bar[BAR_WIDTH + 1];
        int filled = (int)(share * BAR_WIDTH);
        memset(bar, '.', BAR_WIDTH);
        memset(bar, '#', (size_t)filled);
        bar[BAR_WIDTH] = '\0';
        fprintf(stderr, "\r\033[K[%s] %3.0f %%  ", bar, 100.0 * share);
        progress->drawn = true;
    } else {
        fprintf(stderr, "%3.0f %%  ", 100.0 * share);
    }
    fprintf(stderr, "step %llu/%llu  time %.4g s  real-time factor %.3g  ETA %s%s", (unsigned long long)step,
            (unsigned long long)progress->steps, time, time / spent, left, progress->terminal ? "" : "\n");
    fflush(stderr);
}

void weir_progress_end(WeirProgress *progress)
{
    if (progress->drawn) fprintf(stderr, "\r\033[K");
    progress->drawn = false;
}
