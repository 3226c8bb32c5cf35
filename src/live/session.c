/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The full-screen mode: its loop, and what it costs. */
#include "live/live.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "live/state.h"
#include "live/terminal.h"
#include "text/clock.h"

static void count_work(live_work *work, bool frame, double spent) {
    work->frames += frame;
    work->total += spent;
    work->worst = fmax(work->worst, spent);
}

/* Ways are walked a little in each frame. */
static double walked_from;

static bool late(void) {
    static const double SLICE = 0.0015;
    return clock_wall() - walked_from > SLICE;
}

/* Is there more to walk? */
static bool walks(const live *l) {
    for (size_t i = 0; i < live_sides(l); i++)
        if (!*l->side[i].trouble && !way_rests(&l->side[i].way))
            return true;
    return false;
}

static bool film_now(live *l, double seconds) {
    const bool ok = film_frame(&l->film, l->host, l->typing, seconds);
    if (!ok)
        live_tell(l, true, "out of memory: a frame is not recorded");
    return ok;
}

static void session(live *l, live_work *work) {
    enum { IDLE = 1000, FRAME = 16 /* milliseconds */, MANY = 20 };
    double before = clock_wall(), filmed = before, last = clock_worked();
    while (!l->leave) {
        double start = clock_wall();
        walked_from = start;
        const bool fresh = !live_refresh_next(l); /* one scene at a time: keys must not wait for both */
        if (fresh)
            live_walk(l, late);
        const int busy = terminal_busy();
        const bool draws = fresh && l->changed && !busy;
        if (draws) {
            l->changed = false;
            live_draw(l);
        }
        const double now = clock_worked();
        count_work(work, draws, now - last);
        last = now;
        if (draws) {
            film_now(l, start - filmed);
            filmed = start;
        }
        const int pause = !fresh ? 0 : l->playing || walks(l) ? FRAME : l->changed ? busy : IDLE;
        int key = terminal_key(pause, l->host->stop);
        walked_from = start = clock_wall();
        bool away = false;
        for (int many = 1; key != KEY_NONE; many++) { /* held keys: one frame for all that wait */
            away = away || key == KEY_AGAIN;
            live_key(l, key);
            key = many < MANY && !l->leave && !late() ? terminal_key(0, l->host->stop) : KEY_NONE;
        }
        if (away) /* perhaps stopped for long: what plays must not jump */
            before = start = clock_wall();
        live_play_on(l, start - before);
        before = start;
    }
    live_play_end(l);
}

/* For a recording without a terminal. False: the last frame is not recorded. */
static bool play_script(live *l, calc_error *error) {
    static const double FRAME = 1.0 / 15, READING = 1.5, READING_SIGN = 0.04;
    double passed = 0;
    while (!l->leave && !*l->host->stop) {
        live_refresh(l);
        live_walk(l, NULL);
        live_draw(l);
        film_now(l, passed);
        if (l->playing) {
            live_play_on(l, passed = FRAME);
        } else {
            passed = READING + READING_SIGN * (double)(strlen(l->note) + strlen(l->status));
            if (script_ends(l))
                break;
            script_on(l);
        }
    }
    live_refresh(l);
    live_walk(l, NULL);
    live_draw(l);
    return film_now(l, passed) || calc_no_memory(error);
}

static void free_live(live *l) {
    for (size_t i = 0; i < SIDES; i++)
        way_end(&l->side[i].way);
    for (size_t i = 0; i < l->kept_count; i++)
        free(l->kept[i]);
    free(l->page);
    script_close(l);
    free(l);
}

bool live_run(const live_host *host, const char *script, live_work *work, calc_error *error) {
    live *l = calloc(1, sizeof *l);
    *work = (live_work){0, 0, 0};
    if (!l)
        return calc_no_memory(error);
    l->host = host;
    l->speed = 0.5;
    l->phase = 90;
    int cols, rows;
    const bool unseen = script && !terminal_there() && host->filming(host->self, &cols, &rows);
    bool ok = (!script || script_open(l, script, error)) &&
              (unseen ? terminal_open_unseen(cols, rows, error) : terminal_open(error));
    if (ok) {
        if (!script)
            live_begin(l);
        else
            script_on(l);
        if (unseen)
            ok = play_script(l, error);
        else
            session(l, work);
        film_end(&l->film, host);
        terminal_close();
    }
    free_live(l);
    return ok;
}
