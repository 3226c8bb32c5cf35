/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Replaces the full-screen mode when built with LIVE=no. */
#include "live/live.h"

void live_keys(FILE *to) {
    fputs("    This fret has been built without it (LIVE=no).\n", to);
}

bool live_run(const live_host *host, const char *const *script, live_work *work, char **screen,
              calc_error *error) {
    (void)host, (void)script, (void)work, (void)screen;
    return calc_fail(error, 0, 0, "this fret has been built without the full-screen mode (LIVE=no)");
}
