/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The screen as it changes, told to the host, which records it. */
#ifndef LIVE_FILM_H
#define LIVE_FILM_H

#include <stddef.h>

#include "live/live.h"

typedef struct film {
    struct film_cell *cell; /* as told last; NULL: nothing has been */
    void *row;              /* room for one of curses */
    int rows, cols;
} film;

/* What has changed on the screen of curses, as an xterm takes it, whatever the terminal is. After so many
 * seconds. cursor: it is seen. False: out of memory, and nothing is told. */
bool film_frame(film *f, const live_host *host, bool cursor, double seconds);
/* The screen is given back. */
void film_end(film *f, const live_host *host);

#endif
