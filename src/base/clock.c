#include "base/clock.h"

#include <time.h>

static double now(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double fw_seconds(void) { return now(CLOCK_MONOTONIC); }
double fw_cpu_seconds(void) { return now(CLOCK_PROCESS_CPUTIME_ID); }
