#include "progress.h"
#include "output.h"

#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { MIN_BAR = 6, MAX_BAR = 30 };          // columns
static const double terminal_interval = 0.1; // s
static const double line_interval = 1.0;     // s

void weir_progress_begin(WeirProgress *progress, bool enabled, uint64_t steps, double end_time)
{
    double now = weir_wall_time();
    *progress = (WeirProgress){
        .enabled = enabled,
        .terminal = isatty(STDERR_FILENO),
        .start = now,
        .last_print = now,
        .steps = steps,
        .end_time = end_time,
    };
}

static size_t terminal_columns(void)
{
    struct winsize size;
    bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

// The bar takes what the words leave of the line; a line that wraps could not be erased.
static void draw_bar(double share, char *words)
{
    size_t room = terminal_columns() - 1, length = strlen(words);
    char bar[MAX_BAR + 1] = "";
    if (length > room) words[room] = '\0';
    size_t width = room > length + 2 ? room - length - 2 : 0;
    if (width > MAX_BAR) width = MAX_BAR;
    for (size_t k = 0; k < width; ++k) bar[k] = (double)k + 0.5 < share * (double)width ? '#' : '.';
    if (width >= MIN_BAR) {
        fprintf(stderr, "\r\033[K[%s]%s", bar, words);
    } else {
        fprintf(stderr, "\r\033[K%s", words);
    }
}

void weir_progress_update(WeirProgress *progress, uint64_t step, double time)
{
    double now = weir_wall_time();
    double interval = progress->terminal ? terminal_interval : line_interval;
    if (!progress->enabled || now - progress->last_print < interval) return;
    progress->last_print = now;
    double share = progress->steps > 0 ? (double)step / (double)progress->steps : 1.0;
    if (progress->end_time > 0.0) share = time / progress->end_time;
    double spent = now - progress->start;
    char left[32] = "?", words[256], of[32] = "";
    if (step > 0) weir_format_seconds(spent * (1.0 / share - 1.0), left);
    if (progress->steps > 0) snprintf(of, sizeof of, "/%llu", (unsigned long long)progress->steps);
    snprintf(words, sizeof words, " %3.0f %%  step %llu%s  time %.4g s  real-time factor %.3g  ETA %s",
             100.0 * share, (unsigned long long)step, of, time, time / spent, left);
    if (progress->terminal) {
        draw_bar(share, words);
        progress->drawn = true;
    } else {
        fprintf(stderr, "%s\n", words + 1);
    }
    fflush(stderr);
}

void weir_progress_end(WeirProgress *progress)
{
    if (progress->drawn) fprintf(stderr, "\r\033[K");
    progress->drawn = false;
}
