/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The full-screen mode: its loop, and what its keys do to the scene. */
#include "live/live.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "live/state.h"
#include "live/terminal.h"

/* ---- statements -------------------------------------------------------------------------------- */

void live_tell(live *l, bool bad, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(l->status, sizeof l->status, format, args);
    va_end(args);
    l->bad = bad;
    l->changed = true;
}

/* One line goes to the status line, more to a page. */
static void tell_answer(live *l, const char *line, char *answer, bool ok) {
    size_t n = answer ? strlen(answer) : 0;
    while (n > 0 && answer[n - 1] == '\n')
        answer[--n] = 0;
    if (!n) {
        live_tell(l, !ok, "%s", line);
    } else if (!strchr(answer, '\n')) {
        live_tell(l, !ok, ok ? "%s" : "%s", answer);
    } else {
        live_tell(l, !ok, "%s", line);
        free(l->page);
        l->page = answer;
        l->page_from = 0;
        return;
    }
    free(answer);
}

bool live_say(live *l, const char *format, ...) {
    char line[LIVE_LINE], *answer = NULL;
    va_list args;
    va_start(args, format);
    const int n = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (n < 0 || n >= (int)sizeof line) {
        live_tell(l, true, "the line is too long");
        return false;
    }
    live_play_end(l);
    const bool ok = l->host->run(l->host->self, line, &answer);
    if (!ok && *l->host->stop)
        *l->host->stop = 0; /* the statement was interrupted, not the session */
    tell_answer(l, line, answer, ok);
    l->leave = l->leave || *l->host->quit;
    live_update(l);
    return ok;
}

double live_nice(double v) {
    const double ten = pow(10, floor(log10(v))), part = v / ten;
    return ten * (part < 1.5 ? 1 : part < 3.5 ? 2 : part < 7.5 ? 5 : 10);
}

void live_amount(double v, dim d, char *text, size_t size) {
    char in[32], number[40];
    const double scale = (double)unit_choose(d, v, 3, in, sizeof in);
    snprintf(number, sizeof number, "%.3g", v / scale);
    snprintf(text, size, "%s%s%s", number, *in ? " " : "", in);
}

/* ---- what is shown ----------------------------------------------------------------------------- */

const shot *side_shown(const live *l, const side *s) {
    if (!l->playing || !s->shots)
        return &s->now;
    size_t i = 0;
    while (i + 1 < s->shots && s->play[i + 1].time <= l->play_at)
        i++;
    return &s->play[i];
}

static void trouble(live *l, side *s, calc_error *error) {
    calc_word(l->host->calc, error);
    snprintf(s->trouble, sizeof s->trouble, "%.*s", LIVE_TEXT - 1, error->text);
}

/* Of the scene that expressions see; along: the way of the last item too. */
static bool take(live *l, side *s, bool along, calc_error *error) {
    calc *c = l->host->calc;
    const size_t before = s->shots;
    s->trouble[0] = 0;
    s->shots = 0;
    if (!shot_take(c, NULL, &s->now, error))
        return false;
    if (along && !s->play)
        s->play = calloc(PLAY_SHOTS, sizeof *s->play);
    if (along && s->play && shots_again(&s->path, c, &s->now, s->play, before))
        s->shots = before;
    else if (along && s->play && !shots_along(c, s->play, PLAY_SHOTS, &s->shots, error))
        return false;
    return track_follow(&s->path, c, &s->now, s->play, s->shots, error);
}

static bool take_compared(live *l, side *s, size_t i, bool along, calc_error *error) {
    trial *t = trial_open(l->host->calc, error);
    const bool ok = t && trial_set(t, &l->compared, l->compared_with[i], error) && take(l, s, along, error);
    if (t)
        trial_close(t);
    return ok;
}

static void update(live *l, bool along) {
    l->stale = false;
    for (size_t i = 0; i < (l->comparing ? SIDES : 1); i++) {
        calc_error error;
        error_clear(&error);
        side *s = &l->side[i];
        if (!(l->comparing ? take_compared(l, s, i, along, &error) : take(l, s, along, &error)))
            trouble(l, s, &error);
    }
    l->changed = true;
}

void live_update(live *l) {
    l->stale = true;
    l->changed = true;
    if (l->follow)
        live_refresh(l);
}

void live_refresh(live *l) {
    if (!l->stale)
        return;
    update(l, l->follow);
    const shot *s = &l->side[0].now;
    if (!(l->FA > 0) && s->slip > 0 && !*l->side[0].trouble) /* half of what would slide it */
        l->FA = live_nice(s->slip / 2);
}

