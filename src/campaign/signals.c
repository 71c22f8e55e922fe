#include "campaign/signals.h"

#include <signal.h>
#include <stddef.h>
#include <time.h>
#include <unistd.h>

/* The one mutable global of the program: a signal handler has nothing else to write to. */
static volatile sig_atomic_t signals_first;
static struct timespec       signals_time; /* when the first came; read by the handler only */

/* One request can arrive twice within moments (from the batch system and from mpirun): that is not a second request. */
static const double signals_echo = 0.2; /* [s] */

static void signals_handle(int number)
{
    struct timespec now;
    double          age;

    clock_gettime(CLOCK_MONOTONIC, &now);
    if (!signals_first) {
        signals_time  = now;
        signals_first = number;
        return;
    }
    age = (double)(now.tv_sec - signals_time.tv_sec) + 1e-9 * (double)(now.tv_nsec - signals_time.tv_nsec);
    if (age > signals_echo) _exit(75); /* the journal holds all but the last second: run again to go on */
}

void fw_signals_catch(void)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGHUP};
    struct sigaction action    = {.sa_handler = signals_handle, .sa_flags = SA_RESTART};

    sigfillset(&action.sa_mask);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        struct sigaction old;

        if (numbers[i] == SIGHUP && sigaction(SIGHUP, NULL, &old) == 0 && old.sa_handler == SIG_IGN) continue;
        sigaction(numbers[i], &action, NULL);
    }
}

int fw_signals_received(void)
{
    return signals_first;
}

fw_status fw_signals_tick(void *self, double done)
{
    (void)self;
    (void)done;
    return fw_signals_received() ? FW_E_STOPPED : FW_OK;
}
