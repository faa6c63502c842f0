#include "interrupt.h"

#include <signal.h>
#include <stddef.h>

// The one thing that a signal handler may touch.
static volatile sig_atomic_t stop_requested;

static void request_stop(int signal_number)
{
    (void)signal_number;
    stop_requested = 1;
}

void weir_cli_catch_interrupt(void)
{
    struct sigaction action = {.sa_handler = request_stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool weir_cli_interrupted(void)
{
    return stop_requested != 0;
}