void live_begin(live *l) {
    const inputs *in = &l->host->calc->scene.in;
    char line[LIVE_LINE] = "";
    const struct {
        bool missing;
        const char *statement;
    } first[] = {{!in->set[IN_E0] && !in->bound[IN_E0], "material E0=210 GPa nu=0.3 k=0 c0=1 mm"},
                 {!in->geometry, "geometry sphere R=10 mm"},
                 {!in->set[IN_MU] && !in->bound[IN_MU], "friction 0.4"},
                 {!l->host->calc->scene.end.steps, "press FN=100 N"}};
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (first[i].missing) {
            const size_t n = strlen(line);
            snprintf(line + n, sizeof line - n, "%s%s", n ? "; " : "", first[i].statement);
        }
    if (*line)
        live_say(l, "%s", line);
    else
        live_update(l);
}

/* ---- a cycle that plays ------------------------------------------------------------------------ */

/* From where the last item of the load begins to move. */
static void start_play(live *l) {
    const side *s = &l->side[0];
    if (*s->trouble || !s->shots)
        return;
    size_t first = 0; /* what stands still at the beginning, after another cycle, is left out */
    while (first + 1 < s->shots && s->play[first + 1].Fx == s->play[0].Fx &&
           s->play[first + 1].a == s->play[0].a)
        first++;
    if (first + 1 == s->shots)
        return;
    l->play_at = s->play[first].time;
    l->playing = true;
}

static void start_cycle(live *l) {
    char FA[40], FNA[80] = "", swing[40];
    live_amount(l->FA, DIM_FORCE, FA, sizeof FA);
    if (l->FNA > 0) {
        live_amount(l->FNA, DIM_FORCE, swing, sizeof swing);
        snprintf(FNA, sizeof FNA, " FNA=%s phase=%g deg", swing, l->phase);
    }
    l->follow = true;
    const bool ok = live_say(l, "cycle FA=%s%s", FA, FNA);
    l->follow = false;
    if (ok)
        start_play(l);
}

void live_play(live *l) {
    l->last_cycle = false;
    start_cycle(l);
}

void live_play_item(live *l) {
    l->last_cycle = true;
    update(l, true);
    start_play(l);
}

void live_play_end(live *l) {
    l->playing = false;
    l->changed = true;
}

void live_play_on(live *l, double seconds) {
    if (!l->playing)
        return;
    const side *s = &l->side[0];
    l->play_at += seconds * l->speed;
    l->changed = true;
    if (s->shots && l->play_at < s->play[s->shots - 1].time)
        return;
    live_play_end(l);
    if (!l->last_cycle)
        start_cycle(l);
}

/* ---- the loop ---------------------------------------------------------------------------------- */

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Of the processor: how busy the machine is and how slow the terminal is no work of ours. */
static double worked(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void count_frame(live_work *work, double spent) {
    work->frames++;
    work->total += spent;
    work->worst = fmax(work->worst, spent);
}

static void session(live *l, live_work *work) {
    enum { IDLE = 1000 /* milliseconds */, MANY = 20 };
    const int frame = terminal_frame();
    double before = seconds(), filmed = before, last = worked();
    while (!l->leave) {
        double start = seconds();
        if (l->changed) {
            l->changed = false;
            live_draw(l);
            const double now = worked();
            count_frame(work, now - last);
            last = now;
            film_frame(&l->film, l->host, l->typing, start - filmed);
            filmed = start;
        }
        int key = terminal_key(l->playing ? frame : IDLE, l->host->stop);
        start = seconds();
        for (int many = 1; key != KEY_NONE; many++) { /* held keys: one frame for all that wait */
            live_key(l, key);
            key = many < MANY && !l->leave ? terminal_key(0, l->host->stop) : KEY_NONE;
        }
        live_play_on(l, start - before);
        before = start;
    }
}

/* Nobody is there: the script goes on by itself, with time to read. */
static void play_script(live *l) {
    static const double FRAME = 1.0 / 15, READING = 1.5, READING_SIGN = 0.04;
    double passed = 0;
    while (!l->leave && !*l->host->stop) {
        live_draw(l);
        film_frame(&l->film, l->host, l->typing, passed);
        if (l->playing) {
            live_play_on(l, passed = FRAME);
        } else {
            passed = READING + READING_SIGN * (double)(strlen(l->note) + strlen(l->status));
            if (script_ends(l))
                break;
            script_on(l);
        }
    }
    live_draw(l);
    film_frame(&l->film, l->host, l->typing, passed);
}

static void end(live *l) {
    for (size_t i = 0; i < SIDES; i++) {
        track_free(&l->side[i].path);
        free(l->side[i].play);
    }
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
    const bool ok = (!script || script_open(l, script, error)) &&
                    (unseen ? terminal_open_unseen(cols, rows, error) : terminal_open(error));
    if (ok) {
        if (!script)
            live_begin(l);
        else
            script_on(l);
        if (unseen)
            play_script(l);
        else
            session(l, work);
        film_end(&l->film, host);
        terminal_close();
    }
    end(l);
    return ok;
}
