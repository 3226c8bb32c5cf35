/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In place of the full-screen mode where it is not wanted (LIVE=no). */
#include <stdio.h>

#include "live/live.h"

bool live_run(const live_host *host, const char *script, live_work *work, char *error, size_t size) {
    (void)host, (void)script, (void)work;
    snprintf(error, size, "this fret has been built without the full-screen mode (LIVE=no)");
    return false;
}
