/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loop of the full-screen mode, at a terminal or playing a script without one. */
#include "live/live.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "live/state.h"
#include "live/terminal.h"
#include "text/clock.h"

static double slice_began; /* [s] */

/* Is the time over that a frame may spend on running loads, or on keys? */
static bool late(void) {
    static const double SLICE = 0.0015; /* [s] */
    return clock_wall() - slice_began > SLICE;
}

static void session(live *l, live_work *work) {
    enum { IDLE = 1000, FRAME = 16 /* milliseconds */, MANY = 20 };
    double before = clock_wall(), last = clock_worked();
    while (!l->leave) {
        slice_began = clock_wall();
        live_refresh(l);
        const bool there = live_walk(l, late);
        const int busy = terminal_busy();
        const bool draws = l->changed && !busy;
        if (draws) {
            l->changed = false;
            live_draw(l);
        }
        const double now = clock_worked();
        work->frames += draws;
        work->total += now - last;
        work->worst = fmax(work->worst, now - last);
        last = now;
        const int pause = !there ? 0 : l->playing ? FRAME : l->changed ? busy : IDLE;
        int key = terminal_key(pause, l->host->stop);
        slice_began = clock_wall();
        if (key != KEY_AGAIN) /* then the program may have been stopped for long: what plays must not jump */
            live_play_on(l, slice_began - before);
        for (int many = 1; key != KEY_NONE; many++) { /* one frame for all keys that wait */
            live_key(l, key);
            key = many < MANY && !l->leave && !late() ? terminal_key(0, l->host->stop) : KEY_NONE;
        }
        before = clock_wall(); /* nor over the time that statements take */
    }
}

/* Plays a script without a terminal. Returns the text of the last screen; NULL: out of memory. */
static char *play_script(live *l) {
    static const double FRAME = 1.0 / 15;
    for (;;) {
        live_refresh(l);
        live_walk(l, NULL);
        live_draw(l);
        if (l->leave || *l->host->stop || (script_ends(l) && !l->playing))
            return canvas_text();
        if (l->playing)
            live_play_on(l, FRAME);
        else
            script_on(l);
    }
}

static void free_live(live *l) {
    for (size_t i = 0; i < COMPARED; i++)
        playback_end(&l->side[i].playback);
    for (size_t i = 0; i < l->kept_count; i++)
        free(l->kept[i]);
    free(l->page);
    free(l->script.before);
    free(l);
}

bool live_run(const live_host *host, const char *const *script, live_work *work, char **screen,
              calc_error *error) {
    live *l = calloc(1, sizeof *l);
    if (!l)
        return calc_no_memory(error);
    l->host = host;
    l->speed = 0.5;
    l->phase = 90;
    l->unseen = script && !(isatty(STDIN_FILENO) && isatty(STDOUT_FILENO));
    bool ok = (!script || script_open(l, script, error)) && terminal_open(l->unseen, error);
    if (ok) {
        live_update(l);
        if (!script)
            live_begin(l);
        else
            script_on(l);
        if (l->unseen)
            ok = (*screen = play_script(l)) || calc_no_memory(error);
        else
            session(l, work);
        terminal_close();
    }
    free_live(l);
    return ok;
}
