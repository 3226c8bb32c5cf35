/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two clocks: elapsed time and processor time. */
#include "text/clock.h"

#include <time.h>

static double seconds(clockid_t of) {
    struct timespec t;
    clock_gettime(of, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clock_wall(void) {
    return seconds(CLOCK_MONOTONIC);
}

double clock_worked(void) {
    return seconds(CLOCK_PROCESS_CPUTIME_ID);
}
